// What a chart shows of a million values: the least and the largest of each stretch that is a pixel wide.

// Values that are looked at together where all of them fall into one stretch.
const BLOCK = 64;

// What a chart looks at: where values end along time or path, the values, and whether each holds (a step) or goes straight from the one
// before; and the least and largest of each block.
function curve(program, quantity, along) {
  const holds = quantity !== "z";
  const ends = holds ? program.along(along) : program.vertexAlong(along);
  const values = holds ? program[quantity] : program.z;
  if (!values) return null;
  const start = (i) => (holds || i === 0 || program.isStart[i] ? values[i] : values[i - 1]);
  program.blocks ??= {};
  const blocks = (program.blocks[quantity] ??= blocksOf(values, start));
  return { ends, values, start, blocks, holds, lift: holds ? 0 : facts.origin[2] };
}

function blocksOf(values, start) {
  const count = Math.floor(values.length / BLOCK);
  const low = new Float32Array(count).fill(Infinity), high = new Float32Array(count).fill(-Infinity);
  for (let block = 0, i = 0; block < count; block++) {
    // Where the block begins its values come from.
    const from = start(i);
    let least = from, most = from;
    if (!(from === from)) [least, most] = [Infinity, -Infinity];
    for (const end = i + BLOCK; i < end; i++) {
      const value = values[i];
      if (value < least) least = value;
      if (value > most) most = value;
    }
    low[block] = least;
    high[block] = most;
  }
  return { low, high };
}

// The least and largest value in each of `count` stretches of from..to.
function stretches(program, quantity, along, from, to, count) {
  const low = new Float64Array(count).fill(Infinity), high = new Float64Array(count).fill(-Infinity);
  const scale = count / (to - from), shown = curve(program, quantity, along);
  if (!shown || !(scale > 0)) return { low, high };
  const { ends, values, start, blocks, holds, lift } = shown;
  const take = (at, least, most) => {
    if (least + lift < low[at]) low[at] = least + lift;
    if (most + lift > high[at]) high[at] = most + lift;
  };
  for (let i = Math.max(countUpTo(ends, from) - 1, 0); i < ends.length; i++) {
    const begin = i > 0 ? ends[i - 1] : 0;
    if (begin > to) break;
    const first = Math.floor((begin - from) * scale), block = i / BLOCK;
    if (i % BLOCK === 0 && block < blocks.low.length && first >= 0
        && Math.floor((ends[i + BLOCK - 1] - from) * scale) === first && first < count) {
      if (blocks.low[block] <= blocks.high[block]) take(first, blocks.low[block], blocks.high[block]);
      i += BLOCK - 1;
      continue;
    }
    const end = ends[i], one = start(i), other = values[i];
    if (end < from || other !== other) continue;
    const last = Math.min(Math.floor((end - from) * scale), count - 1);
    for (let at = Math.max(first, 0); at <= last; at++) {
      if (holds || first === last) {
        take(at, Math.min(one, other), Math.max(one, other));
        continue;
      }
      const value = (place) => one + (other - one) * Math.min(Math.max((from + place / scale - begin) / (end - begin), 0), 1);
      take(at, Math.min(value(at), value(at + 1)), Math.max(value(at), value(at + 1)));
    }
  }
  return { low, high };
}

// Colours of motions.

// Viridis (Smith and van der Walt, CC0): even steps for the eye, also in grey and for the colour-blind.
const RAMP = [
  [68, 1, 84], [71, 44, 122], [59, 81, 139], [44, 113, 142], [33, 144, 141], [39, 173, 129], [92, 200, 99], [170, 220, 50],
  [246, 210, 30],
];
const RAPID_COLOR = [190, 197, 205];
const CRASH_COLOR = [230, 0, 0];
const UNKNOWN_COLOR = [150, 155, 160];
const CLASS_COLORS = [
  RAPID_COLOR, [86, 180, 233], [230, 120, 0], [0, 90, 181], [0, 158, 115], [204, 121, 167], [150, 60, 60],
];
const CHANGES = ["as it was", "slower", "faster", "elsewhere, new or gone"];
const CHANGE_COLORS = [[175, 182, 190], [0, 90, 181], [0, 150, 70], [214, 51, 108]];
const MANY_COLORS = [[0, 90, 181], [230, 120, 0], [0, 158, 115], [204, 121, 167], [86, 180, 233], [150, 60, 60], [120, 120, 0]];

const rampTable = Array.from({ length: 256 }, (_, i) => {
  const at = (i / 255) * (RAMP.length - 1), low = Math.min(Math.floor(at), RAMP.length - 2), share = at - low;
  return RAMP[low].map((value, part) => Math.round(value + (RAMP[low + 1][part] - value) * share));
});

// The range of a quantity over all programs.
function rangeOf(programs, quantity) {
  let low = Infinity, high = -Infinity;
  for (const program of programs) {
    for (let motion = 0; motion < program.count; motion++) {
      const value = program.value(quantity, motion);
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  return low <= high ? [low, high] : [0, 1];
}

// How motions are coloured: `color(program, motion)` and what the legend says. A crash is red in every mode.
function coloring(mode, programs) {
  const plain = plainColoring(mode, programs);
  const crashes = programs.some((program) => program.flags.some((flags) => flags & CRASH));
  const color = (program, motion) => program.flags[motion] & CRASH ? CRASH_COLOR : plain.color(program, motion);
  return { ...plain, color, crashes };
}

function plainColoring(mode, programs) {
  const rapid = (program, motion) => program.flags[motion] & RAPID;
  const listed = (names, colors, index) => ({
    color: (program, motion) => colors[index(program, motion) % colors.length],
    names: names.map((name, i) => [name, colors[i % colors.length]]),
  });
  if (mode === "class") return listed(facts.classes, CLASS_COLORS, (program, motion) => program.class[motion]);
  if (mode === "change") return listed(CHANGES, CHANGE_COLORS, (program, motion) => program.change[motion]);
  if (mode === "operation") {
    const names = programs[programs.length - 1].operations.slice(0, 12);
    return listed(names.map((name) => name || "(no name)"), MANY_COLORS, (program, motion) => program.operation[motion]);
  }
  const [low, high] = rangeOf(programs, mode), scale = high > low ? 255 / (high - low) : 0;
  const color = (program, motion) => {
    if (rapid(program, motion)) return RAPID_COLOR;
    const value = program.value(mode, motion);
    return value === value ? rampTable[Math.round((value - low) * scale)] : UNKNOWN_COLOR;
  };
  return { color, range: [low, high], quantity: mode };
}

function showLegend(element, coloring) {
  element.replaceChildren();
  const named = (name, [r, g, b]) => {
    const line = document.createElement("div"), swatch = document.createElement("i");
    swatch.style.background = `rgb(${r},${g},${b})`;
    line.append(swatch, name);
    element.append(line);
  };
  if (coloring.range) showRange(element, coloring);
  else coloring.names.forEach(([name, color]) => named(name, color));
  if (coloring.crashes) named("crash: shank or holder in material, or rapid through it", CRASH_COLOR);
}

function showRange(element, coloring) {
  const { title } = QUANTITIES[coloring.quantity];
  const strip = document.createElement("canvas");
  [strip.width, strip.height] = [256, 1];
  const context = strip.getContext("2d");
  rampTable.forEach(([r, g, b], i) => { context.fillStyle = `rgb(${r},${g},${b})`; context.fillRect(i, 0, 1, 1); });
  const ends = document.createElement("div");
  ends.className = "ends";
  for (const value of coloring.range) ends.append(Object.assign(document.createElement("span"), { textContent: printed(coloring.quantity, value) }));
  element.append(title, document.createElement("br"), strip, ends);
}

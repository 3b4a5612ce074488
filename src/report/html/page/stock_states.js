// The stock at a place of the program: the last state that the simulation kept before it, lowered along the path since then.

const UNCHANGED = -1;

// The heights of the points around the axis of an upright cutter over its tip, by the square of their distance.
function cutterHeights(profile, count = 512) {
  const radius = Math.max(...profile.map(([r]) => r)), heights = new Float32Array(count + 1);
  let at = 0;
  for (let i = 0; i <= count; i++) {
    const r = Math.sqrt(i / count) * radius;
    while (at < profile.length - 2 && profile[at + 1][0] < r) at++;
    const [[r0, z0], [r1, z1]] = [profile[at], profile[at + 1] ?? profile[at]];
    heights[i] = r1 > r0 ? z0 + (z1 - z0) * Math.min(Math.max((r - r0) / (r1 - r0), 0), 1) : z0;
  }
  return { radius, heights, scale: count / (radius * radius) };
}

// Calls `touch(cell, height)` for each cell that an upright cutter passes over from `a` to `b`, with how low it comes there.
function sweepCells(cutter, a, b, grid, touch) {
  const { radius, heights, scale } = cutter, { cell, columns, rows, x0, y0 } = grid;
  const first = (low, origin) => Math.max(Math.ceil((low - radius - origin) / cell), 0);
  const last = (high, origin, count) => Math.min(Math.floor((high + radius - origin) / cell), count - 1);
  const c0 = first(Math.min(a[0], b[0]), x0), c1 = last(Math.max(a[0], b[0]), x0, columns);
  const r0 = first(Math.min(a[1], b[1]), y0), r1 = last(Math.max(a[1], b[1]), y0, rows);
  const dx = b[0] - a[0], dy = b[1] - a[1], dz = b[2] - a[2], long = dx * dx + dy * dy;
  for (let row = r0; row <= r1; row++) {
    for (let column = c0; column <= c1; column++) {
      const px = x0 + column * cell - a[0], py = y0 + row * cell - a[1];
      const share = long > 0 ? (px * dx + py * dy) / long : 0, ox = px - share * dx, oy = py - share * dy;
      const room = radius * radius - (ox * ox + oy * oy);
      if (room < 0) continue;
      // Where on its way the cutter is over the cell.
      const half = long > 0 ? Math.sqrt(room / long) : 0, from = Math.max(share - half, 0), to = Math.min(share + half, 1);
      if (long > 0 && from > to) continue;
      let low = Infinity;
      const at = (t) => {
        const ex = px - t * dx, ey = py - t * dy, place = Math.min((ex * ex + ey * ey) * scale, heights.length - 1);
        const z = a[2] + t * dz + heights[Math.floor(place)];
        if (z < low) low = z;
      };
      if (long === 0) { if (dz < 0) at(1); else at(0); } else {
        at(Math.min(Math.max(share, from), to));
        if (dz !== 0) for (let i = 0; i <= 6; i++) at(from + ((to - from) * i) / 6);
      }
      touch(row * columns + column, low);
    }
  }
}

class StockStates {
  constructor(program) {
    const { columns, rows, cell, first, low } = facts.stock, [ox, oy, oz] = facts.origin;
    Object.assign(this, { program, kept: program.kept, cells: columns * rows });
    // Cells count from the drawing's origin, as the path does.
    this.grid = { columns, rows, cell, x0: first[0] - ox, y0: first[1] - oy };
    this.base = low - oz;
    this.decode(program.stock);
    this.cutters = program.shapes.map((shape) => shape && cutterHeights(shape.profile));
    this.upright = !program.k;
    this.now = { motions: -1, heights: new Float32Array(this.cells) };
  }

  decode(all) {
    for (let i = this.cells; i < all.length; i++) if (all[i] === UNCHANGED) all[i] = all[i - this.cells];
    this.states = this.kept.map((_, state) => all.subarray(state * this.cells, (state + 1) * this.cells));
  }

  get last() { return this.states[this.states.length - 1]; }

  // The last state that was kept when `motions` motions were done.
  stateBefore(motions) { return Math.max(countUpTo(this.kept, motions) - 1, 0); }

  // Heights over the base after `motions` motions, and after how many they really are. Tilted tools lower nothing here: then the
  // last state that was kept is shown.
  after(motions) {
    const state = this.stateBefore(motions), { now } = this;
    if (now.motions > motions || now.motions < this.kept[state] || !this.upright) {
      now.heights.set(this.states[state]);
      now.motions = this.kept[state];
    }
    if (this.upright) {
      for (; now.motions < motions; now.motions++) this.lower(now.motions, now.heights);
    }
    return now;
  }

  lower(motion, heights) {
    this.sweep(motion, (cell, z) => { if (z - this.base < heights[cell]) heights[cell] = Math.max(z - this.base, 0); });
  }

  sweep(motion, touch) {
    const { program } = this, cutter = this.cutters[program.tool[motion]], { x, y, z } = program;
    if (!cutter) return;
    const end = program.ends[motion], start = motion ? program.ends[motion - 1] : 0;
    for (let i = start; i < end; i++) {
      if (i === 0 || program.isStart[i]) continue;
      sweepCells(cutter, [x[i - 1], y[i - 1], z[i - 1]], [x[i], y[i], z[i]], this.grid, touch);
    }
  }

  // Which motion made the surface of each cell, found in pieces that leave the page alive. `told` gets the share that is done.
  async owners(told) {
    if (this.owner) return this.owner;
    const owner = new Int32Array(this.cells).fill(-1), lowest = new Float32Array(this.cells).fill(Infinity);
    let pause = performance.now() + 40;
    for (let motion = 0; motion < this.program.count; motion++) {
      // Of motions at one height the first one made the surface.
      this.sweep(motion, (cell, z) => { if (z < lowest[cell] - 1e-5) { lowest[cell] = z; owner[cell] = motion; } });
      if (motion % 256 || performance.now() < pause) continue;
      told(motion / this.program.count);
      await new Promise((done) => setTimeout(done));
      pause = performance.now() + 40;
    }
    // What no tool came near is as it was raw.
    for (let cell = 0; cell < this.cells; cell++) {
      if (Math.abs(lowest[cell] - this.base - this.last[cell]) > 2 * this.grid.cell) owner[cell] = -1;
    }
    return (this.owner = owner);
  }
}

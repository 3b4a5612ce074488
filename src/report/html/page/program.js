// A program as its arrays tell it, and the places in it: motions, vertices, rows of the listing.

const NONE = 0xffffffff;
const RAPID = 1, JUMPS = 2, CRASH = 4;

// The unit of lengths, and the digits that they have more than in mm. A page without a drawing has none.
const LENGTH = facts.units?.length.name, MORE = facts.units?.length.more ?? 0;

// Names, units and digits of what a motion has.
const QUANTITIES = {
  feed: { title: "feed", unit: facts.units?.feed.name, digits: 0 + (facts.units?.feed.more ?? 0) },
  chip: { title: "thickest chip", unit: LENGTH, digits: 4 + MORE },
  removal: { title: "largest removal rate", unit: facts.units?.removal.name, digits: 0 + (facts.units?.removal.more ?? 0) },
  force: { title: "largest force", unit: "N", digits: 0 },
  torque: { title: "largest torque", unit: "N m", digits: 2 },
  power: { title: "largest power", unit: "kW", digits: 3 },
  deflection: { title: "largest deflection", unit: LENGTH, digits: 4 + MORE },
  stress: { title: "largest bending stress", unit: "MPa", digits: 0 },
  z: { title: "z", unit: LENGTH, digits: 3 + MORE },
};

// How many entries of a growing array are at most `value`.
function countUpTo(array, value) {
  let low = 0, high = array.length;
  while (low < high) {
    const middle = (low + high) >>> 1;
    if (array[middle] <= value) low = middle + 1; else high = middle;
  }
  return low;
}

class Program {
  constructor(arrays, told) {
    this.name = told.name;
    this.tools = told.tools;
    this.operations = told.operations;
    this.loads = told.loads;
    this.shapes = told.shapes;
    this.kept = told.kept;
    for (const [name, array] of Object.entries(arrays)) {
      const [side, what] = name.split(".");
      if (side === told.name) this[what] = array;
    }
    this.count = this.ends.length;
    this.alongTime = this.sum(this.seconds);
    this.alongPath = this.sum(this.length);
    // The motion of each vertex; a vertex where a jump ends belongs to the motion that begins there, and ends no segment.
    this.motionOf = new Uint32Array(this.x.length);
    this.isStart = new Uint8Array(this.x.length);
    for (let motion = 0, vertex = 0; motion < this.count; motion++) {
      if (this.flags[motion] & JUMPS) this.isStart[vertex] = 1;
      for (; vertex < this.ends[motion]; vertex++) this.motionOf[vertex] = motion;
    }
    this.spread = {};
  }

  sum(parts) {
    const sums = new Float64Array(parts.length);
    let sum = 0;
    for (let i = 0; i < parts.length; i++) sums[i] = sum += parts[i];
    return sums;
  }

  // Where each motion ends along time (s) or path.
  along(what) { return what === "time" ? this.alongTime : this.alongPath; }

  // Where each vertex is along time or path: a motion's vertices by their share of its length.
  vertexAlong(what) {
    if (this.spread[what]) return this.spread[what];
    const { x, y, z, ends } = this, sums = this.along(what), at = new Float64Array(x.length);
    for (let motion = 0, vertex = 0; motion < this.count; motion++) {
      const from = motion ? sums[motion - 1] : 0, step = sums[motion] - from, first = vertex;
      let length = 0;
      for (; vertex < ends[motion]; vertex++) {
        if (vertex > 0 && !this.isStart[vertex]) {
          length += Math.hypot(x[vertex] - x[vertex - 1], y[vertex] - y[vertex - 1], z[vertex] - z[vertex - 1]);
        }
        at[vertex] = length;
      }
      for (let i = first; i < vertex; i++) at[i] = from + step * (length > 0 ? at[i] / length : 1);
    }
    return (this.spread[what] = at);
  }

  // The motion at a place along time or path.
  motionAt(what, place) {
    return Math.min(countUpTo(this.along(what), place), this.count - 1);
  }

  // The motion of a row: the first that ends there or later.
  motionOfRow(row) {
    return Math.min(row > 0 ? countUpTo(this.row, row - 1) : 0, this.count - 1);
  }

  // The vertex a motion ends at.
  lastVertex(motion) { return Math.max(this.ends[motion] - 1, 0); }

  point(vertex) {
    return [this.x[vertex], this.y[vertex], this.z[vertex]].map((value, axis) => value + facts.origin[axis]);
  }

  // A value of a motion; z is where it ends.
  value(quantity, motion) {
    if (quantity === "z") return this.z[this.lastVertex(motion)] + facts.origin[2];
    return this[quantity] ? this[quantity][motion] : NaN;
  }
}

// A value as people read it; empty where it is not known.
function printedNumber(quantity, value) {
  return Number.isFinite(value) ? grouped(value.toFixed(QUANTITIES[quantity].digits)) : "";
}

function printed(quantity, value) {
  const number = printedNumber(quantity, value);
  return number && `${number} ${QUANTITIES[quantity].unit}`;
}

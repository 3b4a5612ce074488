// The path of a program as lines.

// What the eye can follow while it turns: more segments are drawn coarser until the view rests.
const COARSE_SEGMENTS = 60000;

// One program's path as segments.
class PathLines {
  constructor(program) {
    this.program = program;
    const { x, y, z, isStart, motionOf } = program;
    let count = 0;
    for (let i = 1; i < x.length; i++) if (!isStart[i]) count++;
    const places = new Float32Array(count * 6);
    this.colors = new Uint8Array(count * 8);
    this.motions = new Uint32Array(count);
    for (let i = 1, at = 0; i < x.length; i++) {
      if (isStart[i]) continue;
      for (const [vertex, to] of [[i - 1, at * 6], [i, at * 6 + 3]]) {
        places[to] = x[vertex];
        places[to + 1] = y[vertex];
        places[to + 2] = z[vertex];
      }
      this.motions[at++] = motionOf[i];
    }
    this.places = places;
    this.geometry = new THREE.BufferGeometry();
    this.geometry.setAttribute("position", new THREE.BufferAttribute(places, 3));
    this.geometry.setAttribute("color", new THREE.BufferAttribute(this.colors, 4, true));
    this.geometry.boundingBox = this.box();
    this.lines = new THREE.LineSegments(this.geometry, new THREE.LineBasicMaterial({ vertexColors: true }));
    this.lines.frustumCulled = false;
    this.rapids = true;
    this.limit = Infinity;
    this.index();
  }

  get count() { return this.motions.length; }

  // The box around what is at feed, or around all where nothing is.
  box() {
    const p = this.places, low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (const all of [false, true]) {
      if (low[0] <= high[0]) break;
      for (let i = 0, at = 0; i < this.count; i++, at += 6) {
        if (!all && this.program.flags[this.motions[i]] & RAPID) continue;
        for (let axis = 0; axis < 3; axis++) {
          low[axis] = Math.min(low[axis], p[at + axis], p[at + 3 + axis]);
          high[axis] = Math.max(high[axis], p[at + axis], p[at + 3 + axis]);
        }
      }
    }
    return new THREE.Box3(new THREE.Vector3(...low), new THREE.Vector3(...high));
  }

  color(coloring) {
    const { colors, motions, program } = this;
    let last = -1, r = 0, g = 0, b = 0;
    for (let i = 0, at = 0; i < motions.length; i++, at += 8) {
      if (motions[i] !== last) [r, g, b] = coloring.color(program, (last = motions[i]));
      colors[at] = colors[at + 4] = r;
      colors[at + 1] = colors[at + 5] = g;
      colors[at + 2] = colors[at + 6] = b;
      colors[at + 3] = colors[at + 7] = 255;
    }
    this.geometry.attributes.color.needsUpdate = true;
    if (this.isLarge) this.colorCoarse();
  }

  shows(segment) {
    const motion = this.motions[segment];
    const flags = this.program.flags[motion];
    return motion <= this.limit && (this.rapids || !(flags & RAPID) || flags & CRASH);
  }

  // The vertices to draw: every segment, and a coarse path that leaves points out where it goes on.
  index() {
    const step = this.step = Math.max(Math.ceil(this.count / COARSE_SEGMENTS), 1);
    const full = new Uint32Array(this.count * 2), coarse = [];
    let size = 0;
    // Rapids first: where they go along a cut, the cut is seen. Crashes last: nothing covers them.
    const layer = (flags) => flags & CRASH ? CRASH : flags & RAPID;
    for (const wanted of [RAPID, 0, CRASH]) {
      for (let i = 0, run = 0; i < this.count; i++) {
        if (layer(this.program.flags[this.motions[i]]) !== wanted || !this.shows(i)) { run = 0; continue; }
        full[size++] = 2 * i;
        full[size++] = 2 * i + 1;
        const goesOn = run > 0 && run < step && this.joins(i);
        if (goesOn) { coarse[coarse.length - 1] = 2 * i + 1; run++; } else { coarse.push(2 * i, 2 * i + 1); run = 1; }
      }
    }
    this.full = new THREE.BufferAttribute(full.subarray(0, size), 1);
    this.geometry.setIndex(this.full);
    if (step > 1) this.takeCoarse(coarse);
  }

  // The coarse path has buffers of its own: the first frame takes these few to the graphics card, and those of all segments
  // follow once they are drawn.
  takeCoarse(vertices) {
    this.coarse?.dispose();
    const places = new Float32Array(vertices.length * 3);
    vertices.forEach((vertex, i) => {
      for (let axis = 0; axis < 3; axis++) places[3 * i + axis] = this.places[3 * vertex + axis];
    });
    this.coarseVertices = vertices;
    this.coarse = new THREE.BufferGeometry();
    this.coarse.setAttribute("position", new THREE.BufferAttribute(places, 3));
    this.coarse.setAttribute("color", new THREE.BufferAttribute(new Uint8Array(vertices.length * 4), 4, true));
    this.coarse.boundingBox = this.geometry.boundingBox;
    this.colorCoarse();
    this.setCoarse(true);
  }

  colorCoarse() {
    const { array } = this.coarse.attributes.color, { colors } = this;
    this.coarseVertices.forEach((vertex, i) => {
      for (let part = 0; part < 4; part++) array[4 * i + part] = colors[4 * vertex + part];
    });
    this.coarse.attributes.color.needsUpdate = true;
  }

  // Whether a segment begins where the one before ended.
  joins(segment) {
    const at = segment * 6, p = this.places;
    return p[at] === p[at - 3] && p[at + 1] === p[at - 2] && p[at + 2] === p[at - 1];
  }

  show(rapids, limit) {
    if (rapids === this.rapids && limit === this.limit) return;
    [this.rapids, this.limit] = [rapids, limit];
    this.index();
  }

  get isLarge() { return this.step > 1; }

  setCoarse(coarse) { this.lines.geometry = coarse && this.isLarge ? this.coarse : this.geometry; }

  // How many vertices a frame draws.
  get drawnVertices() { return this.lines.geometry === this.geometry ? this.full.count : this.coarseVertices.length; }
}

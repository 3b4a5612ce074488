// The path and the stock in 3D, drawn by three.js.

const BACKGROUND = 0xf4f6f8;

// What the eye can follow while it turns: more segments are drawn coarser until the view rests.
const COARSE_SEGMENTS = 150000;

// The longest a reader waits for all segments (ms). A browser without a graphics card would take a minute for a million.
const LONGEST_DRAW = 1500;

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
    this.coarse = step > 1 ? new THREE.BufferAttribute(new Uint32Array(coarse), 1) : this.full;
    this.geometry.setIndex(this.full);
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

  get isLarge() { return this.coarse !== this.full; }

  setCoarse(coarse) { this.geometry.setIndex(coarse ? this.coarse : this.full); }
}

// The stock that is left: heights on a grid, and walls down to its lowest material where it ends.
function stockMesh(heights, { first, cell, columns, rows, low }) {
  const places = [], faces = [], number = new Int32Array(columns * rows).fill(-1);
  const [ox, oy, oz] = facts.origin, base = low - oz;
  // Outer columns reach to the border of their cells.
  const border = (index, count) => index + (index === 0 ? -0.5 : index === count - 1 ? 0.5 : 0);
  const px = (column) => first[0] + border(column, columns) * cell - ox, py = (row) => first[1] + border(row, rows) * cell - oy;
  for (let row = 0, at = 0; row < rows; row++) {
    for (let column = 0; column < columns; column++, at++) {
      if (heights[at] !== heights[at]) continue;
      number[at] = places.length / 3;
      places.push(px(column), py(row), base + heights[at]);
    }
  }
  const whole = (column, row) => {
    if (column < 0 || row < 0 || column >= columns - 1 || row >= rows - 1) return false;
    const at = row * columns + column;
    return number[at] >= 0 && number[at + 1] >= 0 && number[at + columns] >= 0 && number[at + columns + 1] >= 0;
  };
  const wall = (a, b) => {
    const start = places.length / 3;
    for (const i of [a, b]) places.push(places[3 * i], places[3 * i + 1], base);
    faces.push(a, start, start + 1, a, start + 1, b);
  };
  for (let row = 0; row < rows - 1; row++) {
    for (let column = 0; column < columns - 1; column++) {
      if (!whole(column, row)) continue;
      const at = row * columns + column;
      const [a, b, c, d] = [number[at], number[at + 1], number[at + columns + 1], number[at + columns]];
      faces.push(a, b, c, a, c, d);
      if (!whole(column, row - 1)) wall(a, b);
      if (!whole(column + 1, row)) wall(b, c);
      if (!whole(column, row + 1)) wall(c, d);
      if (!whole(column - 1, row)) wall(d, a);
    }
  }
  const geometry = new THREE.BufferGeometry();
  geometry.setAttribute("position", new THREE.BufferAttribute(new Float32Array(places), 3));
  geometry.setIndex(new THREE.BufferAttribute(new Uint32Array(faces), 1));
  geometry.computeBoundingBox();
  const material = new THREE.MeshLambertMaterial({
    color: 0xc9ced4, flatShading: true, side: THREE.DoubleSide, polygonOffset: true, polygonOffsetFactor: 2, polygonOffsetUnits: 8,
  });
  return new THREE.Mesh(geometry, material);
}

class Scene3d {
  constructor(parent, marker, path, stock) {
    Object.assign(this, { parent, marker, path, stock, place: null, half: [1, 1], cost: Infinity, measured: 0 });
    this.renderer = new THREE.WebGLRenderer({ antialias: true });
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    parent.prepend(this.renderer.domElement);
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color(BACKGROUND);
    this.scene.add(new THREE.AmbientLight(0xffffff, 1.6));
    this.light = new THREE.DirectionalLight(0xffffff, 1.6);
    this.scene.add(this.light);
    this.scene.add(path.lines);
    if (stock) this.scene.add(stock);
    this.camera = new THREE.OrthographicCamera();
    this.camera.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.camera, this.renderer.domElement);
    this.controls.addEventListener("change", () => this.moved());
    new ResizeObserver(() => this.resize()).observe(parent);
    this.measure();
    this.look(-0.6, -1, 0.9);
  }

  // Shows another path.
  show(path) {
    this.scene.remove(this.path.lines);
    this.scene.add(path.lines);
    this.path = path;
  }

  // The box around what there is.
  measure() {
    const low = new THREE.Vector3(Infinity, Infinity, Infinity), high = low.clone().negate();
    for (const part of [this.path.lines, this.stock]) {
      if (!part || part.geometry.boundingBox.isEmpty()) continue;
      low.min(part.geometry.boundingBox.min);
      high.max(part.geometry.boundingBox.max);
    }
    if (low.x > high.x) { low.set(-1, -1, -1); high.set(1, 1, 1); }
    this.corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => new THREE.Vector3(
      i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z));
    this.middle = low.clone().add(high).multiplyScalar(0.5);
    this.radius = Math.max(low.distanceTo(high) / 2, 1e-3);
  }

  // Looks at everything from a direction.
  look(x, y, z) {
    const direction = new THREE.Vector3(x, y, z).normalize();
    this.controls.target.copy(this.middle);
    this.camera.position.copy(this.middle).addScaledVector(direction, this.radius * 4);
    this.camera.zoom = 1;
    this.controls.update();
    this.camera.updateMatrixWorld();
    const seen = this.corners.map((corner) => corner.clone().applyMatrix4(this.camera.matrixWorldInverse));
    this.half = [Math.max(...seen.map(({ x }) => Math.abs(x)), 1e-3), Math.max(...seen.map(({ y }) => Math.abs(y)), 1e-3)];
    this.resize();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.parent;
    if (width === 0 || height === 0) return;
    this.renderer.setSize(width, height);
    const scale = Math.max(this.half[0] / width, this.half[1] / height) * 1.08, [wide, tall] = [scale * width, scale * height];
    Object.assign(this.camera, { left: -wide, right: wide, top: tall, bottom: -tall, near: -this.radius * 8, far: this.radius * 16 });
    this.camera.updateProjectionMatrix();
    this.moved();
  }

  // The view changed: draw soon, coarse while it goes on where drawing takes long.
  moved() {
    this.light.position.copy(this.camera.position).sub(this.controls.target);
    this.mark();
    this.refresh();
  }

  // Draws soon: a large path coarse first, and whole once the view rests, if that does not take too long.
  refresh() {
    clearTimeout(this.rest);
    this.request(this.path.isLarge);
    if (this.path.isLarge) this.rest = setTimeout(() => this.whole(), 250);
  }

  whole() {
    // The first frame tells too much: it takes the path to the graphics card, too.
    if (!this.affordsAll && this.measured < 2) return this.refresh();
    if (this.affordsAll) this.request(false);
    this.rested?.(!this.affordsAll);
  }

  // Whether all segments are drawn in a time that a reader waits for, as far as frames so far tell.
  get affordsAll() { return !this.path.isLarge || this.cost * this.path.full.count <= LONGEST_DRAW; }

  request(coarse) {
    this.wantsCoarse = coarse;
    if (this.requested) return;
    this.requested = requestAnimationFrame(() => { this.requested = 0; this.draw(this.wantsCoarse); });
  }

  draw(coarse = !this.affordsAll) {
    this.path.setCoarse(coarse);
    const began = performance.now();
    this.renderer.render(this.scene, this.camera);
    if (!this.path.isLarge) return;
    // A pixel that is read waits for the drawing, which else goes on behind our back.
    const gl = this.renderer.getContext();
    gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4));
    const vertices = Math.max(this.path.geometry.index.count, 1);
    this.cost = Math.min(this.cost, (performance.now() - began) / vertices);
    this.measured++;
  }

  // Where a point is on the screen, in pixels of the element.
  onScreen(point) {
    const at = new THREE.Vector3(point[0] - facts.origin[0], point[1] - facts.origin[1], point[2] - facts.origin[2]);
    this.camera.updateMatrixWorld();
    at.project(this.camera);
    return [(at.x + 1) / 2 * this.parent.clientWidth, (1 - at.y) / 2 * this.parent.clientHeight];
  }

  setPlace(point) {
    this.place = point;
    this.mark();
  }

  mark() {
    this.marker.hidden = !this.place;
    if (!this.place) return;
    const [x, y] = this.onScreen(this.place);
    this.marker.style.transform = `translate(${x}px, ${y}px)`;
  }

  // The motion next to a pixel, no further than `most` pixels: of several, the one nearest to the eye.
  pick(x, y, most = 8) {
    this.camera.updateMatrixWorld();
    const m = this.camera.projectionMatrix.clone().multiply(this.camera.matrixWorldInverse).elements;
    const { clientWidth: w, clientHeight: h } = this.parent, { path } = this, p = path.places;
    let found = -1, best = Infinity;
    for (let i = 0, at = 0; i < path.count; i++, at += 6) {
      const px = (o) => (m[0] * p[o] + m[4] * p[o + 1] + m[8] * p[o + 2] + m[12] + 1) / 2 * w;
      const py = (o) => (1 - (m[1] * p[o] + m[5] * p[o + 1] + m[9] * p[o + 2] + m[13])) / 2 * h;
      const ax = px(at), ay = py(at), bx = px(at + 3) - ax, by = py(at + 3) - ay;
      const long = bx * bx + by * by;
      const share = long > 0 ? Math.min(Math.max(((x - ax) * bx + (y - ay) * by) / long, 0), 1) : 0;
      const off = Math.hypot(ax + bx * share - x, ay + by * share - y);
      if (off > most || !path.shows(i)) continue;
      const depth = (o) => m[2] * p[o] + m[6] * p[o + 1] + m[10] * p[o + 2];
      // Two pixels more are worth what lies nearer.
      const score = Math.floor(off / 2) * 4 + depth(at) * (1 - share) + depth(at + 3) * share;
      if (score < best) [best, found] = [score, i];
    }
    return found < 0 ? null : path.motions[found];
  }
}

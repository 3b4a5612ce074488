// The 3D view: path, stock and tool, drawn by three.js, seen in parallel projection.

// The longest a reader waits for all segments (ms). A browser without a graphics card would take a minute for a million.
const LONGEST_DRAW = 1500;

// Colours are those of the style sheet, byte for byte: three.js would encode them a second time.
THREE.ColorManagement.enabled = false;

class Scene3d {
  constructor(parent, path, surface) {
    Object.assign(this, { parent, path, surface, place: null, half: [1, 1], cost: Infinity, measured: 0, listeners: [] });
    this.renderer = new THREE.WebGLRenderer({ antialias: true });
    this.renderer.outputColorSpace = THREE.LinearSRGBColorSpace ?? "srgb-linear";
    this.renderer.setPixelRatio(Math.min(window.devicePixelRatio, 2));
    const canvas = this.renderer.domElement;
    canvas.tabIndex = 0;
    canvas.setAttribute("role", "img");
    parent.prepend(canvas);
    this.scene = new THREE.Scene();
    this.scene.background = new THREE.Color();
    this.scene.add(new THREE.AmbientLight(0xffffff, 1.7));
    this.light = new THREE.DirectionalLight(0xffffff, 1.5);
    this.scene.add(this.light);
    this.tool = new ToolMesh();
    this.scene.add(this.tool.group, path.lines);
    if (surface) this.scene.add(surface.mesh, surface.face);
    this.camera = new THREE.OrthographicCamera();
    this.camera.up.set(0, 0, 1);
    this.controls = new THREE.OrbitControls(this.camera, canvas);
    this.controls.addEventListener("change", () => this.moved());
    new ResizeObserver(() => this.resize()).observe(parent);
    this.recolor();
    this.measure();
    this.look(-0.6, -1, 0.9);
  }

  recolor() {
    const [r, g, b] = theme.colors.scene;
    this.scene.background.setRGB(r / 255, g / 255, b / 255);
    this.tool.recolor();
    this.surface?.recolor();
  }

  // Shows another path, and the stock that belongs to it.
  show(path, surface) {
    this.scene.remove(this.path.lines);
    this.scene.add(path.lines);
    this.path = path;
    if (surface === this.surface) return;
    if (this.surface) this.scene.remove(this.surface.mesh, this.surface.face);
    if (surface) this.scene.add(surface.mesh, surface.face);
    this.surface = surface;
  }

  // The box around what there is.
  measure() {
    const low = new THREE.Vector3(Infinity, Infinity, Infinity), high = low.clone().negate();
    for (const part of [this.path.lines, this.surface?.mesh]) {
      const box = part?.geometry.boundingBox;
      if (!box || box.isEmpty()) continue;
      low.min(box.min);
      high.max(box.max);
    }
    if (low.x > high.x) { low.set(-1, -1, -1); high.set(1, 1, 1); }
    [this.low, this.high] = [low, high];
    this.corners = [0, 1, 2, 3, 4, 5, 6, 7].map((i) => new THREE.Vector3(
      i & 1 ? high.x : low.x, i & 2 ? high.y : low.y, i & 4 ? high.z : low.z));
    this.middle = low.clone().add(high).multiplyScalar(0.5);
    this.radius = Math.max(low.distanceTo(high) / 2, 1e-3);
  }

  // Looks at everything from a direction, or from where the eye is.
  look(x, y, z) {
    const direction = x === undefined ? this.camera.position.clone().sub(this.controls.target) : new THREE.Vector3(x, y, z);
    this.controls.target.copy(this.middle);
    this.camera.position.copy(this.middle).addScaledVector(direction.normalize(), this.radius * 4);
    this.camera.zoom = 1;
    this.controls.update();
    this.camera.updateMatrixWorld();
    const seen = this.corners.map((corner) => corner.clone().applyMatrix4(this.camera.matrixWorldInverse));
    this.half = [Math.max(...seen.map(({ x }) => Math.abs(x)), 1e-3), Math.max(...seen.map(({ y }) => Math.abs(y)), 1e-3)];
    this.resize();
  }

  // Turns the eye around the middle, by angles in radians.
  turn(around, up) {
    const eye = this.camera.position.clone().sub(this.controls.target), radius = eye.length();
    const azimuth = Math.atan2(eye.y, eye.x) + around;
    const height = Math.min(Math.max(Math.asin(eye.z / radius) + up, -1.5707), 1.5707);
    eye.set(Math.cos(height) * Math.cos(azimuth), Math.cos(height) * Math.sin(azimuth), Math.sin(height)).multiplyScalar(radius);
    this.camera.position.copy(this.controls.target).add(eye);
    this.controls.update();
    this.moved();
  }

  zoomBy(factor) {
    this.camera.zoom *= factor;
    this.camera.updateProjectionMatrix();
    this.moved();
  }

  // Cuts everything at a plane across an axis (0, 1, 2), at a place from the drawing's origin; null for no cut.
  setSection(section) {
    const normal = section && new THREE.Vector3(...[0, 1, 2].map((axis) => (axis === section.axis ? -1 : 0)));
    this.renderer.clippingPlanes = section ? [new THREE.Plane(normal, section.at)] : [];
    this.surface?.setSection(section);
    // The face lies in the plane itself, and would be cut away by rounding.
    if (this.surface && section) {
      this.surface.face.position.set(...[0, 1, 2].map((axis) => (axis === section.axis ? -this.radius * 1e-5 : 0)));
    }
    this.refresh();
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.parent;
    // On paper a picture stands in place of the canvas, and marks over it must stay where they are.
    if (width === 0 || height === 0 || theme.paper) return;
    this.renderer.setSize(width, height);
    const scale = Math.max(this.half[0] / width, this.half[1] / height) * 1.12, [wide, tall] = [scale * width, scale * height];
    Object.assign(this.camera, { left: -wide, right: wide, top: tall, bottom: -tall, near: -this.radius * 8, far: this.radius * 16 });
    this.camera.updateProjectionMatrix();
    this.moved();
  }

  // The view changed: draw soon, coarse while it goes on where drawing takes long.
  moved() {
    this.light.position.copy(this.camera.position).sub(this.controls.target);
    this.camera.updateMatrixWorld();
    this.listeners.forEach((changed) => changed());
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
    const vertices = Math.max(this.path.drawnVertices, 1);
    this.cost = Math.min(this.cost, (performance.now() - began) / vertices);
    this.measured++;
  }

  // Pixels of one unit of length.
  get pixelsPerUnit() { return (this.parent.clientWidth / (this.camera.right - this.camera.left)) * this.camera.zoom; }

  // Where a point is on the screen, in pixels of the element.
  onScreen(point) {
    const at = new THREE.Vector3(point[0] - facts.origin[0], point[1] - facts.origin[1], point[2] - facts.origin[2]);
    this.camera.updateMatrixWorld();
    at.project(this.camera);
    return [(at.x + 1) / 2 * this.parent.clientWidth, (1 - at.y) / 2 * this.parent.clientHeight];
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

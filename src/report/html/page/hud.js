// What stands over the 3D view: the place in the program, the places of findings, the axes and a scale.

// More rings than these would hide what they mark.
const MOST_RINGS = 12;

class Hud {
  constructor(scene) {
    Object.assign(this, { scene, element: document.getElementById("hud"), place: null, rings: [] });
    scene.listeners.push(() => this.draw());
  }

  // `place` is the point of the slider.
  setPlace(place) {
    this.place = place;
    this.draw();
  }

  // `rings` are places with a text and a class: { point, text, kind }.
  setRings(rings) {
    this.rings = rings.slice(0, MOST_RINGS);
    this.draw();
  }

  draw() {
    const { clientWidth: width, clientHeight: height } = this.scene.parent;
    if (width === 0) return;
    this.element.setAttribute("viewBox", `0 0 ${width} ${height}`);
    this.element.replaceChildren();
    const labels = [];
    for (const { point, text, kind } of this.rings) {
      const [x, y] = this.scene.onScreen(point);
      if (x < 0 || y < 0 || x > width || y > height) continue;
      // A label that would cover another one stands below it.
      let base = y - 8;
      while (labels.some(([left, there]) => Math.abs(left - x) < 8 * text.length && Math.abs(there - base) < 14)) base += 14;
      labels.push([x, base]);
      this.element.append(svg("circle", { class: `ring ${kind}`, cx: x.toFixed(1), cy: y.toFixed(1), r: 9 }),
        svg("text", { class: `ring ${kind}`, x: (x + 13).toFixed(1), y: base.toFixed(1) }, text));
    }
    if (this.place) {
      const [x, y] = this.scene.onScreen(this.place);
      this.element.append(svg("circle", { id: "marker", cx: x.toFixed(1), cy: y.toFixed(1), r: 6 }));
    }
    this.axes(height);
    this.scale(height);
  }

  // The directions of x, y and z.
  axes(height) {
    const turned = this.scene.camera.matrixWorldInverse.elements, [x0, y0, long] = [44, height - 46, 30];
    ["x", "y", "z"].forEach((name, axis) => {
      const dx = turned[4 * axis] * long, dy = -turned[4 * axis + 1] * long;
      // An axis that points at the reader is a dot.
      if (Math.hypot(dx, dy) < 4) return;
      this.element.append(svg("path", { class: `axis ${name}`, d: `M${x0} ${y0}L${(x0 + dx).toFixed(1)} ${(y0 + dy).toFixed(1)}` }),
        svg("text", { class: "axis", x: (x0 + dx * 1.35).toFixed(1), y: (y0 + dy * 1.35 + 4).toFixed(1), "text-anchor": "middle" }, name));
    });
  }

  // A round length, about a hundred pixels long.
  scale(height) {
    const perUnit = this.scene.pixelsPerUnit;
    if (!(perUnit > 0) || !Number.isFinite(perUnit)) return;
    const power = 10 ** Math.floor(Math.log10(110 / perUnit));
    const length = [5, 2, 1].map((part) => part * power).find((length) => length * perUnit <= 111) ?? power;
    const [x, y, wide] = [100, height - 22, length * perUnit];
    this.element.append(svg("path", { class: "scale", d: `M${x} ${y - 4}V${y + 4}M${x} ${y}H${(x + wide).toFixed(1)}M${(x + wide).toFixed(1)} ${y - 4}V${y + 4}` }),
      svg("text", { class: "axis", x: (x + wide / 2).toFixed(1), y: y - 7, "text-anchor": "middle" }, `${Number(length.toPrecision(1))} ${LENGTH}`));
  }
}

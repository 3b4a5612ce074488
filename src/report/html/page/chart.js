// One chart: the least to the largest value of each pixel, before as an outline over after as a filled band, limits as lines.

// Values of neighbouring pixels that are no further apart than this, in pixels, are one line.
const SMALL_JUMP = 12;

const CHART_HEIGHT = 150, CHART_LEFT = 76, CHART_RIGHT = 14, CHART_TOP = 24;

class Chart {
  constructor(charts, quantity) {
    Object.assign(this, { charts, quantity });
    const { title, unit } = QUANTITIES[quantity];
    this.title = `${title}, ${unit}`;
    this.element = svg("svg", { class: "chart", role: "img" });
  }

  // Draws everything anew, for the width and the zoom that the charts have.
  draw() {
    const { charts, quantity } = this, width = charts.width(), inner = width - CHART_LEFT - CHART_RIGHT;
    const count = Math.max(Math.round(inner), 10), { from, to, along } = charts;
    this.bands = charts.programs.map((program) => ({
      name: program.name, ...stretches(program, quantity, along, from, to, count),
    }));
    this.limits = facts.limits.filter((limit) => limit.quantity === quantity);
    this.range();
    this.element.replaceChildren();
    for (const [key, value] of Object.entries({ viewBox: `0 0 ${width} ${CHART_HEIGHT}`, width, height: CHART_HEIGHT })) {
      this.element.setAttribute(key, value);
    }
    this.element.setAttribute("aria-label", this.label());
    this.element.append(svg("text", { class: "title", x: CHART_LEFT, y: 14 }, this.title));
    this.axis(width);
    const single = this.bands.length === 1;
    for (const band of this.bands) {
      const before = band.name === "before" && !single, { area, lines, jumps } = this.outline(band);
      if (!before) this.element.append(svg("path", { class: "band after", d: area }));
      // Where the two run together the thin line of before lies on the thick one of after, and both are seen.
      const kind = before ? "before" : "after";
      this.element.append(svg("path", { class: `jump ${kind}`, d: jumps }), svg("path", { class: `line ${kind}`, d: lines }));
    }
    if (!single) this.element.append(...this.element.querySelectorAll(".before"));
    this.drawLimits(width);
    this.at = svg("path", { class: "at" });
    this.dot = svg("circle", { class: "dot", r: 4 });
    this.element.append(this.at, this.dot);
    this.mark();
  }

  label() {
    const told = this.bands.map(({ name, low, high }) => {
      const least = low.reduce((a, b) => Math.min(a, b), Infinity), most = high.reduce((a, b) => Math.max(a, b), -Infinity);
      return least <= most ? `${name}: ${printed(this.quantity, least)} to ${printed(this.quantity, most)}` : `${name}: not known`;
    });
    return `${this.title} along ${this.charts.along}; ${told.join("; ")}`;
  }

  // The values that the axis shows: loads begin at zero, limits are in sight where they are not far off.
  range() {
    let low = Infinity, high = -Infinity;
    for (const band of this.bands) {
      for (const value of band.low) if (value < low) low = value;
      for (const value of band.high) if (value > high) high = value;
    }
    if (low > high) [low, high] = [0, 1];
    if (this.quantity !== "z") {
      low = Math.min(low, 0);
      for (const { value } of this.limits) if (value > high && value < 2 * high) high = value;
    }
    const room = Math.max((high - low) * 0.05, Math.abs(high) * 1e-6, 1e-9);
    this.low = this.quantity === "z" ? low - room : low;
    this.high = high + room;
  }

  x(place) {
    const { from, to } = this.charts;
    return CHART_LEFT + ((place - from) / (to - from)) * (this.charts.width() - CHART_LEFT - CHART_RIGHT);
  }

  y(value) { return CHART_HEIGHT - 8 - ((value - this.low) / (this.high - this.low)) * (CHART_HEIGHT - 8 - CHART_TOP); }

  axis(width) {
    const marks = roundMarks(this.low, this.high, 4), texts = markTexts(marks);
    marks.forEach((mark, i) => {
      const y = this.y(mark).toFixed(1);
      this.element.append(svg("path", { class: "grid", d: `M${CHART_LEFT} ${y}H${width - CHART_RIGHT}` }),
        svg("text", { x: CHART_LEFT - 8, y: Number(y) + 4, "text-anchor": "end" }, texts[i]));
    });
  }

  // The outline of a band: its least and its largest values as lines, the jumps between these, which are drawn fainter so that
  // values that go up and down all the time do not hide what lies under them, and the area between least and largest.
  outline({ low, high }) {
    const step = (this.charts.width() - CHART_LEFT - CHART_RIGHT) / low.length, y = (value) => this.y(value).toFixed(1);
    const lines = [], jumps = [], areas = [];
    for (let first = 0; first < low.length; first++) {
      if (!(low[first] <= high[first])) continue;
      let end = first;
      while (end < low.length && low[end] <= high[end]) end++;
      const x = (i) => (CHART_LEFT + i * step).toFixed(1), up = [], down = [];
      for (let i = first; i < end; i++) {
        up.push(`${x(i)} ${y(high[i])}`, `${x(i + 1)} ${y(high[i])}`);
        down.push(`${x(i + 1)} ${y(low[i])}`, `${x(i)} ${y(low[i])}`);
      }
      areas.push(`M${up.join("L")}L${this.backwards(down).join("L")}Z`);
      for (const values of [high, low]) this.trace(values, first, end, { x, y, lines, jumps });
      first = end;
    }
    return { area: areas.join(""), lines: lines.join(""), jumps: jumps.join("") };
  }

  // Pairs of points stay in their order, the pairs themselves go from the last to the first.
  backwards(pairs) {
    const turned = [];
    for (let i = pairs.length - 2; i >= 0; i -= 2) turned.push(pairs[i], pairs[i + 1]);
    return turned;
  }

  trace(values, first, end, { x, y, lines, jumps }) {
    for (let i = first; i < end; i++) {
      const near = i > first && Math.abs(this.y(values[i]) - this.y(values[i - 1])) <= SMALL_JUMP;
      if (i > first && !near) jumps.push(`M${x(i)} ${y(values[i - 1])}V${y(values[i])}`);
      lines.push(near ? `V${y(values[i])}` : `M${x(i)} ${y(values[i])}`, `H${x(i + 1)}`);
    }
  }

  drawLimits(width) {
    let last = -Infinity;
    for (const { value, name } of [...this.limits].sort((a, b) => a.value - b.value)) {
      if (value > this.high || value < this.low) continue;
      const y = this.y(value);
      this.element.append(svg("path", { class: "limit", d: `M${CHART_LEFT} ${y.toFixed(1)}H${width - CHART_RIGHT}` }));
      // Names do not lie on each other.
      if (Math.abs(y - last) < 12) continue;
      last = y;
      const text = svg("text", { class: "limit", x: width - CHART_RIGHT - 4, y: y > CHART_TOP + 8 ? y - 4 : y + 12, "text-anchor": "end" },
        `${name}: ${printed(this.quantity, value)}`);
      this.element.append(text);
    }
  }

  // Shows the place in the program.
  mark() {
    const { charts, quantity } = this, { place } = charts, seen = place >= charts.from && place <= charts.to;
    const x = this.x(place).toFixed(1), value = charts.shown.value(quantity, charts.motion);
    this.at.setAttribute("d", seen ? `M${x} ${CHART_TOP - 4}V${CHART_HEIGHT - 8}` : "");
    const known = seen && Number.isFinite(value);
    this.dot.setAttribute("visibility", known ? "visible" : "hidden");
    if (!known) return;
    this.dot.setAttribute("cx", x);
    this.dot.setAttribute("cy", this.y(value).toFixed(1));
  }
}

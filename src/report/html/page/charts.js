// Charts along time or path, one below the other, all with one zoom and one place.

const STRIP_HEIGHT = 58;

class Charts {
  // `chosen` is told a place along time or path that was clicked.
  constructor(parent, programs, chosen) {
    Object.assign(this, { parent, programs, chosen, along: "time", quantities: [], list: [], place: 0, motion: 0, paper: null });
    this.shown = programs[programs.length - 1];
    [this.from, this.to] = [0, this.end()];
    this.key = Object.assign(document.createElement("div"), { className: "key" });
    this.strip = svg("svg", { class: "strip", role: "img" });
    new ResizeObserver(() => this.resized()).observe(parent);
    this.listen();
  }

  width() { return this.paper ?? Math.max(this.parent.clientWidth, 300); }

  end() { return Math.max(...this.programs.map((program) => program.along(this.along)[program.count - 1] || 0), 1e-9); }

  placeText(value) { return this.along === "time" ? `${clockText(value, 2)}` : `${value.toFixed(2 + MORE)} ${LENGTH}`; }

  show(quantities) {
    this.quantities = quantities;
    this.list = quantities.map((quantity) => new Chart(this, quantity));
    this.parent.replaceChildren(this.key, ...this.list.map((chart) => chart.element), this.strip);
    this.draw();
  }

  draw() {
    this.drawnWidth = this.width();
    this.list.forEach((chart) => chart.draw());
    this.showKey();
    this.drawStrip();
  }

  // What the lines are, in the colours that are drawn.
  showKey() {
    const entry = (kind, name) => {
      const mark = svg("svg", { width: 26, height: 12, viewBox: "0 0 26 12" });
      if (kind === "after") mark.append(svg("rect", { class: "band after", x: 1, y: 2, width: 24, height: 9 }));
      mark.append(svg("path", { class: kind === "limit" ? "limit" : `line ${kind}`, d: `M1 ${kind === "after" ? 2 : 6}H25` }));
      const line = document.createElement("span");
      line.append(mark, name);
      return line;
    };
    const single = this.programs.length === 1;
    const entries = [entry("after", `${single ? "" : "after: "}least to largest of each pixel`)];
    if (!single) entries.push(entry("before", "before: the same, as an outline"));
    if (this.list.some((chart) => chart.limits.length > 0)) entries.push(entry("limit", "target or limit"));
    this.key.replaceChildren(...entries);
  }

  // The axis along, and the operations as bars upon it.
  drawStrip() {
    const width = this.width(), { from, to } = this;
    const x = (place) => CHART_LEFT + ((place - from) / (to - from)) * (width - CHART_LEFT - CHART_RIGHT);
    for (const [key, value] of Object.entries({ viewBox: `0 0 ${width} ${STRIP_HEIGHT}`, width, height: STRIP_HEIGHT })) {
      this.strip.setAttribute(key, value);
    }
    this.strip.setAttribute("aria-label", `operations along ${this.along}`);
    this.strip.replaceChildren();
    this.operationBars().forEach(({ name, start, end }, i) => {
      const left = Math.max(x(start), CHART_LEFT), right = Math.min(x(end), width - CHART_RIGHT);
      if (right <= left) return;
      const bar = svg("rect", { class: `operation ${i % 2 ? "odd" : ""}`, x: left, y: 2, width: right - left, height: 15 });
      bar.append(svg("title", {}, name));
      this.strip.append(bar);
      // A letter takes about 6.2 pixels.
      if (name.length * 6.2 + 8 < right - left) this.strip.append(svg("text", { class: "inside", x: left + 5, y: 13 }, name));
    });
    const count = Math.max(Math.floor((width - CHART_LEFT) / 110), 2), time = this.along === "time";
    const marks = time ? timeMarks(from, to, count) : roundMarks(from, to, count);
    const texts = time ? marks.map((mark) => clockText(mark, decimalsOf(marks))) : markTexts(marks);
    marks.forEach((mark, i) => {
      this.strip.append(svg("path", { class: "grid", d: `M${x(mark).toFixed(1)} 18V24` }),
        svg("text", { x: x(mark).toFixed(1), y: 37, "text-anchor": "middle" }, texts[i]));
    });
    const clock = facts.machineTime ? "time on the machine" : "time at programmed feeds, without acceleration";
    const title = time ? `${clock}, minutes:seconds` : `path, ${LENGTH}`;
    this.strip.append(svg("text", { class: "title", x: width - CHART_RIGHT, y: 53, "text-anchor": "end" }, title));
  }

  // Where operations begin and end, in the program that is shown.
  operationBars() {
    const { shown } = this, along = shown.along(this.along), bars = [];
    for (let motion = 0; motion < shown.count; motion++) {
      const operation = shown.operation[motion], last = bars[bars.length - 1], start = motion ? along[motion - 1] : 0;
      if (last && last.operation === operation) last.end = along[motion];
      else bars.push({ operation, name: shown.operations[operation] || "(no name)", start, end: along[motion] });
    }
    return bars;
  }

  setAlong(along) {
    this.along = along;
    [this.from, this.to] = [0, this.end()];
    this.draw();
  }

  zoom(from, to) {
    const end = this.end(), least = end * 1e-7;
    [from, to] = [Math.max(from, 0), Math.min(to, end)];
    if (to - from < least) return;
    [this.from, this.to] = [from, to];
    this.draw();
  }

  zoomBy(factor, place = Math.min(Math.max(this.place, this.from), this.to)) {
    this.zoom(place - (place - this.from) * factor, place + (this.to - place) * factor);
  }

  mark(shown, motion) {
    const other = shown !== this.shown;
    Object.assign(this, { shown, motion, place: shown.along(this.along)[motion] || 0 });
    if (other) this.drawStrip();
    this.list.forEach((chart) => chart.mark());
  }

  resized() {
    if (this.list.length > 0 && this.drawnWidth !== this.width()) this.draw();
  }

  // Where the pointer is along time or path.
  placeOf(event) {
    const { left, width } = this.parent.getBoundingClientRect(), scale = this.width() / width;
    const share = ((event.clientX - left) * scale - CHART_LEFT) / (this.width() - CHART_LEFT - CHART_RIGHT);
    return this.from + Math.min(Math.max(share, 0), 1) * (this.to - this.from);
  }

  listen() {
    let down = null;
    const selection = Object.assign(document.createElement("div"), { className: "selection" });
    this.parent.addEventListener("pointerdown", (event) => {
      if (event.button === 0 && event.target.closest("svg.chart, svg.strip")) down = { x: event.clientX, place: this.placeOf(event) };
    });
    this.parent.addEventListener("pointermove", (event) => {
      if (!down || Math.abs(event.clientX - down.x) < 4) return;
      const { left } = this.parent.getBoundingClientRect();
      this.parent.append(selection);
      selection.style.left = `${Math.min(event.clientX, down.x) - left}px`;
      selection.style.width = `${Math.abs(event.clientX - down.x)}px`;
    });
    addEventListener("pointerup", (event) => {
      if (!down) return;
      const to = this.placeOf(event), moved = Math.abs(event.clientX - down.x);
      selection.remove();
      if (moved < 4) this.chosen(down.place);
      else this.zoom(Math.min(down.place, to), Math.max(down.place, to));
      down = null;
    });
    this.parent.addEventListener("dblclick", () => this.zoom(0, this.end()));
    this.parent.addEventListener("wheel", (event) => {
      event.preventDefault();
      this.zoomBy(Math.exp(Math.sign(event.deltaY) * 0.25), this.placeOf(event));
    }, { passive: false });
  }
}

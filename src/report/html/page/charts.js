// Charts along time or path, before and after laid over each other, all with one zoom.

const SIDE_COLORS = { before: "#8a929b", after: "#005ab5" };
const CHART_HEIGHT = 170;

// The least and largest value in each of `count` stretches of from..to. A step holds over its motion, z goes straight between vertices.
function stretches(program, quantity, along, from, to, count) {
  const low = new Float64Array(count).fill(Infinity), high = new Float64Array(count).fill(-Infinity);
  const steps = quantity !== "z";
  const ends = steps ? program.along(along) : program.vertexAlong(along);
  const values = steps ? program[quantity] : program.z;
  const lift = steps ? 0 : facts.origin[2];
  const scale = count / (to - from);
  if (!values || !(scale > 0)) return { low, high };
  const first = Math.max(countUpTo(ends, from) - 1, 0);
  for (let i = first; i < ends.length; i++) {
    const start = i > 0 ? ends[i - 1] : 0, end = ends[i];
    if (start > to) break;
    if (end < from) continue;
    const next = values[i] + lift;
    let before = steps || i === 0 || program.isStart[i] ? next : values[i - 1] + lift;
    if (next !== next) continue;
    const a = Math.max(Math.floor((start - from) * scale), 0), b = Math.min(Math.floor((end - from) * scale), count - 1);
    for (let at = a; at <= b; at++) {
      let one = before, other = next;
      if (!steps && b > a) {
        const share = (place) => Math.min(Math.max((from + place / scale - start) / (end - start), 0), 1);
        one = before + (next - before) * share(at);
        other = before + (next - before) * share(at + 1);
      }
      low[at] = Math.min(low[at], one, other);
      high[at] = Math.max(high[at], one, other);
    }
  }
  return { low, high };
}

class Chart {
  constructor(parent, quantity, charts) {
    this.quantity = quantity;
    this.charts = charts;
    const { title, unit } = QUANTITIES[quantity];
    this.element = Object.assign(document.createElement("div"), { className: "chart" });
    parent.append(this.element);
    const series = charts.programs.map((program) => ({
      label: charts.programs.length > 1 ? program.name : title,
      stroke: SIDE_COLORS[program.name],
      width: 1,
      points: { show: false },
      value: (_, value) => (value === null || value === undefined ? "" : printed(quantity, value)),
    }));
    this.plot = new uPlot({
      width: charts.width(),
      height: CHART_HEIGHT,
      scales: { x: { time: false, range: (_, low, high) => [low, high] }, y: { range: (_, low, high) => this.range(low, high) } },
      axes: [{ size: 34 }, { label: `${title}, ${unit}`, size: 62, labelSize: 20 }],
      cursor: {
        // The pointer is seen in all charts; a drag is only this chart's, which zooms all.
        sync: { key: "clsmith", filters: { pub: (event) => event === "mousemove" || event === "mouseleave" } },
        drag: { x: true, y: false, setScale: false },
        bind: { dblclick: () => () => { charts.zoom(0, charts.end()); return null; } },
      },
      hooks: { setSelect: [(plot) => this.selected(plot)] },
      series: [{ label: charts.along, value: (_, value) => (value === null || value === undefined ? "" : charts.placeText(value)) }, ...series],
    }, this.data(), this.element);
    this.at = Object.assign(document.createElement("div"), { className: "at" });
    this.plot.over.append(this.at);
    this.listen(this.plot.over);
    this.mark();
  }

  // Loads begin at zero; z has room around it.
  range(low, high) {
    if (low === null || high === null) return [0, 1];
    if (this.quantity !== "z") return [0, high > 0 ? high * 1.06 : 1];
    const room = Math.max((high - low) * 0.06, 0.01);
    return [low - room, high + room];
  }

  data() {
    const { from, to } = this.charts, count = Math.max(Math.round(this.charts.width() - 90), 50);
    const width = (to - from) / count, x = new Float64Array(2 * count);
    for (let i = 0; i < count; i++) x[2 * i] = x[2 * i + 1] = from + (i + 0.5) * width;
    // Both ends of what is shown, whatever the values.
    [x[0], x[2 * count - 1]] = [from, to];
    const columns = this.charts.programs.map((program) => {
      const { low, high } = stretches(program, this.quantity, this.charts.along, from, to, count);
      const y = new Array(2 * count);
      for (let i = 0; i < count; i++) {
        const known = low[i] <= high[i];
        y[2 * i] = known ? low[i] : null;
        y[2 * i + 1] = known ? high[i] : null;
      }
      return y;
    });
    return [x, ...columns];
  }

  refresh() {
    this.plot.setData(this.data(), true);
    this.mark();
  }

  selected(plot) {
    const { left, width } = plot.select;
    if (width < 4) return;
    const [from, to] = [plot.posToVal(left, "x"), plot.posToVal(left + width, "x")];
    plot.setSelect({ left: 0, width: 0, top: 0, height: 0 }, false);
    this.charts.zoom(from, to);
  }

  listen(over) {
    let down = null;
    over.addEventListener("mousedown", (event) => { down = event.clientX; });
    over.addEventListener("click", (event) => {
      if (down === null || Math.abs(event.clientX - down) > 3) return;
      const place = this.plot.posToVal(event.clientX - over.getBoundingClientRect().left, "x");
      this.charts.chosen(place);
    });
    over.addEventListener("wheel", (event) => {
      event.preventDefault();
      const place = this.plot.posToVal(event.clientX - over.getBoundingClientRect().left, "x");
      const factor = Math.exp(Math.sign(event.deltaY) * 0.25), { from, to } = this.charts;
      this.charts.zoom(place - (place - from) * factor, place + (to - place) * factor);
    }, { passive: false });
  }

  mark() {
    const left = this.plot.valToPos(this.charts.place, "x");
    const seen = this.charts.place >= this.charts.from && this.charts.place <= this.charts.to;
    this.at.style.display = seen ? "" : "none";
    this.at.style.transform = `translateX(${left - 1}px)`;
  }
}

class Charts {
  // `chosen` is told a place along time or path that was clicked.
  constructor(parent, programs, chosen) {
    Object.assign(this, { parent, programs, chosen, along: "time", quantities: [], list: [], place: 0 });
    [this.from, this.to] = [0, this.end()];
    new ResizeObserver(() => this.resized()).observe(parent);
  }

  width() { return Math.max(this.parent.clientWidth, 300); }

  end() { return Math.max(...this.programs.map((program) => program.along(this.along)[program.count - 1] || 0), 1e-9); }

  placeText(value) { return this.along === "time" ? `${value.toFixed(2)} s` : `${value.toFixed(2)} mm`; }

  show(quantities) {
    this.quantities = quantities;
    this.list.forEach((chart) => chart.plot.destroy());
    this.parent.replaceChildren();
    this.list = quantities.map((quantity) => new Chart(this.parent, quantity, this));
  }

  setAlong(along) {
    this.along = along;
    [this.from, this.to] = [0, this.end()];
    this.show(this.quantities);
  }

  zoom(from, to) {
    const end = this.end(), least = end * 1e-7;
    [from, to] = [Math.max(from, 0), Math.min(to, end)];
    if (to - from < least) return;
    [this.from, this.to] = [from, to];
    this.list.forEach((chart) => chart.refresh());
  }

  mark(place) {
    this.place = place;
    this.list.forEach((chart) => chart.mark());
  }

  resized() {
    const width = this.width();
    if (this.list.length === 0 || this.list[0].plot.width === width) return;
    for (const chart of this.list) {
      chart.plot.setSize({ width, height: CHART_HEIGHT });
      chart.refresh();
    }
  }
}

// Charts along time or path, before and after laid over each other, all with one zoom.

const SIDE_COLORS = { before: "#8a929b", after: "#005ab5" };
const CHART_HEIGHT = 170;

// Values that are looked at together where all of them fall into one stretch.
const BLOCK = 64;

// What a chart looks at: where values end along time or path, the values, and whether each holds (a step) or goes straight from the one
// before; and the least and largest of each block.
function curve(program, quantity, along) {
  const holds = quantity !== "z";
  const ends = holds ? program.along(along) : program.vertexAlong(along);
  const values = holds ? program[quantity] : program.z;
  if (!values) return null;
  const start = (i) => (holds || i === 0 || program.isStart[i] ? values[i] : values[i - 1]);
  program.blocks ??= {};
  const blocks = (program.blocks[quantity] ??= blocksOf(values, start));
  return { ends, values, start, blocks, holds, lift: holds ? 0 : facts.origin[2] };
}

function blocksOf(values, start) {
  const count = Math.floor(values.length / BLOCK);
  const low = new Float32Array(count).fill(Infinity), high = new Float32Array(count).fill(-Infinity);
  for (let block = 0, i = 0; block < count; block++) {
    for (const end = i + BLOCK; i < end; i++) {
      for (const value of i % BLOCK ? [values[i]] : [values[i], start(i)]) {
        if (value < low[block]) low[block] = value;
        if (value > high[block]) high[block] = value;
      }
    }
  }
  return { low, high };
}

// The least and largest value in each of `count` stretches of from..to.
function stretches(program, quantity, along, from, to, count) {
  const low = new Float64Array(count).fill(Infinity), high = new Float64Array(count).fill(-Infinity);
  const scale = count / (to - from), shown = curve(program, quantity, along);
  if (!shown || !(scale > 0)) return { low, high };
  const { ends, values, start, blocks, holds, lift } = shown;
  const take = (at, least, most) => {
    if (least + lift < low[at]) low[at] = least + lift;
    if (most + lift > high[at]) high[at] = most + lift;
  };
  for (let i = Math.max(countUpTo(ends, from) - 1, 0); i < ends.length; i++) {
    const begin = i > 0 ? ends[i - 1] : 0;
    if (begin > to) break;
    const first = Math.floor((begin - from) * scale), block = i / BLOCK;
    if (i % BLOCK === 0 && block < blocks.low.length && first >= 0
        && Math.floor((ends[i + BLOCK - 1] - from) * scale) === first && first < count) {
      take(first, blocks.low[block], blocks.high[block]);
      i += BLOCK - 1;
      continue;
    }
    const end = ends[i], one = start(i), other = values[i];
    if (end < from || other !== other) continue;
    const last = Math.min(Math.floor((end - from) * scale), count - 1);
    for (let at = Math.max(first, 0); at <= last; at++) {
      if (holds || first === last) {
        take(at, Math.min(one, other), Math.max(one, other));
        continue;
      }
      const value = (place) => one + (other - one) * Math.min(Math.max((from + place / scale - begin) / (end - begin), 0), 1);
      take(at, Math.min(value(at), value(at + 1)), Math.max(value(at), value(at + 1)));
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

  placeText(value) { return this.along === "time" ? `${value.toFixed(2)} s` : `${value.toFixed(2 + MORE)} ${LENGTH}`; }

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

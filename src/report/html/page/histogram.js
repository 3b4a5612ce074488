// How long the tool stands how much load: time by load, before as an outline over after filled.

const HISTOGRAM = { height: 230, left: 54, right: 14, top: 22, bottom: 44, bins: 24 };

// The seconds of each bin, of what is at feed and has a known value above nothing.
function timeByLoad(program, quantity, high, count) {
  const seconds = new Float64Array(count), values = program[quantity];
  if (!values) return seconds;
  for (let motion = 0; motion < program.count; motion++) {
    const value = values[motion];
    if (!(value > 0) || program.flags[motion] & RAPID) continue;
    seconds[Math.min(Math.floor((value / high) * count), count - 1)] += program.seconds[motion];
  }
  return seconds;
}

class Histogram {
  constructor(parent, programs, quantity) {
    Object.assign(this, { parent, programs, quantity, paper: null });
    new ResizeObserver(() => this.draw()).observe(parent);
  }

  show(quantity) {
    this.quantity = quantity;
    this.drawn = null;
    this.draw();
  }

  width() { return this.paper ?? Math.max(this.parent.clientWidth, 260); }

  draw() {
    const width = this.width();
    if (this.drawn === width) return;
    this.drawn = width;
    const { height, left, right, top, bottom, bins } = HISTOGRAM, { quantity, programs } = this;
    const most = rangeOf(programs, quantity)[1] || 1, limits = facts.limits.filter((limit) => limit.quantity === quantity);
    const high = Math.max(most, ...limits.map(({ value }) => value).filter((value) => value < 2 * most)) * 1.001;
    const all = programs.map((program) => ({ name: program.name, seconds: timeByLoad(program, quantity, high, bins) }));
    const longest = Math.max(...all.map(({ seconds }) => Math.max(...seconds)), 1e-9);
    const x = (value) => left + (value / high) * (width - left - right);
    const y = (seconds) => height - bottom - (seconds / longest) * (height - top - bottom);
    const { title, unit } = QUANTITIES[quantity];
    const picture = svg("svg", {
      class: "histogram", role: "img", viewBox: `0 0 ${width} ${height}`, width, height, "aria-label": this.label(all, high),
    });
    this.axes(picture, { x, y, width, high, longest });
    for (const { name, seconds } of [...all].reverse()) {
      const before = name === "before" && programs.length > 1;
      seconds.forEach((time, bin) => {
        if (time <= 0) return;
        const from = x((bin / bins) * high), to = x(((bin + 1) / bins) * high), up = Math.min(y(time), y(0) - 1);
        const inset = before ? 0.8 : 2.5;
        const bar = svg("rect", {
          class: before ? "before" : "after", x: (from + inset).toFixed(1), y: up.toFixed(1), width: (to - from - 2 * inset).toFixed(1),
          height: (y(0) - up).toFixed(1),
        });
        bar.append(svg("title", {}, `${name}: ${clockText(time, 1)}`));
        picture.append(bar);
      });
    }
    limits.filter(({ value }) => value <= high).forEach(({ name, value }, i) => {
      picture.append(svg("path", { class: "limit", d: `M${x(value).toFixed(1)} ${top - 6}V${height - bottom}` }));
      const end = x(value) > width / 2;
      picture.append(svg("text", { class: "limit", x: x(value) + (end ? -5 : 5), y: top + 4 + 12 * i, "text-anchor": end ? "end" : "start" },
        `${name}: ${printed(quantity, value)}`));
    });
    picture.append(svg("text", { class: "title", x: width - right, y: height - 6, "text-anchor": "end" }, `${title}, ${unit}`),
      svg("text", { class: "title", x: 2, y: 11 }, `time, ${this.programs.length > 1 ? "outline before, filled after" : "minutes:seconds"}`));
    this.parent.replaceChildren(picture);
  }

  axes(picture, { x, y, width, high, longest }) {
    const { left, right, bottom, height } = HISTOGRAM;
    for (const mark of timeMarks(0, longest, 4)) {
      picture.append(svg("path", { class: "grid", d: `M${left} ${y(mark).toFixed(1)}H${width - right}` }),
        svg("text", { x: left - 6, y: (y(mark) + 4).toFixed(1), "text-anchor": "end" }, clockText(mark, longest < 4 ? 1 : 0)));
    }
    const marks = roundMarks(0, high, Math.max(Math.floor(width / 90), 2)), texts = markTexts(marks);
    marks.forEach((mark, i) => picture.append(
      svg("text", { x: x(mark).toFixed(1), y: height - bottom + 16, "text-anchor": "middle" }, texts[i])));
  }

  label(all, high) {
    const told = all.map(({ name, seconds }) => {
      const sum = seconds.reduce((a, b) => a + b, 0), bin = seconds.indexOf(Math.max(...seconds));
      const from = (bin / seconds.length) * high, to = ((bin + 1) / seconds.length) * high;
      return sum > 0 ? `${name}: ${clockText(sum)} in material, most between ${printedNumber(this.quantity, from)} and ${printed(this.quantity, to)}`
        : `${name}: nothing known`;
    });
    return `Time by ${QUANTITIES[this.quantity].title}. ${told.join(". ")}`;
  }
}

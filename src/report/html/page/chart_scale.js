// Marks of axes, and elements of SVG.

const SVG = "http://www.w3.org/2000/svg";

function svg(name, attributes = {}, text) {
  const element = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) element.setAttribute(key, value);
  if (text !== undefined) element.textContent = text;
  return element;
}

// Round numbers (1, 2 or 5 times a power of ten apart) from `low` to `high`, about `count` of them.
function roundMarks(low, high, count) {
  const raw = (high - low) / Math.max(count, 1);
  if (!(raw > 0) || !Number.isFinite(raw)) return [low];
  const power = 10 ** Math.floor(Math.log10(raw)), ratio = raw / power;
  const step = (ratio < 1.5 ? 1 : ratio < 3.5 ? 2 : ratio < 7.5 ? 5 : 10) * power;
  const marks = [];
  for (let i = Math.ceil(low / step - 1e-9); i * step <= high + step * 1e-9; i++) marks.push(i * step);
  return marks;
}

// Marks of time: whole seconds, minutes and hours.
function timeMarks(from, to, count) {
  const raw = (to - from) / count;
  if (raw < 1) return roundMarks(from, to, count);
  const step = [1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200, 14400, 28800, 86400].find((step) => step >= raw)
    ?? 86400 * Math.ceil(raw / 86400);
  const marks = [];
  for (let i = Math.ceil(from / step - 1e-9); i * step <= to + 1e-9; i++) marks.push(i * step);
  return marks;
}

// Seconds as a clock shows them: 12:41, 1:02:03; with `decimals` of a second.
function clockText(seconds, decimals = 0) {
  const scale = 10 ** decimals, all = Math.round(seconds * scale), whole = Math.floor(all / scale);
  const part = decimals > 0 ? `.${String(all % scale).padStart(decimals, "0")}` : "";
  const two = (value) => String(value).padStart(2, "0");
  const [h, m, s] = [Math.floor(whole / 3600), Math.floor(whole / 60) % 60, whole % 60];
  return (h > 0 ? `${h}:${two(m)}:${two(s)}` : `${m}:${two(s)}`) + part;
}

// The decimals that tell marks apart.
function decimalsOf(marks) {
  const step = marks.length > 1 ? Math.abs(marks[1] - marks[0]) : Math.abs(marks[0]) || 1;
  return Math.min(Math.max(Math.ceil(-Math.log10(step) - 1e-9), 0), 7);
}

const grouped = (text) => text.replace(/^(-?)(\d+)/, (_, sign, digits) => sign + digits.replace(/\B(?=(\d{3})+$)/g, ","));

function markTexts(marks) {
  const decimals = decimalsOf(marks);
  return marks.map((mark) => grouped(mark.toFixed(decimals).replace(/^-(0(\.0*)?)$/, "$1")));
}

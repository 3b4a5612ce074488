// Colours of motions and surfaces. What a legend shows is what is drawn: both take their colours from here.

// Plasma (Smith and van der Walt, CC0), of which each background takes the part that stands out from it: even steps for
// the eye, also in grey and for the colour-blind. On both the largest value stands out, too.
const LIGHT_RAMP = [[248, 160, 58], [237, 121, 83], [216, 87, 107], [183, 45, 132], [139, 10, 165], [91, 2, 163], [43, 5, 148]];
const DARK_RAMP = [[122, 60, 210], [156, 34, 172], [195, 62, 127], [225, 100, 98], [243, 135, 72], [253, 180, 47], [244, 238, 60]];

// From material that is missing over what is right to material that is too much.
const DEVIATION_RAMP = [[5, 80, 190], [90, 150, 220], [150, 160, 165], [225, 130, 90], [185, 30, 30]];

// Okabe and Ito's colours, which the colour-blind tell apart, and which stand out from light and dark.
const LISTED_COLORS = [[0, 114, 178], [213, 94, 0], [0, 158, 115], [204, 121, 167], [86, 150, 203], [150, 110, 40], [120, 94, 240]];

const CHANGES = ["as it was", "slower", "faster", "elsewhere, new or gone"];

function tableOf(ramp) {
  return Array.from({ length: 256 }, (_, i) => {
    const at = (i / 255) * (ramp.length - 1), low = Math.min(Math.floor(at), ramp.length - 2), share = at - low;
    return ramp[low].map((value, part) => Math.round(value + (ramp[low + 1][part] - value) * share));
  });
}

const RAMP_TABLES = { light: tableOf(LIGHT_RAMP), dark: tableOf(DARK_RAMP), deviation: tableOf(DEVIATION_RAMP) };
const loadTable = () => (theme.dark ? RAMP_TABLES.dark : RAMP_TABLES.light);

// The range of a quantity over all programs.
function rangeOf(programs, quantity) {
  let low = Infinity, high = -Infinity;
  for (const program of programs) {
    const values = quantity === "z" ? null : program[quantity];
    for (let motion = 0; motion < program.count; motion++) {
      const value = values ? values[motion] : program.value(quantity, motion);
      if (value < low) low = value;
      if (value > high) high = value;
    }
  }
  if (low > high) return [0, 1];
  // Loads begin at nothing.
  return quantity === "z" ? [low, high] : [Math.min(low, 0), high];
}

// How motions are coloured: `color(program, motion)` and what the legend says. A crash is red in every mode.
function coloring(mode, programs) {
  const plain = plainColoring(mode, programs), { bad } = theme.colors;
  const crashes = programs.some((program) => program.flags.some((flags) => flags & CRASH));
  const color = (program, motion) => (program.flags[motion] & CRASH ? bad : plain.color(program, motion));
  return { ...plain, color, crashes };
}

function plainColoring(mode, programs) {
  const { rapid, unknown } = theme.colors;
  const isRapid = (program, motion) => program.flags[motion] & RAPID;
  const listed = (names, colors, index) => ({
    color: (program, motion) => (isRapid(program, motion) ? rapid : colors[index(program, motion) % colors.length]),
    names: [...names.map((name, i) => [name, colors[i % colors.length]]), ["rapid", rapid]],
  });
  if (mode === "class") {
    const names = facts.classes.slice(1);
    return listed(names, LISTED_COLORS, (program, motion) => Math.max(program.class[motion] - 1, 0));
  }
  if (mode === "change") {
    return listed(CHANGES, [unknown, ...LISTED_COLORS], (program, motion) => program.change[motion]);
  }
  if (mode === "operation") {
    const names = programs[programs.length - 1].operations.slice(0, 12);
    return listed(names.map((name) => name || "(no name)"), LISTED_COLORS, (program, motion) => program.operation[motion]);
  }
  const [low, high] = rangeOf(programs, mode), scale = high > low ? 255 / (high - low) : 0, table = loadTable();
  const color = (program, motion) => {
    if (isRapid(program, motion)) return rapid;
    const value = program.value(mode, motion);
    return value === value ? table[Math.round((value - low) * scale)] : unknown;
  };
  return { color, range: [low, high], quantity: mode, table };
}

// Shows what colours mean. `surface` is what the stock is coloured by, if it is.
function showLegend(element, coloring, surface) {
  element.replaceChildren();
  if (coloring.range) {
    const { title, unit } = QUANTITIES[coloring.quantity];
    const ends = coloring.range.map((value) => printedNumber(coloring.quantity, value));
    element.append(rangeLegend(`${title}, ${unit}`, coloring.table, ends));
    element.append(namedLegend("rapid", theme.colors.rapid));
  } else coloring.names.forEach(([name, color]) => element.append(namedLegend(name, color)));
  if (coloring.crashes) element.append(namedLegend("shank or holder in material, or rapid through it", theme.colors.bad));
  if (surface?.range) element.append(rangeLegend(surface.title, surface.table, surface.range));
}

function namedLegend(name, color) {
  const line = document.createElement("div"), swatch = document.createElement("i");
  swatch.style.background = toCss(color);
  line.append(swatch, name);
  return line;
}

function rangeLegend(title, table, ends) {
  const box = document.createElement("div"), strip = document.createElement("canvas");
  [strip.width, strip.height] = [256, 1];
  strip.setAttribute("role", "img");
  strip.setAttribute("aria-label", `colours from ${ends[0]} to ${ends[1]}`);
  const context = strip.getContext("2d");
  table.forEach((color, i) => { context.fillStyle = toCss(color); context.fillRect(i, 0, 1, 1); });
  const numbers = Object.assign(document.createElement("div"), { className: "ends" });
  for (const end of ends) numbers.append(Object.assign(document.createElement("span"), { textContent: end }));
  box.append(title, document.createElement("br"), strip, numbers);
  return box;
}

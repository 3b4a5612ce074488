// Colours of the theme: those of the style sheet, so that drawings and legends have the colours of the text around them.

// Names of custom properties of the style sheet, each a colour #rrggbb.
const THEME_COLORS = ["scene", "rapid", "bad", "unknown", "stock", "holder", "flutes", "place", "before", "after", "ink", "dim"];

function toRgb(hex) {
  const value = parseInt(hex.trim().slice(1), 16);
  return [value >> 16, (value >> 8) & 255, value & 255];
}

const toCss = ([r, g, b]) => `rgb(${r}, ${g}, ${b})`;

// The theme in force. `changed` is told when the reader's system goes from light to dark or back.
const theme = {
  dark: false,
  paper: false,
  colors: {},
  listeners: [],

  read() {
    const style = getComputedStyle(document.documentElement);
    for (const name of THEME_COLORS) this.colors[name] = toRgb(style.getPropertyValue(`--${name}`));
    const [r, g, b] = this.colors.scene;
    this.dark = r + g + b < 380;
  },

  // Paper is white: while a page is printed its drawings have the light colours.
  onPaper(on) {
    this.paper = on;
    document.documentElement.classList.toggle("paper", on);
    this.announce();
  },

  announce() {
    this.read();
    this.listeners.forEach((changed) => changed());
  },
};

theme.read();
matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => theme.announce());

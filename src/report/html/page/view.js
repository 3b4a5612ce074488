// The panel around the 3D: what is shown, and in which colours.

function control(bar, text, element) {
  const label = document.createElement("label");
  label.append(text ? `${text} ` : "", element);
  bar.append(label);
  return element;
}

function choice(bar, text, id, options, changed) {
  const select = Object.assign(document.createElement("select"), { id });
  for (const [value, name] of options) select.append(new Option(name, value));
  select.addEventListener("change", () => changed(select.value));
  return control(bar, text, select);
}

function box(bar, text, id, checked, changed) {
  const input = Object.assign(document.createElement("input"), { type: "checkbox", id, checked });
  input.addEventListener("change", () => changed(input.checked));
  const label = document.createElement("label");
  label.append(input, ` ${text}`);
  bar.append(label);
  return input;
}

function button(bar, text, id, pressed) {
  const element = Object.assign(document.createElement("button"), { type: "button", textContent: text, id });
  element.addEventListener("click", pressed);
  bar.append(element);
  return element;
}

const STANDARD_VIEWS = { iso: [-0.6, -1, 0.9], top: [0, -0.0001, 1], front: [0, -1, 0], right: [1, 0, 0] };

class View {
  // `chosen` is told a motion that was clicked, `sideChosen` the name of the program to be shown.
  constructor(programs, deviations, chosen, sideChosen) {
    Object.assign(this, { programs, deviations, chosen, parent: document.getElementById("view"), motion: 0 });
    this.shown = programs[programs.length - 1];
    this.settings = { path: true, rapids: true, upTo: false, stock: "slider", section: "none", sectionAt: 0.5, tool: true };
    this.paths = new Map();
    this.stocks = new Map();
    try {
      this.scene = new Scene3d(this.parent, this.pathOf(this.shown), this.stockOf(this.shown));
      this.hud = new Hud(this.scene);
      this.scene.rested = (coarse) => this.tellCoarse(coarse);
    } catch (error) {
      // Without WebGL all else still works.
      this.scene = null;
      this.tell(`This browser cannot draw in 3D: ${error.message}`);
    }
    this.bar(sideChosen);
    this.colors(this.mode);
    this.filter();
    this.listen();
    theme.listeners.push(() => this.retheme());
  }

  pathOf(program) {
    if (!this.paths.has(program)) this.paths.set(program, new PathLines(program));
    return this.paths.get(program);
  }

  // The stock of a program; null where it was not simulated. One that was not changed was simulated once, as the one after.
  stockOf(program) {
    const simulated = program.stock ? program : this.programs.find((other) => other.stock);
    if (!simulated || (simulated !== program && simulated.count !== program.count)) return null;
    if (!this.stocks.has(simulated)) {
      const surface = new StockSurface(new StockStates(simulated));
      surface.show(surface.states.last);
      this.stocks.set(simulated, surface);
    }
    return this.stocks.get(simulated);
  }

  bar(sideChosen) {
    const bar = document.getElementById("view-bar"), { programs } = this;
    const named = (name) => [name, QUANTITIES[name].title];
    const loads = programs[programs.length - 1].loads;
    const modes = [...loads.filter((name) => name === "chip").map(named), named("feed")];
    modes.push(...loads.filter((name) => name !== "chip").map(named), named("z"), ["class", "class of motion"]);
    if (programs.length > 1) modes.push(["change", "change"]);
    modes.push(["operation", "operation"]);
    this.mode = modes[0][0];
    if (programs.length > 1) {
      const sides = [...programs].reverse().map((program) => [program.name, program.name]);
      this.sideSelect = choice(bar, "program", "side", sides, sideChosen);
    }
    choice(bar, "colour", "color", modes, (mode) => this.colors(mode));
    box(bar, "path", "path", true, (on) => { this.settings.path = on; this.filter(); });
    box(bar, "rapids", "rapids", true, (on) => { this.settings.rapids = on; this.filter(); });
    box(bar, "up to the place", "up-to", false, (on) => { this.settings.upTo = on; this.filter(); });
    box(bar, "tool and holder", "tool", true, (on) => { this.settings.tool = on; this.showTool(); this.scene?.refresh(); });
    if (this.stockOf(this.shown) && this.scene) this.stockBar(bar);
    // They stay in one row, wherever that breaks.
    const views = bar.appendChild(Object.assign(document.createElement("span"), { className: "views" }));
    for (const name of Object.keys(STANDARD_VIEWS)) button(views, name === "iso" ? "3D" : name, `view-${name}`, () => this.look(name));
    button(views, "fit", "view-fit", () => this.scene?.look());
  }

  stockBar(bar) {
    const stocks = [["slider", "at the place"], ["left", "that is left"], ["load", "left, by the load that made it"]];
    if (this.deviations) stocks.push(["deviation", "left, by what is off the target"]);
    stocks.push(["none", "none"]);
    choice(bar, "stock", "stock", stocks, (stock) => { this.settings.stock = stock; this.showStock(); });
    const sections = [["none", "none"], ["0", "x"], ["1", "y"], ["2", "z"]];
    choice(bar, "section", "section", sections, (section) => { this.settings.section = section; this.cut(); });
    const at = Object.assign(document.createElement("input"), { type: "range", id: "section-at", min: 0, max: 1, step: 0.005, value: 0.5 });
    at.setAttribute("aria-label", "place of the section");
    at.addEventListener("input", () => { this.settings.sectionAt = Number(at.value); this.cut(); });
    at.hidden = true;
    bar.append(at);
  }

  look(name) { this.scene?.look(...STANDARD_VIEWS[name]); }

  cut() {
    const axis = Number(this.settings.section), none = this.settings.section === "none";
    document.getElementById("section-at").hidden = none;
    const { low, high } = this.scene, share = this.settings.sectionAt, name = ["x", "y", "z"][axis];
    this.scene.setSection(none ? null : { axis, at: low[name] + (high[name] - low[name]) * share });
  }

  colors(mode) {
    this.mode = mode;
    this.coloring = coloring(mode, this.programs);
    this.paths.forEach((path) => path.color(this.coloring));
    this.showStock();
    this.legend();
    this.scene?.refresh();
  }

  legend() {
    const { stock } = this.settings, surface = stock === "deviation" && this.deviations ? deviationColoring(this.deviations) : null;
    showLegend(document.getElementById("legend"), this.coloring, surface);
  }

  retheme() {
    this.scene?.recolor();
    this.colors(this.mode);
    this.scene?.draw();
    this.hud?.draw();
  }

  // Shows a program; its lines are made when they are first needed.
  show(program) {
    this.shown = program;
    if (this.sideSelect) this.sideSelect.value = program.name;
    if (!this.scene) return;
    const path = this.pathOf(program);
    path.color(this.coloring);
    this.scene.show(path, this.stockOf(program));
    if (this.settings.section !== "none") this.cut();
    this.filter();
  }

  filter() {
    if (!this.scene) return;
    this.scene.path.lines.visible = this.settings.path;
    this.scene.path.show(this.settings.rapids, this.settings.upTo ? this.motion : Infinity);
    this.scene.refresh();
  }

  tell(text, kind = "") {
    const note = document.getElementById("view-note");
    Object.assign(note, { textContent: text, className: kind, hidden: !text });
  }

  // A path that is not shown whole is told.
  tellCoarse(coarse) {
    this.tell(coarse ? `This browser draws slowly: lines go from every ${this.scene.path.step}th point to the next. Clicks find every motion.` : "", "coarse");
  }

  // Shows the stock as it is chosen: at the slider, or as it is left.
  showStock() {
    const surface = this.scene?.surface, { stock } = this.settings;
    if (!surface) return;
    surface.mesh.visible = stock !== "none";
    if (stock === "slider") surface.show(surface.states.after(this.motion + 1).heights);
    else if (stock === "deviation") surface.show(surface.states.last, deviationColoring(this.deviations).colorOf);
    else if (stock === "load") this.showLoads(surface);
    else surface.show(surface.states.last);
    this.legend();
    this.scene.refresh();
  }

  // The surface by the motion that made it.
  async showLoads(surface) {
    const { states } = surface, { program } = states;
    if (!states.upright) return this.tell("Which tilted tool made which surface is not known to this page.", "coarse");
    const owner = await states.owners((share) => this.tell(`Finding what made the surface: ${Math.round(share * 100)} %`, "coarse"));
    this.tell("");
    if (this.settings.stock !== "load" || this.scene.surface !== surface) return;
    surface.show(states.last, (cell) => (owner[cell] < 0 ? theme.colors.unknown : this.coloring.color(program, owner[cell])));
    this.scene.refresh();
  }

  showTool() {
    if (!this.scene) return;
    const { shown, motion } = this, vertex = shown.lastVertex(motion), { tool } = this.scene;
    tool.wanted = this.settings.tool;
    const axis = shown.k ? [shown.i[vertex], shown.j[vertex], shown.k[vertex]] : [0, 0, 1];
    tool.show(shown.shapes[shown.tool[motion]] ?? null, [shown.x[vertex], shown.y[vertex], shown.z[vertex]], axis);
  }

  mark(motion) {
    this.motion = motion;
    if (!this.scene) return;
    this.hud.setPlace(this.shown.point(this.shown.lastVertex(motion)));
    this.showTool();
    this.scene.refresh();
    clearTimeout(this.later);
    const slow = this.settings.upTo || (this.settings.stock === "slider" && this.scene.surface);
    if (slow) this.later = setTimeout(() => this.follow(), 30);
  }

  // What takes longer than a frame follows once the slider rests for a moment.
  follow() {
    if (this.settings.upTo) this.filter();
    if (this.settings.stock === "slider") this.showStock();
  }

  listen() {
    if (!this.scene) return;
    const canvas = this.scene.renderer.domElement;
    let down = null;
    canvas.addEventListener("pointerdown", (event) => { down = [event.clientX, event.clientY]; });
    canvas.addEventListener("pointerup", (event) => {
      if (!down || Math.hypot(event.clientX - down[0], event.clientY - down[1]) > 4) return;
      const { left, top } = canvas.getBoundingClientRect();
      const motion = this.scene.pick(event.clientX - left, event.clientY - top);
      if (motion !== null) this.chosen(motion);
    });
  }
}

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

class View {
  // `chosen` is told a motion that was clicked, `sideChosen` the name of the program to be shown.
  constructor(programs, stock, chosen, sideChosen) {
    this.programs = programs;
    this.chosen = chosen;
    this.parent = document.getElementById("view");
    this.shown = programs[programs.length - 1];
    this.settings = { rapids: true, upTo: false };
    this.limit = Infinity;
    try {
      this.paths = new Map([[this.shown, new PathLines(this.shown)]]);
      const mesh = stock && facts.stock ? stockMesh(stock, facts.stock) : null;
      this.scene = new Scene3d(this.parent, document.getElementById("marker"), this.paths.get(this.shown), mesh);
      this.scene.rested = (coarse) => this.tellCoarse(coarse);
    } catch (error) {
      // Without WebGL all else still works.
      this.scene = null;
      const note = document.getElementById("view-note");
      note.textContent = `This browser cannot draw in 3D: ${error.message}`;
      note.hidden = false;
    }
    this.bar(stock, sideChosen);
    this.colors(this.mode);
    this.filter();
    this.listen();
  }

  bar(stock, sideChosen) {
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
    box(bar, "rapids", "rapids", true, (on) => { this.settings.rapids = on; this.filter(); });
    box(bar, "up to the place", "up-to", false, (on) => { this.settings.upTo = on; this.filter(); });
    if (stock && this.scene) box(bar, "stock left", "stock", true, (on) => { this.scene.stock.visible = on; this.scene.refresh(); });
    for (const [name, ...direction] of [["3D", -0.6, -1, 0.9], ["top", 0, -0.0001, 1], ["front", 0, -1, 0], ["right", 1, 0, 0]]) {
      const button = Object.assign(document.createElement("button"), { type: "button", textContent: name });
      button.addEventListener("click", () => this.scene?.look(...direction));
      bar.append(button);
    }
  }

  colors(mode) {
    this.mode = mode;
    const chosen = coloring(mode, this.programs);
    showLegend(document.getElementById("legend"), chosen);
    this.coloring = chosen;
    this.paths?.forEach((path) => path.color(chosen));
    this.scene?.refresh();
  }

  // Shows a program; its lines are made when they are first needed.
  show(program) {
    this.shown = program;
    if (this.sideSelect) this.sideSelect.value = program.name;
    if (!this.scene) return;
    if (!this.paths.has(program)) {
      const path = new PathLines(program);
      path.color(this.coloring);
      this.paths.set(program, path);
    }
    this.scene.show(this.paths.get(program));
    this.filter();
  }

  filter() {
    if (!this.scene) return;
    this.scene.path.show(this.settings.rapids, this.settings.upTo ? this.limit : Infinity);
    this.scene.refresh();
  }

  // A path that is not shown whole is told.
  tellCoarse(coarse) {
    const note = document.getElementById("view-note");
    note.textContent = `This browser draws slowly: lines go from every ${this.scene.path.step}th point to the next. Clicks find every motion.`;
    note.className = "coarse";
    note.hidden = !coarse;
  }

  mark(motion, point) {
    this.limit = motion;
    this.scene?.setPlace(point);
    if (!this.settings.upTo) return;
    clearTimeout(this.later);
    this.later = setTimeout(() => this.filter(), 60);
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

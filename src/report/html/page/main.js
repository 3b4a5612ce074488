// Brings charts, 3D, listing and slider together: one place in one program.

class Page {
  constructor(arrays) {
    this.programs = facts.sides.map((told) => new Program(arrays, told));
    this.shown = this.programs[this.programs.length - 1];
    this.motion = 0;
    document.getElementById("path").hidden = false;
    this.listing = new Listing(arrays, (row) => this.goToRow(row));
    this.view = new View(this.programs, arrays.stock, (motion) => this.goTo(motion), (name) => this.showSide(name));
    this.charts = new Charts(document.getElementById("charts"), this.programs, (place) => {
      this.goTo(this.shown.motionAt(this.charts.along, place));
    });
    this.slider = document.getElementById("slider");
    this.slider.addEventListener("input", () => this.goTo(Number(this.slider.value)));
    this.chartBar();
    this.findings();
    this.useSlider();
    this.goTo(0);
  }

  chartBar() {
    const bar = document.getElementById("chart-bar"), loads = this.programs.map((program) => program.loads).flat();
    const all = ["feed", ...["chip", "power", "torque", "force", "removal"].filter((name) => loads.includes(name)), "z"];
    const load = ["power", "removal"].find((name) => all.includes(name));
    this.quantities = new Set(["feed", "chip", load, "z"].filter((name) => all.includes(name)));
    choice(bar, "along", "along", [["time", "time"], ["path", "path"]], (along) => { this.charts.setAlong(along); this.mark(); });
    for (const name of all) {
      box(bar, QUANTITIES[name].title, `chart-${name}`, this.quantities.has(name), (on) => {
        if (on) this.quantities.add(name); else this.quantities.delete(name);
        this.charts.show(all.filter((name) => this.quantities.has(name)));
      });
    }
    for (const program of this.programs.length > 1 ? this.programs : []) {
      const key = document.createElement("b");
      key.style.color = SIDE_COLORS[program.name];
      key.textContent = `— ${program.name}`;
      bar.append(key);
    }
    this.charts.show(all.filter((name) => this.quantities.has(name)));
  }

  // A click on a finding goes to its line.
  findings() {
    for (const element of document.querySelectorAll(".finding[data-old-line], .finding[data-new-line]")) {
      element.addEventListener("click", () => {
        const { oldLine, newLine } = element.dataset;
        this.goToRow(oldLine ? this.listing.rowOfOldLine(Number(oldLine)) : this.listing.rowOfNewLine(Number(newLine)));
        document.getElementById("path").scrollIntoView();
      });
    }
  }

  useSlider() {
    this.slider.max = Math.max(this.shown.count - 1, 0);
    this.slider.value = this.motion;
  }

  // Shows the other program, at the place that belongs to this one's.
  showSide(name) {
    const pair = this.shown.pair[this.motion];
    this.shown = this.programs.find((program) => program.name === name) ?? this.shown;
    this.motion = pair === undefined || pair === NONE ? 0 : pair;
    this.view.show(this.shown);
    this.useSlider();
    this.goTo(this.motion);
  }

  goToRow(row) {
    const other = this.programs.find((program) => program !== this.shown);
    const foreign = this.shown.name === "before" ? NEW : OLD;
    // A line that only the other program has is shown there.
    if (other && this.listing.kinds[row] === foreign) this.showSide(other.name);
    this.goTo(this.shown.motionOfRow(row), row);
  }

  goTo(motion, row) {
    if (this.shown.count === 0) return;
    this.motion = Math.min(Math.max(motion, 0), this.shown.count - 1);
    this.slider.value = this.motion;
    this.row = row ?? this.shown.row[this.motion];
    this.mark();
  }

  mark() {
    const { shown, motion } = this;
    if (shown.count === 0) return;
    this.view.mark(motion, shown.point(shown.lastVertex(motion)));
    this.charts.mark(shown.along(this.charts.along)[motion]);
    this.listing.goTo(this.row);
    this.readout();
  }

  // Why a value is not shown: what a rapid through material would load is no load of a cut.
  unknownText(name, motion) {
    const flags = this.shown.flags[motion];
    if (!(flags & RAPID)) return "not known";
    return name === "feed" ? "rapid" : flags & CRASH ? "crash" : "not known";
  }

  readout() {
    const { shown, motion } = this, other = this.programs.find((program) => program !== shown);
    const pair = other ? shown.pair[motion] : NONE, known = pair !== undefined && pair !== NONE;
    const point = shown.point(shown.lastVertex(motion)).map((value) => value.toFixed(3 + MORE)).join(", ");
    const cells = [
      ["motion", `${motion + 1} of ${shown.count}`],
      ["line", `${(shown.name === "before" ? this.listing.oldNumber : this.listing.newNumber)[this.row]}`],
      ["operation", shown.operations[shown.operation[motion]] ?? ""],
      ["tool", shown.tools[shown.tool[motion]] ?? ""],
      ["class", facts.classes[shown.class[motion]]],
      [`x, y, z in ${LENGTH}`, point],
      ["time", `${shown.alongTime[motion].toFixed(2)} s`],
    ];
    for (const name of ["feed", ...shown.loads]) {
      const text = printed(name, shown.value(name, motion)) || this.unknownText(name, motion);
      const was = known ? printed(name, other.value(name, pair)) : "";
      cells.push([QUANTITIES[name].title, was && was !== text ? `${text} (${other.name} ${was})` : text]);
    }
    const head = document.createElement("tr"), body = document.createElement("tr");
    for (const [name, value] of cells) {
      head.append(Object.assign(document.createElement("th"), { textContent: name }));
      body.append(Object.assign(document.createElement("td"), { textContent: visibleText(value) }));
    }
    document.getElementById("readout").replaceChildren(head, body);
  }
}

async function start() {
  if (facts.sides.length === 0) return;
  const arrays = await readArrays();
  // For the console, and for tests.
  window.clsmith = new Page(arrays);
}

start().catch((error) => {
  const broken = document.getElementById("broken");
  broken.textContent = `The path cannot be drawn: ${error.message}`;
  broken.hidden = false;
  throw error;
});

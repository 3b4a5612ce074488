// Brings charts, 3D, listing and slider together: one place in one program.

class Page {
  constructor(arrays) {
    this.programs = facts.sides.map((told) => new Program(arrays, told));
    this.shown = this.programs[this.programs.length - 1];
    this.motion = 0;
    document.getElementById("work").hidden = false;
    this.listing = new Listing(arrays, (row) => this.goToRow(row));
    this.readout = new Readout(this.programs, this.listing);
    this.view = new View(this.programs, arrays.deviation, (motion) => this.goTo(motion), (name) => this.showSide(name));
    this.charts = new Charts(document.getElementById("charts"), this.programs, (place) => {
      this.goTo(this.shown.motionAt(this.charts.along, place));
    });
    this.slider = document.getElementById("slider");
    this.slider.addEventListener("input", () => this.goTo(Number(this.slider.value)));
    this.worst = new WorstPlaces(document.getElementById("worst"), (motion) => { this.goTo(motion); this.toWork(); });
    this.chartBar();
    this.loadBar();
    this.findings();
    listenToKeys(this);
    listenToPrinting(this);
    this.useSlider();
    this.goTo(this.shown.count - 1);
    this.goToAddress();
    this.showRings();
  }

  // `report.html#line=214` opens the page at that line of the program.
  goToAddress() {
    const line = location.hash.match(/^#line=(\d+)$/);
    if (line) this.goToRow(this.listing.rowOfNewLine(Number(line[1])));
  }

  chartBar() {
    const bar = document.getElementById("chart-bar"), loads = this.programs.map((program) => program.loads).flat();
    const all = ["feed", ...["chip", "power", "torque", "force", "deflection", "stress", "removal"].filter((name) => loads.includes(name)), "z"];
    const load = ["power", "removal"].find((name) => all.includes(name));
    const wanted = new Set(["feed", "chip", load, "z"].filter((name) => all.includes(name)));
    choice(bar, "along", "along", [["time", "time"], ["path", "path"]], (along) => { this.charts.setAlong(along); this.mark(); });
    for (const name of all) {
      box(bar, QUANTITIES[name].title, `chart-${name}`, wanted.has(name), (on) => {
        if (on) wanted.add(name); else wanted.delete(name);
        this.charts.show(all.filter((name) => wanted.has(name)));
      });
    }
    this.charts.show(all.filter((name) => wanted.has(name)));
  }

  // Histogram and worst places are by one load, which is chosen once.
  loadBar() {
    const known = this.programs[this.programs.length - 1].loads, names = known.length ? known : ["feed"];
    this.load = names.includes("chip") ? "chip" : names[0];
    this.histogram = new Histogram(document.getElementById("histogram"), this.programs, this.load);
    const options = names.map((name) => [name, QUANTITIES[name].title]);
    choice(document.getElementById("load-bar"), "load", "load", options, (name) => this.chooseLoad(name)).value = this.load;
    this.histogram.draw();
    this.showWorst();
  }

  chooseLoad(name) {
    this.load = name;
    this.histogram.show(name);
    this.showWorst();
  }

  showWorst() { this.worst.show(this.shown, this.load, (motion) => this.readout.lineOf(this.shown, motion)); }

  // A click on a finding goes to its line.
  findings() {
    this.links = [...document.querySelectorAll("a[data-old-line], a[data-new-line]")];
    for (const link of this.links) {
      link.addEventListener("click", (event) => {
        event.preventDefault();
        this.goToRow(this.rowOfLink(link));
        this.toWork();
      });
    }
  }

  rowOfLink({ dataset: { oldLine, newLine } }) {
    return oldLine ? this.listing.rowOfOldLine(Number(oldLine)) : this.listing.rowOfNewLine(Number(newLine));
  }

  nextFinding(step) {
    const links = this.links.filter((link) => link.closest("#findings"));
    if (links.length === 0) return;
    this.finding = ((this.finding ?? (step > 0 ? -1 : 0)) + step + links.length) % links.length;
    links[this.finding].click();
  }

  toWork() { document.getElementById("work").scrollIntoView({ block: "start" }); }

  // Rings at the places of findings in the program that is shown.
  showRings() {
    const rings = [], foreign = this.shown.name === "before" ? NEW : OLD;
    for (const link of this.links) {
      const finding = link.closest(".finding"), row = this.rowOfLink(link);
      if (!finding || this.shown.count === 0 || this.listing.kinds[row] === foreign) continue;
      const motion = this.shown.motionOfRow(row), kind = finding.classList.contains("error") ? "error" : "warning";
      if (finding.classList.contains("note")) continue;
      const text = `${finding.querySelector(".code").textContent} line ${link.textContent.replace("line ", "")}`;
      rings.push({ point: this.shown.point(this.shown.lastVertex(motion)), text, kind });
    }
    this.view.hud?.setRings(rings);
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
    this.showWorst();
    this.showRings();
  }

  otherSide() {
    const other = this.programs.find((program) => program !== this.shown);
    if (other) this.showSide(other.name);
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

  // The line of the place, in the program that is shown.
  lineOfPlace() { return this.readout.lineOf(this.shown, this.motion, this.row); }

  mark() {
    const { shown, motion } = this;
    if (shown.count === 0) return;
    this.view.mark(motion);
    this.charts.mark(shown, motion);
    this.listing.goTo(this.row);
    this.readout.show(shown, motion, this.row);
    const text = document.getElementById("place").textContent;
    this.slider.setAttribute("aria-valuetext", text);
    this.marked?.();
    this.view.scene?.renderer.domElement.setAttribute("aria-label", `The path, the stock and the tool in 3D. The place: ${text}`);
  }
}

async function start() {
  if (facts.sides.length === 0) return;
  const arrays = await readArrays();
  // For the console, and for tests.
  window.clsmith = new Page(arrays);
  linkWithEditor(window.clsmith);
  window.clsmith.listing.takeText(await readText());
}

start().catch((error) => {
  const broken = document.getElementById("broken");
  broken.textContent = `The path cannot be drawn: ${error.message}`;
  broken.hidden = false;
  throw error;
});

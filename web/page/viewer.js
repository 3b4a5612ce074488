// The viewer: which files there are, what is shown of them, and the work that it takes.

const byId = (id) => document.getElementById(id);

// A corrected program gets the name of its original with this behind it.
const CORRECTED = "-corrected";

function correctedName(name) {
  const dot = name.lastIndexOf(".");
  return dot > 0 ? name.slice(0, dot) + CORRECTED + name.slice(dot) : name + CORRECTED;
}

class Viewer {
  constructor() {
    this.files = new Files();
    this.chosen = { program: "", before: "", setup: "", recipe: "" };
    this.frame = new ReportFrame(byId("frame"));
    this.given = this.output = this.task = null;
    // The names of the files of the example, while it is there.
    this.example = [];
    // How long the last work took.
    this.seconds = 0;
    takeFiles = (files) => this.take(files);
    listenToDrops(window);
    for (const id of ["add", "choose"]) byId(id).addEventListener("click", () => byId("picker").click());
    byId("picker").addEventListener("change", ({ target }) => { this.take([...target.files]); target.value = ""; });
    byId("example").addEventListener("click", () => this.openExample());
    byId("swap").addEventListener("click", () => this.choose({ program: this.chosen.before, before: this.chosen.program }));
    byId("save").addEventListener("click", () => this.save());
    byId("print").addEventListener("click", () => this.frame.print());
    byId("cancel").addEventListener("click", () => this.cancel());
    byId("failure-close").addEventListener("click", () => { byId("failure").hidden = true; });
    for (const what of ["program", "before", "setup", "recipe"]) {
      byId(what).addEventListener("change", ({ target }) => this.choose({ [what]: target.value }));
    }
  }

  // Takes new files, and shows what they are for: a program is opened, two of them are compared, a recipe is run.
  async take(files, isExample = false) {
    if (files.length === 0) return;
    const taken = await this.files.add(files);
    const of = (kind) => taken.filter((file) => file.kind === kind).map(({ name }) => name);
    const programs = of("program"), [setup] = of("setup"), [recipe] = of("recipe"), chosen = {};
    if (isExample) this.example = files.map(({ name }) => name);
    else if (programs.length > 0) this.forgetExample(taken.map(({ name }) => name));
    if (programs.length > 0) Object.assign(chosen, { program: programs[programs.length - 1], before: "" });
    if (programs.length === 2 && !recipe) Object.assign(chosen, { before: programs[0], recipe: "" });
    if (setup) chosen.setup = setup;
    if (recipe) Object.assign(chosen, { recipe, before: "" });
    this.choose(chosen);
  }

  async openExample() {
    const example = JSON.parse(await textOf("example-files"));
    this.take(Object.entries(example).map(([name, text]) => new File([text], name)), true);
  }

  // The recipe and the setup of the example are not for a program of one's own. Files that replaced its own stay.
  forgetExample(replaced) {
    const gone = this.example.filter((name) => !replaced.includes(name));
    this.files.remove(gone);
    for (const [what, name] of Object.entries(this.chosen)) if (gone.includes(name)) this.chosen[what] = "";
    this.example = [];
  }

  choose(chosen) {
    // A program is shown beside what a recipe made of it, or beside another one.
    if (chosen.recipe) chosen.before = "";
    if (chosen.before) chosen.recipe = "";
    Object.assign(this.chosen, chosen);
    if (this.chosen.before === this.chosen.program) this.chosen.before = "";
    this.fillChoices();
    if (this.chosen.program) this.work();
    else this.tellNote(`${[...this.files.all.keys()].join(", ")}: taken. Now drop the CL file.`);
  }

  fillChoices() {
    const fill = (id, names, none) => {
      const options = (none === null ? names : ["", ...names]).map((name) => new Option(name || none, name));
      byId(id).replaceChildren(...options);
      byId(id).value = this.chosen[id];
    };
    const programs = this.files.names("program");
    fill("program", programs, null);
    fill("before", programs.filter((name) => name !== this.chosen.program), "(no comparison)");
    fill("setup", this.files.names("setup"), "(none)");
    fill("recipe", this.files.names("recipe"), "(none)");
    byId("before-label").hidden = programs.length < 2;
    byId("swap").hidden = !this.chosen.before;
    byId("choices").hidden = byId("actions").hidden = !this.chosen.program;
  }

  async work() {
    this.task?.end();
    const { program, before, setup, recipe } = this.chosen, { files } = this;
    const job = {
      program: files.file(program), before: files.file(before), others: files.others(),
      setup: setup || undefined, recipe: recipe || undefined,
    };
    this.begin(recipe ? `${program} through ${recipe}` : before ? `${before} against ${program}` : program);
    const task = this.task = new Task(job, (told) => this.tell(told));
    try {
      const page = await task.done;
      if (task !== this.task) return;
      if (page.failure) this.fail("This cannot be run", this.tellShown(), page.failure);
      else await this.show(page, task);
    } catch (error) {
      if (task === this.task) this.failBy(error);
    }
    if (task === this.task) this.finish();
  }

  async show(page, task) {
    this.tell({ phase: "drawing" });
    byId("empty").hidden = true;
    await this.frame.show(page);
    if (task !== this.task) return;
    this.output = page.output ? { bytes: page.output, name: correctedName(this.chosen.program) } : null;
    byId("save").disabled = !this.output;
    byId("print").disabled = false;
    if (this.chosen.recipe && !this.output) {
      this.fail("No corrected program", "An error was found, so there is nothing to save: see the findings below the path.", "");
    }
  }

  begin(what) {
    byId("note").hidden = byId("failure").hidden = true;
    byId("status").hidden = false;
    byId("save").disabled = true;
    this.output = null;
    this.what = what;
    this.begun = performance.now();
    this.tell({ phase: "starting" });
    clearInterval(this.clock);
    this.clock = setInterval(() => this.tellTime(), 200);
    this.tellTime();
  }

  tell({ phase, fraction }) {
    if (phase) byId("status-text").textContent = `${this.what}: ${phase}`;
    if (fraction === undefined) byId("status-bar").removeAttribute("value");
    else byId("status-bar").value = fraction;
  }

  tellTime() { byId("status-time").textContent = `${((performance.now() - this.begun) / 1000).toFixed(1)} s`; }

  finish() {
    clearInterval(this.clock);
    this.task = null;
    this.seconds = (performance.now() - this.begun) / 1000;
    byId("status").hidden = true;
  }

  cancel() {
    this.task?.end();
    this.finish();
    this.tellNote(`${this.what}: cancelled. ${this.tellShown()} The files are still here; choose one above to begin anew.`);
  }

  tellShown() { return byId("frame").hidden ? "Nothing is shown yet." : "What is shown is from before."; }

  tellNote(text) { Object.assign(byId("note"), { textContent: text, hidden: false }); }

  fail(title, text, findings) {
    byId("failure").hidden = false;
    byId("failure-title").textContent = title;
    byId("failure-text").textContent = text;
    byId("failure-findings").textContent = findings;
  }

  failBy({ message, defect, stopped }) {
    if (defect) this.fail("A defect of clsmith", "Please report this, with the file if you may: the work on it stopped.", defect);
    else if (stopped) {
      this.fail("Not enough memory", `A page in a browser has 4 GiB at most, and this took more (${message}). The command (clsmith) has no such limit.`, "");
    } else this.fail("This did not work", message, "");
  }

  save() {
    if (!this.output) return;
    const address = URL.createObjectURL(new Blob([this.output.bytes], { type: "application/octet-stream" }));
    Object.assign(document.createElement("a"), { href: address, download: this.output.name }).click();
    setTimeout(() => URL.revokeObjectURL(address), 10000);
  }
}

// For the frame, for the console, and for tests.
window.clsmithViewer = new Viewer();

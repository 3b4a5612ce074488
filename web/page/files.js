// The files that were dropped or chosen, and what each of them is.

const MODEL_NAME = /\.(stl|clstock)$/i;
const YAML_NAME = /\.ya?ml$/i;

// Of a YAML file no more is looked at than this, in bytes.
const LOOKED_AT = 1 << 20;

// "program", "recipe", "setup", or "named": a file that another one names, such as a model, a machine or a material.
function kindOfYaml(name, text, texts) {
  if (/^(steps|version)\s*:/m.test(text)) return "recipe";
  const isNamed = [...texts].some(([other, content]) => other !== name && content.includes(name));
  if (isNamed || !/^(machine|stock|tools|material|units|words)\s*:/m.test(text)) return "named";
  return "setup";
}

class Files {
  constructor() {
    this.all = new Map();
    this.texts = new Map();
  }

  // Takes files; one of the same name is replaced. Returns what they are.
  async add(files) {
    for (const file of files) {
      this.all.set(file.name, { file, kind: "program" });
      if (YAML_NAME.test(file.name)) this.texts.set(file.name, await file.slice(0, LOOKED_AT).text().catch(() => ""));
    }
    for (const [name, entry] of this.all) {
      if (MODEL_NAME.test(name)) entry.kind = "named";
      else if (YAML_NAME.test(name)) entry.kind = kindOfYaml(name, this.texts.get(name), this.texts);
    }
    return files.map(({ name }) => ({ name, kind: this.all.get(name).kind }));
  }

  remove(names) {
    for (const name of names) { this.all.delete(name); this.texts.delete(name); }
  }

  names(kind) { return [...this.all].filter(([, entry]) => entry.kind === kind).map(([name]) => name); }

  file(name) { return this.all.get(name)?.file; }

  // All files but programs: what recipes and setups may name.
  others() { return [...this.all.values()].filter(({ kind }) => kind !== "program").map(({ file }) => file); }
}

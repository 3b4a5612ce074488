// What is known of the place in the program: a table, and a sentence for those who hear the page.

class Readout {
  constructor(programs, listing) {
    Object.assign(this, { programs, listing, element: document.getElementById("readout"), place: document.getElementById("place") });
  }

  lineOf(program, motion, row = program.row[motion]) {
    return (program.name === "before" ? this.listing.oldNumber : this.listing.newNumber)[row];
  }

  // Why a value is not shown: what a rapid through material would load is no load of a cut.
  unknownText(shown, name, motion) {
    const flags = shown.flags[motion];
    if (!(flags & RAPID)) return "not known";
    return name === "feed" ? "rapid" : flags & CRASH ? "crash" : "not known";
  }

  show(shown, motion, row) {
    const other = this.programs.find((program) => program !== shown);
    const pair = other ? shown.pair[motion] : NONE, known = pair !== undefined && pair !== NONE;
    const point = shown.point(shown.lastVertex(motion)).map((value) => value.toFixed(3 + MORE)).join(", ");
    const operation = shown.operations[shown.operation[motion]] || "(no name)", tool = shown.tools[shown.tool[motion]] ?? "";
    const cells = [
      ["motion", `${motion + 1} of ${shown.count}`],
      ["line", `${this.lineOf(shown, motion, row)}`],
      ["operation", operation],
      ["tool", tool],
      ["class", facts.classes[shown.class[motion]]],
      [`x, y, z in ${LENGTH}`, point],
      ["time", clockText(shown.alongTime[motion], 2)],
    ];
    for (const name of ["feed", ...shown.loads]) {
      const text = printed(name, shown.value(name, motion)) || this.unknownText(shown, name, motion);
      const was = known ? printed(name, other.value(name, pair)) : "";
      cells.push([QUANTITIES[name].title, was && was !== text ? `${text} (${other.name} ${was})` : text]);
    }
    const head = document.createElement("tr"), body = document.createElement("tr");
    for (const [name, value] of cells) {
      head.append(Object.assign(document.createElement("th"), { textContent: name }));
      body.append(Object.assign(document.createElement("td"), { textContent: visibleText(value) }));
    }
    this.element.replaceChildren(head, body);
    const crash = shown.flags[motion] & CRASH ? " · crash" : "";
    this.place.textContent = visibleText(
      `${shown.name === "before" ? "before · " : ""}line ${this.lineOf(shown, motion, row)} · ${facts.classes[shown.class[motion]]} · ${operation} · ${tool} · ${point}${crash}`);
  }
}

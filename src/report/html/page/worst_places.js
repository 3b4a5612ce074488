// The ten worst places of the program that is shown: the motions with the largest load, each with a jump to it.

const WORST = 10;

// The motions at feed with the largest values, one of each stretch of neighbours that the same value runs through.
function worstMotions(program, quantity) {
  const values = program[quantity], found = [];
  if (!values) return found;
  for (let motion = 0; motion < program.count; motion++) {
    const value = values[motion];
    if (!(value > 0) || program.flags[motion] & RAPID) continue;
    const least = found[found.length - 1];
    if (found.length === WORST && value <= values[least]) continue;
    // Of neighbours only the worst: ten times the same corner would say nothing.
    const near = found.findIndex((other) => Math.abs(other - motion) <= 3);
    if (near >= 0 && values[found[near]] >= value) continue;
    if (near >= 0) found.splice(near, 1);
    const place = found.findIndex((other) => values[other] < value);
    found.splice(place < 0 ? found.length : place, 0, motion);
    found.length = Math.min(found.length, WORST);
  }
  return found;
}

class WorstPlaces {
  // `chosen` is told a motion.
  constructor(parent, chosen) { Object.assign(this, { parent, chosen }); }

  show(program, quantity, lineOf) {
    const motions = worstMotions(program, quantity), { title, unit } = QUANTITIES[quantity];
    const limit = facts.limits.find((limit) => limit.quantity === quantity && quantity !== "feed")?.value;
    const top = motions.length ? program[quantity][motions[0]] : 1;
    const heads = [["line", "n"], ["operation", ""], [`${title}, ${unit}`, "n"], ...(limit ? [["of its target", "n"]] : []),
      [`feed, ${QUANTITIES.feed.unit}`, "n"], ["", ""]];
    const table = document.createElement("table"), head = table.createTHead().insertRow(), body = table.createTBody();
    for (const [text, className] of heads) head.append(Object.assign(document.createElement("th"), { textContent: text, className }));
    for (const motion of motions) {
      const row = body.insertRow(), value = program[quantity][motion];
      const link = Object.assign(document.createElement("a"), { href: "#work", textContent: grouped(String(lineOf(motion))) });
      link.addEventListener("click", (event) => { event.preventDefault(); this.chosen(motion); });
      const cell = (content, className = "") => {
        const at = row.insertCell();
        at.className = className;
        at.append(content);
      };
      cell(link, "n");
      cell(visibleText(program.operations[program.operation[motion]] || "(no name)"));
      cell(printedNumber(quantity, value), "n");
      if (limit) cell(`${(value / limit * 100).toFixed(1)} %`, "n");
      cell(printedNumber("feed", program.value("feed", motion)) || "rapid", "n");
      const bar = svg("svg", { width: 102, height: 12, viewBox: "0 0 102 12", "aria-hidden": "true" });
      bar.append(svg("rect", { class: "after", x: 1, y: 2, width: ((value / top) * 100).toFixed(1), height: 8 }));
      cell(bar);
    }
    this.parent.replaceChildren(motions.length ? table : document.createTextNode("No motion has a known load."));
  }
}

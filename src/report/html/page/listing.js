// The CL text: only the lines in sight are in the page.

const ROW_HEIGHT = 18;

// Browsers draw no higher elements than this; longer listings scroll by shares.
const MOST_HEIGHT = 12000000;

const OLD = 1, NEW = 2;

// Characters that would be invisible, or turn the line around, as signs that are seen.
function visibleText(text) {
  return text.replace(/[\u0000-\u0008\u000a-\u001f]/g, (c) => String.fromCharCode(0x2400 + c.charCodeAt(0)))
    .replace(/\u007f/g, "\u2421")
    .replace(/[\u0080-\u009f\u00ad\u061c\u200b-\u200f\u2028-\u202e\u2060-\u206f\ufeff\ufff9-\ufffb]/g, "\ufffd");
}

const utf8 = new TextDecoder("utf-8", { fatal: true, ignoreBOM: true });

// UTF-8 where it is, else each byte the Latin-1 character of its value.
function decodedRow(bytes) {
  try {
    return visibleText(utf8.decode(bytes));
  } catch {
    return visibleText(Array.from(bytes, (byte) => String.fromCharCode(byte)).join(""));
  }
}

class Listing {
  // `chosen` is told a row that was clicked.
  constructor({ kinds, steps }, chosen) {
    Object.assign(this, { text: null, kinds, steps, here: -1, hidesOld: false });
    this.numbers();
    this.element = document.getElementById("listing");
    this.rows = document.getElementById("listing-rows");
    this.element.addEventListener("scroll", () => this.draw());
    this.rows.addEventListener("click", (event) => {
      const row = event.target.closest(".row");
      if (row) chosen(Number(row.dataset.row));
    });
    this.element.addEventListener("keydown", (event) => {
      const step = { ArrowDown: 1, ArrowUp: -1 }[event.key];
      if (!step || this.here < 0) return;
      event.preventDefault();
      const at = this.placeOf(this.here) + step;
      if (at >= 0 && at < this.count()) chosen(this.rowAt(at));
    });
    document.getElementById("hide-old").addEventListener("change", (event) => {
      this.hidesOld = event.target.checked;
      this.layout();
      this.goTo(this.here);
    });
    new ResizeObserver(() => this.draw()).observe(this.element);
    this.layout();
  }

  // Takes the text of all rows, which comes after all else.
  takeText(text) {
    this.starts = new Uint32Array(this.kinds.length + 1);
    for (let at = text.indexOf(10), row = 1; at >= 0; at = text.indexOf(10, at + 1), row++) this.starts[row] = at + 1;
    this.text = text;
    this.draw();
  }

  // Line numbers of both programs up to each row, and the rows that are not old.
  numbers() {
    const count = this.kinds.length;
    this.oldNumber = new Uint32Array(count);
    this.newNumber = new Uint32Array(count);
    for (let row = 0, was = 0, is = 0; row < count; row++) {
      if (this.kinds[row] !== NEW) was++;
      if (this.kinds[row] !== OLD) is++;
      this.oldNumber[row] = was;
      this.newNumber[row] = is;
    }
  }

  count() { return this.hidesOld ? this.newNumber[this.newNumber.length - 1] || 0 : this.kinds.length; }

  // The row at a place in what is shown, and the place of a row.
  rowAt(place) { return this.hidesOld ? countUpTo(this.newNumber, place) : place; }
  placeOf(row) { return this.hidesOld ? Math.max(this.newNumber[row] - 1, 0) : row; }

  rowOfOldLine(line) { return Math.min(countUpTo(this.oldNumber, line - 1), this.kinds.length - 1); }
  rowOfNewLine(line) { return Math.min(countUpTo(this.newNumber, line - 1), this.kinds.length - 1); }

  rowText(row) {
    if (!this.text) return "…";
    return decodedRow(this.text.subarray(this.starts[row], this.starts[row + 1] - 1));
  }

  layout() {
    this.height = Math.min(this.count() * ROW_HEIGHT, MOST_HEIGHT);
    document.getElementById("listing-height").style.height = `${this.height}px`;
    this.draw();
  }

  // How many places a pixel of the scroll bar is.
  scale() {
    const seen = this.element.clientHeight, whole = this.count() * ROW_HEIGHT;
    return this.height > seen ? (whole - seen) / (this.height - seen) / ROW_HEIGHT : 0;
  }

  draw() {
    const first = this.element.scrollTop * this.scale(), whole = Math.floor(first);
    const seen = Math.ceil(this.element.clientHeight / ROW_HEIGHT) + 1, lines = [];
    for (let place = whole; place < Math.min(whole + seen, this.count()); place++) lines.push(this.line(this.rowAt(place)));
    this.rows.replaceChildren(...lines);
    this.rows.style.transform = `translateY(${-(first - whole) * ROW_HEIGHT}px)`;
  }

  line(row) {
    const line = document.createElement("div"), number = document.createElement("span"), kind = this.kinds[row];
    line.className = `row${kind === OLD ? " old" : kind === NEW ? " new" : ""}${row === this.here ? " here" : ""}`;
    line.dataset.row = row;
    number.className = "number";
    number.textContent = kind === OLD ? this.oldNumber[row] : this.newNumber[row];
    const sign = kind === OLD ? "- " : kind === NEW ? "+ " : "  ";
    const step = this.steps[row];
    if (step > 0) line.title = `${step}. ${facts.steps[step - 1] ?? ""}`;
    line.append(number, sign + this.rowText(row));
    return line;
  }

  // Shows a row, in the middle when it is not in sight.
  goTo(row) {
    if (row < 0) return;
    this.here = row;
    const place = this.placeOf(row), scale = this.scale(), seen = this.element.clientHeight / ROW_HEIGHT;
    const first = this.element.scrollTop * scale;
    if (scale > 0 && (place < first + 1 || place > first + seen - 2)) {
      this.element.scrollTop = Math.max(place - seen / 2, 0) / scale;
    }
    this.draw();
  }
}

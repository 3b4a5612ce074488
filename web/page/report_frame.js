// Shows a page of the library in a frame: the report's own template, style and scripts, around arrays that are handed over.

class ReportFrame {
  constructor(element) {
    this.element = element;
    // Template, style, scripts and licences, which are the same in every page.
    this.parts = textOf("report").then(JSON.parse);
  }

  // Shows a page; what was shown before goes, with its memory.
  async show({ sections, facts, arrays }) {
    const parts = await this.parts;
    // The frame's script takes it from here.
    window.clsmithViewer.given = { facts: JSON.parse(facts), arrays };
    const known = { ...sections, styles: parts.styles, scripts: parts.scripts, licences: parts.licences, policy: parts.policy, data: "" };
    const html = parts.template.replace(/\{\{(\w+)\}\}/g, (_, mark) => known[mark] ?? "");
    this.element.hidden = false;
    await new Promise((resolve) => {
      this.element.onload = resolve;
      this.element.srcdoc = html;
    });
    window.clsmithViewer.given = null;
    this.element.contentWindow.focus();
    listenToDrops(this.element.contentWindow);
  }

  print() { this.element.contentWindow?.print(); }
}

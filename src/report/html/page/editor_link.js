// Links the page with an editor that shows it: the place follows the editor's cursor, and a place that the reader chooses
// moves the cursor. A page in a browser has no editor, and then nothing of this happens.

// Messages to the page: { line } shows the motion of a line, counted from 1. Messages from it: { ready: true }, then { line }.
function linkWithEditor(page) {
  const editor = window.acquireVsCodeApi?.();
  if (!editor) return;
  followEditorTheme();
  let told = page.lineOfPlace();
  page.marked = () => {
    const line = page.lineOfPlace();
    if (line !== told) editor.postMessage({ line: (told = line) });
  };
  window.addEventListener("message", ({ data }) => {
    if (!Number.isInteger(data?.line)) return;
    told = NaN;
    const { marked } = page;
    // The editor is not told of the place that it asked for.
    page.marked = null;
    page.goToRow(page.listing.rowOfNewLine(data.line));
    page.marked = marked;
    told = page.lineOfPlace();
  });
  editor.postMessage({ ready: true });
}

// Editors have colours of their own, whatever those of the system are, and tell them by a class of the body.
function followEditorTheme() {
  const root = document.documentElement.classList;
  const follow = () => {
    const { classList: names } = document.body;
    const dark = names.contains("vscode-dark") || (names.contains("vscode-high-contrast") && !names.contains("vscode-high-contrast-light"));
    root.toggle("dark", dark);
    root.toggle("light", !dark);
    theme.announce();
  };
  root.add("in-editor");
  new MutationObserver(follow).observe(document.body, { attributeFilter: ["class"] });
  follow();
}

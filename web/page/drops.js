// Files that are dragged over the page, or over the frame in it.

// Whoever takes the files.
let takeFiles = () => {};

function showVeil(on) {
  document.getElementById("veil").hidden = !on;
}

function listenToDrops(target) {
  const hasFiles = (event) => [...(event.dataTransfer?.types ?? [])].includes("Files");
  target.addEventListener("dragover", (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    showVeil(true);
  });
  target.addEventListener("dragleave", (event) => { if (!event.relatedTarget) showVeil(false); });
  target.addEventListener("drop", (event) => {
    showVeil(false);
    if (!hasFiles(event)) return;
    event.preventDefault();
    takeFiles([...event.dataTransfer.files]);
  });
}

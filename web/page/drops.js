// Files that are dragged over the page, or over the frame in it.

// Whoever takes the files.
let takeFiles = () => {};

function showVeil(on) {
  document.getElementById("veil").hidden = !on;
}

function listenToDrops(target) {
  const hasFiles = (event) => [...(event.dataTransfer?.types ?? [])].includes("Files");
  const accept = (event) => {
    if (!hasFiles(event)) return;
    event.preventDefault();
    showVeil(true);
  };
  target.addEventListener("dragenter", accept);
  target.addEventListener("dragover", accept);
  target.addEventListener("dragleave", (event) => { if (!event.relatedTarget) showVeil(false); });
  target.addEventListener("drop", (event) => {
    showVeil(false);
    if (!hasFiles(event)) return;
    event.preventDefault();
    takeFiles([...event.dataTransfer.files]);
  });
}

// Paper: light colours, charts as wide as a page of A4, and a picture of the 3D view in place of its canvas.

// The width of A4 between margins of 12 mm and inside a card, in pixels of 1/96 inch.
const PAPER_WIDTH = 680;

function listenToPrinting(page) {
  const { view, charts, histogram } = page;
  const picture = Object.assign(document.createElement("img"), { id: "picture", alt: "the path and the stock in 3D" });
  const draw = (width) => {
    charts.paper = histogram.paper = width;
    charts.draw();
    histogram.drawn = null;
    histogram.draw();
  };
  addEventListener("beforeprint", () => {
    theme.onPaper(true);
    draw(PAPER_WIDTH);
    if (!view.scene) return;
    view.scene.draw();
    picture.src = view.scene.renderer.domElement.toDataURL("image/png");
    view.scene.renderer.domElement.after(picture);
  });
  addEventListener("afterprint", () => {
    picture.remove();
    theme.onPaper(false);
    draw(null);
  });
}

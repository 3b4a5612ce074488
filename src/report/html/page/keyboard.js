// Keys of the whole page. Where a field or a list has the focus, its own keys count.

function listenToKeys(page) {
  const { view, charts } = page;
  const step = (motions) => page.goTo(page.motion + motions);
  const hundredth = () => Math.max(Math.round(page.shown.count / 100), 1);
  const places = {
    ArrowRight: () => step(1), ArrowLeft: () => step(-1), PageDown: () => step(hundredth()), PageUp: () => step(-hundredth()),
    Home: () => page.goTo(0), End: () => page.goTo(page.shown.count - 1),
  };
  const others = {
    n: () => page.nextFinding(1), p: () => page.nextFinding(-1), b: () => page.otherSide(),
    i: () => view.look("iso"), t: () => view.look("top"), f: () => view.look("front"), r: () => view.look("right"),
    0: () => view.scene?.look(), "+": () => charts.zoomBy(0.5), "-": () => charts.zoomBy(2),
  };
  const turns = { ArrowLeft: [-0.1, 0], ArrowRight: [0.1, 0], ArrowUp: [0, 0.1], ArrowDown: [0, -0.1] };
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey || event.defaultPrevented) return;
    const focus = document.activeElement, canvas = view.scene?.renderer.domElement;
    if (focus === canvas && (turns[event.key] || "+-".includes(event.key))) {
      if (turns[event.key]) view.scene.turn(...turns[event.key]);
      else view.scene.zoomBy(event.key === "+" ? 1.2 : 1 / 1.2);
      event.preventDefault();
      return;
    }
    if (focus?.matches("input[type=range], select, input[type=text]")) {
      // A slider and a choice have arrows of their own, and letters choose in a list.
      if (places[event.key] || focus.matches("select")) return;
    }
    // Arrows and pages scroll the page, but where charts or 3D have the focus.
    const inside = focus === canvas || focus?.id === "charts";
    const action = others[event.key] ?? (inside ? places[event.key] : undefined);
    if (!action) return;
    action();
    event.preventDefault();
  });
}

//! Colours that are drawn, read back from pixels, against those that the legend and the style sheet name.

use super::chromium::{self, Browser};
use super::{OpenedReport, choose, open_report};
use crate::cli::clsmith;
use crate::report::simulation::{SHOP, SLOT};
use crate::support::require_program;
use serde_json::json;

/// Functions of a test in the page: the pixels of the 3D view, and the closest one to a colour around a point.
const PIXELS: &str = "window.pixels = () => {
  clsmith.view.scene.draw();
  const from = clsmith.view.scene.renderer.domElement, to = document.createElement('canvas');
  [to.width, to.height] = [from.width, from.height];
  const context = to.getContext('2d');
  context.drawImage(from, 0, 0);
  return context.getImageData(0, 0, to.width, to.height);
};
window.offAround = ([x, y], [r, g, b], reach) => {
  const { data, width } = pixels();
  let least = Infinity;
  for (let dy = -reach; dy <= reach; dy++) for (let dx = -reach; dx <= reach; dx++) {
    const at = 4 * ((Math.round(y) + dy) * width + Math.round(x) + dx);
    least = Math.min(least, Math.max(Math.abs(data[at] - r), Math.abs(data[at + 1] - g), Math.abs(data[at + 2] - b)));
  }
  return least;
};
window.legendColor = (share) => {
  const strip = document.querySelector('#legend canvas');
  return [...strip.getContext('2d').getImageData(Math.round(share * 255), 0, 1, 1).data].slice(0, 3);
};
// A line is a pixel wide and smoothed, so most of its pixels mix its colour with the background: they are as far off as
// they are from the nearest mixture with a third of the colour or more.
window.offAlong = (motion, color) => {
  const program = clsmith.shown, end = program.lastVertex(motion), a = program.point(end - 1), b = program.point(end);
  const shares = Array.from({ length: 90 }, (_, i) => 0.05 + i / 100);
  const { data, width } = pixels();
  const behind = [data[0], data[1], data[2]], way = color.map((part, i) => part - behind[i]);
  const squared = way.reduce((sum, part) => sum + part * part, 0);
  const off = (at) => {
    const share = way.reduce((sum, part, i) => sum + part * (data[at + i] - behind[i]), 0) / squared;
    if (!(share >= 1 / 3)) return Infinity;
    return Math.max(...way.map((part, i) => Math.abs(data[at + i] - behind[i] - part * Math.min(share, 1))));
  };
  return Math.min(...shares.map((share) => {
    const [x, y] = clsmith.view.scene.onScreen(a.map((value, axis) => value + (b[axis] - value) * share)).map(Math.round);
    return Math.min(...[-1, 0, 1].flatMap((dx) => [-1, 0, 1].map((dy) => off(4 * ((y + dy) * width + x + dx)))));
  }));
};
window.rgbOf = (name) => getComputedStyle(document.documentElement).getPropertyValue(name).trim();";

fn set_dark(browser: &mut Browser, dark: bool) {
    let value = if dark { "dark" } else { "light" };
    let features = json!([{ "name": "prefers-color-scheme", "value": value }]);
    browser.call("Emulation.setEmulatedMedia", json!({ "features": features }));
    browser.wait(&format!(
        "(() => {{ const [r] = clsmith.view.scene.scene.background.toArray(); return (r < 0.5) === {dark}; }})()"
    ));
}

#[test]
fn what_the_legend_shows_is_what_is_drawn() {
    let Some(OpenedReport { mut browser, .. }) = open_report() else { return };
    browser.value(PIXELS);
    browser.value("document.getElementById('tool').click()");
    choose(&mut browser, "stock", "none");
    for dark in [false, true] {
        set_dark(&mut browser, dark);
        // The background is the style sheet's colour, to the byte.
        let background = browser.value(
            "(() => { const { data } = pixels(); return '#' + [0, 1, 2].map((i) => data[i].toString(16).padStart(2, '0')).join('') === rgbOf('--scene'); })()",
        );
        assert_eq!(background, true, "dark {dark}");
        for mode in ["feed", "chip"] {
            choose(&mut browser, "color", mode);
            // A cut whose path no other one covers, and one with another value.
            for motion in [2, 4] {
                let share = format!(
                    "(() => {{ const [low, high] = clsmith.view.coloring.range; return (clsmith.shown.value('{mode}', {motion}) - low) / (high - low); }})()"
                );
                let off = browser.number(&format!("offAlong({motion}, legendColor({share}))"));
                assert!(off <= 3.0, "{mode} of motion {motion}, dark {dark}: off by {off} of 255");
            }
        }
        // A rapid has the colour of its name in the legend.
        let off = browser.number("offAlong(0, clsmith.view.coloring.color(clsmith.shown, 0))");
        assert!(off <= 3.0, "a rapid, dark {dark}: {off}");
        let swatch = browser.value(
            "[...document.querySelectorAll('#legend i')].some((swatch) => swatch.style.background.replaceAll(' ', '') === 'rgb(' + clsmith.view.coloring.color(clsmith.shown, 0).join() + ')')",
        );
        assert_eq!(swatch, true);
    }
    assert_eq!(browser.complaints(), [] as [String; 0]);
}

#[test]
fn the_surface_has_the_colours_of_the_motions_that_made_it() {
    let Some(OpenedReport { mut browser, .. }) = open_report() else { return };
    browser.value(PIXELS);
    browser.value("document.getElementById('tool').click(); document.getElementById('path').click(); clsmith.view.look('top')");
    choose(&mut browser, "stock", "load");
    browser.wait("document.getElementById('view-note').hidden && clsmith.view.scene.surface.mesh.material === clsmith.view.scene.surface.flat");
    // The bottom of the first slot is of the motion that made it, and what is left for the way back of that one.
    for (motion, y) in [(2, 23.0), (2, 18.0), (5, 12.0)] {
        let off = browser.number(&format!(
            "offAround(clsmith.view.scene.onScreen([30, {y}, -2]), clsmith.view.coloring.color(clsmith.shown, {motion}), 1)"
        ));
        assert!(off <= 2.0, "motion {motion}: off by {off} of 255");
    }
    // What no tool touched has the colour of what is not known.
    let raw = browser.number(
        "offAround(clsmith.view.scene.onScreen([5, 35, 0]), [...rgbOf('--unknown').matchAll(/[0-9a-f]{2}/g)].map((part) => parseInt(part[0], 16)), 1)",
    );
    assert!(raw <= 2.0, "{raw}");
    assert_eq!(browser.complaints(), [] as [String; 0]);
}

#[test]
fn text_and_lines_stand_out_from_both_backgrounds() {
    let Some(OpenedReport { mut browser, .. }) = open_report() else { return };
    browser.value(PIXELS);
    // Contrast as WCAG 2.2 defines it: 4.5 for text, 3 for what is drawn.
    let contrast = "(one, other) => {
      const light = (name) => {
        const parts = [...rgbOf(name).matchAll(/[0-9a-f]{2}/g)].map((part) => parseInt(part[0], 16) / 255);
        const [r, g, b] = parts.map((value) => (value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4));
        return 0.2126 * r + 0.7152 * g + 0.0722 * b + 0.05;
      };
      const [a, b] = [light(one), light(other)];
      return Math.max(a, b) / Math.min(a, b);
    }";
    for dark in [false, true] {
        set_dark(&mut browser, dark);
        for (name, ground, least) in [
            ("--ink", "--card", 7.0),
            ("--dim", "--card", 4.5),
            ("--dim", "--bg", 4.5),
            ("--after", "--card", 4.5),
            ("--before", "--card", 4.5),
            ("--limit", "--card", 4.5),
            ("--bad", "--bad-bg", 4.5),
            ("--warn", "--warn-bg", 4.5),
            ("--rapid", "--scene", 3.0),
            ("--bad", "--scene", 3.0),
            ("--place", "--scene", 3.0),
        ] {
            let found = browser.number(&format!("({contrast})('{name}', '{ground}')"));
            assert!(found >= least, "{name} on {ground}, dark {dark}: {found:.2}");
        }
    }
}

#[test]
fn what_is_off_the_target_is_coloured_and_measured() {
    let Some(chromium) = require_program(&chromium::NAMES) else { return };
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("shop.yaml"), SHOP).unwrap();
    let simulate = |depth: &str, more: &[&str]| {
        std::fs::write(folder.path().join("part.cls"), SLOT.replace(",-2.0000", depth)).unwrap();
        let args = ["simulate", "part.cls", "--setup", "shop.yaml", "--chips", "columns", "-q"];
        clsmith(folder.path()).args(args).args(more).assert().success();
    };
    // The target is the slot 2 mm deep; the program leaves 1 mm in it.
    simulate(",-2.0000", &["--stl", "part.stl"]);
    simulate(",-1.0000", &["--target", "part.stl", "--report", "out.html"]);
    let mut browser = Browser::start(&chromium);
    browser.open(&folder.path().join("out.html"));
    browser.wait("!!window.clsmith?.listing.text");
    browser.value(PIXELS);
    let at = "(x, y) => { const { columns, cell, x0, y0 } = clsmith.view.scene.surface.states.grid, [ox, oy] = [clsmith.shown.point(0)[0] - clsmith.shown.x[0], clsmith.shown.point(0)[1] - clsmith.shown.y[0]];
      return clsmith.view.deviations[Math.round((y - oy - y0) / cell) * columns + Math.round((x - ox - x0) / cell)]; }";
    let left = browser.number(&format!("({at})(30, 20)"));
    assert!((left - 1.0).abs() < 1e-4, "{left} mm");
    let right = browser.number(&format!("({at})(30, 35)"));
    assert!(right.abs() < 1e-4, "{right} mm");
    browser.value("document.getElementById('tool').click(); document.getElementById('path').click(); clsmith.view.look('top')");
    choose(&mut browser, "stock", "deviation");
    // Too much is red, right is grey; the legend says so.
    for (point, color) in [("[30, 20, -1]", "[185, 30, 30]"), ("[30, 35, 0]", "[151, 160, 164]")] {
        let off = browser.number(&format!("offAround(clsmith.view.scene.onScreen({point}), {color}, 1)"));
        assert!(off <= 4.0, "{point}: off by {off} of 255");
    }
    assert!(browser.text("document.getElementById('legend').textContent").contains("left 1.000"));
    assert_eq!(browser.complaints(), [] as [String; 0]);
}

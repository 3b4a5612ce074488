//! The stock that the page shows at the slider, against simulations of the program up to there.

use super::{OpenedReport, open_report};
use crate::cli::clsmith;
use std::path::Path;

/// The volume that a simulation leaves, mm3.
fn simulated_mm3(folder: &Path, part: &str) -> f64 {
    std::fs::write(folder.join("start.cls"), part).unwrap();
    let run = clsmith(folder)
        .args(["simulate", "start.cls", "--setup", "shop.yaml", "--chips", "columns", "-q", "--json"])
        .assert()
        .success();
    let document: serde_json::Value = serde_json::from_slice(&run.get_output().stdout).unwrap();
    document["stock"]["left_mm3"].as_f64().unwrap()
}

#[test]
fn the_stock_at_the_slider_is_what_a_simulation_up_to_there_leaves() {
    let Some(OpenedReport { mut browser, folder, .. }) = open_report() else { return };
    let written = std::fs::read_to_string(folder.path().join("out.cls")).unwrap();
    let lines: Vec<&str> = written.lines().collect();
    let count = browser.number("clsmith.shown.count") as usize;
    let mut seen = Vec::new();
    for motion in [1, count / 3, count / 2, count - 2] {
        browser.value(&format!("clsmith.goTo({motion}); clsmith.view.follow()"));
        let line = browser.number("clsmith.readout.lineOf(clsmith.shown, clsmith.motion)") as usize;
        let shown = browser.number(
            "(() => { const { surface } = clsmith.view.scene, { cell } = surface.states.grid;
              return surface.heights.reduce((sum, height) => sum + (height === height ? height : 0), 0) * cell * cell; })()",
        );
        let part = format!("{}\n", lines[..line].join("\n"));
        let simulated = simulated_mm3(folder.path(), &part);
        assert!(
            (shown - simulated).abs() < 0.002 * simulated,
            "motion {motion}: {shown} mm3, simulated {simulated} mm3"
        );
        seen.push(shown);
    }
    assert!(seen.windows(2).all(|pair| pair[1] <= pair[0]) && seen[3] < seen[0] - 1000.0, "{seen:?}");
    assert_eq!(browser.complaints(), [] as [String; 0]);
}

#[test]
fn between_kept_states_the_page_cuts_as_the_simulation_does() {
    let Some(OpenedReport { mut browser, .. }) = open_report() else { return };
    // From the raw stock to the end by the page alone, against the state that the simulation left.
    let off = "(() => { const { states } = clsmith.view.scene.surface, heights = states.states[0].slice();
      for (let motion = 0; motion < states.program.count; motion++) states.lower(motion, heights);
      let most = 0, cut = 0;
      heights.forEach((height, cell) => { most = Math.max(most, Math.abs(height - states.last[cell])); cut += height < states.states[0][cell]; });
      return [most, cut]; })()";
    let found = browser.value(off);
    let (most, cut) = (found[0].as_f64().unwrap(), found[1].as_f64().unwrap());
    assert!(cut > 1000.0, "{cut} cells were cut");
    // The flat bottom of the slot, ramps included: half a cell of a steep ramp is the most that sampling leaves.
    assert!(most < 0.06, "{most} mm");
    assert!(browser.number("clsmith.view.scene.surface.states.kept.length") >= 4.0);
}

#[test]
fn a_section_opens_the_stock_and_its_face_follows_the_heights() {
    let Some(OpenedReport { mut browser, .. }) = open_report() else { return };
    super::choose(&mut browser, "section", "0");
    assert_eq!(browser.value("document.getElementById('section-at').hidden"), false);
    let area = "(() => { const { face, states } = clsmith.view.scene.surface, p = face.geometry.attributes.position.array;
      let area = 0;
      for (let i = 0; i + 11 < p.length; i += 6) area += (p[i + 7] - p[i + 1]) * ((p[i + 5] - p[i + 2]) + (p[i + 11] - p[i + 8])) / 2;
      return face.visible ? area : -1; })()";
    // Across the block of 40 x 10 mm, of which a slot of 10 x 2 is gone.
    let across = browser.number(area);
    assert!((300.0..400.0).contains(&across), "{across} mm2");
    let count = browser.number("clsmith.view.scene.renderer.clippingPlanes.length");
    assert_eq!(count, 1.0);
    super::choose(&mut browser, "section", "none");
    assert_eq!(browser.number("clsmith.view.scene.renderer.clippingPlanes.length"), 0.0);
    assert_eq!(browser.complaints(), [] as [String; 0]);
}

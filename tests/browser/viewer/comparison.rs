//! Two files that are compared: the same page, the first as the program before.

use super::{example, open_viewer};
use crate::report::simulation::SLOT;

#[test]
fn two_files_are_compared_and_can_be_swapped() {
    let Some(mut viewer) = open_viewer() else { return };
    let a = viewer.write("a.cls", SLOT);
    let b =
        viewer.write("b.cls", SLOT.replace("GOTO/70.0000,15.0000,-2.0000", "GOTO/72.0000,15.0000,-2.0000"));
    viewer.show(&[a, b]);
    assert_eq!(viewer.in_frame("document.title"), "b.cls");
    assert_eq!(viewer.browser.value("document.getElementById('before').value"), "a.cls");
    let lead = viewer.in_frame("document.querySelector('header').textContent");
    assert!(lead.as_str().unwrap().contains("Compared with a.cls"), "{lead}");
    // One line differs, and both are seen.
    let rows = "['old', 'new'].map((kind) => [...document.querySelectorAll(`.row.${kind}`)].map((row) => row.textContent.slice(-28)).join())";
    let rows = viewer.in_frame(rows);
    assert!(rows[0].as_str().unwrap().ends_with("GOTO/70.0000,15.0000,-2.0000"), "{rows}");
    assert!(rows[1].as_str().unwrap().ends_with("GOTO/72.0000,15.0000,-2.0000"), "{rows}");
    let verdict = viewer.in_frame("document.getElementById('verdict').textContent");
    assert!(verdict.as_str().unwrap().contains("1 point moved"), "{verdict}");
    // Motions belong together: the one whose end moved is elsewhere, the first ones are as they were.
    assert_eq!(viewer.in_frame("clsmith.shown.change[0]"), 0);
    assert_eq!(viewer.in_frame("[...clsmith.shown.change].some((change) => change === 3)"), true);
    assert_eq!(
        viewer.in_frame("clsmith.shown.pair[clsmith.shown.count - 1] === clsmith.programs[0].count - 1"),
        true
    );
    // The other way round.
    viewer.browser.value("clsmithViewer.seconds = 0");
    viewer.press("swap");
    viewer.wait_for_end();
    assert_eq!(viewer.in_frame("document.title"), "a.cls");
    assert_eq!(viewer.browser.value("document.getElementById('save').disabled"), true);
    assert_eq!(viewer.browser.complaints(), [] as [String; 0]);
}

#[test]
fn files_of_two_dialects_are_compared() {
    let Some(mut viewer) = open_viewer() else { return };
    viewer.show(&[example("second-vise/part.aptsource"), example("metric-shop/part.ncl")]);
    let lead = viewer.in_frame("document.querySelector('header').textContent");
    assert!(lead.as_str().unwrap().contains("Compared with part.aptsource (CATIA"), "{lead}");
    assert_eq!(viewer.in_frame("clsmith.programs.every((program) => program.count > 3)"), true);
    assert_eq!(viewer.browser.complaints(), [] as [String; 0]);
}

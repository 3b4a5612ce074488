//! A program that is dropped: its path, charts, text and findings, and what cancelling leaves.

use super::{FRAME, example, open_viewer};
use crate::browser::chromium::DRAWN;
use crate::report::simulation::{SHOP, SLOT};
use std::fmt::Write;

#[test]
fn a_dropped_program_is_drawn_and_its_parts_follow_one_place() {
    let Some(mut viewer) = open_viewer() else { return };
    let part = viewer.write("slot.cls", SLOT);
    viewer.show(std::slice::from_ref(&part));
    assert_eq!(viewer.in_frame("document.title"), "slot.cls");
    assert!(viewer.in_frame(DRAWN).as_f64().unwrap() > 300.0);
    assert_eq!(viewer.in_frame("document.querySelectorAll('svg.chart').length"), 2);
    assert_eq!(viewer.seen_text("empty"), "");
    // A click on a line moves the slider to its motion, and marks the line.
    viewer.in_frame("clsmith.goTo(0)");
    let row = "[...document.querySelectorAll('.row')].find((row) => row.textContent.includes('GOTO/70.0000,15.0000,-2.0000'))";
    viewer.in_frame(&format!("{row}.click()"));
    assert!(viewer.in_frame("clsmith.motion").as_f64().unwrap() > 1.0);
    let marked = viewer.in_frame("document.querySelector('.row.here').textContent");
    assert!(marked.as_str().unwrap().contains("GOTO/70.0000,15.0000,-2.0000"), "{marked}");
    // The keys of the page are at hand at once: the frame has the focus.
    assert_eq!(viewer.browser.value("document.activeElement.id"), "frame");

    // A setup that comes later is taken for it: stock and loads are there.
    let shop = viewer.write("shop.yaml", SHOP);
    viewer.show(&[shop]);
    assert_eq!(viewer.browser.value("document.getElementById('setup').value"), "shop.yaml");
    assert_eq!(viewer.in_frame("document.querySelectorAll('svg.chart').length"), 4);
    assert_eq!(viewer.in_frame("!!document.getElementById('stock')"), true);
    assert!(viewer.in_frame(DRAWN).as_f64().unwrap() > 5000.0);
    // Without it, it is as before.
    viewer.browser.value("clsmithViewer.seconds = 0");
    crate::browser::choose(&mut viewer.browser, "setup", "");
    viewer.wait_for_end();
    assert_eq!(viewer.in_frame("document.querySelectorAll('svg.chart').length"), 2);
    assert_eq!(viewer.browser.complaints(), [] as [String; 0]);
}

#[test]
fn every_dialect_is_opened() {
    let Some(mut viewer) = open_viewer() else { return };
    for (file, dialect) in [
        ("web-pocket/part.cls", "Siemens NX"),
        ("second-vise/part.aptsource", "CATIA"),
        ("metric-shop/part.ncl", "Creo"),
    ] {
        viewer.show(&[example(file)]);
        let lead = viewer.in_frame("document.querySelector('header').textContent");
        assert!(lead.as_str().unwrap().contains(dialect), "{file}: {lead}");
        assert!(viewer.in_frame("clsmith.shown.count").as_f64().unwrap() > 3.0, "{file}");
    }
    assert_eq!(viewer.browser.complaints(), [] as [String; 0]);
}

#[test]
fn the_example_is_one_press_away() {
    let Some(mut viewer) = open_viewer() else { return };
    viewer.browser.value("clsmithViewer.seconds = 0");
    viewer.press("example");
    viewer.wait_for_end();
    assert_eq!(viewer.in_frame("clsmith.programs.length"), 2);
    assert_eq!(viewer.browser.value("document.getElementById('save').disabled"), false);
    // Its recipe and its setup are not for a program of one's own.
    let part = viewer.write("slot.cls", SLOT);
    viewer.show(&[part]);
    for (choice, name) in [("program", "slot.cls"), ("setup", ""), ("recipe", "")] {
        let chosen = viewer.browser.value(&format!("document.getElementById('{choice}').value"));
        assert_eq!(chosen, name, "{choice}");
    }
    assert_eq!(viewer.in_frame("clsmith.programs.length"), 1);
    assert_eq!(viewer.browser.complaints(), [] as [String; 0]);
}

#[test]
fn cancelled_work_ends_at_once_and_leaves_what_was_shown() {
    let Some(mut viewer) = open_viewer() else { return };
    let part = viewer.write("slot.cls", SLOT);
    viewer.show(&[part]);
    let mut long = String::from("LOAD/TOOL,1\nFEDRAT/MMPM,500\n");
    for index in 0..600_000 {
        writeln!(long, "GOTO/{}.0000,{}.0000,-1.0000", index % 997, index / 997).unwrap();
    }
    let long = viewer.write("long.cls", long);
    viewer.drop_files(&[long]);
    viewer.browser.wait("document.getElementById('status-text').textContent.includes('long.cls: reading')");
    viewer.press("cancel");
    assert_eq!(viewer.seen_text("status"), "");
    let told = viewer.seen_text("note");
    assert!(told.contains("long.cls: cancelled. What is shown is from before."), "{told}");
    assert_eq!(viewer.in_frame("document.title"), "slot.cls");
    assert_eq!(viewer.browser.value("clsmithViewer.task === null"), true);
    // The next work is not held up by it, and the file that was cancelled can still be opened.
    viewer.browser.value("clsmithViewer.seconds = 0; clsmithViewer.choose({ program: 'long.cls' })");
    viewer.wait_for_end();
    assert_eq!(viewer.in_frame("clsmith.shown.count"), 599_999);
    assert_eq!(viewer.seen_text("note"), "");
    let frames = viewer.browser.number(&format!("{FRAME}.document.querySelectorAll('canvas').length"));
    assert!(frames >= 1.0);
    assert_eq!(viewer.browser.complaints(), [] as [String; 0]);
}

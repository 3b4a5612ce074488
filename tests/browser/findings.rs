//! Findings of a refused program: verdict, table, links, rings and keys.

use super::chromium::{self, Browser};
use super::middle;
use crate::cli::clsmith;
use crate::report::simulation::{SHOP, SLOT};
use crate::support::require_program;
use std::path::{Path, PathBuf};

/// A report of a program with a rapid through the stock.
fn refused_report(folder: &Path) -> PathBuf {
    let part = SLOT.replace(
        "RAPID\nGOTO/-10.0000,15.0000,20.0000\n",
        "RAPID\nGOTO/70.0000,35.0000,-4.0000\nRAPID\nGOTO/70.0000,35.0000,20.0000\n",
    );
    std::fs::write(folder.join("part.cls"), part).unwrap();
    std::fs::write(folder.join("shop.yaml"), SHOP).unwrap();
    std::fs::write(folder.join("recipe.yaml"), "version: 1\nsteps:\n  - scale_feed: { factor: 0.5 }\n")
        .unwrap();
    let args = [
        "apply",
        "recipe.yaml",
        "part.cls",
        "-o",
        "out.cls",
        "--setup",
        "shop.yaml",
        "--report",
        "out.html",
        "-q",
    ];
    clsmith(folder).args(args).assert().code(1);
    folder.join("out.html")
}

#[test]
fn the_verdict_comes_first_and_every_finding_leads_to_its_line_chart_and_place() {
    let Some(chromium) = require_program(&chromium::NAMES) else { return };
    let folder = tempfile::tempdir().unwrap();
    let page = refused_report(folder.path());
    let mut browser = Browser::start(&chromium);
    browser.open(&page);
    browser.wait("!!window.clsmith?.listing.text");
    let verdict = browser.text("document.querySelector('#verdict b').textContent");
    assert!(
        verdict.starts_with("Do not post: ") && verdict.ends_with("No program was written."),
        "{verdict}"
    );
    assert_eq!(browser.value("document.querySelector('#verdict').classList.contains('stop')"), true);
    // It is the first thing after the name, and says what the table says first of errors.
    assert_eq!(browser.text("document.querySelector('main > section').id"), "verdict");
    let first =
        browser.text("document.querySelector('.finding.error td:nth-child(2)').firstChild.textContent");
    assert!(verdict.contains(first.trim_end_matches('.')), "{verdict}: {first}");

    // A ring marks the place, and a click on the link goes there: slider, line, charts, 3D.
    let rings = browser.number("document.querySelectorAll('#hud circle.ring.error').length");
    assert!(rings >= 1.0);
    browser.value("clsmith.goTo(0)");
    browser.value("document.querySelector('#findings .finding.error a').id = 'wanted'");
    let at = middle(&mut browser, "#wanted");
    browser.click(at);
    assert_eq!(
        browser.text("document.querySelector('.row.here').textContent.trim().split(' ').pop()"),
        "GOTO/70.0000,35.0000,-4.0000"
    );
    let marked = browser.number("clsmith.motion");
    assert_eq!(browser.number("Number(document.getElementById('slider').value)"), marked);
    assert!(browser.text("document.getElementById('place').textContent").contains("crash"));
    let together = "(() => { const ring = document.querySelector('#hud circle.ring.error'), mark = document.getElementById('marker');
      return Math.hypot(...['cx', 'cy'].map((name) => ring.getAttribute(name) - mark.getAttribute(name))); })()";
    assert!(browser.number(together) < 1.0);
    // A crash is drawn in the red of the style sheet.
    let bad = "(() => { const color = clsmith.view.coloring.color(clsmith.shown, clsmith.motion);
      return '#' + color.map((value) => value.toString(16).padStart(2, '0')).join('') === getComputedStyle(document.documentElement).getPropertyValue('--bad').trim(); })()";
    assert_eq!(browser.value(bad), true);

    // Keys: n goes to a finding from anywhere, arrows over the charts go through motions, b shows the program before.
    browser.value("clsmith.goTo(0); document.activeElement.blur()");
    browser.key("n");
    assert!(browser.number("clsmith.motion") > 0.0);
    browser.value("clsmith.goTo(2); document.getElementById('charts').focus()");
    browser.key("ArrowRight");
    assert_eq!(browser.number("clsmith.motion"), 3.0);
    browser.key("b");
    assert_eq!(browser.text("clsmith.shown.name"), "before");
    assert_eq!(browser.complaints(), [] as [String; 0]);

    // An address may name a line, for links from elsewhere.
    let url = format!("file://{}#line=12", page.display());
    browser.call("Page.navigate", serde_json::json!({ "url": "about:blank" }));
    browser.call("Page.navigate", serde_json::json!({ "url": url }));
    browser.wait("!!window.clsmith?.listing.text");
    assert_eq!(browser.number("clsmith.readout.lineOf(clsmith.shown, clsmith.motion)"), 12.0);
}

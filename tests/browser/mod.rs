//! The report's page in a real browser.

mod chromium;
mod drawn_colors;
mod findings;
mod in_editor;
mod looks;
mod paper;
mod stock_states;
mod viewer;

use crate::cli::clsmith;
use crate::report::simulation::{SHOP, SLOT};
use crate::support::require_program;
use chromium::{Browser, DRAWN};
use std::path::{Path, PathBuf};

/// The feed of the slot in one operation, and a comment that tries to be markup.
const RECIPE: &str = "version: 1
steps:
  - scale_feed: { factor: 0.5 }
  - optimize_feed: { target: 0.04, max_feed: 2000, air_feed: 2000, cell: 0.5 }
";

const EVIL: &str =
    "$$ </script><script>window.hurt = 1</script><img src=x onerror='window.hurt = 2'> \u{202e}&amp;\n";

/// A report of a program that a recipe changed.
fn report(folder: &Path, shop: Option<&str>) -> PathBuf {
    let part = SLOT.replace("PAINT/COLOR,31\n", &format!("PAINT/COLOR,31\n{EVIL}"));
    std::fs::write(folder.join("part.cls"), part).unwrap();
    let mut command = clsmith(folder);
    command.args(["apply", "recipe.yaml", "part.cls", "-o", "out.cls", "--report", "out.html", "-q"]);
    let recipe = match shop {
        Some(shop) => {
            std::fs::write(folder.join("shop.yaml"), shop).unwrap();
            command.args(["--setup", "shop.yaml"]);
            RECIPE
        }
        None => "version: 1\nsteps:\n  - scale_feed: { factor: 0.5 }\n",
    };
    std::fs::write(folder.join("recipe.yaml"), recipe).unwrap();
    command.assert().success();
    folder.join("out.html")
}

/// The report of a correction with its setup, open in a browser. The page is in the folder.
struct OpenedReport {
    browser: Browser,
    folder: tempfile::TempDir,
    page: PathBuf,
}

/// Makes the report and opens it; `None` where there is no browser.
#[track_caller]
fn open_report() -> Option<OpenedReport> {
    let chromium = require_program(&chromium::NAMES)?;
    let folder = tempfile::tempdir().unwrap();
    let page = report(folder.path(), Some(SHOP));
    let mut browser = Browser::start(&chromium);
    browser.open(&page);
    browser.wait("!!window.clsmith?.listing.text");
    Some(OpenedReport { browser, folder, page })
}

/// The middle of an element in the window.
fn middle(browser: &mut Browser, selector: &str) -> [f64; 2] {
    browser.value(&format!("document.querySelector('{selector}').scrollIntoView({{ block: 'center' }})"));
    let part = |what: &str| {
        format!(
            "(() => {{ const box = document.querySelector('{selector}').getBoundingClientRect(); return {what}; }})()"
        )
    };
    [browser.number(&part("box.left + box.width / 2")), browser.number(&part("box.top + box.height / 2"))]
}

/// How many corners the lines of each chart have.
const CHARTED: &str = "[...document.querySelectorAll('svg.chart')].map((chart) =>
  [...chart.querySelectorAll('path.line')].reduce((sum, path) => sum + path.getAttribute('d').split('H').length - 1, 0))";

/// Chooses an entry of a list, as a reader would.
fn choose(browser: &mut Browser, id: &str, value: &str) {
    browser.value(&format!(
        "(() => {{ const list = document.getElementById('{id}'); list.value = '{value}'; list.dispatchEvent(new Event('change')); }})()"
    ));
}

/// What a reader sees of the place: slider, marked line, readout, where the mark stands in the 3D and in the first chart.
fn place(browser: &mut Browser) -> (f64, String, String, String, String) {
    (
        browser.number("Number(document.getElementById('slider').value)"),
        browser.text("document.querySelector('.row.here').textContent"),
        browser.text("document.getElementById('readout').textContent"),
        browser
            .text("['cx', 'cy'].map((name) => document.getElementById('marker').getAttribute(name)).join()"),
        browser.text("document.querySelector('.chart .at').getAttribute('d')"),
    )
}

#[test]
fn the_page_draws_and_its_parts_follow_one_place() {
    let Some(OpenedReport { mut browser, page, .. }) = open_report() else { return };

    // It draws: path and stock, and a chart each for feed, chip, power and z.
    let all = browser.number(DRAWN);
    assert!(all > 5000.0, "{all} pixels");
    let charts = browser.value(CHARTED);
    let charts = charts.as_array().unwrap();
    assert_eq!(charts.len(), 4);
    assert!(charts.iter().all(|count| count.as_u64().unwrap() > 500), "{charts:?}");
    // Without stock and tool less is drawn, and without rapids less again.
    choose(&mut browser, "stock", "none");
    let at = middle(&mut browser, "#tool");
    browser.click(at);
    let path = browser.number(DRAWN);
    let at = middle(&mut browser, "#rapids");
    browser.click(at);
    let feed = browser.number(DRAWN);
    assert!(0.0 < feed && feed < path && path < all, "{feed} {path} {all}");

    // The slider moves, and everything follows.
    let before = place(&mut browser);
    let at = middle(&mut browser, "#slider");
    browser.click(at);
    let clicked = place(&mut browser);
    assert_ne!(before.0, clicked.0);
    browser.key("ArrowRight");
    let after = place(&mut browser);
    assert_eq!(after.0, clicked.0 + 1.0);
    assert!(after.1 != clicked.1 && after.2 != clicked.2 && after.3 != clicked.3 && after.4 != clicked.4);

    // A click on a point in 3D shows its line.
    browser.value("document.getElementById('view').scrollIntoView({ block: 'center' })");
    let wanted = browser.number("clsmith.shown.row.findIndex((row) => clsmith.listing.rowText(row) === 'GOTO/70.0000,15.0000,-2.0000')");
    let spot = "(() => { const program = clsmith.shown, motion = MOTION, box = document.getElementById('view').getBoundingClientRect();
        const to = program.point(program.lastVertex(motion)), from = program.point(program.lastVertex(motion) - 1);
        const [x, y] = clsmith.view.scene.onScreen(to.map((value, axis) => value * 0.6 + from[axis] * 0.4));
        return [box.left + x, box.top + y]; })()"
        .replace("MOTION", &wanted.to_string());
    let at = browser.value(&spot);
    browser.click([at[0].as_f64().unwrap(), at[1].as_f64().unwrap()]);
    assert_eq!(browser.number("clsmith.motion"), wanted);
    assert!(place(&mut browser).1.contains("GOTO/70.0000,15.0000,-2.0000"));

    // A click on a line moves the slider to its motion, one on a line that is gone shows the program before.
    let row =
        "(text) => [...document.querySelectorAll('.row')].find((row) => row.textContent.includes(text))";
    browser.value("clsmith.goTo(0)");
    browser.value(&format!("({row})('GOTO/-10.0000,15.0000,-2.0000').id = 'wanted'"));
    let at = middle(&mut browser, "#wanted");
    browser.click(at);
    assert!(place(&mut browser).1.contains("GOTO/-10.0000,15.0000,-2.0000"));
    assert!(browser.number("clsmith.motion") > 3.0);
    browser.value("document.querySelector('.row.old').id = 'old'");
    let at = middle(&mut browser, "#old");
    browser.click(at);
    assert_eq!(browser.text("clsmith.shown.name"), "before");
    assert!(browser.number(DRAWN) > 0.0);

    // A drag across a chart zooms all of them in, a double click shows everything.
    let whole = browser.number("clsmith.charts.to - clsmith.charts.from");
    let at = middle(&mut browser, ".chart");
    browser.drag(at, [at[0] + 100.0, at[1]]);
    let zoomed = browser.number("clsmith.charts.to - clsmith.charts.from");
    assert!(zoomed < whole / 3.0, "{zoomed} of {whole}");
    browser.value(
        "document.querySelector('.chart').dispatchEvent(new MouseEvent('dblclick', { bubbles: true }))",
    );
    assert_eq!(browser.number("clsmith.charts.to - clsmith.charts.from"), whole);
    // A click in it marks a place.
    browser.click([at[0] + 30.0, at[1]]);
    assert!(browser.number("clsmith.motion") > 0.0);
    // Along the path.
    choose(&mut browser, "along", "path");
    let length = browser.number("clsmith.charts.end()");
    assert!((length - 209.0).abs() < 1e-3, "{length} mm");
    // Every colour can be chosen.
    let colors = "[...document.getElementById('color').options].map(({ value }) => { clsmith.view.colors(value); return document.getElementById('legend').textContent; })";
    let legends = browser.value(colors);
    assert_eq!(legends.as_array().unwrap().len(), 10, "{legends}");

    // Text of the file is text.
    let evil = "[...clsmith.listing.kinds.keys()].map((row) => clsmith.listing.rowText(row)).find((text) => text.includes('hurt'))";
    assert!(browser.text(evil).contains("</script><script>window.hurt = 1</script>"));
    assert_eq!(browser.value("window.hurt === undefined"), true);
    assert_eq!(browser.complaints(), [] as [String; 0]);
    assert_eq!(browser.requests(), [format!("file://{}", page.display())]);
}

#[test]
fn without_a_setup_the_page_shows_feed_and_z() {
    let Some(chromium) = require_program(&chromium::NAMES) else { return };
    let folder = tempfile::tempdir().unwrap();
    let page = report(folder.path(), None);
    let mut browser = Browser::start(&chromium);
    browser.open(&page);
    browser.wait("!!window.clsmith?.listing.text");
    assert_eq!(browser.number("document.querySelectorAll('.chart').length"), 2.0);
    assert!(browser.number(DRAWN) > 300.0);
    assert_eq!(browser.value("document.getElementById('stock') === null"), true);
    assert!(browser.text("document.body.textContent").contains("a simulation needs the stock"));
    assert_eq!(browser.complaints(), [] as [String; 0]);
}

//! The page as an editor shows it: linked with the cursor both ways, in the editor's colours, the path alone. Where
//! `CLSMITH_PICTURES` is set, the pictures of docs/editor.md are made as well.

use super::chromium::{self, Browser, DRAWN};
use crate::support::require_program;
use base64::Engine;
use clsmith::editor::{PathPageContent, ProgramView, make_path_page};
use clsmith::simulation_run::SilentWatcher;
use clsmith::source::Source;
use serde_json::json;
use std::path::{Path, PathBuf};

/// What an editor puts into its pages: a function to speak with it, and its colours as a class of the body.
const EDITOR: &str = "window.acquireVsCodeApi = () => ({ postMessage: (message) => window.heard.push(message) });
  window.heard = [];
  addEventListener('DOMContentLoaded', () => document.body.classList.add(window.editorTheme ?? 'vscode-light'));";

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// Opens the page of a program as an editor would.
fn open_page(browser: &mut Browser, folder: &Path, program: &Path, theme: &str) {
    let source = Source::new("part.cls", std::fs::read(program).unwrap()).unwrap();
    let view = ProgramView::new(&source, None);
    let page = make_path_page(&view, None, PathPageContent::Path, &SilentWatcher).unwrap();
    let path = folder.join("page.html");
    std::fs::write(&path, page).unwrap();
    let script = format!("window.editorTheme = '{theme}'; {EDITOR}");
    browser.call("Page.addScriptToEvaluateOnNewDocument", json!({ "source": script }));
    browser.open(&path);
    browser.wait("!!window.clsmith?.listing.text");
}

#[test]
fn the_page_and_the_cursor_follow_each_other() {
    let Some(chromium) = require_program(&chromium::NAMES) else { return };
    let folder = tempfile::tempdir().unwrap();
    let mut browser = Browser::start(&chromium);
    let program = root().join("examples/pocket/part.cls");
    open_page(&mut browser, folder.path(), &program, "vscode-light");
    assert_eq!(browser.value("heard"), json!([{ "ready": true }]));
    assert!(browser.number(DRAWN) > 1000.0);
    // The path, the charts and the slider are there; the text is in the editor, and so are the findings.
    assert_eq!(
        browser.value("['scene', 'charts', 'slider', 'text', 'findings', 'figures'].map((id) => document.getElementById(id).checkVisibility())"),
        json!([true, true, true, false, false, false])
    );

    // The cursor moves to the line of a motion: the page goes there, and does not answer.
    let line = browser.number("clsmith.listing.newNumber[clsmith.shown.row[3]]");
    browser.value(&format!("postMessage({{ line: {line} }}, '*')"));
    browser.wait("clsmith.motion === 3");
    assert_eq!(browser.number("heard.length"), 1.0);
    // Hostile messages do nothing.
    for message in ["null", "'x'", "{ line: 'a' }", "{ line: NaN }", "{ line: -5 }", "{ line: 1e9 }"] {
        browser.value(&format!("postMessage({message}, '*')"));
    }
    browser.value("new Promise((done) => setTimeout(done, 50))");
    assert_eq!(browser.number("heard.length"), 1.0);

    // The reader moves along the path: the editor hears each line once.
    browser.value("clsmith.goTo(5)");
    let line = browser.number("clsmith.listing.newNumber[clsmith.shown.row[5]]");
    assert_eq!(browser.value("heard[heard.length - 1]"), json!({ "line": line as i64 }));
    browser.value("clsmith.goTo(5)");
    assert_eq!(browser.number("heard.length"), 2.0);

    // The colours are those of the editor, whatever the system has.
    let is_dark = "(() => { const [r, g, b] = getComputedStyle(document.body).backgroundColor.match(/\\d+/g).map(Number); return r + g + b < 200; })()";
    assert_eq!(browser.value(is_dark), false);
    browser.value("document.body.className = 'vscode-dark'");
    browser.wait(is_dark);
    browser.value("document.body.className = 'vscode-high-contrast vscode-high-contrast-light'");
    browser.wait(&format!("!{is_dark}"));
    assert_eq!(browser.complaints(), [] as [String; 0]);
}

#[test]
fn pictures_of_the_view_beside_the_text() {
    let Some(chromium) = require_program(&chromium::NAMES) else { return };
    let folder = tempfile::tempdir().unwrap();
    let mut browser = Browser::start(&chromium);
    let program = root().join("examples/figurine/part.cls");
    for (width, theme) in [(1280, "light"), (1280, "dark"), (1920, "light"), (1920, "dark")] {
        // Beside the text the view has half of the window.
        let size =
            json!({ "width": width / 2, "height": width * 9 / 16, "deviceScaleFactor": 1, "mobile": false });
        browser.call("Emulation.setDeviceMetricsOverride", size);
        open_page(&mut browser, folder.path(), &program, &format!("vscode-{theme}"));
        browser.value("clsmith.goTo(Math.floor(clsmith.shown.count * 0.6))");
        assert!(browser.number(DRAWN) > 1000.0, "{width} {theme}");
        assert_eq!(
            browser.value("document.documentElement.scrollWidth <= innerWidth"),
            true,
            "{width} {theme}"
        );
        let shot = browser.call("Page.captureScreenshot", json!({ "format": "png" }));
        let png = base64::engine::general_purpose::STANDARD.decode(shot["data"].as_str().unwrap()).unwrap();
        assert!(png.len() > 10_000, "{width} {theme}");
        if std::env::var_os("CLSMITH_PICTURES").is_some() {
            let pictures = root().join("docs/pictures");
            std::fs::create_dir_all(&pictures).unwrap();
            std::fs::write(pictures.join(format!("editor-path-{width}-{theme}.png")), png).unwrap();
        }
    }
    assert_eq!(browser.complaints(), [] as [String; 0]);
}

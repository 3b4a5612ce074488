//! The viewer of `web/` in a real browser: what is dropped is shown, corrected, compared, saved, and goes nowhere.

mod comparison;
mod correction;
mod hostile_files;
mod network;
mod shown_program;

use super::chromium::{self, Browser};
use crate::support::{require_program, require_viewer};
use std::path::{Path, PathBuf};

/// The viewer in a browser, with a folder for files.
struct OpenedViewer {
    browser: Browser,
    folder: tempfile::TempDir,
    page: PathBuf,
}

/// The page of the program in the viewer's frame.
const FRAME: &str = "document.getElementById('frame').contentWindow";

/// Opens the viewer; `None` where there is no browser or no viewer.
#[track_caller]
fn open_viewer() -> Option<OpenedViewer> {
    let (chromium, page) = (require_program(&chromium::NAMES)?, require_viewer()?);
    let mut browser = Browser::start(&chromium);
    browser.open(&page);
    browser.wait("!!window.clsmithViewer");
    Some(OpenedViewer { browser, folder: tempfile::tempdir().unwrap(), page })
}

impl OpenedViewer {
    /// Writes a file and returns its path.
    fn write(&self, name: &str, content: impl AsRef<[u8]>) -> PathBuf {
        let path = self.folder.path().join(name);
        std::fs::write(&path, content).unwrap();
        path
    }

    /// Drops files in the middle of the window.
    fn drop_files(&mut self, files: &[PathBuf]) {
        self.browser.drop_files([650.0, 500.0], files);
    }

    /// Drops files and waits until what becomes of them is shown.
    fn show(&mut self, files: &[PathBuf]) {
        self.browser.value("window.clsmithViewer.seconds = 0");
        self.drop_files(files);
        self.wait_for_end();
    }

    /// Waits until nothing is worked on, and the frame has its text.
    fn wait_for_end(&mut self) {
        self.browser.wait("clsmithViewer.task === null && clsmithViewer.seconds > 0");
        self.browser.wait(&format!(
            "document.getElementById('frame').hidden || !{FRAME}.document.getElementById('facts') && \
             ({FRAME}.clsmith === undefined || !!{FRAME}.clsmith.listing.text)"
        ));
    }

    /// What an expression is in the frame.
    fn in_frame(&mut self, expression: &str) -> serde_json::Value {
        self.browser.value(&format!(
            "((clsmith, document, window) => {expression})({FRAME}.clsmith, {FRAME}.document, {FRAME})"
        ))
    }

    /// The text of an element of the viewer, where it is seen.
    fn seen_text(&mut self, id: &str) -> String {
        let seen = format!(
            "(() => {{ const it = document.getElementById('{id}'); return it.hidden ? '' : it.textContent; }})()"
        );
        self.browser.text(&seen)
    }

    /// Presses a button of the viewer.
    fn press(&mut self, id: &str) {
        let at = super::middle(&mut self.browser, &format!("#{id}"));
        self.browser.click(at);
    }

    /// Saves the corrected program, and returns its bytes.
    fn save(&mut self, name: &str) -> Vec<u8> {
        let saved = self.folder.path().join("saved");
        std::fs::create_dir_all(&saved).unwrap();
        self.browser.save_into(&saved);
        self.press("save");
        read_when_there(&saved.join(name))
    }
}

fn read_when_there(path: &Path) -> Vec<u8> {
    crate::support::wait_for(&path.display().to_string(), || path.is_file());
    std::fs::read(path).unwrap()
}

/// A file of an example.
fn example(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("examples").join(path)
}

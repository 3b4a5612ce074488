//! This module makes the page of an open program, in a thread of its own that a cancelled request stops.

use super::analysis::read_setup;
use super::documents::SharedState;
use super::jobs::{StopWhenCancelled, refuse_failure};
use super::outbox::Outbox;
use clsmith::editor::{PathPageContent, ProgramView, make_path_page};
use clsmith::job::catch_defect;
use lsp_server::RequestId;
use serde_json::json;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// A page that is to be made.
pub(super) struct PathPageJob {
    view: Arc<ProgramView>,
    setup_file: Option<PathBuf>,
    content: PathPageContent,
    version: i32,
}

impl PathPageJob {
    /// Takes a program as it was read at the last pause of typing. `content` is `path`, which is meant where nothing is
    /// said, or `simulation`.
    ///
    /// # Errors
    /// Returns why there is no page.
    pub(super) fn take(shared: &SharedState, uri: &str, content: Option<&str>) -> Result<Self, String> {
        let content = match content {
            None | Some("path") => PathPageContent::Path,
            Some("simulation") => PathPageContent::Simulation,
            Some(other) => return Err(format!("a page is of `path` or `simulation`, not of `{other}`")),
        };
        let state = shared.lock();
        let document = state.documents.get(uri).ok_or_else(|| format!("{uri} is not open"))?;
        let view =
            document.read.view.clone().ok_or_else(|| format!("{uri} has not been read as a program"))?;
        Ok(Self { view, setup_file: state.settings.setup.clone(), content, version: document.read.version })
    }

    /// Makes the page and answers the request.
    pub(super) fn run(self, id: RequestId, stop: &AtomicBool, outbox: &Outbox) {
        let setup = self.setup_file.as_deref().and_then(|path| read_setup(path, &mut Vec::new()));
        let make = || make_path_page(&self.view, setup.as_ref(), self.content, &StopWhenCancelled(stop));
        let made = catch_defect(self.view.program().source().name(), make);
        match made.unwrap_or_else(|defect| Err(defect.into())) {
            Ok(html) => outbox.answer(id, &json!({ "html": html, "version": self.version })),
            Err(failure) => refuse_failure(outbox, id, &failure),
        }
    }
}

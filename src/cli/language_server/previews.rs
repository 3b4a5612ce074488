//! This module runs a recipe on an open program and shows the changed lines, in a thread of its own that a cancelled request
//! stops.

use super::analysis::findings_to_json;
use super::documents::SharedState;
use super::jobs::StopWhenCancelled;
use super::outbox::Outbox;
use super::places::path_to_uri;
use crate::cli::input_files;
use clsmith::diagnostic::Failure;
use clsmith::editor::preview_recipe;
use clsmith::job::catch_defect;
use clsmith::source::Source;
use lsp_server::{ErrorCode, RequestId};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

/// A recipe that is to be shown on a program.
pub(super) struct Preview {
    recipe: Arc<Source>,
    folder: PathBuf,
    program: Arc<Source>,
    /// Where the diff is written for the editor to show, if it can.
    shown_in: Option<PathBuf>,
}

impl Preview {
    /// Takes the texts of both documents as they are typed now.
    ///
    /// # Errors
    /// Returns which of them is not open.
    pub(super) fn take(
        shared: &SharedState,
        [recipe, program]: [&str; 2],
        shown_in: Option<PathBuf>,
    ) -> Result<Self, String> {
        let state = shared.lock();
        let take = |uri: &str| {
            let document = state.documents.get(uri).ok_or_else(|| format!("{uri} is not open"))?;
            let path = document.path.clone().unwrap_or_else(|| PathBuf::from(uri));
            Ok::<_, String>((Arc::clone(document.text.source()), path))
        };
        let (recipe, path) = take(recipe)?;
        let (program, _) = take(program)?;
        let folder = path.parent().unwrap_or(Path::new("")).to_path_buf();
        Ok(Self { recipe, folder, program, shown_in })
    }

    /// Runs the recipe and answers the request.
    pub(super) fn run(self, id: RequestId, stop: &AtomicBool, outbox: &Outbox) {
        let watch = StopWhenCancelled(stop);
        let run =
            || preview_recipe(&self.recipe, &self.folder, &self.program, input_files::read_bytes, &watch);
        let done = catch_defect(self.program.name(), run).unwrap_or_else(|defect| Err(defect.into()));
        let shown = match done {
            Err(Failure::Interrupted) => {
                outbox.refuse(id, ErrorCode::RequestCanceled, "the preview was cancelled");
                return;
            }
            Err(Failure::Found(findings)) => json!({
                "diff": "", "text": null, "refused": true,
                "findings": findings_to_json(findings.iter(), &self.recipe, None),
            }),
            Ok(preview) => json!({
                "diff": String::from_utf8_lossy(&preview.diff),
                "text": String::from_utf8_lossy(&preview.text),
                "refused": preview.is_refused,
                "findings": findings_to_json(preview.findings.iter(), &self.program, None),
            }),
        };
        if let (Some(path), Some(diff)) = (&self.shown_in, shown.get("diff").and_then(Value::as_str)) {
            show_diff(outbox, path, diff, &shown);
        }
        outbox.answer(id, &shown);
    }
}

/// Lets the editor show the changed lines, or says in a message why there are none.
fn show_diff(outbox: &Outbox, path: &Path, diff: &str, shown: &Value) {
    let first = shown.pointer("/findings/0/message").and_then(Value::as_str);
    if diff.is_empty() {
        let text = first.unwrap_or("the recipe changes nothing in this program");
        outbox.notify("window/showMessage", &json!({ "type": 3, "message": text }));
    } else if std::fs::write(path, diff).is_ok() {
        outbox.ask_client("window/showDocument", &json!({ "uri": path_to_uri(path), "takeFocus": true }));
    }
}

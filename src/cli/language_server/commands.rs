//! This module runs the commands that an editor may ask for. Those that take time have a thread of their own, answer by
//! themselves, and stop when their request is cancelled.

use super::answers::Answers;
use super::outbox::Outbox;
use super::path_pages::PathPageJob;
use super::previews::Preview;
use super::recipe_steps::StepSearch;
use super::server::{RequestError, STACK_BYTES, Server, read_params};
use lsp_server::{ErrorCode, RequestId};
use lsp_types as lsp;
use serde_json::Value;
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

/// Runs a recipe on a program and shows what it changes: address of the recipe, address of the program.
pub(super) const PREVIEW: &str = "clsmith.previewRecipe";
/// Goes to the next feed: address of the program, position.
const NEXT_FEED: &str = "clsmith.nextFeed";
/// Goes to the last feed: address of the program, position.
const LAST_FEED: &str = "clsmith.lastFeed";
/// Goes to the step of a recipe that changed a line: address of the program, position.
const RECIPE_STEP: &str = "clsmith.recipeStep";
/// Makes the page of a program: its address, and `path` or `simulation`.
const PATH_PAGE: &str = "clsmith.pathPage";

/// All of them.
pub(super) const COMMANDS: [&str; 5] = [PREVIEW, NEXT_FEED, LAST_FEED, RECIPE_STEP, PATH_PAGE];

impl Server {
    /// Runs a command. Returns `None` if it answers by itself.
    pub(super) fn run_command(
        &mut self,
        id: RequestId,
        wanted: lsp::ExecuteCommandParams,
    ) -> Result<Option<Value>, RequestError> {
        let text = |at: usize| wanted.arguments.get(at).and_then(Value::as_str);
        let uri = text(0).unwrap_or_default();
        match wanted.command.as_str() {
            NEXT_FEED | LAST_FEED => {
                let at = read_position(&wanted)?;
                let is_next = wanted.command == NEXT_FEED;
                let find =
                    |about: &Answers<'_>| if is_next { about.next_feed(at) } else { about.last_feed(at) };
                let found = self.ask(uri, |about| find(about).unwrap_or(Value::Null));
                if let (true, Some(range)) = (self.shows_documents, found.get("range")) {
                    self.outbox.show_document(uri, range);
                }
                Ok(Some(found))
            }
            RECIPE_STEP => {
                let at = read_position(&wanted)?;
                let search = StepSearch::take(&self.shared, uri, at).map_err(invalid)?;
                let shows = self.shows_documents;
                self.start_job(id, move |id, _, outbox| search.answer_command(id, shows, outbox))
            }
            PATH_PAGE => {
                let job = PathPageJob::take(&self.shared, uri, text(1)).map_err(invalid)?;
                self.start_job(id, move |id, stop, outbox| job.run(id, stop, outbox))
            }
            PREVIEW => {
                let Some(program) = text(1) else {
                    return Err(invalid("a recipe and a program are needed".to_owned()));
                };
                let shown_in = self.make_preview_file();
                let preview = Preview::take(&self.shared, [uri, program], shown_in).map_err(invalid)?;
                self.start_job(id, move |id, stop, outbox| preview.run(id, stop, outbox))
            }
            other => Err(invalid(format!("`{other}` is no command"))),
        }
    }

    /// Runs something in a thread of its own. It answers the request by itself.
    pub(super) fn start_job(
        &mut self,
        id: RequestId,
        run: impl FnOnce(RequestId, &AtomicBool, &Outbox) + Send + 'static,
    ) -> Result<Option<Value>, RequestError> {
        // Only the thread of a job that still runs holds its flag as well.
        self.jobs.retain(|_, stop| Arc::strong_count(stop) > 1);
        let stop = Arc::new(AtomicBool::new(false));
        self.jobs.insert(id.clone(), Arc::clone(&stop));
        let outbox = self.outbox.clone();
        thread::Builder::new()
            .stack_size(STACK_BYTES)
            .spawn(move || run(id, &stop, &outbox))
            .map_err(|error| (ErrorCode::InternalError, error.to_string()))?;
        Ok(None)
    }

    /// Stops a job whose request was cancelled.
    pub(super) fn stop_job(&self, id: &RequestId) {
        if let Some(stop) = self.jobs.get(id) {
            stop.store(true, Ordering::Relaxed);
        }
    }

    /// Returns where a preview is written for the editor to show, if it shows documents. The folder is for the user alone.
    fn make_preview_file(&mut self) -> Option<PathBuf> {
        if !self.shows_documents || self.shared.lock().settings.client_shows_previews {
            return None;
        }
        if self.folder.is_none() {
            let mut builder = tempfile::Builder::new();
            builder.prefix("clsmith-preview");
            #[cfg(unix)]
            builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o700));
            self.folder = builder.tempdir().ok();
        }
        self.preview_count += 1;
        let name = format!("preview-{}.diff", self.preview_count);
        self.folder.as_ref().map(|folder| folder.path().join(name))
    }
}

fn read_position(wanted: &lsp::ExecuteCommandParams) -> Result<lsp::Position, RequestError> {
    read_params(wanted.arguments.get(1).cloned().unwrap_or(Value::Null))
}

fn invalid(reason: String) -> RequestError {
    (ErrorCode::InvalidParams, reason)
}

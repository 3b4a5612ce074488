//! This module runs the server: it takes messages in their order and answers requests.

use super::analysis::AnalysisThread;
use super::answers::Answers;
use super::commands::COMMANDS;
use super::documents::SharedState;
use super::outbox::Outbox;
use super::recipe_steps::StepSearch;
use super::settings::ServerSettings;
use super::transport::{Received, read_message, write_message};
use crate::cli::command_exit::CommandExit;
use crate::cli::stop::Stop;
use clsmith::job::catch_defect;
use lsp_server::{ErrorCode, Message, Notification, Request, RequestId};
use lsp_types as lsp;
use serde::de::DeserializeOwned;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet, VecDeque};
use std::io;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, Receiver, RecvTimeoutError, Sender};
use std::thread;
use std::time::{Duration, Instant};

/// The stack of threads that read texts and run recipes: as large as that of a command.
pub(super) const STACK_BYTES: usize = 8 << 20;

/// What is still to be written at the end may take so long.
const LAST_WORDS: Duration = Duration::from_secs(2);

/// Requests that wait for a text to be read are looked at again after this time.
const WAIT_FOR_READING: Duration = Duration::from_millis(10);

/// Why a request gets no result.
pub(super) type RequestError = (ErrorCode, String);

/// Serves one editor until it says `exit` or goes away.
pub(super) fn serve(settings: ServerSettings) -> Result<CommandExit, Stop> {
    let (messages, to_write) = mpsc::channel::<Value>();
    let writer = thread::Builder::new().spawn(move || {
        let mut out = io::stdout().lock();
        // Null is no message, and says that nothing else is to be written.
        let mut all = to_write.iter().take_while(|message| !message.is_null());
        all.try_for_each(|message| write_message(&mut out, &message))
    });
    let writer = writer.map_err(Stop::Io)?;
    let (received, incoming) = mpsc::channel();
    let reader = move || {
        let mut input = io::BufReader::new(io::stdin());
        loop {
            let next = read_message(&mut input).unwrap_or(Received::End);
            let is_end = matches!(next, Received::End);
            if received.send(next).is_err() || is_end {
                return;
            }
        }
    };
    thread::Builder::new().spawn(reader).map_err(Stop::Io)?;
    let outbox = Outbox::new(messages);
    let shared = Arc::new(SharedState::default());
    shared.lock().settings = settings;
    let (changed, to_read) = mpsc::channel();
    let waiting = Arc::new(AtomicUsize::new(0));
    let analysis = AnalysisThread {
        shared: Arc::clone(&shared),
        outbox: outbox.clone(),
        changed: to_read,
        waiting: Arc::clone(&waiting),
    };
    thread::Builder::new().stack_size(STACK_BYTES).spawn(move || analysis.run()).map_err(Stop::Io)?;
    let mut server = Server {
        shared,
        outbox: outbox.clone(),
        changed,
        waiting,
        jobs: BTreeMap::new(),
        is_initialized: false,
        is_shut_down: false,
        shows_documents: false,
        folder: None,
        preview_count: 0,
    };
    let exit = server.run(&incoming);
    drop(server);
    outbox.send(Value::Null);
    // An editor that does not read its answers is not waited for.
    let begun = Instant::now();
    while !writer.is_finished() && begun.elapsed() < LAST_WORDS {
        thread::sleep(Duration::from_millis(2));
    }
    Ok(exit)
}

/// The server of one editor.
pub(super) struct Server {
    pub(super) shared: Arc<SharedState>,
    pub(super) outbox: Outbox,
    /// Tells the analysis which document was changed.
    pub(super) changed: Sender<String>,
    /// How many changes it has not looked at.
    pub(super) waiting: Arc<AtomicUsize>,
    /// What stops the jobs that run.
    pub(super) jobs: BTreeMap<RequestId, Arc<AtomicBool>>,
    is_initialized: bool,
    is_shut_down: bool,
    pub(super) shows_documents: bool,
    /// Where previews are written for the editor to show.
    pub(super) folder: Option<tempfile::TempDir>,
    pub(super) preview_count: usize,
}

impl Server {
    fn run(&mut self, incoming: &Receiver<Received>) -> CommandExit {
        let mut queue = VecDeque::new();
        let mut cancelled = BTreeSet::new();
        // Requests about texts that were opened and not read yet: editors ask for an outline once, and nothing would be
        // an answer.
        let mut unread: Vec<Request> = Vec::new();
        loop {
            let first = match receive_next(incoming, queue.is_empty(), unread.is_empty()) {
                Ok(next) => next,
                Err(RecvTimeoutError::Timeout) => None,
                Err(RecvTimeoutError::Disconnected) => return self.exit(),
            };
            let (waits, ready): (Vec<_>, Vec<_>) = unread.drain(..).partition(|asked| self.is_unread(asked));
            unread = waits;
            queue.extend(ready.into_iter().map(|asked| Received::Message(Message::Request(asked))));
            // All that has come is looked at before the next answer, so that a cancelled request is not worked on.
            for next in first.into_iter().chain(std::iter::from_fn(|| incoming.try_recv().ok())) {
                if let Received::Message(Message::Notification(told)) = &next {
                    cancelled.extend(read_cancelled_id(told));
                }
                queue.push_back(next);
            }
            match queue.pop_front() {
                None => {}
                Some(Received::End) => return self.exit(),
                Some(Received::Refused(answer)) => self.outbox.send(answer),
                Some(Received::Message(Message::Request(request))) => {
                    if cancelled.contains(&request.id) {
                        self.outbox.refuse(request.id, ErrorCode::RequestCanceled, "cancelled");
                    } else if self.is_unread(&request) {
                        unread.push(request);
                    } else {
                        self.answer_request(request);
                    }
                }
                Some(Received::Message(Message::Notification(told))) if told.method == "exit" => {
                    return self.exit();
                }
                Some(Received::Message(Message::Notification(told))) => {
                    if let Some(id) = read_cancelled_id(&told) {
                        cancelled.remove(&id);
                        self.stop_job(&id);
                        if let Some(at) = unread.iter().position(|asked| asked.id == id) {
                            unread.remove(at);
                            self.outbox.refuse(id, ErrorCode::RequestCanceled, "cancelled");
                        }
                    } else {
                        let name = told.method.clone();
                        if let Err(defect) = catch_defect(&name, || self.take_notification(told)) {
                            self.outbox.notify(
                                "window/logMessage",
                                &json!({ "type": 1, "message": defect.message }),
                            );
                        }
                    }
                }
                Some(Received::Answer | Received::Message(Message::Response(_))) => {}
            }
        }
    }

    /// Whether a request is about a text that was opened and not read yet.
    fn is_unread(&self, request: &Request) -> bool {
        let uri = request.params.pointer("/textDocument/uri").and_then(Value::as_str).unwrap_or_default();
        self.shared.lock().documents.get(uri).is_some_and(|document| !document.read.is_read)
    }

    fn exit(&self) -> CommandExit {
        self.jobs.values().for_each(|stop| stop.store(true, Ordering::Relaxed));
        if self.is_shut_down { CommandExit::Done } else { CommandExit::Errors }
    }

    fn answer_request(&mut self, request: Request) {
        let id = request.id.clone();
        if self.is_shut_down {
            self.outbox.refuse(id, ErrorCode::InvalidRequest, "the server was shut down");
            return;
        }
        if !self.is_initialized && request.method != "initialize" {
            self.outbox.refuse(id, ErrorCode::ServerNotInitialized, "`initialize` comes first");
            return;
        }
        let name = request.method.clone();
        let done = catch_defect(&name, || self.find_answer(request));
        match done {
            Ok(Ok(Some(result))) => self.outbox.answer(id, &result),
            // A job answers by itself.
            Ok(Ok(None)) => {}
            Ok(Err((code, message))) => self.outbox.refuse(id, code, &message),
            Err(defect) => self.outbox.refuse(id, ErrorCode::InternalError, &defect.message),
        }
    }

    fn find_answer(&mut self, request: Request) -> Result<Option<Value>, RequestError> {
        let Request { id, method, params } = request;
        let answer = match method.as_str() {
            "initialize" => self.initialize(&params),
            "shutdown" => {
                self.is_shut_down = true;
                Value::Null
            }
            "textDocument/hover" => self.ask_at(params, |about, at| about.hover(at))?,
            "textDocument/definition" => self.ask_at(params, |about, at| about.tool_load(at))?,
            "textDocument/declaration" => {
                let place: lsp::TextDocumentPositionParams = read_params(params)?;
                let Ok(search) =
                    StepSearch::take(&self.shared, place.text_document.uri.as_str(), place.position)
                else {
                    return Ok(Some(Value::Null));
                };
                return self.start_job(id, move |id, _, outbox| search.answer_declaration(id, outbox));
            }
            "textDocument/prepareRename" => self.ask_at(params, |about, at| about.prepare_rename(at))?,
            "textDocument/documentSymbol" => self.ask_about(params, |about| about.outline())?,
            "textDocument/foldingRange" => self.ask_about(params, |about| about.foldings())?,
            "textDocument/documentLink" => self.ask_about(params, |about| about.links())?,
            "textDocument/codeLens" => {
                let programs = self.list_programs();
                self.ask_about(params, |about| about.lenses(&programs))?
            }
            "textDocument/inlayHint" => {
                let wanted: lsp::InlayHintParams = read_params(params)?;
                self.ask(wanted.text_document.uri.as_str(), |about| about.hints(wanted.range))
            }
            "textDocument/completion" => {
                let wanted: lsp::CompletionParams = read_params(params)?;
                let place = wanted.text_document_position;
                let state = self.shared.lock();
                let views = state
                    .documents
                    .values()
                    .filter_map(|document| document.read.view.clone())
                    .collect::<Vec<_>>();
                drop(state);
                self.ask(place.text_document.uri.as_str(), |about| about.complete(place.position, &views))
            }
            "textDocument/codeAction" => {
                let wanted: lsp::CodeActionParams = read_params(params)?;
                let documentation = self.shared.lock().settings.documentation.clone();
                let uri = wanted.text_document.uri;
                self.ask(uri.as_str(), |about| about.repairs(wanted.range, documentation.as_deref()))
            }
            "textDocument/rename" => {
                let wanted: lsp::RenameParams = read_params(params)?;
                let place = wanted.text_document_position;
                let renamed = |about: &Answers<'_>| about.rename(place.position, &wanted.new_name);
                let done = self.ask_document(place.text_document.uri.as_str(), renamed);
                done.unwrap_or_else(|| Err("the file is not open".to_owned()))
                    .map_err(|reason| (ErrorCode::InvalidParams, reason))?
            }
            "workspace/executeCommand" => {
                let wanted: lsp::ExecuteCommandParams = read_params(params)?;
                return self.run_command(id, wanted);
            }
            _ => return Err((ErrorCode::MethodNotFound, format!("`{method}` is not known"))),
        };
        Ok(Some(answer))
    }

    fn initialize(&mut self, params: &Value) -> Value {
        self.is_initialized = true;
        let able = |path: &str| params.pointer(path).and_then(Value::as_bool) == Some(true);
        self.shows_documents = able("/capabilities/window/showDocument/support");
        let refreshes = able("/capabilities/workspace/inlayHint/refreshSupport");
        self.outbox.refreshes_hints.store(refreshes, Ordering::Relaxed);
        if let Some(options) = params.get("initializationOptions") {
            self.shared.lock().settings.update(options);
        }
        json!({
            "serverInfo": { "name": "clsmith", "version": env!("CARGO_PKG_VERSION") },
            "capabilities": {
                "positionEncoding": "utf-16",
                "textDocumentSync": { "openClose": true, "change": 2, "save": { "includeText": false } },
                "hoverProvider": true,
                "definitionProvider": true,
                "declarationProvider": true,
                "documentSymbolProvider": true,
                "foldingRangeProvider": true,
                "documentLinkProvider": { "resolveProvider": false },
                "inlayHintProvider": true,
                "completionProvider": { "triggerCharacters": ["/", ","] },
                "codeActionProvider": { "codeActionKinds": ["quickfix"] },
                "codeLensProvider": { "resolveProvider": false },
                "renameProvider": { "prepareProvider": true },
                "executeCommandProvider": { "commands": COMMANDS },
            },
        })
    }

    /// Returns the addresses of the open programs.
    pub(super) fn list_programs(&self) -> Vec<String> {
        let state = self.shared.lock();
        let programs = state.documents.iter().filter(|(_, document)| !document.is_yaml);
        programs.map(|(uri, _)| uri.clone()).collect()
    }

    fn ask_document<T>(&self, uri: &str, find: impl FnOnce(&Answers<'_>) -> T) -> Option<T> {
        let state = self.shared.lock();
        let document = state.documents.get(uri)?;
        Some(find(&Answers { uri, document }))
    }

    pub(super) fn ask(&self, uri: &str, find: impl FnOnce(&Answers<'_>) -> Value) -> Value {
        self.ask_document(uri, find).unwrap_or(Value::Null)
    }

    fn ask_about(
        &self,
        params: Value,
        find: impl FnOnce(&Answers<'_>) -> Value,
    ) -> Result<Value, RequestError> {
        #[derive(serde::Deserialize)]
        #[serde(rename_all = "camelCase")]
        struct AboutDocument {
            text_document: lsp::TextDocumentIdentifier,
        }
        let about: AboutDocument = read_params(params)?;
        Ok(self.ask(about.text_document.uri.as_str(), find))
    }

    fn ask_at(
        &self,
        params: Value,
        find: impl FnOnce(&Answers<'_>, lsp::Position) -> Option<Value>,
    ) -> Result<Value, RequestError> {
        let place: lsp::TextDocumentPositionParams = read_params(params)?;
        let uri = place.text_document.uri;
        Ok(self.ask(uri.as_str(), |about| find(about, place.position).unwrap_or(Value::Null)))
    }
}

/// Waits for the next message: not at all where others wait, and briefly where requests wait for a text to be read.
fn receive_next(
    incoming: &Receiver<Received>,
    has_no_other: bool,
    has_no_unread: bool,
) -> Result<Option<Received>, RecvTimeoutError> {
    match (has_no_other, has_no_unread) {
        (false, _) => Ok(None),
        (true, true) => incoming.recv().map(Some).map_err(|_| RecvTimeoutError::Disconnected),
        (true, false) => incoming.recv_timeout(WAIT_FOR_READING).map(Some),
    }
}

pub(super) fn read_params<T: DeserializeOwned>(params: Value) -> Result<T, RequestError> {
    serde_json::from_value(params).map_err(|error| (ErrorCode::InvalidParams, error.to_string()))
}

fn read_cancelled_id(told: &Notification) -> Option<RequestId> {
    if told.method != "$/cancelRequest" {
        return None;
    }
    serde_json::from_value(told.params.get("id")?.clone()).ok()
}

//! This module runs the server: it takes messages in their order and answers requests.

use super::analysis::AnalysisThread;
use super::answers::Answers;
use super::documents::{Document, SharedState};
use super::previews::Preview;
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
use std::path::PathBuf;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicI32, AtomicUsize, Ordering};
use std::sync::mpsc::{self, Receiver, Sender};
use std::thread;
use std::time::{Duration, Instant};

/// The commands that an editor may ask for.
pub(super) const PREVIEW: &str = "clsmith.previewRecipe";
/// The stack of threads that read texts and run recipes: as large as that of a command.
const STACK_BYTES: usize = 8 << 20;

/// What is still to be written at the end may take so long.
const LAST_WORDS: Duration = Duration::from_secs(2);

const NEXT_FEED: &str = "clsmith.nextFeed";
const LAST_FEED: &str = "clsmith.lastFeed";

/// What is sent to the editor, from any thread.
#[derive(Clone)]
pub(super) struct Outbox {
    messages: Sender<Value>,
    /// Numbers of requests to the editor.
    count: Arc<AtomicI32>,
    /// Whether the editor asks for hints again when it is told to.
    refreshes_hints: Arc<AtomicBool>,
}

impl Outbox {
    fn send(&self, message: Value) {
        // Nobody reads any more once the editor has gone, and then the server ends.
        let _ = self.messages.send(message);
    }

    pub(super) fn answer(&self, id: RequestId, result: &Value) {
        self.send(json!({ "jsonrpc": "2.0", "id": id, "result": result }));
    }

    pub(super) fn refuse(&self, id: RequestId, code: ErrorCode, message: &str) {
        self.send(
            json!({ "jsonrpc": "2.0", "id": id, "error": { "code": code as i32, "message": message } }),
        );
    }

    pub(super) fn notify(&self, method: &str, params: &Value) {
        self.send(json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    /// Lets the editor ask for hints again, if it can.
    pub(super) fn refresh_hints(&self) {
        if self.refreshes_hints.load(Ordering::Relaxed) {
            self.ask_client("workspace/inlayHint/refresh", &Value::Null);
        }
    }

    /// Asks the editor for something of which the answer does not matter.
    pub(super) fn ask_client(&self, method: &str, params: &Value) {
        let id = self.count.fetch_add(1, Ordering::Relaxed);
        let mut message = json!({ "jsonrpc": "2.0", "id": id, "method": method });
        if let (false, Value::Object(fields)) = (params.is_null(), &mut message) {
            fields.insert("params".to_owned(), params.clone());
        }
        self.send(message);
    }
}

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
    let outbox = Outbox { messages, count: Arc::default(), refreshes_hints: Arc::default() };
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
        previews: BTreeMap::new(),
        is_initialized: false,
        is_shut_down: false,
        shows_documents: false,
        folder: None,
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

struct Server {
    shared: Arc<SharedState>,
    outbox: Outbox,
    /// Tells the analysis which document was changed.
    changed: Sender<String>,
    waiting: Arc<AtomicUsize>,
    /// What stops the previews that run.
    previews: BTreeMap<RequestId, Arc<AtomicBool>>,
    is_initialized: bool,
    is_shut_down: bool,
    shows_documents: bool,
    /// Where previews are written for the editor to show.
    folder: Option<tempfile::TempDir>,
}

impl Server {
    fn run(&mut self, incoming: &Receiver<Received>) -> CommandExit {
        let mut queue = VecDeque::new();
        let mut cancelled = BTreeSet::new();
        loop {
            if queue.is_empty() {
                match incoming.recv() {
                    Ok(next) => queue.push_back(next),
                    Err(_) => return self.exit(),
                }
            }
            // All that has come is looked at before the next answer, so that a cancelled request is not worked on.
            while let Ok(next) = incoming.try_recv() {
                queue.push_back(next);
            }
            for next in &queue {
                if let Received::Message(Message::Notification(told)) = next
                    && let Some(id) = read_cancelled_id(told)
                {
                    cancelled.insert(id);
                }
            }
            match queue.pop_front() {
                None => {}
                Some(Received::End) => return self.exit(),
                Some(Received::Refused(answer)) => self.outbox.send(answer),
                Some(Received::Message(Message::Request(request))) => {
                    if cancelled.contains(&request.id) {
                        self.outbox.refuse(request.id, ErrorCode::RequestCanceled, "cancelled");
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
                        if let Some(stop) = self.previews.get(&id) {
                            stop.store(true, Ordering::Relaxed);
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
                // Nothing depends on what the editor answers.
                Some(Received::Message(Message::Response(_))) => {}
            }
        }
    }

    fn exit(&self) -> CommandExit {
        self.previews.values().for_each(|stop| stop.store(true, Ordering::Relaxed));
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
            // A preview answers by itself.
            Ok(Ok(None)) => {}
            Ok(Err((code, message))) => self.outbox.refuse(id, code, &message),
            Err(defect) => self.outbox.refuse(id, ErrorCode::InternalError, &defect.message),
        }
    }

    fn find_answer(&mut self, request: Request) -> Result<Option<Value>, (ErrorCode, String)> {
        let Request { id, method, params } = request;
        let answer = match method.as_str() {
            "initialize" => self.initialize(&params),
            "shutdown" => {
                self.is_shut_down = true;
                Value::Null
            }
            "textDocument/hover" => self.ask_at(params, |about, at| about.hover(at))?,
            "textDocument/definition" => self.ask_at(params, |about, at| about.tool_load(at))?,
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
                "documentSymbolProvider": true,
                "foldingRangeProvider": true,
                "documentLinkProvider": { "resolveProvider": false },
                "inlayHintProvider": true,
                "completionProvider": { "triggerCharacters": ["/", ","] },
                "codeActionProvider": { "codeActionKinds": ["quickfix"] },
                "codeLensProvider": { "resolveProvider": false },
                "renameProvider": { "prepareProvider": true },
                "executeCommandProvider": { "commands": [PREVIEW, NEXT_FEED, LAST_FEED] },
            },
        })
    }

    fn take_notification(&mut self, told: Notification) {
        let Notification { method, params } = told;
        match method.as_str() {
            "textDocument/didOpen" => {
                let Ok(opened) = serde_json::from_value::<lsp::DidOpenTextDocumentParams>(params) else {
                    return;
                };
                let item = opened.text_document;
                let uri = item.uri.as_str().to_owned();
                let Ok(document) = Document::open(&uri, &item.language_id, item.version, item.text) else {
                    return;
                };
                self.shared.lock().documents.insert(uri.clone(), document);
                self.read_again(uri);
            }
            "textDocument/didChange" => {
                let Ok(changed) = serde_json::from_value::<lsp::DidChangeTextDocumentParams>(params) else {
                    return;
                };
                let uri = changed.text_document.uri.as_str().to_owned();
                let mut state = self.shared.lock();
                let Some(document) = state.documents.get_mut(&uri) else { return };
                document.change(changed.text_document.version, changed.content_changes);
                drop(state);
                self.read_again(uri);
            }
            "textDocument/didClose" => {
                let Ok(closed) = serde_json::from_value::<lsp::DidCloseTextDocumentParams>(params) else {
                    return;
                };
                let uri = closed.text_document.uri.as_str().to_owned();
                self.shared.lock().documents.remove(&uri);
                let nothing = json!({ "uri": uri, "diagnostics": [] });
                self.outbox.notify("textDocument/publishDiagnostics", &nothing);
            }
            // A setup or a machine may have been saved, by which the programs are judged.
            "textDocument/didSave" => {
                let uri = params.pointer("/textDocument/uri").and_then(Value::as_str).unwrap_or_default();
                let is_yaml = self.shared.lock().documents.get(uri).is_some_and(|document| document.is_yaml);
                if is_yaml && self.shared.lock().settings.setup.is_some() {
                    self.list_programs().into_iter().for_each(|uri| self.read_again(uri));
                }
            }
            "workspace/didChangeConfiguration" => {
                if let Some(settings) = params.get("settings") {
                    self.shared.lock().settings.update(settings);
                }
                let all: Vec<String> = self.shared.lock().documents.keys().cloned().collect();
                all.into_iter().for_each(|uri| self.read_again(uri));
            }
            // Others are for servers that do more.
            _ => {}
        }
    }

    fn read_again(&self, uri: String) {
        self.waiting.fetch_add(1, Ordering::Relaxed);
        // The analysis ends only after the server.
        let _ = self.changed.send(uri);
    }

    /// Returns the addresses of the open programs.
    fn list_programs(&self) -> Vec<String> {
        let state = self.shared.lock();
        let programs = state.documents.iter().filter(|(_, document)| !document.is_yaml);
        programs.map(|(uri, _)| uri.clone()).collect()
    }

    fn ask_document<T>(&self, uri: &str, find: impl FnOnce(&Answers<'_>) -> T) -> Option<T> {
        let state = self.shared.lock();
        let document = state.documents.get(uri)?;
        Some(find(&Answers { uri, document }))
    }

    fn ask(&self, uri: &str, find: impl FnOnce(&Answers<'_>) -> Value) -> Value {
        self.ask_document(uri, find).unwrap_or(Value::Null)
    }

    fn ask_about(
        &self,
        params: Value,
        find: impl FnOnce(&Answers<'_>) -> Value,
    ) -> Result<Value, (ErrorCode, String)> {
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
    ) -> Result<Value, (ErrorCode, String)> {
        let place: lsp::TextDocumentPositionParams = read_params(params)?;
        let uri = place.text_document.uri;
        Ok(self.ask(uri.as_str(), |about| find(about, place.position).unwrap_or(Value::Null)))
    }

    fn run_command(
        &mut self,
        id: RequestId,
        wanted: lsp::ExecuteCommandParams,
    ) -> Result<Option<Value>, (ErrorCode, String)> {
        let text = |at: usize| wanted.arguments.get(at).and_then(Value::as_str);
        match wanted.command.as_str() {
            NEXT_FEED | LAST_FEED => {
                let place = wanted.arguments.get(1).cloned().unwrap_or_default();
                let at: lsp::Position = read_params(place)?;
                let uri = text(0).unwrap_or_default();
                let is_next = wanted.command == NEXT_FEED;
                let find =
                    |about: &Answers<'_>| if is_next { about.next_feed(at) } else { about.last_feed(at) };
                let found = self.ask(uri, |about| find(about).unwrap_or(Value::Null));
                if let (true, Some(range)) = (self.shows_documents, found.get("range")) {
                    let show = json!({ "uri": uri, "takeFocus": true, "selection": range });
                    self.outbox.ask_client("window/showDocument", &show);
                }
                Ok(Some(found))
            }
            PREVIEW => {
                let (Some(recipe), Some(program)) = (text(0), text(1)) else {
                    return Err((ErrorCode::InvalidParams, "a recipe and a program are needed".to_owned()));
                };
                let stop = Arc::new(AtomicBool::new(false));
                let shown_in = self.make_preview_file();
                let preview = Preview::take(id.clone(), &self.shared, [recipe, program], shown_in, &stop)
                    .map_err(|reason| (ErrorCode::InvalidParams, reason))?;
                let outbox = self.outbox.clone();
                thread::Builder::new()
                    .stack_size(STACK_BYTES)
                    .spawn(move || preview.run(&outbox))
                    .map_err(|error| (ErrorCode::InternalError, error.to_string()))?;
                self.previews.insert(id, stop);
                Ok(None)
            }
            other => Err((ErrorCode::InvalidParams, format!("`{other}` is no command"))),
        }
    }

    /// Returns where a preview is written for the editor to show, if it shows documents. The folder is for the user alone.
    fn make_preview_file(&mut self) -> Option<PathBuf> {
        if !self.shows_documents {
            return None;
        }
        if self.folder.is_none() {
            let mut builder = tempfile::Builder::new();
            builder.prefix("clsmith-preview");
            #[cfg(unix)]
            builder.permissions(std::os::unix::fs::PermissionsExt::from_mode(0o700));
            self.folder = builder.tempdir().ok();
        }
        let count = self.previews.len();
        self.folder.as_ref().map(|folder| folder.path().join(format!("preview-{count}.diff")))
    }
}

fn read_params<T: DeserializeOwned>(params: Value) -> Result<T, (ErrorCode, String)> {
    serde_json::from_value(params).map_err(|error| (ErrorCode::InvalidParams, error.to_string()))
}

fn read_cancelled_id(told: &Notification) -> Option<RequestId> {
    if told.method != "$/cancelRequest" {
        return None;
    }
    serde_json::from_value(told.params.get("id")?.clone()).ok()
}

//! This module sends messages to the editor, from any thread.

use lsp_server::{ErrorCode, RequestId};
use serde_json::{Value, json};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicI32, Ordering};
use std::sync::mpsc::Sender;

/// What is sent to the editor, from any thread.
#[derive(Clone)]
pub(super) struct Outbox {
    messages: Sender<Value>,
    /// Numbers of requests to the editor.
    count: Arc<AtomicI32>,
    /// Whether the editor asks for hints again when it is told to.
    pub(super) refreshes_hints: Arc<AtomicBool>,
}

impl Outbox {
    pub(super) fn new(messages: Sender<Value>) -> Self {
        Self { messages, count: Arc::default(), refreshes_hints: Arc::default() }
    }

    pub(super) fn send(&self, message: Value) {
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

    /// Lets the editor show a range of a document.
    pub(super) fn show_document(&self, uri: &str, range: &Value) {
        self.ask_client("window/showDocument", &json!({ "uri": uri, "takeFocus": true, "selection": range }));
    }
}

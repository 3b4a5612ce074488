//! This module takes what an editor tells: texts that are opened, changed and closed, and settings.

use super::documents::Document;
use super::server::Server;
use lsp_server::Notification;
use lsp_types as lsp;
use serde_json::{Value, json};
use std::sync::atomic::Ordering;

impl Server {
    pub(super) fn take_notification(&mut self, told: Notification) {
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
}

//! A small client of the language server protocol over the real process.

use serde_json::{Value, json};
use std::io::{BufRead, BufReader, Write};
use std::process::{Child, ChildStdin, Command, ExitStatus, Stdio};
use std::sync::mpsc::{Receiver, channel};
use std::time::{Duration, Instant};

/// The editor's side of a running server.
pub struct Client {
    process: Child,
    input: Option<ChildStdin>,
    messages: Receiver<Value>,
    /// Messages that came while another one was waited for.
    kept: Vec<Value>,
    count: i32,
}

/// As long as the slowest machine may take for what takes milliseconds.
const PATIENCE: Duration = Duration::from_secs(60);

impl Client {
    /// Starts a server that nothing was said to yet.
    pub fn start(words: &[&str]) -> Self {
        let mut process = Command::new(env!("CARGO_BIN_EXE_clsmith"))
            .arg("lsp")
            .args(words)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::inherit())
            .spawn()
            .unwrap();
        let input = process.stdin.take();
        let mut output = BufReader::new(process.stdout.take().unwrap());
        let (sender, messages) = channel();
        std::thread::spawn(move || {
            while let Some(message) = read_message(&mut output) {
                if sender.send(message).is_err() {
                    return;
                }
            }
        });
        Self { process, input, messages, kept: Vec::new(), count: 0 }
    }

    /// Starts a server and says what this client can.
    pub fn initialized(words: &[&str], options: Value) -> Self {
        let mut client = Self::start(words);
        let can = json!({ "window": { "showDocument": { "support": true } } });
        let told = client.ask(
            "initialize",
            json!({ "processId": null, "rootUri": null, "capabilities": can, "initializationOptions": options }),
        );
        assert_eq!(told["capabilities"]["textDocumentSync"]["change"], 2);
        assert!(told["capabilities"].get("documentFormattingProvider").is_none(), "formatting never");
        client.tell("initialized", json!({}));
        client
    }

    /// Writes bytes as they are.
    pub fn write(&mut self, bytes: &[u8]) {
        let input = self.input.as_mut().unwrap();
        input.write_all(bytes).unwrap();
        input.flush().unwrap();
    }

    pub fn send(&mut self, message: &Value) {
        let body = message.to_string();
        self.write(format!("Content-Length: {}\r\n\r\n{body}", body.len()).as_bytes());
    }

    pub fn tell(&mut self, method: &str, params: Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    /// Asks, and returns the number of the question.
    pub fn begin(&mut self, method: &str, params: Value) -> i32 {
        self.count += 1;
        self.send(&json!({ "jsonrpc": "2.0", "id": self.count, "method": method, "params": params }));
        self.count
    }

    /// The whole answer to a question.
    pub fn answer(&mut self, id: i32) -> Value {
        self.wait_for(|message| message.get("method").is_none() && message["id"] == id)
    }

    /// The result of a question.
    pub fn ask(&mut self, method: &str, params: Value) -> Value {
        let id = self.begin(method, params);
        let answer = self.answer(id);
        assert!(answer.get("error").is_none(), "{method}: {answer}");
        answer["result"].clone()
    }

    /// The next message of a kind, of those that came already as well.
    pub fn wait_for(&mut self, fits: impl Fn(&Value) -> bool) -> Value {
        if let Some(at) = self.kept.iter().position(&fits) {
            return self.kept.remove(at);
        }
        let begun = Instant::now();
        loop {
            let left = PATIENCE.checked_sub(begun.elapsed()).expect("the server did not answer");
            let message = self.messages.recv_timeout(left).expect("the server did not answer");
            if fits(&message) {
                return message;
            }
            self.kept.push(message);
        }
    }

    pub fn open(&mut self, uri: &str, language: &str, text: &str) -> Value {
        let document = json!({ "uri": uri, "languageId": language, "version": 1, "text": text });
        self.tell("textDocument/didOpen", json!({ "textDocument": document }));
        self.findings(uri, 1)
    }

    /// Changes a document: each change is a range of lines and columns, and its text.
    pub fn change(&mut self, uri: &str, version: i32, changes: &[([u32; 4], &str)]) {
        let changes: Vec<Value> = changes
            .iter()
            .map(|([line, column, end_line, end_column], text)| {
                json!({ "range": range([*line, *column, *end_line, *end_column]), "text": text })
            })
            .collect();
        let document = json!({ "uri": uri, "version": version });
        self.tell("textDocument/didChange", json!({ "textDocument": document, "contentChanges": changes }));
    }

    /// The findings of a version of a document.
    pub fn findings(&mut self, uri: &str, version: i32) -> Value {
        let told = self.wait_for(|message| {
            message["method"] == "textDocument/publishDiagnostics"
                && message["params"]["uri"] == uri
                && message["params"]["version"] == version
        });
        told["params"]["diagnostics"].clone()
    }

    pub fn ask_at(&mut self, method: &str, uri: &str, line: u32, column: u32) -> Value {
        let position = json!({ "line": line, "character": column });
        self.ask(method, json!({ "textDocument": { "uri": uri }, "position": position }))
    }

    pub fn ask_about(&mut self, method: &str, uri: &str) -> Value {
        self.ask(method, json!({ "textDocument": { "uri": uri } }))
    }

    pub fn hover(&mut self, uri: &str, line: u32) -> String {
        let told = self.ask_at("textDocument/hover", uri, line, 0);
        told["contents"]["value"].as_str().unwrap_or_default().to_owned()
    }

    /// The most memory that the server has taken, where the system tells it.
    pub fn peak_memory_bytes(&self) -> Option<f64> {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.process.id())).ok()?;
        let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"))?;
        Some(line.trim().trim_end_matches(" kB").parse::<f64>().ok()? * 1024.0)
    }

    /// Ends the server as an editor does.
    pub fn end(mut self) {
        assert!(self.ask("shutdown", Value::Null).is_null());
        let id = self.begin("textDocument/hover", json!({}));
        assert_eq!(self.answer(id)["error"]["code"], -32600, "nothing is answered after `shutdown`");
        self.tell("exit", Value::Null);
        assert!(self.wait().success());
    }

    /// Closes the input.
    pub fn close_input(&mut self) {
        self.input = None;
    }

    pub fn wait(&mut self) -> ExitStatus {
        let begun = Instant::now();
        loop {
            if let Some(status) = self.process.try_wait().unwrap() {
                return status;
            }
            assert!(begun.elapsed() < PATIENCE, "the server does not end");
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}

impl Drop for Client {
    fn drop(&mut self) {
        let _ = self.process.kill();
        let _ = self.process.wait();
    }
}

pub fn range([line, column, end_line, end_column]: [u32; 4]) -> Value {
    json!({
        "start": { "line": line, "character": column },
        "end": { "line": end_line, "character": end_column },
    })
}

fn read_message(input: &mut impl BufRead) -> Option<Value> {
    let mut length = 0;
    loop {
        let mut line = String::new();
        if input.read_line(&mut line).ok()? == 0 {
            return None;
        }
        match line.trim().split_once(':') {
            None => break,
            Some((_, value)) => length = value.trim().parse().ok()?,
        }
    }
    let mut body = vec![0; length];
    input.read_exact(&mut body).ok()?;
    serde_json::from_slice(&body).ok()
}

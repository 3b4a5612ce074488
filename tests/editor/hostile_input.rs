//! What no editor should send ends no server.

use super::PART;
use super::client::Client;
use serde_json::{Value, json};

const URI: &str = "file:///programs/part.cls";

#[test]
fn bytes_and_requests_that_nobody_should_send() {
    let mut client = Client::start(&[]);
    let id = client.begin("textDocument/hover", json!({}));
    assert_eq!(client.answer(id)["error"]["code"], -32002, "nothing is answered before `initialize`");
    client.write(b"\r\n\r\nnonsense\r\nContent-Length: x\r\n\r\nContent-Length: 3\r\n\r\n{]}");
    assert_eq!(client.wait_for(|message| message["id"].is_null())["error"]["code"], -32700);
    client.send(&json!([1, 2]));
    assert_eq!(client.wait_for(|message| message["id"].is_null())["error"]["code"], -32600);
    client.ask("initialize", json!({ "capabilities": 7, "initializationOptions": [3] }));
    client.open(URI, "clsf", PART);
    for method in [
        "textDocument/hover",
        "textDocument/definition",
        "textDocument/documentSymbol",
        "textDocument/foldingRange",
        "textDocument/documentLink",
        "textDocument/codeLens",
        "textDocument/inlayHint",
        "textDocument/completion",
        "textDocument/codeAction",
        "textDocument/rename",
        "workspace/executeCommand",
        "textDocument/formatting",
        "no/such/method",
    ] {
        for params in
            [json!(null), json!([]), json!({ "textDocument": 7 }), json!({ "command": "x", "arguments": [] })]
        {
            let id = client.begin(method, params);
            assert!(client.answer(id)["error"]["code"].is_i64(), "{method}");
        }
    }
    // Places that are not there, of documents that are not open.
    for (uri, line, column) in
        [(URI, u32::MAX, u32::MAX), (URI, 3, u32::MAX), ("file:///none", 0, 0), ("%%%", 1, 1)]
    {
        for method in ["textDocument/hover", "textDocument/definition", "textDocument/completion"] {
            let id = client.begin(
                method,
                json!({ "textDocument": { "uri": uri }, "position": { "line": line, "character": column } }),
            );
            client.answer(id);
        }
    }
    let whole = json!({ "textDocument": { "uri": URI }, "range": super::client::range([9, 9, 0, 0]) });
    let id = client.begin("textDocument/inlayHint", whole);
    client.answer(id);
    // Changes that do not fit, to documents that are open, closed or unknown.
    client.change(
        URI,
        2,
        &[([9999, 9999, 3, 1], "x"), ([3, 5, 1, 0], "y"), ([0, 0, u32::MAX, u32::MAX], PART)],
    );
    client.change("file:///none", 2, &[([0, 0, 0, 0], "x")]);
    client.tell("textDocument/didChange", json!({ "textDocument": 3 }));
    client.tell("textDocument/didOpen", json!("x"));
    client.tell("$/cancelRequest", json!({ "id": [] }));
    client.tell("textDocument/didClose", json!({ "textDocument": { "uri": "file:///none" } }));
    client.findings(URI, 2);
    assert!(client.hover(URI, 10).contains("1200 MMPM"));
    client.end();
}

#[test]
fn files_of_any_content() {
    let mut client = Client::initialized(&[], Value::Null);
    let deep = format!("version: 1\nsteps: {}", "[".repeat(5000));
    for (number, text) in [
        "\u{0}\u{1}\u{feff}",
        "%\nO1000\nG0 X1\nM30\n%\n",
        "GOTO/$",
        "$$\r\r\n\r",
        "A/".repeat(20_000).as_str(),
        deep.as_str(),
    ]
    .into_iter()
    .enumerate()
    {
        for end in ["cls", "yaml"] {
            let uri = format!("file:///programs/{number}.{end}");
            client.open(&uri, "", text);
            client.hover(&uri, 0);
            client.ask_about("textDocument/documentSymbol", &uri);
            client.ask_about("textDocument/foldingRange", &uri);
            client.ask_about("textDocument/codeLens", &uri);
            client.ask_about("textDocument/documentLink", &uri);
            client.ask_at("textDocument/completion", &uri, 0, 3);
        }
    }
    client.end();
}

#[test]
fn cancelled_requests_stop() {
    let mut client = Client::initialized(&[], Value::Null);
    client.open(URI, "clsf", PART);
    // In one piece, so that the requests and their cancelling are there together.
    let mut bytes = String::new();
    let mut add = |message: Value| {
        let body = message.to_string();
        bytes.push_str(&format!("Content-Length: {}\r\n\r\n{body}", body.len()));
    };
    for id in 1000..1200 {
        let at = json!({ "textDocument": { "uri": URI }, "position": { "line": 10, "character": 0 } });
        add(json!({ "jsonrpc": "2.0", "id": id, "method": "textDocument/hover", "params": at }));
    }
    for id in 1000..1200 {
        add(json!({ "jsonrpc": "2.0", "method": "$/cancelRequest", "params": { "id": id } }));
    }
    client.write(bytes.as_bytes());
    let codes: Vec<i64> = (1000..1200).filter_map(|id| client.answer(id)["error"]["code"].as_i64()).collect();
    assert!(!codes.is_empty() && codes.iter().all(|code| *code == -32800), "{codes:?}");
    client.end();
}

#[test]
fn an_editor_that_goes_away_leaves_no_server() {
    let mut client = Client::initialized(&[], Value::Null);
    client.open(URI, "clsf", PART);
    client.close_input();
    assert_eq!(client.wait().code(), Some(1), "it did not say `shutdown`");
}

//! Typing: changes in UTF-16, answers while a text is ahead of what was read, long programs.

use super::PART;
use super::client::Client;
use serde_json::{Value, json};
use std::time::{Duration, Instant};

const URI: &str = "file:///programs/part.cls";

#[test]
fn columns_behind_letters_of_any_length_are_right() {
    let mut client = Client::initialized(&[], Value::Null);
    let text = "$$ Fräser 😀\r\nFEDRAT/MMPM,100\r\nGOTO/0,0,0\r\nGOTO/9,0,0\r\n";
    client.open(URI, "apt", text);
    // Behind `😀`, which is two units; then the second line, with the line end before it taken away and put back.
    client.change(URI, 2, &[([0, 12, 0, 12], "é"), ([0, 13, 1, 0], ""), ([0, 13, 0, 13], "\r\n")]);
    client.findings(URI, 2);
    client.change(URI, 3, &[([1, 12, 1, 15], "250")]);
    client.findings(URI, 3);
    assert!(client.hover(URI, 2).contains("feed: 250 MMPM"), "{}", client.hover(URI, 2));
    client.change(URI, 4, &[([2, 5, 2, 10], "ä,0,0")]);
    let found = client.findings(URI, 4);
    let found = found.as_array().unwrap().iter().find(|found| found["severity"] == 1).unwrap();
    assert_eq!(found["range"]["start"], json!({ "line": 2, "character": 5 }), "{found}");
    client.end();
}

#[test]
fn lines_are_followed_while_the_text_is_ahead() {
    let mut client = Client::initialized(&[], Value::Null);
    client.open(URI, "clsf", PART);
    // Asked at once, before a pause of typing: three new lines in front, one of them half typed.
    client.change(URI, 2, &[([5, 0, 5, 0], "$$ a\n$$ b\nGOT\n")]);
    assert!(client.hover(URI, 13).contains("feed: 1200 MMPM"));
    assert!(client.hover(URI, 7).starts_with("before this edited line"));
    let load = client.ask_at("textDocument/definition", URI, 13, 0);
    assert_eq!(load["range"]["start"]["line"], 2);
    client.findings(URI, 2);
    assert!(!client.hover(URI, 7).starts_with("before this edited line"));
    client.end();
}

#[test]
fn every_half_typed_prefix_is_answered() {
    let mut client = Client::initialized(&[], Value::Null);
    client.open(URI, "clsf", "");
    let (mut line, mut column) = (0, 0);
    for (at, character) in PART.chars().enumerate() {
        client.change(URI, at as i32 + 2, &[([line, column, line, column], character.to_string().as_str())]);
        (line, column) = if character == '\n' { (line + 1, 0) } else { (line, column + 1) };
        if at % 7 == 0 {
            client.ask_at("textDocument/hover", URI, line, column);
            client.ask_at("textDocument/completion", URI, line, column);
            client.ask_about("textDocument/documentSymbol", URI);
        }
    }
    client.findings(URI, PART.chars().count() as i32 + 1);
    assert!(client.hover(URI, 10).contains("feed: 1200 MMPM"));
    client.end();
}

/// The bench of the server states figures; here is only that an edit of a long program is not answered by reading it anew.
#[test]
fn an_edit_of_a_long_program_is_answered_before_it_is_read() {
    let mut text = String::from("UNITS/MM\nLOAD/TOOL,1\nFEDRAT/MMPM,100\n");
    for point in 0..50_000 {
        text.push_str(&format!("GOTO/{point}.0000,0.0000,0.0000\n"));
    }
    let mut client = Client::initialized(&[], Value::Null);
    client.open(URI, "apt", &text);
    let begun = Instant::now();
    client.change(URI, 2, &[([25_000, 5, 25_000, 6], "7")]);
    assert!(client.hover(URI, 40_000).contains("position: 39997, 0, 0 mm"));
    // A pause comes first, then the reading: an answer within the pause did not wait for it.
    let taken = begun.elapsed();
    client.findings(URI, 2);
    assert!(taken < Duration::from_secs(2), "{taken:?}");
    if let Some(peak) = client.peak_memory_bytes() {
        // The command itself and its threads take some megabytes, whatever the file.
        assert!(peak < 8.0 * text.len() as f64 + 40e6, "{peak} of {}", text.len());
    }
    client.end();
}

#[test]
fn what_is_asked_before_a_text_was_read_waits_for_it() {
    let mut client = Client::initialized(&[], Value::Null);
    let document = json!({ "uri": URI, "languageId": "clsf", "version": 1, "text": PART });
    client.tell("textDocument/didOpen", json!({ "textDocument": document }));
    let about = json!({ "textDocument": { "uri": URI } });
    let outline = client.begin("textDocument/documentSymbol", about.clone());
    let dropped = client.begin("textDocument/foldingRange", about);
    client.tell("$/cancelRequest", json!({ "id": dropped }));
    let answer = client.answer(outline);
    assert!(answer["result"].as_array().is_some_and(|found| !found.is_empty()), "{answer}");
    assert_eq!(client.answer(dropped)["error"]["code"], -32800);
    client.end();
}

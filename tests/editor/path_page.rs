//! The page of a program that editors show.

use super::client::Client;
use super::{PART, view};
use clsmith::editor::{PathPageContent, make_path_page};
use clsmith::simulation_run::SilentWatcher;
use serde_json::{Value, json};

const URI: &str = "file:///programs/part.cls";

#[test]
fn the_page_of_a_program_is_whole() {
    let page = make_path_page(&view(PART), None, PathPageContent::Path, &SilentWatcher).unwrap();
    assert!(page.starts_with("<!doctype html>") && page.contains("Content-Security-Policy"));
    assert!(page.contains("ROUGH") && page.contains("linkWithEditor"));
    let simulated = make_path_page(&view(PART), None, PathPageContent::Simulation, &SilentWatcher).unwrap();
    assert!(simulated.contains("Not shown"), "the page says what a simulation needs");
}

#[test]
fn the_server_makes_the_page_and_stops_when_it_is_cancelled() {
    let folder = tempfile::tempdir().unwrap();
    let shop = folder.path().join("shop.yaml");
    let setup = "units: mm\nstock: { block: { from: [-20, -20, -10], to: [220, 220, 0] } }\n\
        tools: [ { match: { number: 1 }, diameter: 10, teeth: 4, flute_length: 20 } ]\n";
    std::fs::write(&shop, setup).unwrap();
    let mut client = Client::initialized(&[], json!({ "setup": shop }));
    let mut text = String::from("UNITS/MM\nLOAD/TOOL,1\nSPINDL/RPM,5000,CLW\nFEDRAT/MMPM,1200\n");
    for row in 0..40_000 {
        text.push_str(&format!("GOTO/{}.,{}.,-{}.\n", 200 * (row % 2), row % 200, 1 + row % 9));
    }
    client.open(URI, "apt", &text);
    let wanted = |content: &str| json!({ "command": "clsmith.pathPage", "arguments": [URI, content] });
    let id = client.begin("workspace/executeCommand", wanted("simulation"));
    std::thread::sleep(std::time::Duration::from_millis(200));
    client.tell("$/cancelRequest", json!({ "id": id }));
    assert_eq!(client.answer(id)["error"]["code"], -32800);
    let page = client.ask("workspace/executeCommand", wanted("path"));
    assert_eq!(page["version"], 1);
    assert!(page["html"].as_str().unwrap().starts_with("<!doctype html>"));
    let id = client.begin("workspace/executeCommand", wanted("none"));
    assert_eq!(client.answer(id)["error"]["code"], -32602);
    let id = client.begin(
        "workspace/executeCommand",
        json!({ "command": "clsmith.pathPage", "arguments": ["file:///none"] }),
    );
    assert_eq!(client.answer(id)["error"]["code"], -32602);
    assert!(matches!(client.ask_about("textDocument/documentSymbol", URI), Value::Array(_)));
    client.end();
}

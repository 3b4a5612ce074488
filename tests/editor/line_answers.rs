//! What is told about lines of a program: by the library, and by the server.

use super::client::Client;
use super::{PART, view};
use clsmith::editor::{OutlineKind, complete_words, refuse_operation_name};
use serde_json::{Value, json};

const URI: &str = "file:///programs/part.cls";

#[test]
fn the_state_at_every_line_is_that_of_the_motions() {
    // Long enough for several places from which the state is found.
    let mut text = String::from("UNITS/MM\nLOAD/TOOL,1\nSPINDL/RPM,1000,CLW\nFEDRAT/MMPM,100\n");
    for point in 0..7000 {
        text.push_str(&format!("GOTO/{point},0,0\n"));
        if point % 500 == 0 {
            text.push_str(&format!("FEDRAT/MMPM,{}\n", 100 + point));
        }
    }
    let view = view(&text);
    let program = view.program();
    let (mut length, mut seen) = (0.0, 0);
    for motion in program.motions() {
        length += motion.length();
        seen += 1;
        if seen % 97 != 0 && !(2040..2056).contains(&seen) {
            continue;
        }
        let state = view.line_state(view.line_of_statement(motion.last_statement())).unwrap();
        assert_eq!(state.pose.unwrap().point, motion.to.point);
        assert_eq!(state.feed, motion.feed);
        assert!((state.sums.feed_length_mm + state.sums.rapid_length_mm - length).abs() < 1e-6);
    }
    assert_eq!(seen, 7000);
}

#[test]
fn the_state_names_all_that_holds() {
    let state = view(PART).line_state(10).unwrap();
    let text = state.to_markdown();
    for part in [
        "operation: `ROUGH`",
        "tool 3",
        "position: 60, 0, -2 mm",
        "axis: 0, 0, 1",
        "feed: 1200 MMPM (1200 mm/min, 47.244 inch/min)",
        "spindle: 5000 rev/min clockwise",
        "coolant: FLOOD",
        "motion: ",
        "so far: 72 mm at feed",
    ] {
        assert!(text.contains(part), "{part}\n{text}");
    }
    // 12 mm at 600 mm/min and 60 mm at 1200 mm/min are 4.2 s.
    assert!((state.sums.seconds - 4.2).abs() < 1e-9, "{:?}", state.sums);
    assert!(view(PART).line_state(500).is_none());
}

#[test]
fn outline_places_hints_and_folding() {
    let view = view(PART);
    let outline = view.outline();
    let told: Vec<_> =
        outline.iter().map(|entry| (entry.kind, entry.name.as_str(), entry.children.len())).collect();
    assert_eq!(told, [(OutlineKind::Operation, "ROUGH", 1), (OutlineKind::Operation, "FINISH", 1)]);
    assert_eq!(outline[1].children[0].name, "tool 4");
    let slice = |span| std::str::from_utf8(view.program().source().slice(span)).unwrap();
    assert_eq!(slice(view.tool_load(10).unwrap()), "LOAD/TOOL,3");
    assert_eq!(slice(view.tool_load(19).unwrap()), "LOAD/TOOL,4");
    assert_eq!(slice(view.next_feed(7).unwrap()), "FEDRAT/1200.0000");
    assert_eq!(slice(view.last_feed(17).unwrap()), "FEDRAT/1200.0000");
    assert_eq!(view.last_feed(3), None);
    let hints: Vec<_> = view.line_hints(0..21).into_iter().map(|hint| (hint.line, hint.text)).collect();
    let feed = |line, text: &str| (line, text.to_owned());
    for hint in [
        feed(6, "rapid"),
        feed(8, "600 MMPM"),
        feed(10, "1200 MMPM"),
        feed(16, "rapid"),
        feed(18, "300 MMPM"),
    ] {
        assert!(hints.contains(&hint), "{hint:?} of {hints:?}");
    }
    assert!(hints.iter().any(|(line, text)| *line == 0 && text.ends_with(" s")), "{hints:?}");
    // A part of the lines has the hints that all lines have there.
    let part: Vec<_> = view.line_hints(8..17).into_iter().map(|hint| (hint.line, hint.text)).collect();
    assert_eq!(part, hints.iter().filter(|(line, _)| (8..17).contains(line)).cloned().collect::<Vec<_>>());
    assert!(
        view.foldings().contains(&(0, 11)) && view.foldings().contains(&(12, 20)),
        "{:?}",
        view.foldings()
    );
}

#[test]
fn words_are_completed_and_names_judged() {
    assert!(complete_words("COOLNT/").iter().any(|one| one.word == "FLOOD"));
    assert!(complete_words("$$ GO").is_empty());
    assert!(complete_words("goto").iter().any(|one| one.word == "GOTO"));
    assert_eq!(refuse_operation_name("ROUGH_2"), None);
    for bad in ["", " ", "A,B", "A/B", "A$", "A\nB", " A"] {
        assert!(refuse_operation_name(bad).is_some(), "{bad:?}");
    }
}

#[test]
fn the_server_tells_it_to_an_editor() {
    let mut client =
        Client::initialized(&["--stdio"], json!({ "documentation": "https://docs.example/codes.html" }));
    let text = PART.replace("FEDRAT/1200.0000", "FEDRAT/12O0.0000");
    let findings = client.open(URI, "clsf", &text);
    let wrong = findings.as_array().unwrap().iter().find(|found| found["code"] == "CL0003").unwrap();
    assert_eq!(wrong["range"], super::client::range([9, 7, 9, 16]));
    assert_eq!(wrong["codeDescription"]["href"], "https://docs.example/codes.html#cl0003");

    let actions = client.ask(
        "textDocument/codeAction",
        json!({ "textDocument": { "uri": URI }, "range": wrong["range"], "context": { "diagnostics": [wrong] } }),
    );
    let fix = actions.as_array().unwrap().iter().find(|action| action["isPreferred"] == true).unwrap();
    let edit = &fix["edit"]["changes"][URI][0];
    assert_eq!((&edit["range"], &edit["newText"]), (&wrong["range"], &json!("1200.0000")));
    client.change(URI, 2, &[([9, 7, 9, 16], "1200.0000")]);
    let after = client.findings(URI, 2);
    assert!(after.as_array().unwrap().iter().all(|found| found["code"] != "CL0003"), "{after}");

    assert!(client.hover(URI, 10).contains("1200 MMPM"));
    let symbols = client.ask_about("textDocument/documentSymbol", URI);
    assert_eq!(symbols[1]["name"], "FINISH");
    assert_eq!(symbols[1]["selectionRange"], super::client::range([12, 0, 12, 28]));
    let load = client.ask_at("textDocument/definition", URI, 18, 3);
    assert_eq!(load["range"]["start"], json!({ "line": 14, "character": 0 }));
    let foldings = client.ask_about("textDocument/foldingRange", URI);
    assert_eq!(foldings[0]["startLine"], 0);
    let hints = client.ask(
        "textDocument/inlayHint",
        json!({ "textDocument": { "uri": URI }, "range": super::client::range([0, 0, 30, 0]) }),
    );
    assert!(hints.as_array().unwrap().iter().any(|hint| hint["label"] == "600 MMPM"), "{hints}");
    let words = client.ask_at("textDocument/completion", URI, 4, 7);
    assert!(words.as_array().unwrap().iter().any(|word| word["label"] == "MIST"), "{words}");
    let feed = json!({ "command": "clsmith.nextFeed", "arguments": [URI, { "line": 7, "character": 0 }] });
    assert_eq!(client.ask("workspace/executeCommand", feed)["range"]["start"]["line"], 9);
    let shown = client.wait_for(|message| message["method"] == "window/showDocument");
    assert_eq!(shown["params"]["selection"]["start"]["line"], 9);

    let place = client.ask_at("textDocument/prepareRename", URI, 0, 12);
    assert_eq!(place["placeholder"], "ROUGH");
    let rename = |name: &str| json!({ "textDocument": { "uri": URI }, "position": { "line": 0, "character": 12 }, "newName": name });
    let edits = client.ask("textDocument/rename", rename("ROUGH_2"));
    let edit = json!({ "range": place["range"], "newText": "ROUGH_2" });
    assert_eq!(edits["changes"][URI], json!([edit]));
    let id = client.begin("textDocument/rename", rename("A,B"));
    assert_eq!(client.answer(id)["error"]["code"], -32602);
    client.end();
}

#[test]
fn findings_that_are_too_many_are_counted() {
    let mut client = Client::initialized(&[], Value::Null);
    let found = client.open(URI, "clsf", &"GOTO/0,ä,0\n".repeat(600));
    let found = found.as_array().unwrap();
    assert_eq!(found.len(), 501);
    let last = found.last().unwrap()["message"].as_str().unwrap();
    assert!(last.ends_with("more findings are not shown here; `clsmith check` tells all of them"), "{last}");
    client.end();
}

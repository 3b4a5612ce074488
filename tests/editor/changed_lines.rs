//! From a line of a corrected program to the step of the recipe that changed it.

use super::client::Client;
use super::{PART, view};
use crate::cli::clsmith;
use clsmith::editor::{LineChange, StepReference, find_step_places};
use clsmith::source::Source;
use serde_json::{Value, json};
use std::path::Path;

/// Two steps of one name, and one of another.
const RECIPE: &str = "version: 1
units: mm
steps:
  - scale_feed: { factor: 0.5, where: { operations: [ROUGH] } }
  - set_spindle: { speed: { set: 4000 }, feeds: keep }
  - scale_feed: { factor: 2, where: { operations: [FINISH] } }
";

fn apply(folder: &Path, recipe: &str, words: &[&str]) -> String {
    std::fs::write(folder.join("part.cls"), PART).unwrap();
    std::fs::write(folder.join("recipe.yaml"), recipe).unwrap();
    let always = ["apply", "recipe.yaml", "part.cls", "-o", "out.cls", "-q"];
    clsmith(folder).args(always).args(words).assert().success();
    std::fs::read_to_string(folder.join("out.cls")).unwrap()
}

fn line_of(text: &str, wanted: &str) -> u32 {
    text.lines().position(|line| line == wanted).unwrap_or_else(|| panic!("{wanted} is not in {text}")) as u32
}

#[test]
fn reports_name_the_steps_of_every_line() {
    let folder = tempfile::tempdir().unwrap();
    let text = apply(folder.path(), RECIPE, &["--json", "out.json"]);
    let report = std::fs::read(folder.path().join("out.json")).unwrap();
    let report = Source::new("out.json", report).unwrap();
    let program = Source::new("out.cls", text.clone().into_bytes()).unwrap();
    let steps = |line| LineChange::from_report(&program, line, &report).unwrap().unwrap().steps;
    for (wanted, number) in [
        ("FEDRAT/600.0000", 1),
        ("SPINDL/RPM,4000,CLW", 2),
        ("FEDRAT/MMPM,600.0000", 3),
        ("FEDRAT/MMPM,300.0000", 1),
    ] {
        // The first feed of ROUGH is 300 now, and the feed of FINISH 600.
        assert_eq!(steps(line_of(&text, wanted)), [StepReference::Number(number)], "{wanted}");
    }
    for untouched in ["RAPID", "END-OF-PATH", "LOAD/TOOL,3"] {
        assert_eq!(steps(line_of(&text, untouched)), [], "{untouched}");
    }
    assert_eq!(LineChange::from_report(&program, 900, &report).unwrap(), None);
    let other = Source::new("out.cls", format!("{text}\n").into_bytes()).unwrap();
    assert_eq!(LineChange::from_report(&other, 3, &report).unwrap(), None, "another text");
}

#[test]
fn comments_name_the_steps_where_there_is_no_report() {
    let folder = tempfile::tempdir().unwrap();
    let text = apply(folder.path(), RECIPE, &["--provenance", "comments"]);
    let view = view(&text);
    let found = |line| LineChange::from_comments(&view, line).unwrap();
    let named = |name: &str| vec![StepReference::Name(name.to_owned())];
    let spindle = line_of(&text, "SPINDL/RPM,4000,CLW");
    assert_eq!(found(spindle).steps, named("set_spindle"));
    assert_eq!(found(spindle - 1).steps, named("set_spindle"), "the comment itself");
    assert_eq!(found(line_of(&text, "FEDRAT/600.0000")).steps, named("scale_feed"));
    assert_eq!(found(line_of(&text, "GOTO/60.0000,0.0000,-2.0000")).steps, []);
    assert_eq!(found(0).recipes, ["recipe.yaml"]);
    let recipe = Source::new("recipe.yaml", RECIPE.as_bytes().to_vec()).unwrap();
    let places = find_step_places(&recipe, &named("scale_feed")).unwrap();
    assert_eq!(places.iter().map(|place| place.number).collect::<Vec<_>>(), [1, 3], "any of one name");
    assert!(places.iter().all(|place| recipe.slice(place.span) == b"scale_feed"));
}

#[test]
fn the_server_leads_to_the_step() {
    let folder = tempfile::tempdir().unwrap();
    let text = apply(folder.path(), RECIPE, &["--json", "out.json", "--provenance", "comments"]);
    let uri = |name: &str| format!("file://{}", folder.path().join(name).display());
    let (program, recipe) = (uri("out.cls"), uri("recipe.yaml"));
    let mut client = Client::initialized(&[], Value::Null);
    client.open(&program, "clsf", &text);
    let command = |line: u32| json!({ "command": "clsmith.recipeStep", "arguments": [program, { "line": line, "character": 0 }] });
    let feed = line_of(&text, "FEDRAT/MMPM,600.0000");
    let found = client.ask("workspace/executeCommand", command(feed));
    // Comments alone could not say which of the two it was.
    assert_eq!(found["steps"].as_array().unwrap().len(), 1, "{found}");
    assert_eq!((&found["steps"][0]["number"], &found["recipeChanged"]), (&json!(3), &json!(false)));
    let shown = client.wait_for(|message| message["method"] == "window/showDocument");
    assert_eq!(shown["params"]["uri"], recipe);
    assert_eq!(shown["params"]["selection"]["start"], json!({ "line": 5, "character": 4 }));
    // A comment of clsmith leads where its record does.
    let told = client.ask_at("textDocument/declaration", &program, feed - 1, 0);
    assert_eq!(told[0]["range"]["start"]["line"], 5, "{told}");
    let id = client.begin("workspace/executeCommand", command(line_of(&text, "RAPID")));
    let message = client.answer(id)["error"]["message"].as_str().unwrap().to_owned();
    assert!(message.starts_with("no step changed this line"), "{message}");

    // The recipe as it is typed: a step in front of the others, and half of one.
    client.open(&recipe, "yaml", RECIPE);
    client.change(&recipe, 2, &[([3, 0, 3, 0], "  - clamp_feed: { max: 5000 }\n")]);
    let found = client.ask("workspace/executeCommand", command(feed));
    assert_eq!(found["recipeChanged"], true, "the number may be that of another step now");
    client.change(&recipe, 3, &[([3, 0, 3, 0], "  - clamp_f: {\n")]);
    let id = client.begin("workspace/executeCommand", command(feed));
    let message = client.answer(id)["error"]["message"].as_str().unwrap().to_owned();
    assert!(message.starts_with("step 3 of recipe.yaml changed this line: "), "{message}");

    // An edited text is not the one of the report any more; comments still tell.
    client.change(&program, 2, &[([0, 0, 0, 0], "$$ mine\n")]);
    client.findings(&program, 2);
    client.tell("textDocument/didClose", json!({ "textDocument": { "uri": recipe } }));
    let found = client.ask("workspace/executeCommand", command(feed + 1));
    assert_eq!(found["steps"].as_array().unwrap().len(), 2, "{found}");
    client.end();
}

//! `--select`: rules that choose the recipe.

use super::{clsmith, example};
use std::fs;
use std::path::Path;

const SLOW: &str = "version: 1\nsteps:\n  - scale_feed: { factor: 0.5 }\n";
const SAME: &str = "version: 1\nsteps: []\n";

/// A folder with an NX program, a Creo program, two recipes and a selection.
fn shop(rules: &str) -> tempfile::TempDir {
    let folder = example("pocket");
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    fs::create_dir(folder.path().join("shop")).unwrap();
    write("shop/slow.yaml", SLOW);
    write("shop/same.yaml", SAME);
    write("shop/recipes.yaml", rules);
    write(
        "creo.ncl",
        "$$*          Pro/CLfile  Version 9.0 - 9.0.3.0\nPARTNO / OP10\nMACHIN / UNCX01, 1\nUNITS / MM\nLOADTL / 5\nRAPID\nGOTO / 0.0, 0.0, 10.0\nFEDRAT / 100.0,  MMPM\nGOTO / 0.0, 0.0, 0.0\nFINI\n",
    );
    folder
}

/// The rule that chose the recipe, as the log tells it, and the outcome.
fn chosen(folder: &Path, input: &str) -> (String, String) {
    let log = folder.join("log.jsonl");
    let _ = fs::remove_file(&log);
    let _ = clsmith(folder)
        .args([
            "hook",
            "-q",
            "--select",
            "shop/recipes.yaml",
            "--log",
            "log.jsonl",
            input,
            "--",
            "true",
            "{}",
        ])
        .assert();
    let line: serde_json::Value = serde_json::from_str(&fs::read_to_string(log).unwrap()).unwrap();
    let text = |value: &serde_json::Value| value.as_str().unwrap_or("none").to_owned();
    (text(&line["recipe"]["chosen_by"]), text(&line["outcome"]))
}

fn pair(by: &str, outcome: &str) -> (String, String) {
    (by.to_owned(), outcome.to_owned())
}

#[test]
fn the_first_rule_that_fits_wins() {
    let folder = shop(
        "rules:\n\
         - when: { machine: \"UNC*\", file: \"*.cls\" }\n  recipe: same.yaml\n\
         - when: { machine: [\"DMU*\", \"UNCX01,1\"] }\n  recipe: slow.yaml\n\
         - when: { operation: \"HOLES\", tool: [99, \"DRILL*\"] }\n  recipe: slow.yaml\n\
         - when: { file: \"*.cls\" }\n  recipe: same.yaml\n",
    );
    assert_eq!(chosen(folder.path(), "creo.ncl"), pair("rule 2", "corrected"));
    assert_eq!(chosen(folder.path(), "part.cls"), pair("rule 3", "corrected"));
    fs::write(folder.path().join("other.cls"), "RAPID\nGOTO/0.0,0.0,0.0\n").unwrap();
    assert_eq!(chosen(folder.path(), "other.cls"), pair("rule 4", "unchanged"));
}

#[test]
fn tools_are_asked_by_number_and_by_name() {
    for (tool, rule) in [("8", "rule 1"), ("EM12", "rule 1"), ("\"em*\"", "otherwise"), ("12", "otherwise")] {
        let text = format!(
            "rules:\n- when: {{ tool: {tool} }}\n  recipe: same.yaml\notherwise: {{ recipe: slow.yaml }}\n"
        );
        assert_eq!(chosen(shop(&text).path(), "part.cls").0, rule, "{tool}");
    }
}

#[test]
fn what_becomes_of_the_others_is_said() {
    let rule = "rules:\n- when: { file: \"*.nowhere\" }\n  recipe: same.yaml\n";
    for (otherwise, outcome) in [
        ("", pair("none", "refused")),
        ("otherwise: stop\n", pair("none", "refused")),
        ("otherwise: pass\n", pair("none", "passed")),
        ("otherwise: { recipe: slow.yaml }\n", pair("otherwise", "corrected")),
    ] {
        let folder = shop(&format!("{rule}{otherwise}"));
        assert_eq!(chosen(folder.path(), "part.cls"), outcome, "{otherwise}");
    }
    let folder = shop(rule);
    let mut command = clsmith(folder.path());
    command.args(["hook", "--select", "shop/recipes.yaml", "part.cls", "--", "true", "{}"]);
    let done = command.assert().code(125);
    let text = String::from_utf8_lossy(&done.get_output().stderr).into_owned();
    assert!(text.contains("CL0416") && text.contains("POCKET_ROUGH, HOLES"), "{text}");
    assert!(text.contains("machine: not stated") && text.contains("3 (EM12), 8 (DRILL8)"), "{text}");
}

#[test]
fn the_choice_is_told_and_paths_are_beside_the_selection() {
    let folder = shop("rules:\n- when: { file: part.cls }\n  recipe: slow.yaml\n  setup: shop.yaml\n");
    fs::write(folder.path().join("shop/shop.yaml"), "machine: { max_feed: 8000 }\n").unwrap();
    let mut command = clsmith(folder.path());
    command.args([
        "hook",
        "--select",
        "shop/recipes.yaml",
        "--log",
        "log.jsonl",
        "part.cls",
        "--",
        "true",
        "{}",
    ]);
    let done = command.assert().code(0);
    let text = String::from_utf8_lossy(&done.get_output().stderr).replace('\\', "/");
    assert!(text.contains("corrected by shop/slow.yaml (rule 1)"), "{text}");
    let log = fs::read_to_string(folder.path().join("log.jsonl")).unwrap();
    let line: serde_json::Value = serde_json::from_str(&log).unwrap();
    assert_eq!(line["recipe"]["files"].as_array().unwrap().len(), 2, "{line}");
}

#[test]
fn a_wrong_selection_is_underlined() {
    for (text, code, said) in [
        ("rules:\n- when: { fiel: \"*\" }\n  recipe: a.yaml\n", "CL0204", "`file`"),
        ("rules:\n- when: {}\n  recipe: a.yaml\n", "CL0207", "has no condition"),
        ("rules: []\n", "CL0207", "there is no rule"),
        ("rules:\n- when: { tool: [] }\n  recipe: a.yaml\n", "CL0207", "an empty list fits nothing"),
        ("rules:\n- when: { machine: \"[\" }\n  recipe: a.yaml\n", "CL0207", "no name pattern"),
        ("rules:\n- when: { file: \"*\" }\n", "CL0205", "`recipe`"),
        (
            "rules:\n- when: { file: \"*\" }\n  recipe: a.yaml\notherwise: skip\n",
            "CL02",
            "Did you mean `stop`",
        ),
        ("version: 1\nsteps: []\n", "CL02", "--recipe"),
    ] {
        let folder = shop(text);
        let mut command = clsmith(folder.path());
        command.args(["hook", "--select", "shop/recipes.yaml", "part.cls", "--", "true", "{}"]);
        let done = command.assert().code(125);
        let shown = String::from_utf8_lossy(&done.get_output().stderr).into_owned();
        assert!(shown.contains(said) && shown.contains("recipes.yaml:"), "{text}{shown}");
        assert!(shown.contains(&code[..4]), "{text}{shown}");
    }
}

#[test]
fn the_schema_of_a_selection() {
    let folder = example("pocket");
    let done = clsmith(folder.path()).args(["schema", "--select"]).assert().success();
    let text = String::from_utf8_lossy(&done.get_output().stdout).into_owned();
    crate::support::snapshots("cli").bind(|| insta::assert_snapshot!("select_schema", text));
}

#[test]
fn a_rule_sees_a_program_in_the_words_of_its_setup() {
    let folder = shop(
        "rules:\n\
         - when: { operation: \"ROUGH*\" }\n  recipe: same.yaml\n\
         - when: { operation: \"ROUGH*\" }\n  recipe: slow.yaml\n  setup: words.yaml\n\
         otherwise: pass\n",
    );
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("shop/words.yaml", "words: { OP_NAME: operation, F_CUT: feed }\n");
    write(
        "own.apt",
        "UNITS/MM\nCUTTER/10\nLOADTL/1\nSPINDL/900,RPM,CLW\nOP_NAME/ROUGH BASE\nF_CUT/300\nGOTO/0,0,0\nGOTO/9,0,0\nFINI\n",
    );
    assert_eq!(chosen(folder.path(), "own.apt"), pair("rule 2", "corrected"));
    assert_eq!(chosen(folder.path(), "part.cls"), pair("none", "passed"));
}

//! Defaults that a schema cannot state as a value are told in words; the words say what is done.

use crate::support;
use clsmith::diagnostic::Failure;
use clsmith::recipe::recipe_schema;
use clsmith::report::DisplayUnits;
use clsmith::setup::Setup;
use clsmith::source::Source;
use clsmith::transform::{Recipe, Step, run_recipe};
use serde_json::Value;
use std::collections::BTreeMap;

/// Every key whose default is told in words: its path in the schema, the words, and its description.
fn worded_defaults() -> Vec<(String, String, String)> {
    fn walk(path: &str, schema: &Value, found: &mut Vec<(String, String, String)>) {
        match schema {
            Value::Object(keys) => {
                let text = |key: &str| keys.get(key).and_then(Value::as_str).unwrap_or_default().to_owned();
                if keys.contains_key("x-default") {
                    found.push((path.to_owned(), text("x-default"), text("description")));
                }
                keys.iter().for_each(|(key, inner)| walk(&format!("{path}/{key}"), inner, found));
            }
            Value::Array(items) => items.iter().for_each(|inner| walk(path, inner, found)),
            _ => {}
        }
    }
    let mut found = Vec::new();
    walk("", &recipe_schema::<Step>(), &mut found);
    found
}

/// The words of a key of a step.
fn default_of(step: &str, key: &str) -> String {
    let schema = recipe_schema::<Step>();
    let definitions = schema["$defs"].as_object().unwrap();
    let name: String = step.split('_').map(|word| word[..1].to_uppercase() + &word[1..]).collect();
    let property = &definitions[&name]["properties"][key];
    property["x-default"].as_str().unwrap_or_else(|| panic!("{step}.{key}: {property}")).to_owned()
}

/// A slot of 40 mm with air before it, between two walls of stock that is lower on one side.
const SLOT: &str = "TLDATA/MILL,10.0000,0.0000,50.0000,0.0000,0.0000\nLOAD/TOOL,3\nSPINDL/RPM,5000,CLW\nRAPID\n\
    GOTO/-30.0000,3.0000,-2.0000\nFEDRAT/MMPM,400.0000\nGOTO/-20.0000,3.0000,-2.0000\nGOTO/-8.0000,3.0000,-2.0000\n\
    GOTO/-6.0000,3.0000,-2.0000\nGOTO/-4.0000,3.0000,-2.0000\nGOTO/40.0000,17.3000,-2.0000\nFEDRAT/MMPM,900.0000\n\
    GOTO/40.0000,-3.1000,-2.0000\nGOTO/90.0000,-3.1000,-2.0000\n";

const SHOP: &str = "  machine: { max_feed: 700, max_acceleration: 20000 }\n  \
    stock: { block: { from: [0, -20, -10], to: [60, 20, 0] } }\n  \
    tools: [ { match: {}, flute_length: 20, teeth: 4, insert: { height: 5, radius: 6 } } ]\n";

/// The program and the report that a step with these parameters makes.
fn run(step: &str, parameters: &str, text: &str) -> String {
    let recipe = format!("version: 1\nunits: mm\nsetup:\n{SHOP}steps:\n  - {step}: {{ {parameters} }}\n");
    let source = Source::new("recipe.yaml", recipe.clone().into_bytes()).unwrap();
    let recipe_read = Recipe::load(&source).unwrap_or_else(|failure| panic!("{recipe}: {failure}"));
    let setup = recipe_read.merge_setups(Setup::default(), Setup::default());
    let outcome = run_recipe(&recipe_read, &setup, support::program(text))
        .map_err(Failure::into_findings)
        .unwrap_or_else(|found| panic!("{recipe}: {found:?}"));
    let mut done = String::from_utf8_lossy(&outcome.program.to_bytes()).into_owned();
    outcome.reports.iter().for_each(|report| done.push_str(&report.to_text(DisplayUnits::MM)));
    done
}

/// A key left out, given as its default, and given as something else.
struct Row {
    step: &'static str,
    key: &'static str,
    /// The words for the default.
    words: String,
    others: &'static str,
    /// The default as a value, and another one.
    values: [String; 2],
    program: String,
}

fn row(step: &'static str, key: &'static str, others: &'static str, values: [f64; 2], program: &str) -> Row {
    let values = values.map(|value| value.to_string());
    Row { step, key, words: default_of(step, key), others, values, program: program.to_owned() }
}

/// A key whose default is a length in mm, which is read from its words.
fn length(step: &'static str, key: &'static str, others: &'static str, program: &str) -> Row {
    let words = default_of(step, key);
    let value: f64 = words.strip_suffix(" mm").and_then(|number| number.parse().ok()).expect(&words);
    row(step, key, others, [value, 4.0 * value], program)
}

/// A key whose default is the diameter of 10 mm by a number, which is read from its words.
fn divided(step: &'static str, key: &'static str, others: &'static str) -> Row {
    let words = default_of(step, key);
    let (_, behind) = words.split_once("divided by ").expect(&words);
    let number: f64 = behind.split([',', ';']).next().and_then(|number| number.parse().ok()).expect(&words);
    row(step, key, others, [10.0 / number, 20.0 / number], SLOT)
}

/// A pass over a hill whose chords depend on the tolerance.
fn hill() -> String {
    let mut text =
        "TLDATA/MILL,10.0000,5.0000,50.0000,0.0000,0.0000\nLOAD/TOOL,1\nSPINDL/RPM,5000,CLW\nRAPID\n\
        GOTO/0.0000,0.0000,40.0000\nFEDRAT/MMPM,400.0000\n"
            .to_owned();
    for x in 0..40 {
        let x = f64::from(x);
        text.push_str(&format!("GOTO/{x:.4},0.0000,{:.4}\n", 3.0 * (x / 5.0).sin()));
    }
    text + "RAPID\nGOTO/39.0000,0.0000,40.0000\n"
}

fn rows() -> Vec<Row> {
    let ramps = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("examples/web-pocket/part.cls");
    let ramps = std::fs::read_to_string(ramps).unwrap();
    let feed = "target: 0.05, min_change: 0";
    vec![
        length("optimize_feed", "margin", "target: 0.05, air_feed: 300, min_change: 0", SLOT),
        length("correct_ramp", "clearance", "depth_of_cut: 3", &ramps),
        length("compensate_z", "tolerance", "radius: 5", &hill()),
        divided("optimize_feed", "cell", "target: 0.05, min_change: 0, engagement: columns"),
        divided("optimize_feed", "layer", "target: 0.05, min_change: 0, engagement: layers"),
        row("optimize_feed", "max_feed", feed, [700.0, 300.0], SLOT),
        row("optimize_feed", "max_acceleration", feed, [20000.0, 2000.0], SLOT),
        row("clamp_feed", "max", "min: 1", [700.0, 650.0], SLOT),
        row("clamp_feed", "min", "max: 600", [1.0, 500.0], SLOT),
        row("compensate_z", "radius", "tolerance: 0.005", [5.0, 4.0], &hill()),
    ]
}

#[test]
fn a_default_in_words_is_what_is_done() {
    for Row { step, key, words, others, values: [same, other], program } in rows() {
        let left_out = run(step, others, &program);
        let given = |value: &str| run(step, &format!("{others}, {key}: {value}"), &program);
        assert_eq!(given(&same), left_out, "{step}.{key}: `{words}`");
        assert_ne!(given(&other), left_out, "{step}.{key}: nothing here depends on it");
    }
}

/// A description may repeat the default; then it repeats the same.
#[test]
fn descriptions_repeat_the_same_defaults() {
    let mut repeated = 0;
    for (path, words, description) in worded_defaults() {
        let description = description.replace('\n', " ");
        let Some((before, _)) = description.split_once(" mm when it is left out") else { continue };
        let number = before.rsplit(' ').next().unwrap();
        assert_eq!(words, format!("{number} mm"), "{path}: {description}");
        repeated += 1;
    }
    assert_eq!(repeated, 3);
}

/// Numbers in words are made from what is done, and tried above. A number that is typed into the words would drift.
#[test]
fn no_default_in_words_has_a_number_that_is_not_tried() {
    let tried: BTreeMap<String, &str> = rows().into_iter().map(|row| (row.words, row.key)).collect();
    for (path, words, _) in worded_defaults() {
        let has_number = words.bytes().any(|byte| byte.is_ascii_digit())
            || ["half", "third", "tenth", "fortieth", "twice"].iter().any(|word| words.contains(word));
        let is_tried = tried.get(&words).is_some_and(|key| path.ends_with(key));
        assert!(!has_number || is_tried, "{path}: `{words}`");
    }
}

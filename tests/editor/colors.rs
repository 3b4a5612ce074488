//! The grammar by which editors colour programs is made from the records that the reader knows. `INSTA_UPDATE=always` writes
//! it.

use crate::real_text::record_table::RECORDS;
use clsmith::editor::complete_words;
use clsmith::parse::{parse, syntax};
use clsmith::program::RecordKind;
use clsmith::program::record::known_words;
use clsmith::source::Source;
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

/// The scope of the words of each kind of record; themes of editors have colours for their first parts.
fn scope_of(kind: RecordKind) -> Option<&'static str> {
    Some(match kind {
        RecordKind::Point | RecordKind::Arc | RecordKind::Spline => "keyword.control.motion",
        RecordKind::Rapid => "keyword.other.unit.rapid",
        RecordKind::Feed | RecordKind::Spindle => "storage.type.feed",
        RecordKind::Tool | RecordKind::Compensation => "entity.name.type.tool",
        RecordKind::Axis | RecordKind::Frame => "entity.name.tag.frame",
        RecordKind::Cycle => "entity.name.function.cycle",
        RecordKind::Mark | RecordKind::Other => "support.function.word",
        RecordKind::Structure => "keyword.other.structure",
        RecordKind::Comment => "comment.line.text",
        _ => return None,
    })
}

/// The major words of all records of all dialects, by scope.
fn words_by_scope() -> BTreeMap<&'static str, BTreeSet<String>> {
    let mut found: BTreeMap<&str, BTreeSet<String>> = BTreeMap::new();
    let mut taken = BTreeSet::new();
    for (dialect, samples) in RECORDS {
        for sample in *samples {
            let line = format!("{sample}\n");
            let word = syntax(line.as_bytes()).major_word().into_owned();
            let is_word = word.chars().next().is_some_and(|first| first.is_ascii_alphabetic())
                && word.chars().all(|c| c.is_ascii_alphanumeric() || " -_*".contains(c));
            let parsed = parse(&Source::new("a", line.into_bytes()).unwrap(), Some(*dialect));
            let record = parsed.program.statements()[0].record().clone();
            let Some(scope) = scope_of(RecordKind::from_record(&record)).filter(|_| is_word) else {
                continue;
            };
            // A word that is several kinds of record has the colour of the first.
            if taken.insert(word.clone()) {
                found.entry(scope).or_default().insert(word);
            }
        }
    }
    for word in known_words().iter().map(|word| (*word).to_owned()) {
        if taken.insert(word.clone()) {
            found.entry("support.function.word").or_default().insert(word);
        }
    }
    found
}

/// The minor words that completion knows behind any of the major ones.
fn minor_words(major: &BTreeMap<&str, BTreeSet<String>>) -> BTreeSet<&'static str> {
    let all = major.values().flatten().flat_map(|word| complete_words(&format!("{word}/")));
    all.map(|one| one.word).collect()
}

/// Words as one pattern: long ones first, so that `TOOL PATH` is not `TOOL`.
fn alternatives<'w>(words: impl IntoIterator<Item = &'w str>) -> String {
    let mut words: Vec<&str> = words.into_iter().collect();
    words.sort_by_key(|word| (std::cmp::Reverse(word.len()), *word));
    words.join("|").replace('*', "\\*")
}

fn grammar() -> Value {
    let words = words_by_scope();
    let minor = alternatives(minor_words(&words));
    let mut patterns = vec![
        json!({ "name": "comment.line.cl", "match": "(?i)^\\s*(?:\\$\\$|REMARK\\b|PPRINT\\b).*$" }),
        json!({ "name": "comment.line.cl", "match": "\\$\\$.*$" }),
        json!({ "name": "constant.character.escape.continuation.cl", "match": "\\$\\s*$" }),
        json!({
            "match": "(?i)^\\s*(TOOL PATH)\\s*/([^,]*)",
            "captures": {
                "1": { "name": "keyword.other.structure.cl" },
                "2": { "name": "entity.name.section.cl" },
            },
        }),
    ];
    for (scope, words) in &words {
        let words = alternatives(words.iter().map(String::as_str));
        patterns.push(json!({
            "match": format!("(?i)^\\s*(?:(N?\\d+)\\s+)?({words})(?=\\s*(?:/|\\$|$))"),
            "captures": { "1": { "name": "constant.numeric.sequence.cl" }, "2": { "name": format!("{scope}.cl") } },
        }));
    }
    patterns.extend([
        json!({ "name": "string.quoted.single.cl", "match": "'[^']*'" }),
        json!({ "name": "variable.parameter.minor.cl", "match": format!("(?i)(?<=[/,])\\s*(?:{minor})(?=\\s*(?:,|\\$|$))") }),
        json!({ "name": "constant.numeric.cl", "match": "(?<![A-Za-z0-9_.])[-+]?(?:\\d+\\.?\\d*|\\.\\d+)(?:[eEdD][-+]?\\d+)?(?![A-Za-z0-9_])" }),
    ]);
    json!({
        "name": "CL data",
        "comment": "Made by a test from the records that the reader knows; do not edit (`INSTA_UPDATE=always cargo test colors`).",
        "scopeName": "source.cl",
        "fileTypes": ["cls", "clsf", "aptsource", "apt", "ncl"],
        "patterns": patterns,
    })
}

#[test]
fn the_grammar_is_made_from_the_records() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("editors/vscode/syntaxes/cl.tmLanguage.json");
    let text = serde_json::to_string_pretty(&grammar()).unwrap() + "\n";
    if std::env::var_os("INSTA_UPDATE").is_some_and(|value| value == "always") {
        std::fs::write(&path, &text).unwrap();
    }
    let there = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(there == text, "{} is older than the records; INSTA_UPDATE=always writes it", path.display());
    for word in ["GOTO", "FEDRAT", "TOOL PATH", "COOLNT", "MULTAX"] {
        assert!(text.contains(word), "{word}");
    }
}

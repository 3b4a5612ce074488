//! The SARIF log, key by key.

use super::{PART, at, finding, source};
use clsmith::diagnostic::codes::{BAD_NUMBER, MALFORMED, UNREADABLE};
use clsmith::diagnostic::{Diagnostic, Severity};
use clsmith::report::render::sarif::render_sarif;
use clsmith::source::Span;
use serde_json::{Value, json};

fn rendered(found: &[Diagnostic], file: Option<&str>) -> Value {
    let mut out = Vec::new();
    render_sarif(&mut out, found, file).unwrap();
    // What the crate reads back fits its types.
    serde_json::from_slice::<serde_sarif::sarif::Sarif>(&out).unwrap();
    serde_json::from_slice(&out).unwrap()
}

fn region(bytes: &[u8], span: Span) -> Value {
    let part = source("part.cls", bytes);
    let found = Diagnostic::new(MALFORMED, "m").with_label(&part, span, "");
    rendered(&[found], None)["runs"][0]["results"][0]["locations"][0]["physicalLocation"]["region"].clone()
}

fn uri(name: &str) -> Value {
    let found = finding(MALFORMED, &source(name, "FINI"), "FINI");
    rendered(&[found], None)["runs"][0]["results"][0]["locations"][0]["physicalLocation"]["artifactLocation"]
        ["uri"]
        .clone()
}

#[test]
fn the_whole_log() {
    let part = source("jobs/part 1.cls", PART);
    let recipe = source("recipe.yaml", "version: 1\n");
    let mut denied = Diagnostic::new(BAD_NUMBER, "`0..0000` is not a number")
        .with_label(&part, at(&part, "0..0000"), "two decimal points")
        .with_label(&recipe, Span::new(0, 7), "asked for here")
        .with_help("delete one");
    denied.severity = Severity::Warning;
    let unreadable = Diagnostic::new(UNREADABLE, "gone");
    let start = at(&part, "0..0000").start;
    let rule = |code: clsmith::diagnostic::DiagnosticCode| {
        json!({
            "id": code.id(),
            "shortDescription": { "text": code.meaning() },
            "fullDescription": { "text": code.explanation() },
            "help": { "text": code.help() },
            "defaultConfiguration": { "level": "error" },
        })
    };
    assert_eq!(
        rendered(&[unreadable, denied], Some("jobs/part 1.cls")),
        json!({
            "$schema": "https://json.schemastore.org/sarif-2.1.0.json",
            "version": "2.1.0",
            "runs": [{
                "tool": { "driver": {
                    "name": "clsmith",
                    "version": env!("CARGO_PKG_VERSION"),
                    "semanticVersion": env!("CARGO_PKG_VERSION"),
                    "rules": [rule(BAD_NUMBER), rule(UNREADABLE)],
                } },
                "columnKind": "unicodeCodePoints",
                "results": [
                    {
                        "ruleId": "CL0401",
                        "ruleIndex": 1,
                        "level": "error",
                        "message": { "text": "gone" },
                        "locations": [
                            { "physicalLocation": { "artifactLocation": { "uri": "jobs/part%201.cls" } } }
                        ],
                    },
                    {
                        "ruleId": "CL0003",
                        "ruleIndex": 0,
                        "level": "warning",
                        "message": { "text": "`0..0000` is not a number\nhelp: delete one" },
                        "locations": [{
                            "physicalLocation": {
                                "artifactLocation": { "uri": "jobs/part%201.cls" },
                                "region": {
                                    "startLine": 6, "startColumn": 13, "endLine": 6, "endColumn": 20,
                                    "byteOffset": start, "byteLength": 7,
                                },
                            },
                            "message": { "text": "two decimal points" },
                        }],
                        "relatedLocations": [{
                            "physicalLocation": {
                                "artifactLocation": { "uri": "recipe.yaml" },
                                "region": {
                                    "startLine": 1, "startColumn": 1, "endLine": 1, "endColumn": 8,
                                    "byteOffset": 0, "byteLength": 7,
                                },
                            },
                            "message": { "text": "asked for here" },
                        }],
                    },
                ],
            }],
        })
    );
}

#[test]
fn nothing_found_is_an_empty_run() {
    let log = rendered(&[], None);
    assert_eq!(log["runs"][0]["results"], json!([]));
    assert_eq!(log["runs"][0]["tool"]["driver"]["rules"], json!([]));
}

#[test]
fn columns_count_characters_and_offsets_bytes() {
    let expected = |column: usize, offset: usize| {
        json!({ "startLine": 2, "startColumn": column, "endLine": 2, "endColumn": column + 4,
                "byteOffset": offset, "byteLength": 4 })
    };
    assert_eq!(region("A\nFräser TEXT\n".as_bytes(), Span::new(10, 14)), expected(8, 10));
    assert_eq!(region(b"A\nFr\xe4ser TEXT\n", Span::new(9, 13)), expected(8, 9));
}

#[test]
fn line_ends_and_file_ends() {
    let span = |start, end, last, column| {
        json!({ "startLine": 1, "startColumn": 1, "endLine": last, "endColumn": column,
                "byteOffset": start, "byteLength": end - start })
    };
    assert_eq!(region(b"RAPID\r\nFINI\r\n", Span::new(0, 7)), span(0, 5, 1, 6));
    assert_eq!(region(b"RAPID\r\nFINI\r\n", Span::new(0, 13)), span(0, 11, 2, 5));
    assert_eq!(region(b"", Span::new(0, 0)), span(0, 0, 1, 1));
}

#[test]
fn names_become_uris() {
    assert_eq!(uri("part.cls"), "part.cls");
    assert_eq!(uri("a b/50%/Fräser#1?.cls"), "a%20b/50%25/Fr%C3%A4ser%231%3F.cls");
    assert_eq!(uri("a:b.cls"), "a%3Ab.cls");
    assert_eq!(uri("/jobs/part.cls"), "file:///jobs/part.cls");
    assert_eq!(uri("C:\\jobs\\part.cls"), "file:///C:/jobs/part.cls");
}

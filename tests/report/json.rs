//! The JSON structure, which programs rely on.

use super::{PART, at, finding, source};
use clsmith::diagnostic::codes::{BAD_NUMBER, MALFORMED, UNREADABLE};
use clsmith::diagnostic::{Diagnostic, Severity};
use clsmith::report::render::json::render_json;
use clsmith::source::Span;
use serde_json::{Value, json};

fn rendered(found: &[Diagnostic]) -> Value {
    let mut out = Vec::new();
    render_json(&mut out, found).unwrap();
    assert!(out.ends_with(b"}\n"));
    serde_json::from_slice(&out).unwrap()
}

#[test]
fn the_whole_structure() {
    let part = source("part.cls", PART);
    let recipe = source("recipe.yaml", "version: 1\n");
    let mut warning = Diagnostic::new(UNREADABLE, "gone");
    warning.severity = Severity::Warning;
    warning.help = None;
    let found = Diagnostic::new(BAD_NUMBER, "`0..0000` is not a number")
        .with_label(&part, at(&part, "0..0000"), "two decimal points")
        .with_label(&recipe, Span::new(0, 11), "");
    let start = at(&part, "0..0000").start;
    assert_eq!(
        rendered(&[warning, found]),
        json!({
            "version": 1,
            "diagnostics": [
                { "code": "CL0401", "severity": "warning", "allowed": false, "step": null, "message": "gone", "help": null, "labels": [] },
                {
                    "code": "CL0003",
                    "severity": "error",
                    "allowed": false,
                    "step": null,
                    "message": "`0..0000` is not a number",
                    "help": BAD_NUMBER.help(),
                    "labels": [
                        {
                            "file": "part.cls",
                            "start": { "line": 6, "column": 13, "offset": start },
                            "end": { "line": 6, "column": 20, "offset": start + 7 },
                            "message": "two decimal points",
                            "text": "0..0000",
                        },
                        {
                            "file": "recipe.yaml",
                            "start": { "line": 1, "column": 1, "offset": 0 },
                            "end": { "line": 2, "column": 1, "offset": 11 },
                            "message": "",
                            "text": "version: 1\n",
                        },
                    ],
                },
            ],
            "counts": { "errors": 1, "warnings": 1, "notes": 0, "allowed": 0 },
        })
    );
}

#[test]
fn nothing_found_is_still_a_document() {
    let empty = json!({ "errors": 0, "warnings": 0, "notes": 0, "allowed": 0 });
    assert_eq!(rendered(&[]), json!({ "version": 1, "diagnostics": [], "counts": empty }));
}

#[test]
fn text_in_any_encoding_and_of_any_length() {
    let part = source("part.cls", &b"Fr\xe4ser\0 \xc3\x98"[..]);
    let found = finding(MALFORMED, &part, part.bytes());
    assert_eq!(rendered(&[found])["diagnostics"][0]["labels"][0]["text"], "Fräser\0 Ø");
    let long = source("part.cls", [b'7'; 1001]);
    let found = finding(MALFORMED, &long, long.bytes());
    assert_eq!(rendered(&[found])["diagnostics"][0]["labels"][0]["text"], Value::Null);
}

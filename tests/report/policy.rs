//! `--deny`, `--allow`, `--notes`, and the order of findings.

use super::{PART, at, finding, source};
use clsmith::diagnostic::codes::{BAD_ARGUMENTS, BAD_NUMBER, MALFORMED, NOT_TEXT, UNREADABLE};
use clsmith::diagnostic::{CATALOGUE, Diagnostic, Severity};
use clsmith::report::finding_policy::{FindingPolicy, parse_code, sort_findings};
use clsmith::source::Span;

fn with(severity: Severity, mut found: Diagnostic) -> Diagnostic {
    found.severity = severity;
    found
}

/// An error, a warning and a note, as the policy leaves them.
fn applied(deny: &[&str], allow: &[&str], notes: bool) -> Vec<(&'static str, Severity)> {
    let part = source("part.cls", PART);
    let found = vec![
        with(Severity::Error, finding(MALFORMED, &part, "TOOL PATH")),
        with(Severity::Warning, finding(BAD_ARGUMENTS, &part, "TLDATA")),
        with(Severity::Note, finding(BAD_NUMBER, &part, "RAPID")),
    ];
    let policy = FindingPolicy::from_code_lists(deny.iter().copied(), allow.iter().copied(), notes).unwrap();
    let stands = policy.apply(found).into_iter().filter(|found| !found.is_allowed);
    stands.map(|found| (found.code.id(), found.severity)).collect()
}

#[test]
fn what_stands() {
    use Severity::{Error, Note, Warning};
    assert_eq!(applied(&[], &[], false), [("CL0001", Error), ("CL0002", Warning)]);
    assert_eq!(applied(&[], &[], true), [("CL0001", Error), ("CL0002", Warning), ("CL0003", Note)]);
    assert_eq!(applied(&["CL0002"], &[], false), [("CL0001", Error), ("CL0002", Error)]);
    assert_eq!(applied(&["cl0003"], &[], false), [("CL0001", Error), ("CL0002", Warning), ("CL0003", Error)]);
    assert_eq!(applied(&["warnings"], &[], true), [("CL0001", Error), ("CL0002", Error), ("CL0003", Note)]);
    assert_eq!(applied(&[], &["CL0001"], false), [("CL0002", Warning)]);
    assert_eq!(applied(&["warnings"], &["CL0002"], false), [("CL0001", Error)]);
}

#[test]
fn what_cannot_be_wished() {
    let refused = |deny: &[&str], allow: &[&str]| {
        FindingPolicy::from_code_lists(deny.iter().copied(), allow.iter().copied(), false)
            .unwrap_err()
            .to_string()
    };
    assert_eq!(refused(&["CL0001"], &["CL0001"]), "CL0001 is both denied and allowed");
    assert_eq!(
        refused(&[], &["CL0401"]),
        "CL0401 cannot be allowed: a file that cannot be read ends the run"
    );
    assert_eq!(
        refused(&[], &["CL0410"]),
        "CL0410 cannot be allowed, because it is always reported: the untouched program was handed on"
    );
    assert!(refused(&[], &["warnings"]).starts_with("`warnings` can be denied but not allowed"));
    assert!(refused(&["CL1"], &[]).contains("did you mean CL0001"));
}

#[test]
fn unknown_codes_get_a_proposal() {
    let proposed = |text| parse_code(text).unwrap_err().to_string();
    assert_eq!(
        proposed("CL1"),
        "`CL1` is not a code; did you mean CL0001 (a statement the grammar cannot read)?"
    );
    assert!(proposed("10").contains("CL0010"));
    assert!(proposed("cl-0401").contains("CL0401"));
    assert!(proposed("C0004").contains("CL0004"));
    assert_eq!(proposed("feed"), "`feed` is not a code; codes look like CL0001");
    assert_eq!(proposed(""), "`` is not a code; codes look like CL0001");
    assert_eq!(parse_code(" cl0001 "), Ok(MALFORMED));
}

#[test]
fn every_code_is_found_by_its_id() {
    for code in CATALOGUE.iter().flat_map(|rows| rows.iter()) {
        assert_eq!(parse_code(code.id()), Ok(*code));
    }
}

#[test]
fn sorted_by_file_place_and_code_and_each_once() {
    let (a, b) = (source("a.cls", PART), source("b.cls", PART));
    let note =
        |code, file, text, message: &str| Diagnostic::new(code, message).with_label(file, at(file, text), "");
    let expected = vec![
        Diagnostic::new(UNREADABLE, "gone"),
        note(NOT_TEXT, &a, "TOOL PATH", "one"),
        note(BAD_NUMBER, &a, "RAPID", "one"),
        note(BAD_NUMBER, &a, "RAPID", "two"),
        note(NOT_TEXT, &a, "RAPID", "one"),
        note(MALFORMED, &b, "RAPID", "one"),
        note(MALFORMED, &b, "RAPID", "one").with_label(&a, Span::new(0, 1), "seen from here"),
    ];
    let mut found: Vec<Diagnostic> = expected.iter().rev().chain(&expected).cloned().collect();
    sort_findings(&mut found);
    assert_eq!(format!("{found:?}"), format!("{expected:?}"));
}

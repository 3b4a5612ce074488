//! Every lint: a text it finds something in, the bytes it points at, and the same text put right.

mod corpus;
mod cuts;
mod paths;
mod rechecks;
mod structure;

use crate::support;
use clsmith::check::{LINTS, check_program};
use clsmith::diagnostic::{CATALOGUE, Diagnostic, DiagnosticCode};
use std::collections::BTreeSet;

/// A text with a finding, the bytes under its primary label (empty for findings without a place), and a text without it.
struct Case {
    code: DiagnosticCode,
    bad: String,
    shown: &'static str,
    good: String,
}

fn case(code: DiagnosticCode, bad: impl Into<String>, shown: &'static str, good: impl Into<String>) -> Case {
    Case { code, bad: bad.into(), shown, good: good.into() }
}

/// An NX operation without a finding, with statements put in while the tool is at 0,0,0 with axis z.
fn nx(inside: &str) -> String {
    format!(
        "TOOL PATH/A,TOOL,B\n\
         TLDATA/MILL,10.0000,1.0000,50.0000,0.0000,0.0000\n\
         MSYS/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000\n\
         LOAD/TOOL,1,ADJUST,1\n\
         SPINDL/RPM,1000,CLW\n\
         RAPID\n\
         GOTO/0.0000,0.0000,50.0000,0.0000000,0.0000000,1.0000000\n\
         FEDRAT/MMPM,500.0000\n\
         GOTO/0.0000,0.0000,0.0000\n\
         {inside}\
         PAINT/COLOR,37\n\
         RAPID\n\
         GOTO/0.0000,0.0000,99.0000\n\
         END-OF-PATH\n"
    )
}

/// A CATIA program without a finding, with statements put in while the tool is at 0,0,0.
fn catia(inside: &str) -> String {
    format!(
        "$$     CATIA APT VERSION 1.0\n\
         CUTTER/   10.000000\n\
         TOOLNO/1,   10.000000\n\
         LOADTL/1\n\
         SPINDL/ 1000.0000,RPM,CLW\n\
         RAPID\n\
         GOTO  /    0.00000,    0.00000,   50.00000\n\
         FEDRAT/  500.0000,MMPM\n\
         GOTO  /    0.00000,    0.00000,    0.00000\n\
         {inside}\
         RAPID\n\
         GOTO  /    0.00000,    0.00000,   99.00000\n\
         FINI\n"
    )
}

fn cases() -> Vec<Case> {
    [paths::cases(), cuts::cases(), structure::cases()].into_iter().flatten().collect()
}

fn findings(text: &str) -> Vec<Diagnostic> {
    check_program(&support::program(text))
}

fn codes(found: &[Diagnostic]) -> Vec<&'static str> {
    found.iter().map(|found| found.code.id()).collect()
}

#[test]
fn the_texts_that_cases_start_from_have_no_finding() {
    for text in [nx(""), catia("")] {
        assert_eq!(codes(&findings(&text)), [""; 0], "{text}");
    }
}

#[test]
fn every_lint_finds_its_fault_at_the_right_bytes_and_is_silent_without_it() {
    for Case { code, bad, shown, good } in cases() {
        let found = findings(&bad);
        let Some(one) = found.iter().find(|found| found.code == code) else {
            panic!("{code} not found, but {:?} in\n{bad}", codes(&found));
        };
        let label = one.labels.first().map(|label| label.source.slice(label.span)).unwrap_or_default();
        assert_eq!(String::from_utf8_lossy(label), shown, "{code} in\n{bad}");
        let found = findings(&good);
        assert!(!found.iter().any(|found| found.code == code), "{code} in\n{good}");
    }
}

#[test]
fn a_fault_is_not_reported_under_several_names() {
    for Case { code, bad, .. } in cases() {
        let others: BTreeSet<_> = findings(&bad)
            .into_iter()
            .filter(|found| found.code != code && found.is_error())
            .map(|found| found.code)
            .collect();
        assert!(others.is_empty(), "{code} comes with {others:?} in\n{bad}");
    }
}

#[test]
fn every_code_of_checking_belongs_to_a_lint_and_has_a_case() {
    let listed: BTreeSet<DiagnosticCode> = CATALOGUE
        .iter()
        .flat_map(|rows| rows.iter())
        .copied()
        .filter(|code| code.id().starts_with("CL01"))
        .collect();
    let reported: BTreeSet<DiagnosticCode> = LINTS.iter().flat_map(|lint| lint.codes).copied().collect();
    assert_eq!(listed, reported);
    // Stale records need an edited program; their cases stand beside the code, where programs can be edited.
    let tested: BTreeSet<DiagnosticCode> = cases().iter().map(|case| case.code).collect();
    let untested: Vec<_> = listed.difference(&tested).collect();
    assert!(untested.is_empty(), "without a case: {untested:?}");
}

#[test]
fn every_code_of_checking_explains_itself() {
    for code in LINTS.iter().flat_map(|lint| lint.codes) {
        assert!(!code.help().is_empty() && code.help().ends_with('.'), "{code}");
        assert!(code.explanation().len() > 80, "{code}");
        assert!(!code.meaning().ends_with('.'), "{code}");
    }
}

#[test]
fn findings_come_in_the_order_of_the_file() {
    let found =
        findings(&nx("GOTO/0.0000,0.0000,0.0000\nNONSENSE/1\nGOTO/1.0000,1.0000,1.0000,0.0,0.0,1.05\n"));
    let places: Vec<_> = found.iter().map(|found| found.labels[0].span.start).collect();
    assert_eq!(codes(&found), ["CL0114", "CL0150", "CL0110"]);
    assert!(places.is_sorted(), "{places:?}");
}

#[test]
fn a_file_that_is_no_cl_data_has_one_finding() {
    let source = crate::support::text("d=.5\ncutter/d\ngoto/0,0,0\n");
    let (_, found) = clsmith::check::read_and_check(&source, None);
    assert_eq!(found.iter().map(|found| found.code.id()).collect::<Vec<_>>(), ["CL0010"]);
}

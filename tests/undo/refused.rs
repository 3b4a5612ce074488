//! What undo does not do.

use super::report;
use crate::provenance::{done, with_comments};
use crate::support;
use clsmith::diagnostic::{Diagnostic, DiagnosticCode, Failure, codes};
use clsmith::source::Source;
use clsmith::undo::UndoData;
use std::sync::Arc;

fn part() -> String {
    let points: String = (0..200).map(|x| format!("GOTO/{x}.0000,0.0000,-1.0000\n")).collect();
    format!("UNITS/MM\nFEDRAT/200.0000,MMPM\n{points}")
}

/// The corrected file of a run, and its report.
fn run() -> (Vec<u8>, Arc<Source>) {
    let recipe = with_comments("  - scale_feed: { factor: 0.5 }");
    let program = done(&recipe, &support::text(part())).unwrap().program;
    let report = report(&recipe, &program);
    (program.to_bytes(), report)
}

fn undo(file: &[u8], report: &Arc<Source>) -> Result<Vec<u8>, Failure> {
    let undo = UndoData::read_report(report)?;
    undo.restore_original(&support::text(file), report).map(|undone| undone.bytes)
}

fn refused(file: &[u8], report: &Arc<Source>, code: DiagnosticCode) -> Diagnostic {
    let found = undo(file, report).unwrap_err().into_findings().remove(0);
    assert_eq!(found.code, code, "{found:?}");
    found
}

fn text(bytes: impl AsRef<[u8]>) -> Arc<Source> {
    Source::new("out.json", bytes.as_ref().to_vec()).unwrap()
}

#[test]
fn another_file_is_told_from_where_on_it_differs() {
    let (file, report) = run();
    assert_eq!(undo(&file, &report).unwrap(), part().as_bytes());
    let mut edited = file.clone();
    let at = edited.windows(5).position(|bytes| bytes == b"/150.").unwrap();
    edited[at + 3] = b'1';
    let found = refused(&edited, &report, codes::OTHER_FILE);
    let line = String::from_utf8_lossy(&file[..at]).lines().count();
    let (from, to) = found.message.split_once("between line ").unwrap().1.split_once(" and ").unwrap();
    let (from, to): (usize, usize) = (from.parse().unwrap(), to.parse().unwrap());
    assert!(from <= line && line <= to && to - from < 60, "{line} in {}", found.message);
    let label = &found.labels[0];
    assert_eq!(label.source.line_column(label.span.start).0, from);
    // A line more, and a line less.
    edited = file.clone();
    edited.extend_from_slice(b"FINI\n");
    let found = refused(&edited, &report, codes::OTHER_FILE);
    assert!(
        found.message.ends_with(&format!("and it has {} bytes, not {}", edited.len(), file.len())),
        "{}",
        found.message
    );
    let found = refused(&file[..1024], &report, codes::OTHER_FILE);
    assert_eq!(found.message, format!("the file ends after 1024 bytes; the run wrote {}", file.len()));
    refused(b"", &report, codes::OTHER_FILE);
}

#[test]
fn the_original_and_other_line_ends_are_known() {
    let (file, report) = run();
    let found = refused(part().as_bytes(), &report, codes::OTHER_FILE);
    assert_eq!(found.message, "this is the original already, as it was before the run");
    let crlf = String::from_utf8(file).unwrap().replace('\n', "\r\n");
    let found = refused(crlf.as_bytes(), &report, codes::OTHER_FILE);
    assert!(found.message.ends_with("here they are CRLF"), "{}", found.message);
}

#[test]
fn what_is_no_report_is_said_to_be_none() {
    let (file, report) = run();
    let whole = report.bytes();
    for (bytes, says) in [
        (&whole[..whole.len() / 2], "ends in the middle"),
        (b"".as_slice(), "ends in the middle"),
        (b"<!doctype html><html></html>", "a page for people"),
        (b"# Summary", "no JSON"),
        (b"{\"version\":1}", "not the report of a run"),
        (b"{\"format\":\"clsmith run\"}", "does not state its version"),
        (b"{\"format\":\"clsmith run\",\"version\":1}", "lacks what undo needs: missing field `input`"),
        (b"{\"clsmith_batch\":1,\"version\":\"0.1.0\"}\n{\"file\":\"a.cls\"}\n", "results of a batch"),
        (b"{\"version\":1,\"command\":\"watch\"}\n{\"version\":1}\n", "this is a log"),
        (b"{\"version\":\"0.1.0\"}", "not the report of a run"),
        (b"[]", "lacks what undo needs"),
    ] {
        let found = refused(&file, &text(bytes), codes::NO_RUN_REPORT);
        assert!(found.message.contains(says), "{}", found.message);
    }
    // Every cut is noticed.
    for cut in (0..whole.len() - 1).step_by(17) {
        assert!(UndoData::read_report(&text(&whole[..cut])).is_err(), "{cut}");
    }
    let newer = String::from_utf8_lossy(whole).replacen("\"version\":1", "\"version\":2", 1);
    let found = refused(&file, &text(newer), codes::NEWER_RUN_REPORT);
    assert_eq!(found.message, "the report has version 2; this clsmith reads version 1");
}

#[test]
fn a_report_that_was_changed_gives_nothing() {
    let (file, report) = run();
    let changed = |from: &str, to: &str| {
        let text_of = String::from_utf8_lossy(report.bytes());
        assert!(text_of.contains(from), "{from} in {text_of}");
        text(text_of.replace(from, to))
    };
    for report in [
        changed("FEDRAT/200.0000", "FEDRAT/900.0000"),
        changed("\"undo\":[{\"at\":0,", "\"undo\":[{\"at\":99999999,"),
        changed("\"undo\":[{\"at\":0,", "\"undo\":[{\"at\":18446744073709551615,"),
    ] {
        refused(&file, &report, codes::BAD_UNDO);
    }
}

//! What a person sees: one finding or several, in colours or without.

use super::{PART, at, finding, source};
use crate::support::snapshots;
use clsmith::diagnostic::codes::{BAD_NUMBER, MALFORMED, UNREADABLE};
use clsmith::diagnostic::{Diagnostic, Severity};
use clsmith::report::render::human::{HumanOptions, not_shown, render};
use clsmith::source::Span;

pub fn draw(found: &[Diagnostic], options: &HumanOptions) -> String {
    let mut out = Vec::new();
    render(&mut out, found, Some("part.cls"), options).unwrap();
    String::from_utf8(out).unwrap()
}

#[test]
fn one_finding_in_its_lines() {
    let part = source("part.cls", PART);
    let found = Diagnostic::new(BAD_NUMBER, "`0..0000` is not a number").label(
        &part,
        at(&part, "0..0000"),
        "two decimal points",
    );
    snapshots("report").bind(|| {
        insta::assert_snapshot!("one_finding", draw(std::slice::from_ref(&found), &HumanOptions::default()));
        let ascii = HumanOptions { unicode: false, ..HumanOptions::default() };
        insta::assert_snapshot!("one_finding_ascii", draw(std::slice::from_ref(&found), &ascii));
        let color = HumanOptions { color: true, ..HumanOptions::default() };
        insta::assert_snapshot!("one_finding_color", draw(&[found], &color).replace('\u{1b}', "ESC"));
    });
}

#[test]
fn ascii_without_colors_is_ascii_only() {
    let part = source("part.cls", PART);
    let found = finding(BAD_NUMBER, &part, "0..0000");
    let options = HumanOptions { unicode: false, ..HumanOptions::default() };
    assert!(draw(&[found], &options).is_ascii());
}

#[test]
fn every_file_is_shown_under_its_name() {
    let part = source("part.cls", PART);
    let recipe = source("recipe.yaml", "version: 1\nsteps:\n  - optimize_feed: { max_feed: 700 }\n");
    let found = Diagnostic::new(MALFORMED, "the feed is above the recipe's limit")
        .label(&part, at(&part, "800.0000"), "this feed")
        .label(&recipe, at(&recipe, "700"), "the limit")
        .label(&part, at(&part, "MILL_10"), "of this tool");
    snapshots("report")
        .bind(|| insta::assert_snapshot!("two_files", draw(&[found], &HumanOptions::default())));
}

#[test]
fn neighbouring_labels_share_a_snippet() {
    let part = source("part.cls", PART);
    let found = Diagnostic::new(MALFORMED, "a rapid into material")
        .label(&part, at(&part, "GOTO/0.0000,0.0000,50.0000"), "from here")
        .label(&part, at(&part, "GOTO/0.0000,0..0000"), "to here")
        .label(&part, at(&part, "RAPID"), "");
    snapshots("report")
        .bind(|| insta::assert_snapshot!("shared_snippet", draw(&[found], &HumanOptions::default())));
}

#[test]
fn severities_and_a_finding_without_a_place() {
    let part = source("part.cls", PART);
    let missing = Diagnostic::new(UNREADABLE, "shop.yaml cannot be read: no such file");
    let mut warning = finding(MALFORMED, &part, "RAPID");
    warning.severity = Severity::Warning;
    let mut note = finding(BAD_NUMBER, &part, "FEDRAT").help("nothing to do");
    note.severity = Severity::Note;
    snapshots("report").bind(|| {
        insta::assert_snapshot!("severities", draw(&[missing, warning, note], &HumanOptions::default()));
    });
}

#[test]
fn more_than_the_cap_is_counted_not_shown() {
    let part = source("part.cls", PART);
    let found = vec![finding(MALFORMED, &part, "RAPID"); 7];
    let options = HumanOptions { per_code: 2, ..HumanOptions::default() };
    let capped = draw(&found, &options);
    assert_eq!(capped.matches("error[CL0001]").count(), 2);
    assert!(
        capped.ends_with("5 more of CL0001 not shown (--max-per-code 0 shows all)\npart.cls: 7 errors\n"),
        "{capped}"
    );
    let all = draw(&found, &HumanOptions { per_code: 0, ..options });
    assert_eq!(all.matches("error[CL0001]").count(), 7);
    assert!(!all.contains("not shown"));
    assert_eq!(not_shown(MALFORMED, 2, 2), None);
}

#[test]
fn nothing_found_is_said() {
    assert_eq!(draw(&[], &HumanOptions::default()), "part.cls: no problems found\n");
    let mut out = Vec::new();
    render(&mut out, &[], None, &HumanOptions::default()).unwrap();
    assert_eq!(out, b"clsmith: no problems found\n");
}

#[test]
fn a_long_message_is_wrapped() {
    let found = Diagnostic::new(UNREADABLE, "word ".repeat(60)).help("help ".repeat(60));
    let narrow = HumanOptions { width: 60, ..HumanOptions::default() };
    let drawn = draw(&[found], &narrow);
    assert!(drawn.lines().all(|line| line.chars().count() <= 60), "{drawn}");
}

proptest::proptest! {
    #[test]
    fn no_bytes_and_no_place_make_it_panic(
        bytes: Vec<u8>,
        spans in proptest::collection::vec((0usize..120, 0usize..120), 1..5),
        context in 0usize..4,
        unicode: bool,
    ) {
        let part = source("part.cls", bytes);
        let mut found = Diagnostic::new(MALFORMED, "anything");
        for (start, length) in spans {
            found = found.label(&part, Span::new(start, start + length), "here");
        }
        let drawn = draw(&[found], &HumanOptions { unicode, context_lines: context, ..HumanOptions::default() });
        // Not the one-line form that stands in when miette gives up.
        assert!(drawn.starts_with("error[CL0001]"), "{drawn}");
        assert!(!drawn.contains("Failed to read"), "{drawn}");
        assert!(drawn.chars().all(|c| c == '\n' || !c.is_control()), "{drawn:?}");
    }
}

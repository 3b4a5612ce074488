//! What a person sees: one finding or several, in colours or without.

use super::{PART, at, finding, source};
use crate::support::snapshots;
use clsmith::diagnostic::codes::{BAD_NUMBER, MALFORMED, UNREADABLE};
use clsmith::diagnostic::{Diagnostic, Severity};
use clsmith::report::render::human::{HumanRenderOptions, render_human};
use clsmith::source::Span;

pub fn draw(found: &[Diagnostic], options: &HumanRenderOptions) -> String {
    let mut out = Vec::new();
    render_human(&mut out, found, Some("part.cls"), options).unwrap();
    String::from_utf8(out).unwrap()
}

#[test]
fn one_finding_in_its_lines() {
    let part = source("part.cls", PART);
    let found = Diagnostic::new(BAD_NUMBER, "`0..0000` is not a number").with_label(
        &part,
        at(&part, "0..0000"),
        "two decimal points",
    );
    snapshots("report").bind(|| {
        insta::assert_snapshot!(
            "one_finding",
            draw(std::slice::from_ref(&found), &HumanRenderOptions::default())
        );
        let ascii = HumanRenderOptions::default().with_unicode(false);
        insta::assert_snapshot!("one_finding_ascii", draw(std::slice::from_ref(&found), &ascii));
        let color = HumanRenderOptions::default().with_color(true);
        insta::assert_snapshot!("one_finding_color", draw(&[found], &color).replace('\u{1b}', "ESC"));
    });
}

#[test]
fn ascii_without_colors_is_ascii_only() {
    let part = source("part.cls", PART);
    let found = finding(BAD_NUMBER, &part, "0..0000");
    let options = HumanRenderOptions::default().with_unicode(false);
    assert!(draw(&[found], &options).is_ascii());
}

#[test]
fn every_file_is_shown_under_its_name() {
    let part = source("part.cls", PART);
    let recipe = source("recipe.yaml", "version: 1\nsteps:\n  - optimize_feed: { max_feed: 700 }\n");
    let found = Diagnostic::new(MALFORMED, "the feed is above the recipe's limit")
        .with_label(&part, at(&part, "800.0000"), "this feed")
        .with_label(&recipe, at(&recipe, "700"), "the limit")
        .with_label(&part, at(&part, "MILL_10"), "of this tool");
    snapshots("report")
        .bind(|| insta::assert_snapshot!("two_files", draw(&[found], &HumanRenderOptions::default())));
}

#[test]
fn neighbouring_labels_share_a_snippet() {
    let part = source("part.cls", PART);
    let found = Diagnostic::new(MALFORMED, "a rapid into material")
        .with_label(&part, at(&part, "GOTO/0.0000,0.0000,50.0000"), "from here")
        .with_label(&part, at(&part, "GOTO/0.0000,0..0000"), "to here")
        .with_label(&part, at(&part, "RAPID"), "");
    snapshots("report")
        .bind(|| insta::assert_snapshot!("shared_snippet", draw(&[found], &HumanRenderOptions::default())));
}

#[test]
fn severities_and_a_finding_without_a_place() {
    let part = source("part.cls", PART);
    let missing = Diagnostic::new(UNREADABLE, "shop.yaml cannot be read: no such file");
    let mut warning = finding(MALFORMED, &part, "RAPID");
    warning.severity = Severity::Warning;
    let mut note = finding(BAD_NUMBER, &part, "FEDRAT").with_help("nothing to do");
    note.severity = Severity::Note;
    snapshots("report").bind(|| {
        insta::assert_snapshot!(
            "severities",
            draw(&[missing, warning, note], &HumanRenderOptions::default())
        );
    });
}

#[test]
fn more_than_the_cap_is_counted_not_shown() {
    let part = source("part.cls", PART);
    let found = vec![finding(MALFORMED, &part, "RAPID"); 7];
    let options = HumanRenderOptions::default().with_per_code(2);
    let capped = draw(&found, &options);
    assert_eq!(capped.matches("error[CL0001]").count(), 2);
    assert!(
        capped.ends_with("5 more of CL0001, on line 3 (--max-per-code 0 shows all)\n\npart.cls: 7 errors\n"),
        "{capped}"
    );
    let all = draw(&found, &options.with_per_code(0));
    assert_eq!(all.matches("error[CL0001]").count(), 7);
    assert!(!all.contains("more of"));
    let few = draw(&found[..3], &options.with_per_code(1));
    assert_eq!(few.matches("error[CL0001]").count(), 3, "three are no wall");
}

#[test]
fn nothing_found_is_said() {
    assert_eq!(draw(&[], &HumanRenderOptions::default()), "part.cls: no problems found\n");
    let mut out = Vec::new();
    render_human(&mut out, &[], None, &HumanRenderOptions::default()).unwrap();
    assert_eq!(out, b"clsmith: no problems found\n");
}

#[test]
fn a_long_message_is_wrapped() {
    let found = Diagnostic::new(UNREADABLE, "word ".repeat(60)).with_help("help ".repeat(60));
    let narrow = HumanRenderOptions::default().with_width(60);
    let drawn = draw(&[found], &narrow);
    assert!(drawn.lines().all(|line| line.chars().count() <= 60), "{drawn}");
}

proptest::proptest! {
    #![proptest_config(crate::support::property(256))]

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
            found = found.with_label(&part, Span::new(start, start + length), "here");
        }
        let drawn = draw(&[found], &HumanRenderOptions::default().with_unicode(unicode).with_context_lines(context));
        // Not the one-line form that stands in when miette gives up.
        assert!(drawn.starts_with("error[CL0001]"), "{drawn}");
        assert!(!drawn.contains("Failed to read"), "{drawn}");
        assert!(drawn.chars().all(|c| c == '\n' || !c.is_control()), "{drawn:?}");
    }
}

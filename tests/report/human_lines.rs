//! Which lines an excerpt shows, and that the underline stands below the right characters, whatever the bytes.

use super::human::draw;
use super::{at, source};
use crate::support::snapshots;
use clsmith::diagnostic::Diagnostic;
use clsmith::diagnostic::codes::MALFORMED;
use clsmith::report::render::human::HumanRenderOptions;
use clsmith::source::Span;

/// Draws one label and keeps only the snippet.
fn snippet(bytes: impl Into<Vec<u8>>, span: impl FnOnce(&clsmith::source::Source) -> Span) -> String {
    let part = source("part.cls", bytes);
    let found = Diagnostic::new(MALFORMED, "m").with_label(&part, span(&part), "here");
    let drawn = draw(&[found], &HumanRenderOptions::default());
    let kept = drawn.lines().skip(3).take_while(|line| !line.trim_start().starts_with("help:"));
    kept.map(|line| format!("{line}\n")).collect()
}

/// One text of every length up to twice the terminal's width, labelled at its end: never wider than the terminal.
#[test]
fn lines_are_cut_to_the_terminal() {
    for length in 0..200 {
        let shown = snippet(format!("{}TEXT{}", "7".repeat(length), "7".repeat(200 - length)), text("TEXT"));
        assert!(shown.lines().all(|line| line.chars().count() <= 100), "{shown}");
        assert!(shown.contains("TEXT"), "{shown}");
    }
}

fn of(start: usize, end: usize) -> impl FnOnce(&clsmith::source::Source) -> Span {
    move |_| Span::new(start, end)
}

fn text(text: &'static str) -> impl FnOnce(&clsmith::source::Source) -> Span {
    move |source| at(source, text)
}

#[test]
fn line_ends_do_not_show() {
    let lf = snippet("RAPID\nGOTO/1,2,3\nFINI\n", text("GOTO/1,2,3\n"));
    assert_eq!(lf, snippet("RAPID\r\nGOTO/1,2,3\r\nFINI\r\n", text("GOTO/1,2,3\r\n")));
    assert_eq!(lf, snippet("RAPID\rGOTO/1,2,3\rFINI\r", text("GOTO/1,2,3\r")));
    assert_eq!(lf, snippet("RAPID\r\nGOTO/1,2,3\nFINI", text("GOTO/1,2,3")));
    snapshots("report").bind(|| insta::assert_snapshot!("line_ends", lf));
}

#[test]
fn places_at_the_edges_of_a_file() {
    let all = [
        ("an empty file", snippet("", of(0, 0))),
        ("past the end of an empty file", snippet("", of(7, 9))),
        ("empty, at the start", snippet("FINI\n", of(0, 0))),
        ("empty, at the end of a line", snippet("RAPID\nFINI\n", of(5, 5))),
        ("a line end alone", snippet("RAPID\r\nFINI\r\n", of(5, 7))),
        ("after the last line end", snippet("RAPID\nFINI\n", of(11, 11))),
        ("at the end, no last line end", snippet("RAPID\nFINI", of(10, 10))),
        ("the last line, no line end", snippet("RAPID\nFINI", of(6, 10))),
        ("beyond the end", snippet("RAPID\nFINI", of(8, 99))),
    ];
    let all: String = all.iter().map(|(what, shown)| format!("{what}\n{shown}\n")).collect();
    snapshots("report").bind(|| insta::assert_snapshot!("edges", all));
}

#[test]
fn spans_over_several_lines() {
    let lines: String = (1..=30).map(|n| format!("GOTO/{n}\n")).collect();
    let few = snippet(lines.clone(), |s| Span { start: at(s, "GOTO/9").start, end: at(s, "GOTO/11\n").end });
    let many = snippet(lines, |s| Span { start: at(s, "GOTO/9").start, end: at(s, "GOTO/29\n").end });
    snapshots("report").bind(|| insta::assert_snapshot!("several_lines", format!("{few}\n{many}")));
}

#[test]
fn a_long_line_is_cut_around_the_label() {
    let mut line = vec![b'7'; 1_000_000];
    line[500_000..500_004].copy_from_slice(b"HERE");
    let all = [
        snippet(line.clone(), |_| Span::new(500_000, 500_004)),
        snippet(line.clone(), |_| Span::new(0, 1)),
        snippet(line.clone(), |_| Span::new(1_000_000, 1_000_000)),
        snippet(line, |_| Span::new(10, 900_000)),
        snippet([&b"SHORT\n"[..], &[b'7'; 1000]].concat(), |_| Span::new(0, 5)),
    ];
    assert!(all.iter().all(|shown| shown.len() < 2500), "{all:?}");
    snapshots("report").bind(|| insta::assert_snapshot!("long_lines", all.join("\n")));
}

#[test]
fn a_cut_never_splits_a_character() {
    for shift in 0..4 {
        let line = format!("{}{}HERE{}", "7".repeat(shift), "ø€😀".repeat(80), "ø€😀".repeat(80));
        let shown = snippet(line, text("HERE"));
        assert!(!shown.contains(['\u{fffd}', 'Ã', 'â', 'ð']), "{shown}");
    }
}

#[test]
fn any_encoding_shows_and_the_underline_fits() {
    let all = [
        ("Latin-1", snippet(&b"PPRINT/Fr\xe4ser \xd8 10 mm, TEXT\n"[..], text("TEXT"))),
        ("UTF-8", snippet("PPRINT/Fräser Ø 10 mm, TEXT\n", text("TEXT"))),
        ("a Latin-1 letter", snippet(&b"PPRINT/Fr\xe4ser\n"[..], |_| Span::new(9, 10))),
        ("a UTF-8 letter", snippet("PPRINT/Fräser\n", text("ä"))),
        ("half a UTF-8 letter", snippet("PPRINT/Fräser\n", |_| Span::new(10, 11))),
        ("NUL, ESC, DEL, C1, a reversed line", {
            snippet(&b"GOTO/\0 \x1b[31m \x7f \x9b \xe2\x80\xae TEXT\n"[..], text("TEXT"))
        }),
        ("a tab", snippet("GOTO\t/1,\tTEXT\n", text("TEXT"))),
        ("wide letters", snippet("PPRINT/工具 TEXT\n", text("TEXT"))),
    ];
    let all: String = all.iter().map(|(what, shown)| format!("{what}\n{shown}\n")).collect();
    assert!(!all.contains(['\0', '\u{1b}', '\u{202e}']));
    snapshots("report").bind(|| insta::assert_snapshot!("encodings", all));
}

#[test]
fn control_characters_in_messages_and_names_do_not_reach_the_terminal() {
    let part = source("pa\u{1b}]0;rt\n.cls", "FINI\n");
    let found = Diagnostic::new(MALFORMED, "bad \u{1b}[2J")
        .with_label(&part, Span::new(0, 4), "\u{7}bell")
        .with_help("ring\u{8}");
    let drawn = draw(&[found], &HumanRenderOptions::default());
    assert!(drawn.chars().all(|c| c == '\n' || !c.is_control()), "{drawn:?}");
}

//! One line per finding.

use super::{PART, at, source};
use clsmith::diagnostic::Diagnostic;
use clsmith::diagnostic::codes::{BAD_NUMBER, MALFORMED, UNREADABLE};
use clsmith::report::render::line::render_lines;

fn lines(found: &[Diagnostic], file: Option<&str>) -> String {
    let mut out = Vec::new();
    render_lines(&mut out, found, file).unwrap();
    String::from_utf8(out).unwrap()
}

#[test]
fn place_code_message() {
    let part = source("dir/part.cls", PART);
    let found = [
        Diagnostic::new(BAD_NUMBER, "`0..0000` is not a number").with_label(&part, at(&part, "0..0000"), "x"),
        Diagnostic::new(MALFORMED, "two\r\n  lines\n\nand\ta tab").with_label(&part, at(&part, "RAPID"), ""),
    ];
    assert_eq!(
        lines(&found, None),
        "dir/part.cls:6:13: CL0003: `0..0000` is not a number\n\
         dir/part.cls:3:1: CL0001: two lines and\ta tab\n"
    );
}

#[test]
fn without_a_place() {
    let found = [Diagnostic::new(UNREADABLE, "no such file")];
    assert_eq!(lines(&found, Some("part.cls")), "part.cls: CL0401: no such file\n");
    assert_eq!(lines(&found, None), "clsmith: CL0401: no such file\n");
    assert_eq!(lines(&[], None), "");
}

#[test]
fn a_name_or_message_cannot_forge_a_line() {
    let part = source("a\nb:1:1: CL9999: forged", "FINI");
    let found = [Diagnostic::new(MALFORMED, "\u{1b}[1mbold\n").with_label(&part, at(&part, "FINI"), "")];
    let written = lines(&found, None);
    assert_eq!(written.matches('\n').count(), 1);
    assert!(!written.contains('\u{1b}'));
}

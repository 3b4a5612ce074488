//! The unified diff of a program that carries its changes is a patch that gives its bytes.

use crate::support::{snapshots, text};
use clsmith::parse::parse;
use clsmith::program::{InsertionPoint, Program, StatementId, StepId};
use clsmith::report::unified_diff::{UnifiedDiffOptions, to_bytes};
use clsmith::write::ProgramEditor;
use proptest::prelude::*;

/// Applies a unified diff as `patch` would, without any fuzz: every context line and every count must fit.
pub fn apply(old: &[u8], patch: &[u8]) -> Vec<u8> {
    let lines: Vec<&[u8]> = old.split_inclusive(|b| *b == b'\n').collect();
    let mut patch = patch.split_inclusive(|b| *b == b'\n').peekable();
    let (mut out, mut at) = (Vec::new(), 0);
    if patch.peek().is_none() {
        return old.to_vec();
    }
    assert!(patch.next().unwrap().starts_with(b"--- a/") && patch.next().unwrap().starts_with(b"+++ b/"));
    let mut new_lines = 0;
    while let Some(head) = patch.next() {
        let head = std::str::from_utf8(head).unwrap();
        let parts: Vec<&str> = head.trim_end().split(' ').collect();
        assert_eq!((parts[0], parts[3]), ("@@", "@@"));
        let range = |text: &str| {
            let (start, length) = text[1..].split_once(',').unwrap_or((&text[1..], "1"));
            (start.parse::<usize>().unwrap(), length.parse::<usize>().unwrap())
        };
        let ((start, mut old_left), (new_start, mut new_left)) = (range(parts[1]), range(parts[2]));
        let start = if old_left == 0 { start } else { start - 1 };
        assert!(start >= at, "hunks overlap");
        new_lines += start - at;
        lines[at..start].iter().for_each(|line| out.extend_from_slice(line));
        at = start;
        assert_eq!(new_lines, if new_left == 0 { new_start } else { new_start - 1 });
        while old_left + new_left > 0 {
            let line = patch.next().unwrap();
            let mut text = &line[1..];
            if patch.peek().is_some_and(|next| next.starts_with(b"\\ ")) {
                patch.next();
                text = text.strip_suffix(b"\n").unwrap();
            }
            if line[0] != b'+' {
                assert_eq!(lines[at], text, "the line in the file");
                at += 1;
                old_left -= 1;
            }
            if line[0] != b'-' {
                out.extend_from_slice(text);
                new_lines += 1;
                new_left -= 1;
            }
        }
    }
    lines[at..].iter().for_each(|line| out.extend_from_slice(line));
    out
}

#[derive(Debug, Clone)]
enum Edit {
    Set(usize, String),
    Delete(usize),
    Insert(usize, String),
}

fn edited(source: &[u8], edits: &[Edit]) -> Program {
    let program = parse(&text(source), None).program;
    let ids: Vec<StatementId> = program.statement_ids().collect();
    let places: Vec<InsertionPoint> = ids.iter().map(|id| id.before()).chain([program.end()]).collect();
    let mut editor = ProgramEditor::new(program, StepId(0));
    for edit in edits {
        // What the gate refuses is not changed, which is as good a program as any.
        let named = |at: &usize| ids.get(at.checked_rem(ids.len())?).copied();
        let _ = match edit {
            Edit::Set(at, text) => named(at).map_or(Ok(()), |id| editor.set_text(id, text.as_bytes())),
            Edit::Insert(at, text) => editor.insert(places[at % places.len()], text.as_bytes()),
            Edit::Delete(at) => named(at).map_or(Ok(()), |id| editor.delete_statement(id)),
        };
    }
    editor.finish().unwrap()
}

#[test]
fn changes_in_a_file_with_every_oddity() {
    let source = b"$$ G\xE9n\xE9r\xE9\r\nGOTO/0,0,0\r\nGOTO/1,0,0\r\nGOTO/2,0,0\r\nGOTO/3,0,0\r\nGOTO/4,0,0\r\nGOTO/5,$\r\n 0,0\r\nGOTO/6,0,0\rGOTO/7,0,0\rGOTO/8,0,0\nFINI";
    let edits = [
        Edit::Set(1, "GOTO/0,0,1\r\n".into()),
        Edit::Set(6, "GOTO/5,$\r\n 0,1\r\n".into()),
        Edit::Delete(8),
        Edit::Insert(11, "$$ end".into()),
    ];
    let program = edited(source, &edits);
    let patch = to_bytes(&program, &UnifiedDiffOptions::default().with_context(1));
    assert_eq!(apply(source, &patch), program.to_bytes());
    let display = UnifiedDiffOptions::default().with_context(1).with_display(true).with_color(true);
    let shown = String::from_utf8(to_bytes(&program, &display)).unwrap();
    snapshots("report").bind(|| insta::assert_snapshot!("unified", shown));
}

#[test]
fn nothing_changed_is_an_empty_patch() {
    let program = parse(&text("GOTO/0,0,0\nFINI"), None).program;
    assert!(to_bytes(&program, &UnifiedDiffOptions::default()).is_empty());
}

#[test]
fn everything_deleted_and_something_out_of_nothing() {
    let gone = edited(b"GOTO/0,0,0\nFINI", &[Edit::Delete(0), Edit::Delete(1)]);
    let patch = to_bytes(&gone, &UnifiedDiffOptions::default());
    assert!(patch.ends_with(b"@@ -1,2 +0,0 @@\n-GOTO/0,0,0\n-FINI\n\\ No newline at end of file\n"));
    assert_eq!(apply(b"GOTO/0,0,0\nFINI", &patch), b"");
    let made = edited(b"", &[Edit::Insert(0, "FINI".into())]);
    let patch = to_bytes(&made, &UnifiedDiffOptions::default());
    assert!(patch.ends_with(b"@@ -0,0 +1 @@\n+FINI\n"));
    assert_eq!(apply(b"", &patch), b"FINI\n");
}

fn statement() -> impl Strategy<Value = String> {
    prop_oneof![
        (0..9, 0..9).prop_map(|(x, y)| format!("GOTO/{x},{y},0")),
        (1..9).prop_map(|feed| format!("FEDRAT/{feed}00,$\n MMPM")),
        Just("RAPID".to_owned()),
        Just("$$ comment".to_owned()),
        Just(String::new()),
    ]
}

fn line_end() -> impl Strategy<Value = &'static str> {
    prop_oneof![6 => Just("\n"), 2 => Just("\r\n"), 1 => Just("\r")]
}

proptest! {
    #![proptest_config(crate::support::property(256))]

    #[test]
    fn a_patch_gives_the_program(
        lines in proptest::collection::vec((statement(), line_end()), 0..40),
        closed in any::<bool>(),
        edits in proptest::collection::vec(
            prop_oneof![
                (0..50usize, statement(), line_end()).prop_map(|(at, text, end)| Edit::Set(at, text + end)),
                (0..50usize).prop_map(Edit::Delete),
                (0..50usize, statement()).prop_map(|(at, text)| Edit::Insert(at, text)),
            ],
            0..12,
        ),
        context in 0..5usize,
    ) {
        let mut source: String = lines.iter().flat_map(|(text, end)| [text.as_str(), end]).collect();
        if !closed {
            source.truncate(source.trim_end().len());
        }
        let program = edited(source.as_bytes(), &edits);
        let patch = to_bytes(&program, &UnifiedDiffOptions::default().with_context(context));
        prop_assert_eq!(apply(source.as_bytes(), &patch), program.to_bytes());
    }
}

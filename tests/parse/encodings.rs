//! 8-bit text of any code page is read alike and never changed.

use crate::support::{program, text};
use clsmith::diagnostic::codes;
use clsmith::parse::{parse, syntax};
use clsmith::program::operation::find_operations;
use clsmith::program::{Record, StatementKind};

#[test]
fn latin_1_comments_and_text_are_read() {
    let lines = b"$$     G\xE9n\xE9r\xE9 le jeudi 30 novembre 2023\r\nPARTNO PI\xC8CE N\xB0 4\r\nTPRINT/T1 Fraise \xD810\r\nGOTO  /    1.00000,    2.00000,    3.00000\r\n";
    let program = program(lines);
    assert_eq!(program.to_bytes(), lines);
    assert_eq!(program.statements()[0].record(), &Record::Comment);
    assert!(matches!(program.statements()[3].record(), Record::Goto(_)));
}

#[test]
fn cyrillic_operation_names_are_kept_byte_for_byte() {
    // "Контур" in CP1251: no UTF-8, so the name is shown as Latin-1, every byte a character, and written as it was.
    let lines = b"OPFEATSTART/\xCA\xEE\xED\xF2\xF3\xF0\nRAPID/ \nGOTO/ 1.0,2.0,3.0 \nOPFEATEND/\xCA\xEE\xED\xF2\xF3\xF0\n";
    let program = program(lines);
    let found = find_operations(&program);
    assert_eq!(found.len(), 1);
    assert_eq!(
        found[0].name.chars().map(|c| c as u32).collect::<Vec<_>>(),
        [0xCA, 0xEE, 0xED, 0xF2, 0xF3, 0xF0]
    );
    assert!(found[0].closed);
    assert_eq!(program.to_bytes(), lines);
}

#[test]
fn utf_8_names_are_shown_as_they_are() {
    let program = program("TOOL PATH/Tasche für Ø10,TOOL,Fräser\n");
    assert_eq!(find_operations(&program)[0].name, "Tasche für Ø10");
}

#[test]
fn bytes_above_127_may_stand_in_words_and_fields() {
    let line = syntax(b"\xC4NDERN/\xD810,5.0\n");
    assert_eq!((line.form, line.fields.len()), (StatementKind::Words, 2));
    assert_eq!(line.bytes_at(&line.fields[0].at), b"\xD810");
}

#[test]
fn a_utf_8_mark_in_front_is_kept_and_is_no_statement() {
    let lines = b"\xEF\xBB\xBFPARTNO X\nGOTO/1,2,3\n";
    let program = program(lines);
    assert_eq!(program.statements()[0].record(), &Record::ByteOrderMark);
    assert_eq!(program.statements()[1].record(), &Record::Text);
    assert_eq!(program.to_bytes(), lines);
    // The shortcut for GOTO lines must see the first line behind the mark as well.
    let first = parse(&text(b"\xEF\xBB\xBFGOTO/1,2,3"), None).program;
    assert!(matches!(first.statements()[1].record(), Record::Goto(_)));
}

#[test]
fn utf_16_and_binary_files_are_refused_with_one_diagnostic() {
    let utf16 = |text: &str, big: bool| {
        let mark = std::iter::once(0xFEFF).chain(text.encode_utf16());
        mark.flat_map(|unit| if big { unit.to_be_bytes() } else { unit.to_le_bytes() }).collect::<Vec<u8>>()
    };
    let without_mark = utf16("GOTO/1,2,3\r\n", false)[2..].to_vec();
    let binary = [0u8, 0, 0, 7, 0, 0, 0, 80].repeat(100);
    for bytes in [utf16("GOTO/1,2,3\r\n", false), utf16("GOTO/1,2,3\r\n", true), without_mark, binary] {
        let source = text(&bytes);
        let parsed = parse(&source, None);
        let found: Vec<_> = parsed.diagnostics.iter().map(|found| found.code).collect();
        assert_eq!(found, [codes::NOT_TEXT]);
        assert_eq!(parsed.program.to_bytes(), bytes);
        assert_eq!(parsed.program.motions().count(), 0);
    }
}

#[test]
fn a_nul_byte_breaks_its_statement_only() {
    let source = text("GOTO/1,2,3\nFED\0RAT/100\nGOTO/4,5,6\nPPRINT a\0b\n".repeat(3));
    let parsed = parse(&source, None);
    assert_eq!(parsed.diagnostics.len(), 3, "{:?}", parsed.diagnostics);
    assert_eq!(parsed.program.motions().count(), 6);
    assert_eq!(parsed.program.to_bytes(), source.bytes());
}

//! Text for people: everything to the end of the line, whatever it looks like.

use crate::support::program;
use clsmith::parse::syntax;
use clsmith::program::operation::{operation_name, tool_name};
use clsmith::program::{Record, StatementKind};

#[track_caller]
fn assert_text(line: &str, major: &str, expected: &str) {
    let found = syntax(line.as_bytes());
    assert_eq!(found.form, StatementKind::FreeText, "{line}");
    assert_eq!(found.major_word(), major);
    let text = found.fields.first().map(|field| found.bytes_at(&field.at)).unwrap_or_default();
    assert_eq!(String::from_utf8_lossy(text), expected);
    assert_eq!(Record::read(&found).unwrap(), Record::Text);
}

#[test]
fn free_text_needs_no_slash() {
    assert_text("PARTNO PART TO BE MACHINED\r\n", "PARTNO", "PART TO BE MACHINED");
    assert_text("PPRINT -prva strana", "PPRINT", "-prva strana");
    assert_text("PPRINT OPERATION: obrada cela\n", "PPRINT", "OPERATION: obrada cela");
    assert_text("PARTNO / MFG0031\n", "PARTNO", "MFG0031");
    assert_text("PPRINT\n", "PPRINT", "");
    assert_text("PPRINT -text", "PPRINT", "-text");
}

#[test]
fn a_dollar_and_commas_in_free_text_mean_nothing() {
    // A price list in a PPRINT must not swallow the next statement.
    let program = program("PPRINT cost 12$\nPPRINT/'a', (b, $$ c\nINSERT/T1, D10 $\nRAPID\n");
    assert_eq!(program.statements().len(), 4);
    assert_eq!(program.statements()[3].record(), &Record::Rapid);
}

#[test]
fn solidworks_writes_its_tools_and_stock_as_insert() {
    assert_text(
        "INSERT/[HOLDER=C40-25ERP210] 6MM X 60DEG HSS",
        "INSERT",
        "[HOLDER=C40-25ERP210] 6MM X 60DEG HSS",
    );
    assert_text("INSERT/Stock Size X410. Y190. Z35.", "INSERT", "Stock Size X410. Y190. Z35.");
}

#[test]
fn words_that_only_start_like_free_text_are_words() {
    assert_eq!(syntax(b"INSERTS/5").form, StatementKind::Words);
    assert_eq!(syntax(b"PARTNO1/5").form, StatementKind::Words);
    assert_eq!(syntax(b"TPRINTER/5").form, StatementKind::Words);
}

#[test]
fn remark_is_text_even_when_a_real_word_stands_in_it() {
    assert_text("REMARK MACHID=MACHIN / UNCX05, 1", "REMARK", "MACHID=MACHIN / UNCX05, 1");
    assert_text("REMARK          Pro/CLfile  Version 9.0", "REMARK", "Pro/CLfile  Version 9.0");
}

#[test]
fn tprint_holds_names_with_commas_and_may_go_on() {
    assert_text("TPRINT/T1 Tap D 10", "TPRINT", "T1 Tap D 10");
    let line = syntax(b"TPRINT/SVJBL 2020 K16,$\n SDJCL 1210 (D07),'x\n");
    let names: Vec<_> = line.fields.iter().map(|field| line.bytes_at(&field.at)).collect();
    assert_eq!(names, [&b"SVJBL 2020 K16"[..], b"SDJCL 1210 (D07)", b"'x"]);
}

#[test]
fn nx_names_operations_and_tools_freely() {
    let program = program(
        "TOOL PATH/R390-25A25L 17' (rough)$,TOOL,D10 R1, long\nEND-OF-PATH\nTOOL PATH/EXTERNAL_TRIM\n",
    );
    let names = |index: usize| {
        let statement = &program.statements()[index];
        (operation_name(&program, statement).unwrap(), tool_name(&program, statement))
    };
    assert_eq!(names(0), ("R390-25A25L 17' (rough)$".to_owned(), Some("D10 R1, long".to_owned())));
    assert_eq!(names(2), ("EXTERNAL_TRIM".to_owned(), None));
}

#[test]
fn quotes_hold_commas_and_slashes() {
    let line = syntax(b"PPLOG/'a, b / c (d',5\n");
    let fields: Vec<_> = line.fields.iter().map(|field| line.bytes_at(&field.at)).collect();
    assert_eq!(fields, [&b"'a, b / c (d'"[..], b"5"]);
}

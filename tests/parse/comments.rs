//! What is a comment and what only looks like one.

use crate::support::{program, text};
use clsmith::parse::{parse, syntax};
use clsmith::program::{FieldKind, Record, StatementKind};

#[test]
fn two_dollars_in_quotes_are_no_comment() {
    // CATIA through an ICAM table writes this; a reader that cuts at `$$` loses the second field and the quote.
    let line = syntax(b"SYN/'TLAXIS','$$*TLAXIS'\n");
    let fields: Vec<_> = line.fields.iter().map(|field| (line.bytes_at(&field.at), &field.kind)).collect();
    let quoted = &FieldKind::Quoted;
    assert_eq!(fields, [(&b"'TLAXIS'"[..], quoted), (&b"'$$*TLAXIS'"[..], quoted)]);
    assert!(line.remark.is_none());
}

#[test]
fn a_remark_after_a_statement_is_not_part_of_it() {
    let line = syntax(b"FEDRAT/300.0,MMPM   $$ plunge, slowly\n");
    assert_eq!(line.fields.len(), 2);
    assert_eq!(line.bytes_at(line.remark.as_ref().unwrap()), b"$$ plunge, slowly");
    let program = program("GOTO/1,2,3$$ no blank before it\nRAPID $$ and after a bare word\n");
    assert!(matches!(program.statements()[0].record(), Record::Goto(_)));
    assert_eq!(program.statements()[1].record(), &Record::Rapid);
}

#[test]
fn a_comment_takes_its_line_and_no_more() {
    // The `$` at its end continues nothing: only `$$->` records continue.
    let program = program("$$ tool change, see sheet 4 $\nRAPID\nGOTO/1,2,3\n");
    let records: Vec<_> = program.statements().iter().map(|statement| statement.record().clone()).collect();
    assert_eq!(records[..2], [Record::Comment, Record::Rapid]);
    assert!(matches!(records[2], Record::Goto(_)));
}

#[test]
fn a_commented_goto_does_not_move_the_tool() {
    for comment in ["$$ GOTO/1,2,3", "$$GOTO/1,2,3", "  $$ GOTO/1,2,3", "$$$ GOTO/1,2,3", "$$*TLAXIS/0,0,1"] {
        assert_eq!(program(comment).statements()[0].record(), &Record::Comment, "{comment}");
    }
}

#[test]
fn blank_lines_stand_for_nothing() {
    let program = program("\n   \n\t\nFINI\n\n");
    let forms: Vec<_> =
        program.statements().iter().map(|statement| syntax(program.statement_text(statement)).form).collect();
    assert_eq!(
        forms,
        [
            StatementKind::Blank,
            StatementKind::Blank,
            StatementKind::Blank,
            StatementKind::Words,
            StatementKind::Blank
        ]
    );
}

#[test]
fn catia_keeps_its_matrix_in_comments_and_only_four_numbers_are_a_row() {
    let rows = "$$*CATIA0\n$$ Program.1\n$$     1.00000     0.00000    -0.50000  -220.00000\n$$ 1 2 3\n$$ 1 2 3 4 mm\n";
    let program = program(rows);
    let records: Vec<_> = program.statements().iter().map(|statement| statement.record().clone()).collect();
    let row = Record::MatrixRow(Box::new([1.0, 0.0, -0.5, -220.0]));
    assert_eq!(records, [Record::FrameMark, Record::Comment, row, Record::Comment, Record::Comment]);
}

#[test]
fn comments_are_never_diagnosed() {
    let odd = "$$\n$$ ' ( unclosed\n$$-> \n$$->\n$$-> ???\n$$*\n$$ 1 2 3 1e999\n";
    assert!(parse(&text(odd), None).diagnostics.is_empty());
}

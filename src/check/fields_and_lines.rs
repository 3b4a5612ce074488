//! This module checks text that is readable here, but perhaps not for the post.

use super::{Lint, LintFindings};
use crate::diagnostic::{DiagnosticCode, codes};
use crate::parse::columns::{inspect_line, lines_with_starts};
use crate::program::{Dialect, FieldKind, Record, Statement, StatementField, StatementId};
use crate::source::Span;

pub(super) const LINE_CODES: &[DiagnosticCode] =
    &[codes::LONG_LINE, codes::MIXED_LINE_ENDS, codes::NO_LAST_LINE_END, codes::BYTE_ORDER_MARK];

/// Reports missing commas and unusual numbers.
#[derive(Default)]
pub(super) struct FieldLint {
    /// Whether CAMWorks' missing commas were reported: it leaves one out in every cycle.
    commas_reported: bool,
}

impl Lint for FieldLint {
    fn check_statement(&mut self, id: StatementId, statement: &Statement, found: &mut LintFindings<'_>) {
        match statement.record() {
            Record::ByteOrderMark
            | Record::Blank
            | Record::Comment
            | Record::FrameMark
            | Record::MatrixRow(_)
            | Record::Rapid
            | Record::OperationStart(_)
            | Record::Text
            | Record::Marked(_)
            | Record::Definition
            | Record::Unparsed => return,
            _ => {}
        }
        let text = found.program.statement_text(statement);
        if !is_suspect(text) {
            return;
        }
        let syntax = found.statement_syntax(id);
        for pair in syntax.fields.windows(2) {
            let [one, two] = pair else { continue };
            let between = syntax.text.get(one.at.end..two.at.start).unwrap_or_default();
            if !between.is_empty()
                && !self.commas_reported
                && between.iter().all(|byte| matches!(byte, b' ' | b'\t'))
            {
                let span = found.text_span(id, &(one.at.start..two.at.end));
                found.report(codes::MISSING_COMMA, span, "a comma is missing between these two fields", "");
                self.commas_reported = found.program.dialect() == Dialect::CamWorks;
            }
        }
        for StatementField { at, kind } in &syntax.fields {
            let unusual = |byte: &u8| byte.is_ascii_alphabetic() || *byte == b'+';
            if matches!(kind, FieldKind::Number(_)) && syntax.bytes_at(at).iter().any(unusual) {
                let span = found.text_span(id, at);
                found.report(
                    codes::UNUSUAL_NUMBER,
                    span,
                    "not every post reads a number written like this",
                    "",
                );
            }
        }
    }
}

/// Returns whether a statement may contain a missing comma or an unusual number. A single pass over its bytes
/// saves running the grammar over every statement again. The answer may be yes for a correct statement, but
/// never no for a faulty one.
fn is_suspect(text: &[u8]) -> bool {
    let Some(slash) = memchr::memchr(b'/', text) else { return false };
    let fields = text.get(slash + 1..).unwrap_or_default();
    // Plain decimals and commas are most of every file.
    let plain = |byte: &u8| byte.wrapping_sub(b',') <= b'9' - b',' || matches!(byte, b'\n' | b'\r');
    if fields.iter().all(plain) {
        return false;
    }
    let (mut before, mut ink, mut blank) = (b'/', b'/', false);
    for &byte in fields {
        match byte {
            b' ' | b'\t' => blank = true,
            b'+' => return true,
            b'E' | b'e' | b'D' | b'd' if before.is_ascii_digit() || before == b'.' => return true,
            // The rest of the line is a comment.
            b'$' => (ink, blank) = (b',', false),
            b'\r' | b'\n' => blank = false,
            _ => {
                if blank && !matches!(ink, b',' | b'/' | b'(') && !matches!(byte, b',' | b')') {
                    return true;
                }
                (ink, blank) = (byte, false);
            }
        }
        before = byte;
    }
    false
}

/// The number of columns that processors of CATIA and Creo files read.
const COLUMNS: usize = 72;

/// Checks the length of lines, and how they end.
#[derive(Default)]
pub(super) struct LineLint {
    /// The first kind of line end: with CR or without.
    first: Option<bool>,
    mixed: bool,
    last: Option<StatementId>,
}

impl Lint for LineLint {
    fn check_statement(&mut self, id: StatementId, statement: &Statement, found: &mut LintFindings<'_>) {
        let text = found.program.statement_text(statement);
        match statement.record() {
            Record::ByteOrderMark => {
                found.report(
                    codes::BYTE_ORDER_MARK,
                    statement.origin(),
                    "the file starts with a byte order mark",
                    "",
                );
                return;
            }
            Record::Blank | Record::Comment | Record::Text | Record::MatrixRow(_) | Record::Unparsed => {}
            _ if text.len() > COLUMNS && has_column_limit(found.program.dialect()) => {
                report_long_lines(id, text, found)
            }
            _ => {}
        }
        self.last = Some(id);
        if self.mixed {
            return;
        }
        let crlf = match text {
            [.., b'\r', b'\n'] => true,
            [.., b'\n'] => false,
            _ => return,
        };
        if *self.first.get_or_insert(crlf) != crlf {
            self.mixed = true;
            let (this, before) = if crlf { ("CRLF", "LF") } else { ("LF", "CRLF") };
            let message = format!("this line ends in {this}, the lines before in {before}");
            found.report(codes::MIXED_LINE_ENDS, found.statement_span(id), message, "");
        }
    }

    fn finish(&mut self, found: &mut LintFindings<'_>) {
        let Some(last) = self.last else { return };
        let text = found.statement_text(last);
        if !text.trim_ascii().is_empty() && !text.ends_with(b"\n") && !text.ends_with(b"\r") {
            found.report(
                codes::NO_LAST_LINE_END,
                found.statement_span(last),
                "the last line has no line end",
                "",
            );
        }
    }
}

fn has_column_limit(dialect: Dialect) -> bool {
    matches!(dialect, Dialect::Catia | Dialect::CatiaIcam | Dialect::Creo | Dialect::CreoGpost)
}

fn report_long_lines(id: StatementId, text: &[u8], found: &mut LintFindings<'_>) {
    for (start, line) in lines_with_starts(text) {
        let length = line.trim_ascii_end().len();
        // Processors know the identification and do not read it.
        if length > COLUMNS && inspect_line(line).identification.is_none() {
            let span: Span = found.text_span(id, &(start + COLUMNS..start + length));
            let message = format!("this line has {length} columns");
            found.report(codes::LONG_LINE, span, message, "beyond column 72");
        }
    }
}

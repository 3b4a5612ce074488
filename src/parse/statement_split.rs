//! This module splits off one statement after the other, by a shortcut or by the grammar.
//!
//! What a statement is depends on its own lines alone: neither the lines behind it nor the way in which it is read
//! decide whether it is too long.

use super::columns::{find_line_end, lines_with_starts};
use super::grammar::{bare_syntax, parse_statement};
use super::plain_statement;
use super::statement_limit::{find_readable_end, is_readable_length};
use crate::program::{StatementField, StatementKind, StatementSyntax};

/// Splits off the statement at the start of `rest`, with as many lines as it continues over. Returns its
/// syntax and its length in bytes. The fields may take the memory of `spare`, which is empty.
pub(super) fn split_statement<'t>(
    rest: &'t [u8],
    spare: &mut Vec<StatementField>,
) -> (StatementSyntax<'t>, usize) {
    if let Some(syntax) = plain_statement::read_plain_statement(rest, spare) {
        let length = syntax.text.len();
        return (syntax, length);
    }
    split_by_grammar(rest)
}

/// Splits off the statement at the start of `rest` by the grammar alone.
pub(super) fn split_by_grammar(rest: &[u8]) -> (StatementSyntax<'_>, usize) {
    let mut lines = 1;
    let mut window = find_lines_end(rest, 0, lines);
    while let Some(lines_read) = rest.get(..window).filter(|text| is_readable_length(text)) {
        let syntax = parse_statement(lines_read);
        if !syntax.open || window == rest.len() {
            let length = syntax.text.len();
            return (syntax, length.max(1));
        }
        // Doubling the window keeps the time for a statement of very many lines linear.
        window = find_lines_end(rest, window, lines);
        lines *= 2;
    }
    split_long_statement(rest)
}

/// Splits off a statement whose window became too long: it is read if it ends in the lines of the longest window, and
/// else refused with all its lines.
fn split_long_statement(rest: &[u8]) -> (StatementSyntax<'_>, usize) {
    let window = find_readable_end(rest);
    if window > 0 {
        let syntax = parse_statement(rest.get(..window).unwrap_or(rest));
        if !syntax.open {
            let length = syntax.text.len();
            return (syntax, length);
        }
    }
    let length = measure_refused(rest);
    (bare_syntax(rest.get(..length).unwrap_or(rest), StatementKind::Refused), length)
}

/// Returns the length of a statement that is not read: up to the end of its last continued line, as the rule `refused`
/// of the grammar takes it.
fn measure_refused(rest: &[u8]) -> usize {
    // What follows the first `$` of a line is a comment; a second one behind it says that the statement ends there.
    let goes_on = |line: &[u8]| memchr::memchr(b'$', line).is_some_and(|at| line.get(at + 1) != Some(&b'$'));
    let mut lines = lines_with_starts(rest);
    let last = lines.find(|(_, line)| !goes_on(line));
    last.map_or(rest.len(), |(start, line)| start + line.len())
}

/// Returns the end of the `count`-th line after `from`. LF, CRLF and a lone CR end a line.
fn find_lines_end(bytes: &[u8], from: usize, count: usize) -> usize {
    let mut end = from;
    for _ in 0..count {
        let Some(next) = find_line_end(bytes, end) else { break };
        end = next;
    }
    end
}

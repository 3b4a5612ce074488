//! This module converts pest's pairs to our own [`StatementSyntax`]. It is the only module that knows pest.
//!
//! pest reads `str`, so it is given the text with some bytes masked (see [`super::columns`]). Offsets stay the
//! same, and every code page is read alike.

use super::columns::mask_for_grammar;
use super::statement_limit::is_readable_length;
use crate::number;
use crate::program::{FieldGroup, FieldKind, StatementField, StatementKind, StatementSyntax, join_broken};
use pest::Parser;
use pest::iterators::Pair;

/// The grammar of CL text, of which `grammar/cl.pest` is the only description.
#[derive(pest_derive::Parser)]
#[grammar = "grammar/cl.pest"]
struct ClGrammar;

/// Reads the statement at the start of `window`; the text of the result shows how many bytes it takes.
///
/// `window` holds whole lines that are short enough for one statement ([`is_readable_length`]). `StatementSyntax::open` says that the statement continues
/// past the end of the window; then the caller gives a longer window, unless the file ends there. This never fails:
/// text that fits no form of the grammar gets [`StatementKind::Refused`].
pub(super) fn parse_statement(window: &[u8]) -> StatementSyntax<'_> {
    debug_assert!(is_readable_length(window), "a window of {} bytes uses up the memory", window.len());
    let readable = mask_for_grammar(window);
    let Some(statement) =
        ClGrammar::parse(Rule::statement, &readable).ok().and_then(|mut pairs| pairs.next())
    else {
        // The rule `refused` takes any text, so this is only reached if pest itself gives up (its call limit,
        // which is not set here).
        return bare_syntax(window, StatementKind::Refused);
    };
    let Some(form) = statement.into_inner().next() else {
        return bare_syntax(window, StatementKind::Refused);
    };
    // The statement's text ends where the form ends; the rest of the window belongs to the next statements.
    let text = window.get(..form.as_span().end()).unwrap_or(window);
    let mut syntax = bare_syntax(text, statement_kind(form.as_rule()));
    syntax.open = form.clone().into_inner().flatten().any(|part| part.as_rule() == Rule::open);
    for part in form.into_inner() {
        add_part(part, &mut syntax);
    }
    syntax
}

/// Returns the offset at which a refused line is no longer readable: the furthest byte that the strict forms
/// reached.
pub(super) fn find_refusal_offset(text: &[u8]) -> usize {
    if !is_readable_length(text) {
        return 0;
    }
    match ClGrammar::parse(Rule::words, &mask_for_grammar(text)) {
        Ok(_) => 0,
        Err(error) => match error.location {
            pest::error::InputLocation::Pos(at) => at,
            pest::error::InputLocation::Span((at, _)) => at,
        },
    }
}

/// Makes a syntax without fields.
pub(super) fn bare_syntax(text: &[u8], form: StatementKind) -> StatementSyntax<'_> {
    StatementSyntax { text, form, word: 0..0, fields: Vec::new(), remark: None, open: false }
}

/// Returns the kind of statement that a rule of the grammar stands for.
fn statement_kind(rule: Rule) -> StatementKind {
    match rule {
        Rule::blank_line => StatementKind::Blank,
        Rule::structured => StatementKind::Structured,
        Rule::frame_mark => StatementKind::FrameMark,
        Rule::matrix_row => StatementKind::MatrixRow,
        Rule::comment => StatementKind::Comment,
        Rule::operation_start => StatementKind::OperationStart,
        Rule::free_text | Rule::listed_text | Rule::inert_text => StatementKind::FreeText,
        Rule::numbers => StatementKind::Numbers,
        Rule::definition => StatementKind::Definition,
        Rule::words => StatementKind::Words,
        _ => StatementKind::Refused,
    }
}

/// Adds a part of a statement: its word, its remark or a field.
fn add_part(part: Pair<'_, Rule>, syntax: &mut StatementSyntax<'_>) {
    let at = part.as_span().start()..part.as_span().end();
    match part.as_rule() {
        Rule::head | Rule::free_word | Rule::listed_word | Rule::inert_word | Rule::operation_word => {
            syntax.word = at;
        }
        Rule::remark => syntax.remark = Some(at),
        _ => syntax.fields.extend(parse_field(part)),
    }
}

/// Reads a field; returns `None` for pairs that are not fields.
fn parse_field(part: Pair<'_, Rule>) -> Option<StatementField> {
    let at = part.as_span().start()..part.as_span().end();
    let kind = match part.as_rule() {
        Rule::empty => FieldKind::Empty,
        Rule::number => number::parse_number(&join_broken(part.as_str().as_bytes()))
            .map_or(FieldKind::Text, FieldKind::Number),
        Rule::quoted => FieldKind::Quoted,
        Rule::text
        | Rule::bracketed
        | Rule::inner_text
        | Rule::text_line
        | Rule::listed
        | Rule::operation_name
        | Rule::plain_name
        | Rule::tool_name => FieldKind::Text,
        Rule::group | Rule::group_2 | Rule::group_3 => FieldKind::Group(Box::new(parse_group(part))),
        _ => return None,
    };
    Some(StatementField { at, kind })
}

/// Reads a nested record with its word and fields.
fn parse_group(part: Pair<'_, Rule>) -> FieldGroup {
    let mut group = FieldGroup { word: 0..0, fields: Vec::new() };
    for inner in part.into_inner() {
        if inner.as_rule() == Rule::head {
            group.word = inner.as_span().start()..inner.as_span().end();
        } else if let Some(field) = parse_field(inner) {
            group.fields.push(field);
        }
    }
    group
}

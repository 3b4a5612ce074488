//! This module refuses files before any value is read: bytes that are no text, text that is no YAML, and
//! features of YAML that are not supported.

use super::node_location;
use super::yaml_tree::{YamlNode, YamlRefusal, YamlTreeBuilder};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::source::{Source, Span};
use serde::de::DeserializeSeed;
use std::sync::Arc;

/// The largest file that is read. A recipe of this size would have about 20 000 steps.
pub(super) const LARGEST_FILE_BYTES: usize = 1 << 20;

/// Checks that the bytes are text. Returns the text after the byte order mark, and the length of that mark,
/// because serde_yaml does not count it.
pub(super) fn check_text(source: &Arc<Source>) -> Result<(&str, usize), Failure> {
    let bytes = source.bytes();
    if bytes.len() > LARGEST_FILE_BYTES {
        let message =
            format!("the file has {} bytes, but recipes and setup files must be below 1 MiB", bytes.len());
        return Err(Diagnostic::new(codes::YAML_TOO_LARGE, message)
            .with_label(source, Span::new(0, 0), "")
            .into());
    }
    let text = std::str::from_utf8(bytes).map_err(|error| {
        let start = error.valid_up_to();
        let span = Span::new(start, start + error.error_len().unwrap_or(bytes.len() - start));
        Diagnostic::new(codes::YAML_NOT_TEXT, "the file is not UTF-8 text").with_label(
            source,
            span,
            "this byte is not UTF-8",
        )
    })?;
    let (text, base) = match text.strip_prefix('\u{feff}') {
        Some(rest) => (rest, text.len() - rest.len()),
        None => (text, 0),
    };
    if let Some((at, c)) = text.char_indices().find(|&(_, c)| !is_printable(c)) {
        let span = Span::new(base + at, base + at + c.len_utf8());
        let message = format!("a control character (U+{:04X}) in the text", c as u32);
        return Err(Diagnostic::new(codes::YAML_NOT_TEXT, message).with_label(source, span, "here").into());
    }
    if let Some(at) = find_excess_bracket(text) {
        return Err(report_too_deep(source, Span::new(base + at, base + at + 1)).into());
    }
    Ok((text, base))
}

/// Returns the first bracket that exceeds the allowed nesting.
///
/// The time of libyaml grows with the number of open brackets times the length of the text, long before
/// serde_yaml counts its 128 levels. Brackets in quotes are counted, too, but a text with a thousand brackets
/// that never close is no recipe either.
fn find_excess_bracket(text: &str) -> Option<usize> {
    const MOST: usize = 1000;
    let mut open = 0_usize;
    text.bytes().position(|byte| {
        match byte {
            b'[' | b'{' => open += 1,
            b']' | b'}' => open = open.saturating_sub(1),
            _ => {}
        }
        open > MOST
    })
}

fn report_too_deep(source: &Arc<Source>, here: Span) -> Diagnostic {
    Diagnostic::new(codes::YAML_TOO_LARGE, "lists and maps are nested more than 128 deep").with_label(
        source,
        here,
        "too deep from here on",
    )
}

/// Returns whether YAML 1.2 calls a character printable.
fn is_printable(c: char) -> bool {
    matches!(c, '\t' | '\n' | '\r' | ' '..='~' | '\u{85}' | '\u{a0}'..='\u{fffd}' | '\u{10000}'..)
        && c != '\u{feff}'
}

/// Reads the only document of a file.
pub(super) fn parse_tree(source: &Arc<Source>, text: &str, base: usize) -> Result<YamlNode, Failure> {
    let builder = YamlTreeBuilder::new();
    let mut documents = serde_yaml::Deserializer::from_str(text);
    let Some(first) = documents.next() else {
        return Err(report_empty_file(source).into());
    };
    let root = builder.deserialize(first).map_err(|error| {
        let at = error.location().map_or(0, |location| location.index().min(text.len()));
        explain_refusal(source, text, base, at, &error, builder.refusal())
    })?;
    if documents.next().is_some() {
        return Err(report_second_document(source, text, base).into());
    }
    match root {
        YamlNode::Null => Err(report_empty_file(source).into()),
        root => Ok(root),
    }
}

fn report_empty_file(source: &Arc<Source>) -> Diagnostic {
    Diagnostic::new(codes::YAML_EMPTY, "the file is empty").with_label(source, Span::new(0, 0), "")
}

fn report_second_document(source: &Arc<Source>, text: &str, base: usize) -> Diagnostic {
    let at = node_location::find_second_document(text).unwrap_or(text.len());
    let before = text.get(..at).unwrap_or_default();
    let start = before.rfind("---").unwrap_or(at);
    Diagnostic::new(codes::YAML_SEVERAL_DOCUMENTS, "a second document starts in the file").with_label(
        source,
        Span::new(base + start, base + (start + 3).min(text.len())),
        "the second document starts here",
    )
}

fn explain_refusal(
    source: &Arc<Source>,
    text: &str,
    base: usize,
    at: usize,
    error: &serde_yaml::Error,
    refusal: Option<YamlRefusal>,
) -> Diagnostic {
    let words = error.to_string();
    let here = character_span(text, base, at);
    match refusal {
        _ if words.starts_with("recursion limit") => report_too_deep(source, here),
        _ if words.contains("repetition limit") => report_alias_bomb(source, here),
        Some(YamlRefusal::Bomb) => report_alias_bomb(source, here),
        Some(YamlRefusal::Tag) => {
            let token = text.get(at..).unwrap_or_default();
            let from = token.find('!').unwrap_or(0);
            let rest = token.get(from..).unwrap_or_default();
            let length = rest.find(char::is_whitespace).unwrap_or(rest.len());
            let span = Span::new(base + at + from, base + at + from + length);
            Diagnostic::new(codes::YAML_FEATURE, "a YAML tag (`!name`)")
                .with_label(source, span, "not used here")
                .with_help("Remove the tag; a step is written as `- name: { … }`, without `!`.")
        }
        Some(YamlRefusal::Key) => Diagnostic::new(codes::YAML_FEATURE, "a list or a map where a key belongs")
            .with_label(source, shift_span(node_location::find_node_span(text, at, None), base), "not a word")
            .with_help("Keys are single words. Text with `{` or `[` in front needs quotes."),
        None => explain_syntax_error(source, text, base, at, &words),
    }
}

fn report_alias_bomb(source: &Arc<Source>, here: Span) -> Diagnostic {
    Diagnostic::new(
        codes::YAML_TOO_LARGE,
        "aliases (`*name`) repeat so much that the file would become too large",
    )
    .with_label(source, here, "while repeating this")
}

/// The messages of libyaml with what they usually mean. The first fragment that occurs in a message decides.
const HINTS: &[(&str, &str, &str)] = &[
    (
        "unknown anchor",
        "an alias (`*name`) whose anchor (`&name`) does not stand before it",
        "If the text itself starts with `*`, as a name pattern does, put it in quotes: `\"*ROUGH\"`.",
    ),
    (
        "did not find expected alphabetic or numeric character",
        "a `*` or `&` without a name behind it",
        "A name pattern that starts with `*` needs quotes: `\"*ROUGH\"`.",
    ),
    (
        "found character that cannot start any token",
        "a character that cannot start a value",
        "Text that starts with `@`, `` ` `` or `%` needs quotes; indent with spaces, never with tabs.",
    ),
    (
        "found a tab character",
        "a tab in the indentation",
        "YAML indents with spaces only; set the editor to insert spaces.",
    ),
    (
        "mapping values are not allowed",
        "a `:` that cannot belong to a key here",
        "The line is most likely indented wrongly, or text with `: ` in it needs quotes.",
    ),
    (
        "could not find expected ':'",
        "a line without the `:` that its neighbours have",
        "Write `key: value`, with a blank after the colon.",
    ),
    ("found unexpected end of stream", "the file ends inside a quoted text", "Close the quote."),
    (
        "did not find expected ',' or",
        "a bracket is not closed, or a comma is missing",
        "Write `{ a: 1, b: 2 }` and `[1, 2]`. Close every bracket that you open.",
    ),
    (
        "did not find expected key",
        "the line does not match the lines above it",
        "Compare its indentation with that of the lines to which it belongs.",
    ),
    (
        "did not find expected '-' indicator",
        "the line does not continue the list above it",
        "Elements start with `- ` in one column; what belongs to an element is indented deeper than its `-`.",
    ),
    (
        "block sequence entries are not allowed",
        "a list cannot start here",
        "Start the list in the next line, or write it in brackets: `[a, b]`.",
    ),
    (
        "unknown escape character",
        "an unknown escape in a quoted text",
        "In double quotes, write `\\\\` for one backslash. Within single quotes, it needs no escape.",
    ),
];

/// The hints whose cause is an open quote or bracket.
const UNCLOSED: &[&str] = &["found unexpected end of stream", "did not find expected ',' or"];

fn explain_syntax_error(source: &Arc<Source>, text: &str, base: usize, at: usize, words: &str) -> Diagnostic {
    let here = character_span(text, base, at);
    let line_start = text.get(..at).unwrap_or_default().rfind('\n').map_or(0, |newline| newline + 1);
    let line = text.get(line_start..).unwrap_or_default();
    let indent = line.len() - line.trim_start_matches([' ', '\t']).len();
    let tab = line.get(..indent).and_then(|indent| indent.find('\t'));
    if let Some(tab) = tab {
        let span = Span::new(base + line_start + tab, base + line_start + tab + 1);
        return Diagnostic::new(codes::YAML_SYNTAX, "a tab in the indentation")
            .with_label(source, span, "this is a tab")
            .with_help("YAML indents with spaces only; set the editor to insert spaces.");
    }
    let Some((fragment, message, help)) = HINTS.iter().find(|(fragment, _, _)| words.contains(fragment))
    else {
        let plain = words.split(" at line ").next().unwrap_or(words);
        return Diagnostic::new(codes::YAML_SYNTAX, format!("not YAML: {plain}"))
            .with_label(source, here, "here");
    };
    let diagnostic = Diagnostic::new(codes::YAML_SYNTAX, *message).with_help(*help);
    // An open quote or bracket is only noticed far behind it, so the place where it was opened is shown.
    match find_open_bracket(text, words).filter(|_| UNCLOSED.contains(fragment)) {
        Some(start) => diagnostic
            .with_label(source, character_span(text, base, start), "opened here")
            .with_label(source, here, "read up to here"),
        None => diagnostic.with_label(source, here, "here"),
    }
}

/// Returns the offset of the second place that libyaml names: the start of what it was reading.
fn find_open_bracket(text: &str, words: &str) -> Option<usize> {
    let (_, context) = words.split_once(", while ")?;
    let (_, place) = context.split_once(" at line ")?;
    let (line, column) = place.split_once(" column ")?;
    let (line, column): (usize, usize) = (line.parse().ok()?, column.parse().ok()?);
    let start: usize = text.split_inclusive('\n').take(line.checked_sub(1)?).map(str::len).sum();
    let (offset, _) = text.get(start..)?.char_indices().nth(column.checked_sub(1)?)?;
    Some(start + offset)
}

/// Returns the character at an offset. At the end of a line or of the file, it is the last character before
/// it.
fn character_span(text: &str, base: usize, at: usize) -> Span {
    let at = (0..=at).rev().find(|&at| text.is_char_boundary(at)).unwrap_or(0);
    let rest = text.get(at..).unwrap_or_default();
    match rest.chars().next() {
        Some(c) if !c.is_whitespace() => Span::new(base + at, base + at + c.len_utf8()),
        _ => {
            let before = text.get(..at).unwrap_or_default().trim_end();
            let last = before.chars().next_back().map_or(0, char::len_utf8);
            Span::new(base + before.len() - last, base + before.len())
        }
    }
}

fn shift_span(span: Span, base: usize) -> Span {
    Span::new(span.to_range().start + base, span.to_range().end + base)
}

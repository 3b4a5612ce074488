//! This module converts places between the protocol and the library.

use clsmith::editor::{EditedLines, TextPosition, find_position};
use clsmith::source::{Source, Span};
use lsp_types::{Position, Range};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

pub(super) fn position(at: Position) -> TextPosition {
    TextPosition::new(at.line, at.character)
}

pub(super) fn position_to_json(at: TextPosition) -> Value {
    json!({ "line": at.line, "character": at.column })
}

pub(super) fn range_to_json(from: TextPosition, to: TextPosition) -> Value {
    json!({ "start": position_to_json(from), "end": position_to_json(to) })
}

/// Returns a range of the text as it was read.
pub(super) fn span_to_json(source: &Source, span: Span) -> Value {
    range_to_json(find_position(source, span.start), find_position(source, span.end))
}

/// Returns the range of a span in the text as it is now, or `None` if its lines were edited.
pub(super) fn moved_span(source: &Source, span: Span, edited: &EditedLines) -> Option<Value> {
    let moved = |offset: u32| {
        let mut at = find_position(source, offset);
        at.line = edited.line_now(at.line)?;
        Some(at)
    };
    Some(range_to_json(moved(span.start)?, moved(span.end)?))
}

pub(super) fn touches(range: Range, from: TextPosition, to: TextPosition) -> bool {
    range.start.line <= to.line && from.line <= range.end.line
}

/// Returns the file of an address `file:///...`.
pub(super) fn uri_to_path(uri: &str) -> Option<PathBuf> {
    let path = uri.strip_prefix("file://")?;
    let path = path.get(path.find('/')?..)?;
    let mut bytes = Vec::with_capacity(path.len());
    let mut rest = path.as_bytes();
    while let Some((&first, behind)) = rest.split_first() {
        let code = behind.get(..2).filter(|_| first == b'%').and_then(|code| std::str::from_utf8(code).ok());
        match code.and_then(|code| u8::from_str_radix(code, 16).ok()) {
            Some(byte) => {
                bytes.push(byte);
                rest = behind.get(2..).unwrap_or_default();
            }
            None => {
                bytes.push(first);
                rest = behind;
            }
        }
    }
    let text = String::from_utf8(bytes).ok()?;
    // `/C:/programs` is a path of Windows.
    let is_drive = text.as_bytes().get(2) == Some(&b':');
    Some(PathBuf::from(if is_drive { text.get(1..)? } else { text.as_str() }))
}

/// Returns the address of a file.
pub(super) fn path_to_uri(path: &Path) -> String {
    let text = path.to_string_lossy().replace('\\', "/");
    let mut uri = String::from(if text.starts_with('/') { "file://" } else { "file:///" });
    for byte in text.bytes() {
        if byte.is_ascii_alphanumeric() || b"/-._~:".contains(&byte) {
            uri.push(char::from(byte));
        } else {
            uri.push_str(&format!("%{byte:02X}"));
        }
    }
    uri
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_are_files_and_back() {
        let path = Path::new("/shop/Teil ä 5%.cls");
        let uri = path_to_uri(path);
        assert_eq!(uri, "file:///shop/Teil%20%C3%A4%205%25.cls");
        assert_eq!(uri_to_path(&uri).as_deref(), Some(path));
        assert_eq!(uri_to_path("file:///C%3A/shop/a.cls"), Some(PathBuf::from("C:/shop/a.cls")));
        for other in ["untitled:a", "file:", "file://", "%"] {
            assert_eq!(uri_to_path(other), None, "{other}");
        }
    }
}

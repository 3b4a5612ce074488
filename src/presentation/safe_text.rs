//! This module makes text that is safe to show from any bytes.
//!
//! CL files come in many 8-bit encodings and do not state which. Valid UTF-8 is read as such, and any other
//! byte as the Latin-1 character of its value. So every byte is shown, and none is merged with another.

use crate::source::{Source, Span};

/// Returns the characters of a text in an unknown encoding, each with its number of bytes.
pub(crate) fn decode_characters(bytes: &[u8]) -> impl Iterator<Item = (char, usize)> + '_ {
    bytes.utf8_chunks().flat_map(|chunk| {
        let valid = chunk.valid().chars().map(|c| (c, c.len_utf8()));
        valid.chain(chunk.invalid().iter().map(|&byte| (char::from(byte), 1)))
    })
}

/// Returns whether a character would be invisible, move the cursor or reverse the line.
pub(crate) fn is_hidden_character(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{ad}' | '\u{61c}' | '\u{feff}' | '\u{200b}'..='\u{200f}' | '\u{2028}'..='\u{202e}')
        || matches!(c, '\u{2060}'..='\u{206f}' | '\u{fff9}'..='\u{fffb}' | '\u{e0000}'..='\u{e007f}')
}

/// Returns a visible replacement for a hidden character, and any other character and the tab unchanged.
/// `unicode` tells whether replacements may be other than ASCII.
///
/// A comment in a CL file must not be able to send commands to the terminal.
pub(crate) fn to_visible_character(c: char, unicode: bool) -> char {
    match c {
        '\t' => c,
        _ if !is_hidden_character(c) => c,
        _ if !unicode => '?',
        '\0'..='\u{1f}' => char::from_u32(0x2400 + u32::from(c)).unwrap_or('\u{fffd}'),
        '\u{7f}' => '\u{2421}',
        _ => '\u{fffd}',
    }
}

/// Returns a message that is safe to show, with its line breaks.
pub(crate) fn to_safe_paragraph(text: &str, unicode: bool) -> String {
    text.replace("\r\n", "\n")
        .chars()
        .map(|c| if c == '\n' { c } else { to_visible_character(c, unicode) })
        .collect()
}

/// Returns a message or a name as one line that is safe to show: line breaks become blanks, and hidden
/// characters are replaced by visible ones.
///
/// ```
/// use clsmith::report::to_safe_line;
///
/// assert_eq!(to_safe_line("part\u{202e}slc.exe\n"), "part\u{fffd}slc.exe");
/// ```
pub fn to_safe_line(text: &str) -> String {
    let words: Vec<&str> = text.split(['\n', '\r']).map(str::trim).filter(|part| !part.is_empty()).collect();
    words.join(" ").chars().map(|c| to_visible_character(c, true)).collect()
}

/// Returns the part of a span that lies inside its file, without the line end at its end, which should not be
/// underlined.
pub(crate) fn trim_line_end(source: &Source, span: Span) -> Span {
    let length = source.bytes().len();
    let (start, end) = (span.to_range().start.min(length), span.to_range().end.min(length));
    let text = source.bytes().get(start..end).unwrap_or_default();
    let kept = text.iter().rposition(|byte| !matches!(byte, b'\n' | b'\r')).map_or(0, |last| last + 1);
    Span::new(start, start + kept)
}

//! This module writes JSON in which hidden characters are escaped.
//!
//! JSON itself only requires escapes for quotes, backslashes and characters below U+0020. But a log or a
//! result is also read in a terminal, where a bidirectional override in a tool's name would reverse the line.
//! For readers of JSON, the escaped text is the same.

use super::safe_text::is_hidden_character;
use serde::Serialize;
use std::io::{self, Write};

/// Writes a value as JSON on one line, without a line end.
///
/// # Errors
/// Returns the errors of `out`.
pub fn write_json(out: impl Write, value: &impl Serialize) -> io::Result<()> {
    Ok(serde_json::to_writer(SafeJsonWriter(out), value)?)
}

/// Writes a value as indented JSON, without a line end.
///
/// # Errors
/// Returns the errors of `out`.
pub fn write_json_pretty(out: impl Write, value: &impl Serialize) -> io::Result<()> {
    Ok(serde_json::to_writer_pretty(SafeJsonWriter(out), value)?)
}

/// Returns a value as a line of JSON, with a line end.
///
/// # Errors
/// Returns an error for a value that JSON cannot hold: a map whose keys are no text.
pub fn to_json_line(value: &impl Serialize) -> io::Result<Vec<u8>> {
    let mut line = Vec::new();
    write_json(&mut line, value)?;
    line.push(b'\n');
    Ok(line)
}

/// A writer of JSON that escapes hidden characters. This is correct because they only occur inside strings,
/// and because a serializer never writes a part of a character.
pub(crate) struct SafeJsonWriter<W>(pub W);

impl<W: Write> Write for SafeJsonWriter<W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        // Nearly everything that is written is printable ASCII, and line ends come from the indentation, so a
        // test of the bytes avoids decoding.
        if bytes.iter().all(|byte| (b' '..0x7f).contains(byte) || *byte == b'\n') {
            self.0.write_all(bytes)?;
            return Ok(bytes.len());
        }
        for chunk in bytes.utf8_chunks() {
            let mut rest = chunk.valid();
            while let Some((at, hidden)) =
                rest.char_indices().find(|(_, c)| is_hidden_character(*c) && *c != '\n')
            {
                let (before, from) = rest.split_at(at);
                self.0.write_all(before.as_bytes())?;
                let mut units = [0; 2];
                for unit in hidden.encode_utf16(&mut units) {
                    write!(self.0, "\\u{unit:04x}")?;
                }
                rest = from.get(hidden.len_utf8()..).unwrap_or_default();
            }
            self.0.write_all(rest.as_bytes())?;
            self.0.write_all(chunk.invalid())?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn hidden_characters_are_escaped_and_read_back() {
        let text = "A\u{202e}B\u{7f}\u{9b}\u{e0041}\u{feff}\t\n\u{1b}ä\u{20ac}";
        let line = String::from_utf8(to_json_line(&text).unwrap()).unwrap();
        assert_eq!(line, "\"A\\u202eB\\u007f\\u009b\\udb40\\udc41\\ufeff\\t\\n\\u001bä\u{20ac}\"\n");
        assert_eq!(serde_json::from_str::<String>(&line).unwrap(), text);
    }

    #[test]
    fn indented_json_keeps_its_line_ends() {
        let mut out = Vec::new();
        write_json_pretty(&mut out, &["a", "b"]).unwrap();
        assert_eq!(out, b"[\n  \"a\",\n  \"b\"\n]");
    }
}

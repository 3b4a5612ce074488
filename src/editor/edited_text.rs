//! This module holds a text that is being edited, as editors see it: lines, and columns in UTF-16.

use crate::source::{Source, SourceTooLarge};
use std::ops::Range;
use std::sync::Arc;

/// A place in a text as editors count it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default)]
pub struct TextPosition {
    /// The line, from 0.
    pub line: u32,
    /// The UTF-16 units before it on its line.
    pub column: u32,
}

impl TextPosition {
    /// Makes a position.
    pub fn new(line: u32, column: u32) -> Self {
        Self { line, column }
    }
}

/// The lines that an edit replaced: `first` to `first + old_lines` became `first` to `first + new_lines`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct LineEdit {
    /// The first line that was touched.
    pub first: u32,
    /// How many lines were touched, at least one.
    pub old_lines: u32,
    /// How many lines stand in their place, at least one.
    pub new_lines: u32,
}

/// A text as it is now. An edit makes a new text, so whoever reads an older one is not disturbed, and a text that nobody
/// edits is there once, however many read it.
///
/// ```
/// use clsmith::editor::{EditedText, TextPosition};
///
/// let mut text = EditedText::new("part.cls", "RAPID\nGOTO/1,2,3\n".to_owned())?;
/// text.replace(TextPosition::new(1, 5)..TextPosition::new(1, 6), "1.5")?;
/// assert_eq!(text.bytes(), b"RAPID\nGOTO/1.5,2,3\n");
/// // A position behind the end is the end, and one behind a line's end is the line's end.
/// assert_eq!(text.offset(TextPosition::new(0, 99)), 5);
/// assert_eq!(text.offset(TextPosition::new(9, 0)), text.bytes().len());
/// # Ok::<(), clsmith::source::SourceTooLarge>(())
/// ```
#[derive(Debug, Clone)]
pub struct EditedText {
    source: Arc<Source>,
}

impl EditedText {
    /// Takes a text; `name` is the name of its file in findings.
    ///
    /// # Errors
    /// Returns [`SourceTooLarge`] for 4 GiB and more.
    pub fn new(name: impl Into<String>, text: String) -> Result<Self, SourceTooLarge> {
        Ok(Self { source: Source::new(name, text.into_bytes())? })
    }

    /// Returns the text as it is now, for others to read.
    pub fn source(&self) -> &Arc<Source> {
        &self.source
    }

    /// Returns the bytes, which are UTF-8.
    pub fn bytes(&self) -> &[u8] {
        self.source.bytes()
    }

    /// Returns the number of lines; an empty text has one.
    pub fn line_count(&self) -> u32 {
        self.line_at(self.bytes().len()) + 1
    }

    /// Returns the bytes of a line, counted from 0, without its end; none past the last line.
    pub fn line(&self, line: u32) -> &[u8] {
        self.source.line_span(line as usize + 1).map_or(&[], |span| self.source.slice(span))
    }

    /// Returns the offset at which a line starts; the end of the text past the last line.
    pub fn line_start(&self, line: u32) -> usize {
        self.source.line_span(line as usize + 1).map_or(self.bytes().len(), |span| span.start as usize)
    }

    /// Returns the offset of a position. A position inside a character is its start, and one behind a line's end
    /// is the line's end.
    pub fn offset(&self, position: TextPosition) -> usize {
        self.line_start(position.line) + utf8_length(self.line(position.line), position.column)
    }

    /// Returns the position of an offset.
    pub fn position(&self, offset: usize) -> TextPosition {
        find_position(&self.source, offset.min(self.bytes().len()) as u32)
    }

    /// Replaces a part of the text and returns which lines that touched. A range that is not in order is empty.
    ///
    /// # Errors
    /// Returns [`SourceTooLarge`] if the text would have 4 GiB or more; it stays as it was then.
    pub fn replace(&mut self, range: Range<TextPosition>, text: &str) -> Result<LineEdit, SourceTooLarge> {
        let start = self.offset(range.start);
        let end = self.offset(range.end).max(start);
        let length = self.bytes().len() - (end - start) + text.len();
        if length >= u32::MAX as usize {
            return Err(SourceTooLarge::File { bytes: length as u64 });
        }
        // A line end of two bytes may be joined or parted at both ends of the edit.
        let first = self.line_at(start.saturating_sub(1));
        let old_lines = self.line_at(end + 1) - first + 1;
        let name = self.source.name().to_owned();
        let nothing = Source::new(name.as_str(), Vec::new())?;
        let bytes = match Arc::try_unwrap(std::mem::replace(&mut self.source, nothing)) {
            // Nobody else reads this text, so it is changed where it stands.
            Ok(own) => {
                let mut bytes = own.into_bytes();
                bytes.splice(start..end, text.bytes());
                bytes
            }
            Err(shared) => {
                let old = shared.bytes();
                let [before, behind] = [old.get(..start), old.get(end..)].map(Option::unwrap_or_default);
                [before, text.as_bytes(), behind].concat()
            }
        };
        self.source = Source::new(name, bytes)?;
        let new_lines = self.line_at(start + text.len() + 1) - first + 1;
        Ok(LineEdit { first, old_lines, new_lines })
    }

    fn line_at(&self, offset: usize) -> u32 {
        self.source.line_column(offset.min(self.bytes().len()) as u32).0 as u32 - 1
    }
}

/// Returns the position of an offset in a file that was read.
pub fn find_position(source: &Source, offset: u32) -> TextPosition {
    let (line, column) = source.line_column(offset);
    let start = offset as usize + 1 - column;
    let before = source.bytes().get(start..offset as usize).unwrap_or_default();
    TextPosition { line: line as u32 - 1, column: utf16_length(before) }
}

/// Returns how many bytes so many UTF-16 units of a line take.
fn utf8_length(line: &[u8], column: u32) -> usize {
    if line.is_ascii() {
        return line.len().min(column as usize);
    }
    let text = String::from_utf8_lossy(line);
    let mut units = 0;
    for (at, character) in text.char_indices() {
        units += character.len_utf16() as u32;
        if units > column {
            return at.min(line.len());
        }
    }
    line.len()
}

/// Returns the UTF-16 units of a text.
fn utf16_length(text: &[u8]) -> u32 {
    if text.is_ascii() {
        return text.len() as u32;
    }
    String::from_utf8_lossy(text).encode_utf16().count() as u32
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::property::property;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(property(256))]
        /// After any edit the text is that of a plain string, and lines that it did not touch are as they were.
        #[test]
        fn edits_touch_the_lines_that_they_name(
            first in "[a\r\nä😀]{0,12}",
            edits in proptest::collection::vec((0_u32..6, 0_u32..6, 0_u32..6, 0_u32..6, "[b\r\n€]{0,4}"), 0..6),
        ) {
            let mut text = EditedText::new("a", first).unwrap();
            for (line, column, end_line, end_column, new) in edits {
                let (from, to) = (TextPosition::new(line, column), TextPosition::new(end_line, end_column));
                let (start, end) = (text.offset(from), text.offset(to).max(text.offset(from)));
                let mut plain = String::from_utf8(text.bytes().to_vec()).unwrap();
                plain.replace_range(start..end, &new);
                let before = text.clone();
                let edit = text.replace(from..to, &new).unwrap();
                prop_assert_eq!(text.bytes(), plain.as_bytes());
                prop_assert_eq!(before.line_count() + edit.new_lines, text.line_count() + edit.old_lines);
                for line in 0..edit.first {
                    prop_assert_eq!(before.line(line), text.line(line));
                }
                for line in edit.first + edit.new_lines..text.line_count() {
                    prop_assert_eq!(before.line(line + edit.old_lines - edit.new_lines), text.line(line));
                }
            }
        }
    }

    #[test]
    fn columns_are_those_of_utf16() {
        let text = EditedText::new("a", "$$ ä😀x\r\nGOTO/1,2,3".to_owned()).unwrap();
        assert_eq!(text.offset(TextPosition::new(0, 4)), 5);
        assert_eq!(text.offset(TextPosition::new(0, 5)), 5, "the middle of a pair is its start");
        assert_eq!(text.offset(TextPosition::new(0, 6)), 9);
        assert_eq!(text.position(9), TextPosition::new(0, 6));
        assert_eq!(text.line(0), "$$ ä😀x".as_bytes());
        assert_eq!(text.position(text.bytes().len()), TextPosition::new(1, 10));
    }
}

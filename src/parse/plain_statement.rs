//! This module reads the syntax of plain statements, which are nearly all of a CAM system's file: a word with
//! numbers, words and nested records of numbers, in as many lines as it takes, and comments and empty lines.
//!
//! The grammar defines the language. This reader takes a statement as the grammar does, to the byte, or leaves
//! it to the grammar; the tests of [`super::agreement`] hold it to that.

use super::columns::{CARD_COLUMNS, DATA_COLUMNS, inspect_line};
use super::statement_limit::is_readable_length;
use crate::number::parse_plain_decimal;
use crate::program::{FieldGroup, FieldKind, StatementField, StatementKind, StatementSyntax};

/// The longest comment in bytes that is read here.
const LONGEST_COMMENT: usize = 256;

/// The most characters of a number that is broken by a line end.
const BROKEN_LENGTH: usize = 40;

/// Reads the statement at the start of `text`. Returns `None` if only the grammar can read it.
///
/// `spare` is an empty list, whose memory becomes that of the fields.
pub(super) fn read_plain_statement<'t>(
    text: &'t [u8],
    spare: &mut Vec<StatementField>,
) -> Option<StatementSyntax<'t>> {
    debug_assert!(spare.is_empty(), "the fields of another statement are left");
    let (form, length) = match text.first()? {
        // What is too long is refused by the grammar, however plain it is.
        b'A'..=b'Z' => return read_words(text, spare).filter(|syntax| is_readable_length(syntax.text)),
        b'$' => (StatementKind::Comment, comment_length(text)?),
        b'\n' => (StatementKind::Blank, 1),
        b'\r' if text.get(1) == Some(&b'\n') => (StatementKind::Blank, 2),
        _ => return None,
    };
    let text = text.get(..length)?;
    Some(StatementSyntax { text, form, word: 0..0, fields: Vec::new(), remark: None, open: false })
}

/// Returns the length of a comment that holds no record: no `$$->`, no `$$*CATIA0`, and no row of a matrix.
fn comment_length(text: &[u8]) -> Option<usize> {
    let line = text.get(..LONGEST_COMMENT).unwrap_or(text);
    let end = match memchr::memchr2(b'\n', b'\r', line) {
        Some(end) => end + if text.get(end..end + 2) == Some(b"\r\n") { 2 } else { 1 },
        None if line.len() == text.len() => line.len(),
        None => return None,
    };
    let rest = line.strip_prefix(b"$$")?;
    if matches!(rest, [b'*', ..] | [b'-', b'>', ..]) {
        return None;
    }
    let ink = rest.iter().find(|byte| !matches!(byte, b' ' | b'\t' | 0x0C));
    (!matches!(ink, Some(b'0'..=b'9' | b'.' | b'+' | b'-'))).then_some(end)
}

/// Reads a statement of words and fields.
fn read_words<'t>(text: &'t [u8], spare: &mut Vec<StatementField>) -> Option<StatementSyntax<'t>> {
    if starts_free_text(text) {
        return None;
    }
    let mut reader = PlainReader { text, at: 0, line: 0 };
    reader.skip_name();
    while let Some([b',', b'A'..=b'Z', ..]) = text.get(reader.at..) {
        reader.at += 1;
        reader.skip_name();
    }
    let word = 0..reader.at;
    reader.skip_blanks();
    let ended = match reader.peek() {
        Some(b'/') => reader.read_fields(spare),
        _ => reader.end_line(),
    };
    if ended.is_none() {
        spare.clear();
        return None;
    }
    let text = text.get(..reader.at)?;
    let fields = std::mem::take(spare);
    Some(StatementSyntax { text, form: StatementKind::Words, word, fields, remark: None, open: false })
}

/// Returns whether a statement may be a text for people. All their words begin with six letters of their own.
fn starts_free_text(text: &[u8]) -> bool {
    matches!(
        text.get(..6),
        Some(b"PARTNO" | b"PPRINT" | b"INSERT" | b"REMARK" | b"TITLES" | b"LETTER" | b"OPFEAT" | b"TPRINT")
    )
}

/// The state of reading one statement.
struct PlainReader<'t> {
    text: &'t [u8],
    at: usize,
    /// The start of the line that is read.
    line: usize,
}

impl PlainReader<'_> {
    #[inline(always)]
    fn peek(&self) -> Option<u8> {
        self.text.get(self.at).copied()
    }

    /// Skips a name; one with other characters than these is left to the grammar by what follows.
    #[inline]
    fn skip_name(&mut self) {
        while let Some(b'A'..=b'Z' | b'0'..=b'9' | b'_' | b'-') = self.peek() {
            self.at += 1;
        }
    }

    #[inline(always)]
    fn skip_blanks(&mut self) {
        while self.peek() == Some(b' ') {
            self.at += 1;
        }
    }

    /// Skips blanks, and breaks of the line with `$`.
    #[inline(always)]
    fn skip_gap(&mut self) -> Option<()> {
        self.skip_blanks();
        while self.peek() == Some(b'$') {
            self.break_line()?;
            self.skip_blanks();
        }
        Some(())
    }

    /// Goes from a `$` at the end of a line to the next line.
    fn break_line(&mut self) -> Option<()> {
        let next = match self.text.get(self.at + 1..)? {
            [b'\n', ..] => self.at + 2,
            [b'\r', b'\n', ..] => self.at + 3,
            _ => return None,
        };
        self.check_columns(self.at + 1)?;
        (self.at, self.line) = (next, next);
        // A statement that the file ends in is an error, which the grammar finds.
        (next < self.text.len()).then_some(())
    }

    /// Returns `None` if the line, which ends at `end`, has an identification behind its data.
    #[inline(always)]
    fn check_columns(&self, end: usize) -> Option<()> {
        if !(DATA_COLUMNS..=CARD_COLUMNS).contains(&(end - self.line)) {
            return Some(());
        }
        inspect_line(self.text.get(self.line..end)?).identification.is_none().then_some(())
    }

    /// Ends the statement with its line or with the file.
    #[inline(always)]
    fn end_line(&mut self) -> Option<()> {
        self.check_columns(self.at)?;
        self.at += match self.text.get(self.at..)? {
            [] => 0,
            [b'\n', ..] => 1,
            [b'\r', b'\n', ..] => 2,
            // A lone CR ends a line too, but only the grammar decides what follows it.
            _ => return None,
        };
        Some(())
    }

    /// Reads the fields from the slash on, and the end of the line.
    #[inline]
    fn read_fields(&mut self, fields: &mut Vec<StatementField>) -> Option<()> {
        loop {
            self.at += 1;
            self.skip_gap()?;
            let field = self.read_field()?;
            // A text goes on in the next line if its own is full, so that is for the grammar to say.
            if matches!(field.kind, FieldKind::Text) {
                self.skip_blanks()
            } else {
                self.skip_gap()?
            }
            fields.push(field);
            if self.peek() != Some(b',') {
                return self.end_line();
            }
        }
    }

    #[inline]
    fn read_field(&mut self) -> Option<StatementField> {
        let start = self.at;
        let kind = match self.peek() {
            Some(b'0'..=b'9' | b'.' | b'-') => FieldKind::Number(self.read_number()?),
            Some(b'A'..=b'Z' | b'a'..=b'z') => {
                while self.peek().is_some_and(is_plain_ink) {
                    self.at += 1;
                }
                FieldKind::Text
            }
            Some(b'(') => FieldKind::Group(Box::new(self.read_group()?)),
            None | Some(b',' | b'\n' | b'\r') => FieldKind::Empty,
            _ => return None,
        };
        Some(StatementField { at: start..self.at, kind })
    }

    #[inline]
    fn read_number(&mut self) -> Option<f64> {
        let rest = self.text.get(self.at..)?;
        if let Some((value, length)) = parse_plain_decimal(rest) {
            match rest.get(length) {
                Some(b',' | b'\n' | b'\r' | b' ' | b')') | None => {
                    self.at += length;
                    return Some(value);
                }
                Some(b'$') => {}
                // An exponent, or a name that begins like a number.
                _ => return None,
            }
        }
        self.read_broken_number()
    }

    /// Reads a number that a `$` may break at the end of the line, in any column.
    #[cold]
    fn read_broken_number(&mut self) -> Option<f64> {
        let mut joined = [0; BROKEN_LENGTH];
        let mut length = 0;
        loop {
            match self.peek() {
                Some(byte @ (b'0'..=b'9' | b'.' | b'-')) => {
                    *joined.get_mut(length)? = byte;
                    length += 1;
                    self.at += 1;
                }
                Some(b'$') => {
                    let before = (self.at, self.line);
                    self.break_line()?;
                    match self.peek() {
                        Some(b'0'..=b'9' | b'.') => {}
                        // The number was whole; the gap behind it has the break.
                        Some(b' ' | b',' | b')' | b'\n' | b'\r') => {
                            (self.at, self.line) = before;
                            break;
                        }
                        _ => return None,
                    }
                }
                Some(b' ' | b',' | b')' | b'\n' | b'\r') | None => break,
                _ => return None,
            }
        }
        let (value, read) = parse_plain_decimal(joined.get(..length)?)?;
        (read == length).then_some(value)
    }

    /// Reads a nested record of numbers: `(CIRCLE/1.0,2.0,3.0,4.0)`.
    fn read_group(&mut self) -> Option<FieldGroup> {
        self.at += 1;
        self.skip_gap()?;
        let start = self.at;
        while let Some(b'A'..=b'Z') = self.peek() {
            self.at += 1;
        }
        let word = start..self.at;
        self.skip_gap()?;
        if word.is_empty() || self.peek() != Some(b'/') {
            return None;
        }
        let mut fields = Vec::with_capacity(6);
        loop {
            self.at += 1;
            self.skip_gap()?;
            let start = self.at;
            let value = self.read_number()?;
            fields.push(StatementField { at: start..self.at, kind: FieldKind::Number(value) });
            self.skip_gap()?;
            match self.peek()? {
                b',' => {}
                b')' => break,
                _ => return None,
            }
        }
        self.at += 1;
        Some(FieldGroup { word, fields })
    }
}

/// Returns whether a byte is part of a word or name that is read here.
#[inline(always)]
fn is_plain_ink(byte: u8) -> bool {
    byte.is_ascii_graphic() && !matches!(byte, b',' | b'$' | b'\'' | b'(' | b')')
}

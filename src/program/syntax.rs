//! This module holds the words and fields of one statement as the grammar reads them: places in the
//! statement's text, and values of numbers.
//!
//! A [`StatementSyntax`] is made on demand and never stored. Records read their meaning from it; edits and
//! rewrite rules work on it.

use std::borrow::Cow;
use std::ops::Range;

/// The form of the grammar that a statement has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum StatementKind {
    /// Only blanks.
    Blank,
    /// A comment: `$$ ...`
    Comment,
    /// Creo's `$$-> WORD / ...` and G-POST's `REMARK -> WORD / ...`.
    Structured,
    /// CATIA's `$$*CATIA0`.
    FrameMark,
    /// `$$` and four numbers.
    MatrixRow,
    /// `PPRINT`, `PARTNO` and the like: the rest of the line is for people.
    FreeText,
    /// NX's `TOOL PATH/name,TOOL,tool`.
    OperationStart,
    /// Bare numbers.
    Numbers,
    /// `L1 = LINE/...`: the input of an APT processor.
    Definition,
    /// A major word with or without fields.
    Words,
    /// A statement that fits no form.
    Refused,
}

/// A field of a statement: its place (relative to the statement's text) and its content.
#[derive(Debug, Clone, PartialEq)]
pub struct StatementField {
    /// The place in the statement's text.
    pub at: Range<usize>,
    /// The content.
    pub kind: FieldKind,
}

/// The content of a field.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum FieldKind {
    /// Nothing between two commas.
    Empty,
    /// A number.
    Number(f64),
    /// A word or name.
    Text,
    /// A text `'...'`; its place includes the quotes.
    Quoted,
    /// A nested record `(WORD/...)`, as CATIA nests CIRCLE and LINE.
    Group(Box<FieldGroup>),
}

/// A nested record.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldGroup {
    /// The place of its word.
    pub word: Range<usize>,
    /// Its fields.
    pub fields: Vec<StatementField>,
}

/// One statement, divided into its parts.
#[derive(Debug, Clone)]
pub struct StatementSyntax<'t> {
    /// The statement's whole text with its line end.
    pub text: &'t [u8],
    /// The form of the grammar.
    pub form: StatementKind,
    /// The place of the major word(s); empty if there is none.
    pub word: Range<usize>,
    /// The fields in order.
    pub fields: Vec<StatementField>,
    /// The place of a `$$` comment at the end.
    pub remark: Option<Range<usize>>,
    /// Whether the statement continues past the end of the file.
    pub open: bool,
}

impl<'t> StatementSyntax<'t> {
    /// Returns the bytes at a place, or no bytes if the place is not in the text.
    pub fn bytes_at(&self, at: &Range<usize>) -> &'t [u8] {
        self.text.get(at.clone()).unwrap_or_default()
    }

    /// Returns the major word in upper case, with single blanks between words and no blanks around commas:
    /// `TOOL PATH`, `TLON,GOFWD`.
    pub fn major_word(&self) -> Cow<'t, str> {
        fold_text(self.bytes_at(&self.word))
    }

    /// Returns all numbers in the order of the text, including nested ones. Edits name a number by its index
    /// in this list.
    pub fn numbers(&self) -> Vec<(Range<usize>, f64)> {
        let mut found = Vec::new();
        self.add_numbers(&mut found);
        found
    }

    /// Returns how many numbers there are, including nested ones.
    pub(crate) fn count_numbers(&self) -> usize {
        count_numbers(&self.fields)
    }

    /// Adds all numbers in the order of the text to a list.
    pub(crate) fn add_numbers(&self, into: &mut Vec<(Range<usize>, f64)>) {
        collect_numbers(&self.fields, into);
    }

    /// Returns the places of all words, texts and numbers in the order of the text, including nested ones. Only where
    /// a full line is broken may the break stand within one of them.
    pub(crate) fn token_places(&self) -> Vec<Range<usize>> {
        let mut found = Vec::with_capacity(self.fields.len() + 1);
        found.push(self.word.clone());
        collect_tokens(&self.fields, &mut found);
        found
    }

    /// Returns the text of a field in upper case if it is a word.
    pub fn word_at(&self, index: usize) -> Option<Cow<'t, str>> {
        let field = self.fields.get(index)?;
        matches!(field.kind, FieldKind::Text).then(|| fold_text(self.bytes_at(&field.at)))
    }

    /// Returns the value of a field if it is a number.
    pub fn number_at(&self, index: usize) -> Option<f64> {
        self.fields.get(index).and_then(StatementField::number_value)
    }
}

impl StatementField {
    /// Returns the value if the field is a number.
    pub fn number_value(&self) -> Option<f64> {
        match self.kind {
            FieldKind::Number(value) => Some(value),
            _ => None,
        }
    }
}

/// Counts the numbers of fields, including those of nested records.
fn count_numbers(fields: &[StatementField]) -> usize {
    let count = |field: &StatementField| match &field.kind {
        FieldKind::Number(_) => 1,
        FieldKind::Group(group) => count_numbers(&group.fields),
        FieldKind::Empty | FieldKind::Text | FieldKind::Quoted => 0,
    };
    fields.iter().map(count).sum()
}

/// Adds the numbers of fields, including those of nested records.
fn collect_numbers(fields: &[StatementField], into: &mut Vec<(Range<usize>, f64)>) {
    for field in fields {
        match &field.kind {
            FieldKind::Number(value) => into.push((field.at.clone(), *value)),
            FieldKind::Group(group) => collect_numbers(&group.fields, into),
            FieldKind::Empty | FieldKind::Text | FieldKind::Quoted => {}
        }
    }
}

/// Adds the places of words, texts and numbers in fields, including those of nested records.
fn collect_tokens(fields: &[StatementField], into: &mut Vec<Range<usize>>) {
    for field in fields {
        match &field.kind {
            FieldKind::Group(group) => {
                into.push(group.word.clone());
                collect_tokens(&group.fields, into);
            }
            FieldKind::Number(_) | FieldKind::Text | FieldKind::Quoted | FieldKind::Empty => {
                into.push(field.at.clone());
            }
        }
    }
}

/// Returns a word, text or number without the breaks in it: the `$` at the end of a line, what follows it in
/// that line, and the line end.
pub(crate) fn join_broken(bytes: &[u8]) -> Cow<'_, [u8]> {
    if memchr::memchr2(b'\n', b'\r', bytes).is_none() {
        return Cow::Borrowed(bytes);
    }
    let mut joined = Vec::with_capacity(bytes.len());
    let mut lines = bytes.split(|byte| matches!(byte, b'\n' | b'\r')).peekable();
    while let Some(line) = lines.next() {
        // The grammar reads a full line's `$` as another byte.
        let end = match lines.peek() {
            Some(_) => line.iter().rposition(|byte| matches!(byte, b'$' | 1)).unwrap_or(line.len()),
            None => line.len(),
        };
        joined.extend_from_slice(line.get(..end).unwrap_or_default());
    }
    Cow::Owned(joined)
}

/// Returns a text in upper case, with single blanks between words and no blanks around commas. Bytes from
/// 0x80 on are read as Latin-1. Breaks in the text are left out. A text that has that form is not copied.
pub(crate) fn fold_text(bytes: &[u8]) -> Cow<'_, str> {
    let is_folded = |byte: u8| matches!(byte, b'A'..=b'Z' | b'0'..=b'9' | b'_' | b'-' | b'.' | b',' | b'+');
    if bytes.iter().all(|byte| is_folded(*byte))
        && let Ok(text) = std::str::from_utf8(bytes)
    {
        return Cow::Borrowed(text);
    }
    let bytes = &*join_broken(bytes);
    let mut text = String::with_capacity(bytes.len());
    let mut blank = false;
    for &byte in bytes {
        if matches!(byte, b' ' | b'\t' | 0x0C) {
            blank = true;
            continue;
        }
        if blank && byte != b',' && !text.is_empty() && !text.ends_with(',') {
            text.push(' ');
        }
        blank = false;
        text.push(char::from(byte.to_ascii_uppercase()));
    }
    Cow::Owned(text)
}

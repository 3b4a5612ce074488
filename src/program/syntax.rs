//! The words and fields of one statement, as the grammar sees them: places in the statement's text, and number values.
//!
//! [`StatementSyntax`] is made on demand and never stored. Records read their meaning from it; edits and rewrite rules work on it.

use std::ops::Range;

/// Which form of the grammar a statement has.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StatementKind {
    /// Nothing but blanks.
    Blank,
    /// `$$ ...`
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
    /// `L1 = LINE/...`: the source of an APT processor.
    Definition,
    /// A major word with or without fields.
    Words,
    /// What no form fits.
    Refused,
}

/// A field of a statement: its bytes (relative to the statement's text) and what stands there.
#[derive(Debug, Clone, PartialEq)]
pub struct StatementField {
    /// Place in the statement's text.
    pub at: Range<usize>,
    /// What stands there.
    pub kind: FieldKind,
}

/// What stands in a field.
#[derive(Debug, Clone, PartialEq)]
pub enum FieldKind {
    /// Nothing between two commas.
    Empty,
    /// A number.
    Number(f64),
    /// A word or name.
    Text,
    /// `'...'`, quotes included in the place.
    Quoted,
    /// `(WORD/...)`, as CATIA nests CIRCLE and LINE.
    Group(Box<FieldGroup>),
}

/// A nested record.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldGroup {
    /// Place of its word.
    pub word: Range<usize>,
    /// Its fields.
    pub fields: Vec<StatementField>,
}

/// One statement, taken apart.
#[derive(Debug, Clone)]
pub struct StatementSyntax<'t> {
    /// The statement's whole text, line end included.
    pub text: &'t [u8],
    /// Its form.
    pub form: StatementKind,
    /// Place of the major word(s); empty when there is none.
    pub word: Range<usize>,
    /// Its fields in order.
    pub fields: Vec<StatementField>,
    /// Place of a trailing `$$` comment.
    pub remark: Option<Range<usize>>,
    /// The statement continues past the end of the file.
    pub open: bool,
}

impl<'t> StatementSyntax<'t> {
    /// The bytes at a place; empty when the place is not in the text.
    pub fn bytes_at(&self, at: &Range<usize>) -> &'t [u8] {
        self.text.get(at.clone()).unwrap_or_default()
    }

    /// The major word in upper case, inner blanks folded to one and blanks around commas dropped: `TOOL PATH`, `TLON,GOFWD`.
    pub fn major_word(&self) -> String {
        fold_text(self.bytes_at(&self.word))
    }

    /// All numbers in the order they stand, nested ones included. The index of a number here is what edits name.
    pub fn numbers(&self) -> Vec<(Range<usize>, f64)> {
        let mut found = Vec::new();
        collect_numbers(&self.fields, &mut found);
        found
    }

    /// A field's text in upper case, when it is a word.
    pub fn word_at(&self, index: usize) -> Option<String> {
        let field = self.fields.get(index)?;
        matches!(field.kind, FieldKind::Text).then(|| fold_text(self.bytes_at(&field.at)))
    }

    /// A field's value, when it is a number.
    pub fn number_at(&self, index: usize) -> Option<f64> {
        self.fields.get(index).and_then(StatementField::number_value)
    }
}

impl StatementField {
    /// The value, when it is a number.
    pub fn number_value(&self) -> Option<f64> {
        match self.kind {
            FieldKind::Number(value) => Some(value),
            _ => None,
        }
    }
}

fn collect_numbers(fields: &[StatementField], into: &mut Vec<(Range<usize>, f64)>) {
    for field in fields {
        match &field.kind {
            FieldKind::Number(value) => into.push((field.at.clone(), *value)),
            FieldKind::Group(group) => collect_numbers(&group.fields, into),
            FieldKind::Empty | FieldKind::Text | FieldKind::Quoted => {}
        }
    }
}

/// Upper case, runs of blanks folded to one, no blanks around commas. Bytes from 0x80 on stand as Latin-1.
pub fn fold_text(bytes: &[u8]) -> String {
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
    text
}

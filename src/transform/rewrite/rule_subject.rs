//! This module reads a statement as rules see it: its class, word and arguments, independent of its spelling.

use crate::parse;
use crate::program::{FieldKind, StatementField, StatementKind};
use std::ops::Range;

/// The length of the word of a plain GOTO line, which begins with it.
const GOTO: usize = 4;

/// The kinds of statement that rules distinguish.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum SubjectClass {
    /// A word with arguments or text.
    Words,
    /// The same after `$$->` or `REMARK ->`.
    Structured,
    /// A `$$` comment, whose text is its only argument.
    Comment,
    /// Statements that no rule matches: blank lines, bare numbers, and what cannot be read.
    Other,
}

/// A statement, split into its parts.
#[derive(Debug, Clone)]
pub(super) struct RuleSubject<'t> {
    /// Its text, including the line end.
    pub text: &'t [u8],
    /// Its class.
    pub class: SubjectClass,
    /// The place of its word.
    pub word: Range<usize>,
    /// Its arguments, without the empty one after a last comma (CLT) or a bare slash (`RAPID/`).
    pub fields: Vec<StatementField>,
    /// The place of a trailing comment.
    pub remark: Option<Range<usize>>,
    open: bool,
}

impl<'t> RuleSubject<'t> {
    /// Splits a statement's text into its parts. Text after the first statement is ignored; see
    /// [`RuleSubject::is_whole`].
    pub(super) fn from_text(text: &'t [u8]) -> Self {
        if let Some(numbers) = parse::plain_goto_numbers(text) {
            let number = |(at, value)| StatementField { at, kind: FieldKind::Number(value) };
            let fields = numbers.into_iter().map(number).collect();
            return Self {
                text,
                class: SubjectClass::Words,
                word: 0..GOTO,
                fields,
                remark: None,
                open: false,
            };
        }
        let syntax = parse::syntax(text);
        let open = syntax.open;
        let class = match syntax.form {
            StatementKind::Words | StatementKind::FreeText | StatementKind::OperationStart => {
                SubjectClass::Words
            }
            StatementKind::Structured => SubjectClass::Structured,
            StatementKind::Comment | StatementKind::FrameMark | StatementKind::MatrixRow => {
                SubjectClass::Comment
            }
            StatementKind::Blank
            | StatementKind::Numbers
            | StatementKind::Definition
            | StatementKind::Refused => SubjectClass::Other,
        };
        let mut subject = Self {
            text: syntax.text,
            class,
            word: syntax.word,
            fields: syntax.fields,
            remark: syntax.remark,
            open,
        };
        match syntax.form {
            StatementKind::OperationStart => subject.expose_tool_word(),
            _ if class == SubjectClass::Comment => {
                subject.fields = comment_text(syntax.text).into_iter().collect()
            }
            _ => {}
        }
        if matches!(class, SubjectClass::Words | SubjectClass::Structured)
            && subject.fields.last().is_some_and(|field| field.kind == FieldKind::Empty)
        {
            subject.fields.pop();
        }
        subject
    }

    /// Returns whether a text is this one statement and nothing more.
    pub(super) fn is_whole(&self, text: &[u8]) -> bool {
        self.text.len() == text.len() && !self.open
    }

    /// Returns the bytes at a place.
    pub(super) fn bytes_at(&self, at: &Range<usize>) -> &'t [u8] {
        self.text.get(at.clone()).unwrap_or_default()
    }

    /// Makes an argument of the `TOOL` in `TOOL PATH/name,TOOL,tool`, which the grammar consumes.
    fn expose_tool_word(&mut self) {
        let [name, tool] = self.fields.as_slice() else { return };
        let between = name.at.end..tool.at.start;
        let letter = |byte: &u8| byte.is_ascii_alphabetic();
        let bytes = self.bytes_at(&between);
        if let (Some(first), Some(last)) = (bytes.iter().position(letter), bytes.iter().rposition(letter)) {
            let at = between.start + first..between.start + last + 1;
            self.fields.insert(1, StatementField { at, kind: FieldKind::Text });
        }
    }
}

/// Returns the text of a comment without `$$` and blanks. Returns `None` if it is empty.
fn comment_text(text: &[u8]) -> Option<StatementField> {
    let start = text.iter().position(|&byte| byte == b'$')? + 2;
    let rest = text.get(start..)?;
    let is_ink = |byte: &u8| !matches!(byte, b' ' | b'\t' | 0x0C | b'\r' | b'\n');
    let at = start + rest.iter().position(is_ink)?..start + rest.iter().rposition(is_ink)? + 1;
    Some(StatementField { at, kind: FieldKind::Text })
}

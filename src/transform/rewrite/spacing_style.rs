//! This module finds out how a file spaces its statements: `GOTO /`, `FEDRAT / 10.0, IPM`, `GOTO/ 1,2`.

use super::rule_subject::{RuleSubject, SubjectClass};
use crate::program::{FieldKind, Program, StatementField};
use std::collections::HashMap;
use std::ops::Range;

/// The spacing of a file, found word by word and remembered.
#[derive(Default)]
pub(super) struct SpacingStyle {
    line_end: &'static str,
    columns: bool,
    /// The gap after each word, as the first statement with this word has it.
    slashes: HashMap<Vec<u8>, Vec<u8>>,
    /// Slash and comma of the first GOTO.
    usual: Option<(Vec<u8>, Vec<u8>)>,
}

impl SpacingStyle {
    /// Prepares the spacing of a program.
    pub(super) fn from_program(program: &Program, line_end: &'static str) -> Self {
        Self { line_end, columns: program.dialect().has_columns(), ..Self::default() }
    }

    /// Returns the text of a statement without its line end, spaced as the file spaces its own. Free text
    /// stays unchanged.
    pub(super) fn apply_spacing(&mut self, text: &[u8], program: &Program) -> Vec<u8> {
        let subject = RuleSubject::from_text(text);
        let mut out = Vec::with_capacity(text.len() + 8);
        let mut copied = 0;
        if matches!(subject.class, SubjectClass::Words | SubjectClass::Structured) && subject.is_whole(text) {
            let mut before = &subject.word;
            for (index, field) in subject.fields.iter().enumerate() {
                let gap = before.end..field.at.start;
                let wanted = match index {
                    0 => self.slash_gap(&subject, &gap, program),
                    _ => self.comma_gap(&subject, &gap, program),
                };
                if let Some(wanted) = wanted {
                    out.extend_from_slice(text.get(copied..gap.start).unwrap_or_default());
                    out.extend_from_slice(&wanted);
                    copied = gap.end;
                }
                before = &field.at;
            }
        }
        out.extend_from_slice(text.get(copied..).unwrap_or_default());
        replace_line_ends(&out, self.line_end)
    }

    /// Returns the gap between word and arguments. Only a plain gap is changed: free text needs no slash, and
    /// a continuation is intended.
    fn slash_gap(
        &mut self,
        subject: &RuleSubject<'_>,
        gap: &Range<usize>,
        program: &Program,
    ) -> Option<Vec<u8>> {
        let bytes = plain_gap(subject.bytes_at(gap), b'/')?;
        let word = subject.bytes_at(&subject.word).to_ascii_uppercase();
        if !self.slashes.contains_key(&word) {
            let found =
                find_slash_gap(&word, program).unwrap_or_else(|| self.default_slash_gap(&word, program));
            self.slashes.insert(word.clone(), found);
        }
        let mut slash = self.slashes.get(&word)?.clone();
        if self.columns {
            // Blanks before a number keep it in its column, so they stay.
            let after = bytes.iter().position(|&byte| byte == b'/')? + 1;
            slash.truncate(slash.iter().position(|&byte| byte == b'/')? + 1);
            slash.extend_from_slice(bytes.get(after..).unwrap_or_default());
        }
        Some(slash)
    }

    fn comma_gap(
        &mut self,
        subject: &RuleSubject<'_>,
        gap: &Range<usize>,
        program: &Program,
    ) -> Option<Vec<u8>> {
        plain_gap(subject.bytes_at(gap), b',')?;
        (!self.columns).then(|| self.default_gaps(program).1.clone())
    }

    /// Returns the usual gap of a word. CATIA pads its short motion words, but not CYCLE, DELAY and others
    /// (this was measured).
    fn default_slash_gap(&mut self, word: &[u8], program: &Program) -> Vec<u8> {
        match word {
            b"GOTO" | b"FROM" if self.columns => b"  /".to_vec(),
            b"INTOL" if self.columns => b" /".to_vec(),
            _ if self.columns => b"/".to_vec(),
            _ => self.default_gaps(program).0.clone(),
        }
    }

    fn default_gaps(&mut self, program: &Program) -> &(Vec<u8>, Vec<u8>) {
        self.usual.get_or_insert_with(|| {
            let goto = find_first_statement(b"GOTO", program);
            goto.and_then(|goto| goto_gaps(&goto)).unwrap_or((b"/".to_vec(), b",".to_vec()))
        })
    }
}

/// Returns the first statement of the file with a word, as it was read. What steps have made of it shows
/// nothing about the file.
fn find_first_statement<'p>(word: &[u8], program: &'p Program) -> Option<RuleSubject<'p>> {
    let texts = program.statements().iter().map(|statement| program.source().slice(statement.origin()));
    texts.filter(|text| starts_with_word(text, word)).map(RuleSubject::from_text).find(|subject| {
        subject.class == SubjectClass::Words
            && subject.bytes_at(&subject.word).eq_ignore_ascii_case(word)
            && !subject.fields.is_empty()
    })
}

fn starts_with_word(text: &[u8], word: &[u8]) -> bool {
    text.trim_ascii_start().get(..word.len()).is_some_and(|start| start.eq_ignore_ascii_case(word))
}

fn find_slash_gap(word: &[u8], program: &Program) -> Option<Vec<u8>> {
    let subject = find_first_statement(word, program)?;
    let gap = subject.word.end..subject.fields.first()?.at.start;
    plain_gap(subject.bytes_at(&gap), b'/').map(<[u8]>::to_vec)
}

fn goto_gaps(goto: &RuleSubject<'_>) -> Option<(Vec<u8>, Vec<u8>)> {
    let [x, y, ..] = goto.fields.as_slice() else { return None };
    let slash = plain_gap(goto.bytes_at(&(goto.word.end..x.at.start)), b'/')?;
    let comma = plain_gap(goto.bytes_at(&(x.at.end..y.at.start)), b',')?;
    Some((slash.to_vec(), comma.to_vec()))
}

/// Returns the gap if it consists of the sign and blanks only.
fn plain_gap(gap: &[u8], sign: u8) -> Option<&[u8]> {
    let signs = gap.iter().filter(|&&byte| byte == sign).count();
    let plain = signs == 1 && gap.iter().all(|&byte| byte == sign || byte == b' ');
    plain.then_some(gap)
}

/// Replaces line ends inside a continued statement by those of the file.
fn replace_line_ends(text: &[u8], line_end: &str) -> Vec<u8> {
    let mut out = Vec::with_capacity(text.len());
    let mut bytes = text.iter().copied().peekable();
    while let Some(byte) = bytes.next() {
        match byte {
            b'\r' if bytes.peek() == Some(&b'\n') => {}
            b'\n' | b'\r' => out.extend_from_slice(line_end.as_bytes()),
            byte => out.push(byte),
        }
    }
    out
}

/// Returns whether two statements state the same, however they are spelled.
pub(super) fn is_same_statement(a: &RuleSubject<'_>, b: &RuleSubject<'_>) -> bool {
    a.class == b.class
        && super::wildcards::is_same_folded(a.bytes_at(&a.word), b.bytes_at(&b.word))
        && has_same_fields(a, &a.fields, b, &b.fields)
}

fn has_same_fields(
    a: &RuleSubject<'_>,
    left: &[StatementField],
    b: &RuleSubject<'_>,
    right: &[StatementField],
) -> bool {
    left.len() == right.len()
        && left.iter().zip(right).all(|(x, y)| match (&x.kind, &y.kind) {
            (FieldKind::Number(x), FieldKind::Number(y)) => x == y,
            (FieldKind::Group(x), FieldKind::Group(y)) => {
                super::wildcards::is_same_folded(a.bytes_at(&x.word), b.bytes_at(&y.word))
                    && has_same_fields(a, &x.fields, b, &y.fields)
            }
            (x_kind, y_kind) if std::mem::discriminant(x_kind) == std::mem::discriminant(y_kind) => {
                super::wildcards::is_same_folded(a.bytes_at(&x.at), b.bytes_at(&y.at))
            }
            _ => false,
        })
}

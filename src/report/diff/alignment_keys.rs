//! This module computes the keys by which statements are aligned: equal meanings first, then equal shapes.

use crate::parse;
use crate::program::{
    FieldKind, Program, Record, RecordKind, Statement, StatementField, StatementId, StatementSyntax,
    fold_text,
};
use std::hash::{DefaultHasher, Hash, Hasher};

/// The keys of a program's live statements.
#[derive(Debug, Default)]
pub(super) struct AlignmentKeys {
    /// The statements to which the keys belong, in order.
    pub(super) ids: Vec<StatementId>,
    /// Keys that are equal for statements with the same meaning, whatever their blanks and zeros are.
    pub(super) meaning: Vec<u64>,
    /// Keys that are equal for statements that may differ only in their numbers.
    pub(super) shape: Vec<u32>,
}

impl AlignmentKeys {
    pub(super) fn from_program(program: &Program) -> Self {
        let mut keys = Self::default();
        for (id, statement) in program.live_statements() {
            let text = program.statement_text(statement);
            keys.ids.push(id);
            keys.meaning.push(hash_meaning(statement.record(), text));
            keys.shape.push(hash_shape(statement.record(), text));
        }
        keys
    }

    pub(super) fn len(&self) -> usize {
        self.meaning.len()
    }
}

fn hash_meaning(record: &Record, text: &[u8]) -> u64 {
    let mut hasher = DefaultHasher::new();
    match record {
        Record::Goto(goto) => {
            // Adding 0 turns -0 into 0.
            goto.point.iter().for_each(|value| (value + 0.0).to_bits().hash(&mut hasher));
            if let Some(axis) = goto.axis {
                axis.iter().for_each(|value| (value + 0.0).to_bits().hash(&mut hasher));
            }
        }
        Record::Feed(feed) => {
            feed.value.to_bits().hash(&mut hasher);
            feed.unit.hash(&mut hasher);
        }
        _ => bytes_without_layout(record, text).for_each(|byte| hasher.write_u8(byte)),
    }
    RecordKind::from_record(record).hash(&mut hasher);
    hasher.finish()
}

/// Returns a statement's bytes without layout: without line ends, and for records also without blanks.
fn bytes_without_layout<'t>(record: &Record, text: &'t [u8]) -> impl Iterator<Item = u8> + 't {
    let people = RecordKind::from_record(record) == RecordKind::Comment;
    text.trim_ascii_end().iter().copied().filter(move |byte| people || !matches!(byte, b' ' | b'\t'))
}

fn hash_shape(record: &Record, text: &[u8]) -> u32 {
    let kind = RecordKind::from_record(record);
    let mut hasher = DefaultHasher::new();
    kind.hash(&mut hasher);
    match kind {
        // These kinds hold many different records, so the first word of the statement distinguishes them. A
        // record of any other kind has the same shape in all dialects, whatever its words are.
        RecordKind::Other
        | RecordKind::Structure
        | RecordKind::Tool
        | RecordKind::Frame
        | RecordKind::Mark
        | RecordKind::Spline => {
            let word = text.trim_ascii_start();
            let letters = word.iter().take_while(|byte| byte.is_ascii_alphanumeric() || **byte == b'_');
            letters.for_each(|byte| hasher.write_u8(byte.to_ascii_uppercase()));
        }
        RecordKind::Comment => text.trim_ascii().is_empty().hash(&mut hasher),
        _ => std::mem::discriminant(record).hash(&mut hasher),
    }
    hasher.finish() as u32
}

/// Returns whether two statements have the same meaning: equal fields, whatever their layout and the notation
/// of numbers.
pub(super) fn have_same_meaning(a: (&Program, &Statement), b: (&Program, &Statement)) -> bool {
    let (record_a, record_b) = (a.1.record(), b.1.record());
    let (text_a, text_b) = (a.0.statement_text(a.1), b.0.statement_text(b.1));
    if std::mem::discriminant(record_a) != std::mem::discriminant(record_b) {
        return false;
    }
    match (record_a, record_b) {
        // These records hold everything that their statements state.
        (Record::Goto(_) | Record::From(_) | Record::Feed(_) | Record::ToolAxis(_), _)
        | (Record::Control(_) | Record::Knot(_) | Record::MatrixRow(_) | Record::Rapid, _) => {
            record_a == record_b
        }
        _ if bytes_without_layout(record_a, text_a).eq(bytes_without_layout(record_b, text_b)) => true,
        (Record::Comment | Record::Text | Record::Unparsed | Record::Blank, _) => false,
        _ => have_same_fields(&parse::syntax(text_a), &parse::syntax(text_b)),
    }
}

fn have_same_fields(a: &StatementSyntax<'_>, b: &StatementSyntax<'_>) -> bool {
    a.major_word() == b.major_word() && are_fields_equal(&a.fields, a, &b.fields, b)
}

fn are_fields_equal(
    left: &[StatementField],
    a: &StatementSyntax<'_>,
    right: &[StatementField],
    b: &StatementSyntax<'_>,
) -> bool {
    left.len() == right.len()
        && left.iter().zip(right).all(|(one, other)| match (&one.kind, &other.kind) {
            (FieldKind::Number(one), FieldKind::Number(other)) => one == other,
            (FieldKind::Group(one), FieldKind::Group(other)) => {
                fold_text(a.bytes_at(&one.word)) == fold_text(b.bytes_at(&other.word))
                    && are_fields_equal(&one.fields, a, &other.fields, b)
            }
            (FieldKind::Text, FieldKind::Text) => {
                fold_text(a.bytes_at(&one.at)) == fold_text(b.bytes_at(&other.at))
            }
            (one_kind, other_kind) => one_kind == other_kind && a.bytes_at(&one.at) == b.bytes_at(&other.at),
        })
}

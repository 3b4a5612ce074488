//! What statements are aligned by: their meaning where it is the same, their shape where it is not.

use crate::parse;
use crate::program::{Field, FieldKind, Program, Record, Statement, Syntax, folded};
use crate::report::kind::Kind;
use std::hash::{DefaultHasher, Hash, Hasher};

/// The keys of a program's live statements.
#[derive(Debug, Default)]
pub(super) struct Keys {
    /// Index of each statement in the program.
    pub(super) index: Vec<u32>,
    /// Equal for statements that say the same, whatever their blanks and zeros.
    pub(super) meaning: Vec<u64>,
    /// Equal for statements that may be the same one with other numbers.
    pub(super) shape: Vec<u32>,
}

impl Keys {
    pub(super) fn of(program: &Program) -> Self {
        let mut keys = Self::default();
        for (index, statement) in program.live() {
            let text = program.text(statement);
            keys.index.push(index as u32);
            keys.meaning.push(meaning(statement.record(), text));
            keys.shape.push(shape(statement.record(), text));
        }
        keys
    }

    pub(super) fn len(&self) -> usize {
        self.index.len()
    }
}

fn meaning(record: &Record, text: &[u8]) -> u64 {
    let mut hasher = DefaultHasher::new();
    match record {
        Record::Goto(goto) => {
            // Adding 0 makes one zero of the two.
            goto.point.iter().for_each(|value| (value + 0.0).to_bits().hash(&mut hasher));
            if let Some(axis) = goto.axis {
                axis.iter().for_each(|value| (value + 0.0).to_bits().hash(&mut hasher));
            }
        }
        Record::Feed(feed) => {
            feed.value.to_bits().hash(&mut hasher);
            feed.unit.hash(&mut hasher);
        }
        _ => squeezed(record, text).for_each(|byte| hasher.write_u8(byte)),
    }
    Kind::of(record).hash(&mut hasher);
    hasher.finish()
}

/// A statement's bytes without what is only layout: line ends; in records also blanks.
fn squeezed<'t>(record: &Record, text: &'t [u8]) -> impl Iterator<Item = u8> + 't {
    let people = Kind::of(record) == Kind::Comment;
    text.trim_ascii_end().iter().copied().filter(move |byte| people || !matches!(byte, b' ' | b'\t'))
}

fn shape(record: &Record, text: &[u8]) -> u32 {
    let kind = Kind::of(record);
    let mut hasher = DefaultHasher::new();
    kind.hash(&mut hasher);
    match kind {
        // Words of different dialects for one thing are one shape; of these, the word is all we know.
        Kind::Other | Kind::Structure | Kind::Tool | Kind::Frame | Kind::Mark | Kind::Spline => {
            let word = text.trim_ascii_start();
            let letters = word.iter().take_while(|byte| byte.is_ascii_alphanumeric() || **byte == b'_');
            letters.for_each(|byte| hasher.write_u8(byte.to_ascii_uppercase()));
        }
        Kind::Comment => text.trim_ascii().is_empty().hash(&mut hasher),
        _ => std::mem::discriminant(record).hash(&mut hasher),
    }
    hasher.finish() as u32
}

/// Whether two statements say the same: equal fields, whatever their layout and the style of their numbers.
pub(super) fn same_meaning(a: (&Program, &Statement), b: (&Program, &Statement)) -> bool {
    let (record_a, record_b) = (a.1.record(), b.1.record());
    let (text_a, text_b) = (a.0.text(a.1), b.0.text(b.1));
    if std::mem::discriminant(record_a) != std::mem::discriminant(record_b) {
        return false;
    }
    match (record_a, record_b) {
        // Of these the record is all that the statement says.
        (Record::Goto(_) | Record::From(_) | Record::Feed(_) | Record::ToolAxis(_), _)
        | (Record::Control(_) | Record::Knot(_) | Record::MatrixRow(_) | Record::Rapid, _) => {
            record_a == record_b
        }
        _ if squeezed(record_a, text_a).eq(squeezed(record_b, text_b)) => true,
        (Record::Comment | Record::Text | Record::Unparsed | Record::Blank, _) => false,
        _ => same_fields(&parse::syntax(text_a), &parse::syntax(text_b)),
    }
}

fn same_fields(a: &Syntax<'_>, b: &Syntax<'_>) -> bool {
    a.major() == b.major() && equal(&a.fields, a, &b.fields, b)
}

fn equal(left: &[Field], a: &Syntax<'_>, right: &[Field], b: &Syntax<'_>) -> bool {
    left.len() == right.len()
        && left.iter().zip(right).all(|(one, other)| match (&one.kind, &other.kind) {
            (FieldKind::Number(one), FieldKind::Number(other)) => one == other,
            (FieldKind::Group(one), FieldKind::Group(other)) => {
                folded(a.bytes(&one.word)) == folded(b.bytes(&other.word))
                    && equal(&one.fields, a, &other.fields, b)
            }
            (FieldKind::Text, FieldKind::Text) => folded(a.bytes(&one.at)) == folded(b.bytes(&other.at)),
            (one_kind, other_kind) => one_kind == other_kind && a.bytes(&one.at) == b.bytes(&other.at),
        })
}

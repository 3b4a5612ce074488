//! This module reads the cutting of threads with a turning tool: `PITCH/`, `THREAD/`.

use super::{NumberRole, Record, RecordReading};
use crate::program::syntax::{FieldKind, StatementField, StatementSyntax, fold_text};
use crate::program::units::{Feed, FeedUnit};

/// The cutting of a thread with a turning tool, whose feed is its pitch times the spindle speed.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Threading {
    /// `PITCH/`: the pitch of the threads that follow.
    Pitch(StatedPitch),
    /// `THREAD/TURN` and the like: the motions that follow cut a thread. `THREAD/TURN,LEAD,2` states its pitch.
    On(Option<StatedPitch>),
    /// `THREAD/OFF`: they no longer do.
    Off,
}

/// How a record states the pitch of a thread: the way of the tool in one revolution.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum StatedPitch {
    /// A length in the file's unit: `PITCH/2`, `PITCH/LEAD,2`.
    Length(f64),
    /// Threads in an inch: `PITCH/TPI,16`.
    PerInch(f64),
    /// In a way that only the post understands: a pitch that changes along the thread, a word that is not known.
    Unknown,
}

impl StatedPitch {
    /// Returns the feed that makes the pitch; `None` if it is not known.
    pub fn to_feed(self) -> Option<Feed> {
        match self {
            Self::Length(pitch) => Some(Feed { value: pitch, unit: Some(FeedUnit::PerRevolution) }),
            Self::PerInch(count) => {
                Some(Feed { value: 1.0 / count, unit: Some(FeedUnit::InchPerRevolution) })
            }
            Self::Unknown => None,
        }
    }

    /// Reads a pitch by the word before its number, which is `None` for a number without one. Returns `None` for a word
    /// that tells no pitch.
    pub(super) fn from_word(word: Option<&str>, value: f64) -> Option<Self> {
        match word {
            _ if value <= 0.0 => None,
            None | Some("PITCH" | "LEAD") => Some(Self::Length(value)),
            Some("TPI") => Some(Self::PerInch(value)),
            Some(_) => None,
        }
    }
}

/// Reads a record of this family.
pub(super) fn read_record(major: &str, syntax: &StatementSyntax<'_>) -> RecordReading {
    let threading = match major {
        "PITCH" => Threading::Pitch(read_pitch(syntax)),
        "THREAD" => match syntax.word_at(0).as_deref() {
            Some("OFF" | "NOMORE") => Threading::Off,
            _ => Threading::On(find_thread_pitch(syntax)),
        },
        _ => return None,
    };
    Some(Ok(Record::Threading(threading)))
}

/// Reads the fields of a PITCH: a number, with one word in front of it or behind it.
fn read_pitch(syntax: &StatementSyntax<'_>) -> StatedPitch {
    let word = |field: &StatementField| match &field.kind {
        FieldKind::Text => Some(fold_text(syntax.bytes_at(&field.at))),
        _ => None,
    };
    let read = match syntax.fields.as_slice() {
        [only] => only.number_value().and_then(|value| StatedPitch::from_word(None, value)),
        [one, other] => match (word(one), one.number_value(), word(other), other.number_value()) {
            (Some(word), _, _, Some(value)) | (_, Some(value), Some(word), _) => {
                StatedPitch::from_word(Some(&word), value)
            }
            _ => None,
        },
        _ => None,
    };
    read.unwrap_or(StatedPitch::Unknown)
}

/// Finds the pitch among the fields of a THREAD: `THREAD/TURN,LEAD,2.0`. A number without a word that says what it is
/// may be the pitch or a count of starts: only the post knows (`THREAD/TURN,2.0`).
fn find_thread_pitch(syntax: &StatementSyntax<'_>) -> Option<StatedPitch> {
    let stated = syntax.fields.windows(2).find_map(|pair| match pair {
        [word, number] if word.kind == FieldKind::Text => {
            let name = fold_text(syntax.bytes_at(&word.at));
            StatedPitch::from_word(Some(&name), number.number_value()?)
        }
        _ => None,
    });
    stated.or((syntax.count_numbers() > 0).then_some(StatedPitch::Unknown))
}

/// Returns the roles of the numbers of this family.
pub(super) fn number_roles(threading: &Threading, syntax: &StatementSyntax<'_>) -> Vec<NumberRole> {
    match threading {
        Threading::On(_) => {
            super::role::roles_by_word(syntax, |word| matches!(word, "PITCH" | "LEAD" | "INCR"))
        }
        // PITCH/0.5,INCR,0.1 and PITCH/LEAD,1.5 are lengths. TPI counts threads in an inch.
        Threading::Pitch(_) => {
            let per_inch = (0..syntax.fields.len()).any(|at| syntax.word_at(at).as_deref() == Some("TPI"));
            let role = if per_inch { NumberRole::Plain } else { NumberRole::Length };
            vec![role; syntax.count_numbers()]
        }
        Threading::Off => Vec::new(),
    }
}

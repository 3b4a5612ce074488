//! Frames: where the program's coordinates stand in the part, and shifts and turns of them.

use super::{NumberRole, Record, RecordReading, read_all_numbers, wrong_count};
use crate::program::syntax::{StatementKind, StatementSyntax};

/// The word of a frame record; the meaning of its numbers hangs on it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FrameWord {
    /// NX `MSYS/`: origin, x axis, y axis (9 numbers).
    Msys,
    /// `CSYS/`, `$$-> CSYS /`, `CAMERA/`: three rows of x, y, z column and translation (12 numbers).
    Csys,
    /// `TRANS/dx,dy,dz`: the post adds this to every point.
    Trans,
    /// `ORIGIN/x,y,z`: the post subtracts this from every point.
    Origin,
    /// `ROTABL/`, `ROTHED/`: a rotary axis turns.
    Rotary,
}

/// A frame record and its numbers as printed.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameRecord {
    /// The word.
    pub word: FrameWord,
    /// Its numbers.
    pub numbers: Vec<f64>,
}

pub(super) fn read_record(major: &str, syntax: &StatementSyntax<'_>) -> RecordReading {
    let (word, takes, counts): (_, _, &[usize]) = match major {
        "MSYS" => (FrameWord::Msys, "9 numbers", &[9]),
        "CSYS" | "CAMERA" => (FrameWord::Csys, "12 numbers", &[12]),
        "TRANS" => (FrameWord::Trans, "3 numbers", &[3]),
        "ORIGIN" => (FrameWord::Origin, "3 numbers", &[3]),
        "ROTABL" | "ROTHED" => {
            let numbers = syntax.fields.iter().filter_map(|field| field.number_value()).collect();
            return Some(Ok(Record::Frame(Box::new(FrameRecord { word: FrameWord::Rotary, numbers }))));
        }
        _ => return None,
    };
    if syntax.fields.is_empty()
        || syntax.word_at(0).is_some_and(|word| word.starts_with(|c: char| c.is_ascii_alphabetic()))
    {
        return Some(Ok(Record::Known));
    }
    Some(read_all_numbers(syntax).and_then(|numbers| {
        if counts.contains(&numbers.len()) {
            Ok(Record::Frame(Box::new(FrameRecord { word, numbers })))
        } else {
            Err(wrong_count(major, syntax, takes, numbers.len()))
        }
    }))
}

pub(super) fn read_matrix_row(syntax: &StatementSyntax<'_>) -> Record {
    debug_assert_eq!(syntax.form, StatementKind::MatrixRow);
    // It is a comment first of all: one that holds a number too large to read is no row, and no error.
    match read_all_numbers(syntax).as_deref() {
        Ok([a, b, c, d]) => Record::MatrixRow(Box::new([*a, *b, *c, *d])),
        _ => Record::Comment,
    }
}

pub(super) fn number_roles(record: &Record) -> Vec<NumberRole> {
    let word = match record {
        Record::Frame(frame) => frame.word,
        // Which row it is only the statements before it say; the frame view gives rows their roles.
        _ => return Vec::new(),
    };
    match word {
        FrameWord::Msys => [origin_roles(), frame_axis_roles(0), frame_axis_roles(1)].concat(),
        FrameWord::Csys => (0..3)
            .flat_map(|row| {
                [
                    NumberRole::FrameAxis(0, row),
                    NumberRole::FrameAxis(1, row),
                    NumberRole::FrameAxis(2, row),
                    NumberRole::FrameOrigin(row),
                ]
            })
            .collect(),
        FrameWord::Trans | FrameWord::Origin => vec![NumberRole::Length; 3],
        FrameWord::Rotary => Vec::new(),
    }
}

fn origin_roles() -> Vec<NumberRole> {
    vec![NumberRole::FrameOrigin(0), NumberRole::FrameOrigin(1), NumberRole::FrameOrigin(2)]
}

fn frame_axis_roles(axis: u8) -> Vec<NumberRole> {
    (0..3).map(|component| NumberRole::FrameAxis(axis, component)).collect()
}

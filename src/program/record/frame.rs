//! This module reads frames, which place the program's coordinates in the part, and their shifts and turns.

use super::{NumberRole, Record, RecordReading, read_all_numbers, wrong_count};
use crate::program::syntax::{FieldKind, StatementKind, StatementSyntax};

/// The word of a frame record, on which the meaning of its numbers depends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum FrameWord {
    /// NX `MSYS/`: origin, x axis, y axis (9 numbers).
    Msys,
    /// `CSYS/`, `$$-> CSYS /`, `CAMERA/`: three rows with the x, y and z columns and the translation (12
    /// numbers).
    Csys,
    /// `TRANS/dx,dy,dz`: the post adds this to every point.
    Trans,
    /// `ORIGIN/x,y,z`: the post subtracts this from every point.
    Origin,
    /// `ROTABL/`, `ROTHED/`: a rotary axis turns.
    Rotary,
}

/// A frame record with its numbers as printed.
#[derive(Debug, Clone, PartialEq)]
pub struct FrameRecord {
    /// The word.
    pub word: FrameWord,
    /// The numbers.
    pub numbers: Vec<f64>,
}

/// Reads a record of this family.
pub(super) fn read_record(major: &str, syntax: &StatementSyntax<'_>) -> RecordReading {
    let (word, takes, counts): (_, _, &[usize]) = match major {
        "MSYS" => (FrameWord::Msys, "9 numbers", &[9]),
        "CSYS" | "CAMERA" => (FrameWord::Csys, "12 numbers", &[12]),
        "TRANS" => (FrameWord::Trans, "3 numbers", &[3]),
        // Some posts take two axes of the frame with the origin.
        "ORIGIN" => (FrameWord::Origin, "3 or 9 numbers", &[3, 9]),
        "ROTABL" | "ROTHED" => {
            let numbers = syntax.fields.iter().filter_map(|field| field.number_value()).collect();
            return Some(Ok(Record::Frame(Box::new(FrameRecord { word: FrameWord::Rotary, numbers }))));
        }
        _ => return None,
    };
    if syntax.fields.iter().all(|field| field.kind == FieldKind::Empty)
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

/// Reads a comment with four numbers as a row of a CATIA0 matrix.
pub(super) fn read_matrix_row(syntax: &StatementSyntax<'_>) -> Record {
    debug_assert_eq!(syntax.form, StatementKind::MatrixRow);
    // The row is a comment first of all. If it has a number that is too large to read, it is not a row, and
    // not an error.
    match read_all_numbers(syntax).as_deref() {
        Ok([a, b, c, d]) => Record::MatrixRow(Box::new([*a, *b, *c, *d])),
        _ => Record::Comment,
    }
}

/// Returns the roles of the numbers of a frame.
pub(super) fn number_roles(record: &Record) -> Vec<NumberRole> {
    let word = match record {
        Record::Frame(frame) => frame.word,
        // Only the statements before it tell which row a matrix row is; the frame view gives its numbers
        // their roles.
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

/// Returns the roles of an origin's coordinates.
fn origin_roles() -> Vec<NumberRole> {
    vec![NumberRole::FrameOrigin(0), NumberRole::FrameOrigin(1), NumberRole::FrameOrigin(2)]
}

/// Returns the roles of an axis' components.
fn frame_axis_roles(axis: u8) -> Vec<NumberRole> {
    (0..3).map(|component| NumberRole::FrameAxis(axis, component)).collect()
}

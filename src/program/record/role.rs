//! This module holds the roles of numbers in a statement, which tell a transform whether and how a number
//! changes.
//!
//! Transforms of geometry and units work on roles, so they need no list of records of their own.

use crate::program::syntax::{FieldKind, StatementSyntax, fold_text};

/// The role of one number. The numbers `0..=2` are the components x, y, z.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum NumberRole {
    /// A coordinate of a point in the program's frame; it moves, turns and scales.
    Point(u8),
    /// A component of a step between points (GODLTA); it turns and scales, but does not move.
    Step(u8),
    /// A component of a unit vector; it only turns.
    Direction(u8),
    /// A component of an arc's axis; it turns, and changes its sign in a mirror (it is a pseudo-vector).
    ArcAxis(u8),
    /// A coordinate of the frame's origin, seen from outside; it scales, and only moves with the frame.
    FrameOrigin(u8),
    /// A component (second number) of the frame's x, y or z axis (first number), seen from outside.
    FrameAxis(u8, u8),
    /// A length, or a distance relative to a point; it only scales.
    Length,
    /// A feed whose unit is in the record or in force.
    Feed,
    /// A surface speed, whose unit is in the record.
    SurfaceSpeed,
    /// A count, an angle, a time or a knot; it never changes.
    Plain,
}

/// Returns roles of numbers that the word before them tells: those behind a word that `is_length` accepts are
/// lengths, all others are plain. A word governs the numbers up to the next word.
pub(super) fn roles_by_word(
    syntax: &StatementSyntax<'_>,
    is_length: impl Fn(&str) -> bool,
) -> Vec<NumberRole> {
    let mut length = false;
    let mut roles = Vec::new();
    for field in &syntax.fields {
        match &field.kind {
            FieldKind::Text => length = is_length(&fold_text(syntax.bytes_at(&field.at))),
            FieldKind::Number(_) => {
                roles.push(if length { NumberRole::Length } else { NumberRole::Plain });
            }
            _ => {}
        }
    }
    roles
}

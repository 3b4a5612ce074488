//! This module swaps words of left and right: the sides of CUTCOM, and the sense of arcs that state it in
//! words.

use crate::diagnostic::Failure;
use crate::program::{FieldKind, StatementId, StatementSyntax, fold_text};
use crate::transform::Affine;
use crate::write::{self, ProgramEditor};
use nalgebra::Vector3;
use std::ops::Range;

const SIDES: &[[&str; 2]] = &[["LEFT", "RIGHT"]];
const SENSES: &[[&str; 2]] = &[["CLOCKWISE", "COUNTERCLOCKWISE"], ["CLW", "CCLW"]];

/// Swaps LEFT and RIGHT in a CUTCOM.
///
/// # Errors
/// Returns an error if the new text does not read back.
pub(super) fn swap_sides(editor: &mut ProgramEditor, id: StatementId) -> Result<(), Failure> {
    swap_words(editor, id, SIDES)
}

/// Swaps the words that state the sense of an arc.
///
/// # Errors
/// Returns an error if the new text does not read back.
pub(super) fn swap_senses(editor: &mut ProgramEditor, id: StatementId) -> Result<(), Failure> {
    swap_words(editor, id, SENSES)
}

/// Returns the normal of the plane that a CUTCOM names. Returns `None` if it names none.
pub(super) fn named_plane_normal(syntax: &StatementSyntax<'_>) -> Option<Vector3<f64>> {
    (0..syntax.fields.len()).find_map(|field| match syntax.word_at(field)?.as_ref() {
        "XYPLAN" => Some(Vector3::z()),
        "YZPLAN" => Some(Vector3::x()),
        "ZXPLAN" => Some(Vector3::y()),
        _ => None,
    })
}

/// Returns whether the transform keeps a plane and the side from which its word is meant.
pub(super) fn keeps_plane(place: &Affine, normal: Vector3<f64>) -> bool {
    place.keeps_direction(normal)
}

fn swap_words(
    editor: &mut ProgramEditor,
    id: StatementId,
    pairs: &[[&'static str; 2]],
) -> Result<(), Failure> {
    let syntax = write::statement_syntax(editor.program(), id);
    let parts: Vec<(Range<usize>, Vec<u8>)> = syntax
        .fields
        .iter()
        .filter(|field| field.kind == FieldKind::Text)
        .filter_map(|field| {
            let bytes = syntax.bytes_at(&field.at);
            let word = fold_text(bytes);
            let other = pairs
                .iter()
                .find_map(|[a, b]| if word == *a { Some(*b) } else { (word == *b).then_some(*a) })?;
            let lower = bytes.iter().any(u8::is_ascii_lowercase);
            let other = if lower { other.to_ascii_lowercase() } else { other.to_owned() };
            Some((field.at.clone(), other.into_bytes()))
        })
        .collect();
    let parts: Vec<_> = parts.iter().map(|(at, bytes)| (at.clone(), bytes.as_slice())).collect();
    if parts.is_empty() { Ok(()) } else { editor.replace_parts(id, &parts) }
}

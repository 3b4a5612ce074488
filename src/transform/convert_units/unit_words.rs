//! This module handles the words that name the units of the file, of feeds and of surface speeds.

use super::unit_conversion::UnitConversion;
use crate::diagnostic::Failure;
use crate::program::{
    FeedUnit, FieldKind, LengthUnit, StatementField, StatementId, StatementSyntax, fold_text,
};
use crate::write::{self, ProgramEditor};
use std::ops::Range;

/// Returns the numbers of a statement that are feeds, with the unit word that governs each of them. That is
/// the word before the number, or the only one of the record (CATIA writes it after the number).
pub(super) fn find_feeds(syntax: &StatementSyntax<'_>) -> Vec<(usize, Option<FeedUnit>)> {
    let units = find_feed_words(syntax);
    let mut found = Vec::new();
    for (index, (at, _)) in syntax.numbers().iter().enumerate() {
        let before = units.iter().rev().find(|(place, _)| place.end <= at.start);
        found.push((index, before.or_else(|| units.first()).map(|(_, unit)| *unit)));
    }
    found
}

/// Replaces the unit words of feeds by their new names.
///
/// # Errors
/// Returns an error if the new text does not read back.
pub(super) fn swap_feed_words(
    editor: &mut ProgramEditor,
    id: StatementId,
    conversion: UnitConversion,
) -> Result<(), Failure> {
    let syntax = write::statement_syntax(editor.program(), id);
    let parts = find_feed_words(&syntax)
        .into_iter()
        .filter_map(|(at, unit)| conversion.convert_feed_unit(Some(unit)).0.map(|new| (at, new.word())))
        .collect();
    replace_words(editor, id, parts)
}

/// Replaces the unit word of a surface speed by its new name.
///
/// # Errors
/// Returns an error if the new text does not read back.
pub(super) fn swap_speed_word(
    editor: &mut ProgramEditor,
    id: StatementId,
    to: LengthUnit,
) -> Result<(), Failure> {
    let (old, new) = match to {
        LengthUnit::Inch => ("SMM", "SFM"),
        LengthUnit::Mm => ("SFM", "SMM"),
    };
    let syntax = write::statement_syntax(editor.program(), id);
    let parts = split_words(&syntax).filter(|(_, word)| word == old).map(|(at, _)| (at, new)).collect();
    replace_words(editor, id, parts)
}

/// Writes the new unit into a UNITS record. Its word keeps its own spelling.
///
/// # Errors
/// Returns an error if the new text does not read back.
pub(super) fn swap_units(editor: &mut ProgramEditor, id: StatementId, to: LengthUnit) -> Result<(), Failure> {
    let syntax = write::statement_syntax(editor.program(), id);
    let name = match to {
        LengthUnit::Inch => "INCHES",
        LengthUnit::Mm => "MM",
    };
    let parts = syntax.fields.first().map(|field| (field.at.clone(), name)).into_iter().collect();
    replace_words(editor, id, parts)
}

fn find_feed_words(syntax: &StatementSyntax<'_>) -> Vec<(Range<usize>, FeedUnit)> {
    split_words(syntax).filter_map(|(at, word)| FeedUnit::from_word(&word).map(|unit| (at, unit))).collect()
}

/// Returns the words of all fields. A field may hold several words where a comma is missing (CAMWorks).
fn split_words<'s>(syntax: &'s StatementSyntax<'_>) -> impl Iterator<Item = (Range<usize>, String)> + 's {
    let of_field = |field: &'s StatementField| {
        let bytes = syntax.bytes_at(&field.at);
        let start = field.at.start;
        let mut at = 0;
        bytes.split(|byte| matches!(byte, b' ' | b'\t')).map(move |word| {
            let place = start + at..start + at + word.len();
            at += word.len() + 1;
            (place, fold_text(word).into_owned())
        })
    };
    syntax.fields.iter().filter(|field| field.kind == FieldKind::Text).flat_map(of_field)
}

fn replace_words(
    editor: &mut ProgramEditor,
    id: StatementId,
    parts: Vec<(Range<usize>, &'static str)>,
) -> Result<(), Failure> {
    let parts: Vec<_> = parts.into_iter().map(|(at, word)| (at, word.as_bytes())).collect();
    if parts.is_empty() { Ok(()) } else { editor.replace_parts(id, &parts) }
}

//! This module reads the numbers of a statement with their roles, for transforms that change geometry.
//!
//! Roles come from the records ([`crate::program::NumberRole`]). Two of them depend on what stands before the
//! statement: whether a long GOTO holds axes (MULTAX), and which row of a CATIA matrix a comment is.

use crate::diagnostic::Failure;
use crate::number::{self, NumberFormat};
use crate::parse;
use crate::program::record::{has_contact_normal, has_tool_axes};
use crate::program::{FieldKind, NumberRole, Record, StatementId};
use crate::write::{ProgramEditor, copy_with_numbers};
use nalgebra::Vector3;
use std::borrow::Cow;

/// The tolerance of a matrix in the comments of a CATIA file. It prints unit vectors with 5 decimals, but
/// rotated ones need as many as an NX frame.
const MATRIX_TOLERANCE: f64 = 5e-8;

/// Returns the roles of a statement's numbers. A GOTO of several points only holds axes under MULTAX, as
/// motions read it.
pub(super) fn number_roles(record: &Record, text: &[u8], multi_axis: bool) -> Vec<NumberRole> {
    roles_without_multax(record, multi_axis).unwrap_or_else(|| parse::number_roles(record, text))
}

/// Returns the roles of a GOTO of several points that would hold axes if MULTAX were in force, and `None` for any
/// other statement.
pub(super) fn roles_without_multax(record: &Record, multi_axis: bool) -> Option<Vec<NumberRole>> {
    let Record::Points(numbers) = record else { return None };
    let axes = !has_contact_normal(numbers) && has_tool_axes(numbers);
    (axes && !multi_axis)
        .then(|| (0..numbers.len()).map(|index| NumberRole::Point((index % 3) as u8)).collect())
}

/// Gives every point and vector among the numbers a new value. `change` gets the role of the first component,
/// and returns `None` if the triple stays. The result is meant for [`ProgramEditor::set_numbers`].
pub(super) fn map_triples(
    values: &[f64],
    roles: &[NumberRole],
    change: impl Fn(NumberRole, Vector3<f64>) -> Option<Vector3<f64>>,
) -> Vec<(usize, f64)> {
    let mut edits = Vec::with_capacity(values.len());
    add_triples(|index| values.get(index).copied(), roles, change, &mut edits);
    edits
}

/// Does the same for the numbers that `value` returns by their indices, and adds the edits to a list.
pub(super) fn add_triples(
    value: impl Fn(usize) -> Option<f64>,
    roles: &[NumberRole],
    change: impl Fn(NumberRole, Vector3<f64>) -> Option<Vector3<f64>>,
    edits: &mut Vec<(usize, f64)>,
) {
    for (index, role) in roles.iter().enumerate() {
        if !matches!(
            role,
            NumberRole::Point(0) | NumberRole::Step(0) | NumberRole::Direction(0) | NumberRole::ArcAxis(0)
        ) {
            continue;
        }
        let (Some(x), Some(y), Some(z)) = (value(index), value(index + 1), value(index + 2)) else {
            continue;
        };
        if let Some(new) = change(*role, Vector3::new(x, y, z)) {
            edits.extend([(index, new.x), (index + 1, new.y), (index + 2, new.z)]);
        }
    }
}

/// Counts the rows of CATIA's matrix: three after each `$$*CATIA0`, with only comments between them.
#[derive(Debug, Default)]
pub(super) struct MatrixRowCounter {
    open: bool,
    next: u8,
}

impl MatrixRowCounter {
    /// Reads a record. Returns the index of the row (0 to 2) if it is one.
    pub(super) fn observe_record(&mut self, record: &Record) -> Option<u8> {
        match record {
            Record::FrameMark => *self = Self { open: true, next: 0 },
            Record::MatrixRow(_) if self.open => {
                let row = self.next;
                self.next += 1;
                self.open = self.next < 3;
                return Some(row);
            }
            Record::Comment | Record::MatrixRow(_) => {}
            _ => self.open = false,
        }
        None
    }
}

/// Gives numbers of a matrix row in a comment new values in their columns. Numbers are only separated by
/// blanks, so at least one blank stays.
///
/// Returns an error if the row does not read back.
pub(super) fn set_matrix_row(
    editor: &mut ProgramEditor,
    id: StatementId,
    edits: &[(usize, f64)],
) -> Result<(), Failure> {
    let statement = editor.program().statement(id);
    let text = editor.program().statement_text(statement).to_vec();
    let numbers = parse::statement_numbers(&text);
    let mut parts: Vec<(std::ops::Range<usize>, String)> = Vec::new();
    for (place, (at, old)) in numbers.iter().enumerate() {
        let before = text.get(..at.start).unwrap_or_default();
        let start = before.trim_ascii_end().len();
        let Some((_, wanted)) = edits.iter().find(|(edited, _)| *edited == place) else { continue };
        if (wanted - old).abs() <= 1e-13 * old.abs().max(1.0) {
            continue;
        }
        let own = number::count_decimals(text.get(at.clone()).unwrap_or_default());
        let tolerance = if place < 3 { MATRIX_TOLERANCE } else { 5e-5 };
        let form = NumberFormat {
            decimals: own + if place < 3 { 0 } else { editor.style().finer },
            tolerance,
            zeros: Default::default(),
            point: true,
        };
        let printed = form.format_number(*wanted, wanted - old);
        let width = at.end - start;
        parts.push((start..at.end, format!(" {printed:>0$}", width.saturating_sub(1))));
    }
    let parts: Vec<_> = parts.iter().map(|(at, text)| (at.clone(), text.as_bytes())).collect();
    if parts.is_empty() { Ok(()) } else { editor.replace_parts(id, &parts) }
}

/// Returns the major word of a statement in upper case, without the cost of the grammar. It is meant for
/// comparisons with lists of words.
pub(super) fn major_word(text: &[u8]) -> Cow<'_, str> {
    let text = text.trim_ascii_start();
    // The number of a statement stands in front of its word (`N10 GOTO/`), numbers behind a comma (`CHANNEL,1`).
    let label = text.strip_prefix(b"N").or(text.strip_prefix(b"n")).unwrap_or(text);
    let digits = label.iter().take_while(|byte| byte.is_ascii_digit()).count();
    let text = match label.get(digits..) {
        Some([b' ' | b'\t', rest @ ..]) if digits > 0 => rest.trim_ascii_start(),
        _ => text,
    };
    let number = |at: usize| {
        let behind = text.get(at + 1..).unwrap_or_default().trim_ascii_start();
        behind.first().is_some_and(|first| first.is_ascii_digit() || b".-+".contains(first))
    };
    let ends = |(at, byte): (usize, &u8)| match byte {
        b'/' | b'$' | b'\r' | b'\n' => true,
        b',' => number(at),
        _ => false,
    };
    let end = text.iter().enumerate().position(ends).unwrap_or(text.len());
    crate::program::fold_text(text.get(..end).unwrap_or_default().trim_ascii_end())
}

/// Returns a statement's text without remark and line end.
pub(super) fn strip_remark(text: &[u8]) -> Vec<u8> {
    let syntax = parse::syntax(text);
    let end = match (&syntax.remark, syntax.fields.last()) {
        (None, _) => syntax.text.len(),
        (Some(_), Some(field)) if field.kind != FieldKind::Empty => field.at.end,
        (Some(remark), _) => remark.start,
    };
    syntax.text.get(..end).unwrap_or_default().to_vec()
}

/// Deletes a statement. A remark at its end stays as a comment of its own.
///
/// # Errors
/// Returns an error if the comment does not read back.
pub(super) fn delete_keeping_remark(
    editor: &mut ProgramEditor,
    statement: StatementId,
) -> Result<(), Failure> {
    let program = editor.program();
    let found = program.statement(statement);
    let text = program.statement_text(found);
    let remark = parse::syntax(text).remark.and_then(|remark| text.get(remark.start..));
    match remark.map(<[u8]>::to_vec) {
        Some(remark) => editor.set_text(statement, &remark),
        None => editor.delete_statement(statement),
    }
}

/// Rounds a coordinate to the decimals that a file prints. A machine gains nothing from more decimals.
pub(super) fn round_to_decimals(value: f64, decimals: usize) -> f64 {
    let power = 10f64.powi(decimals as i32);
    (value * power).round() / power
}

/// Returns pairs of the numbers' indices, from `first` on, and their new values.
pub(super) fn pair_with_indices(first: usize, values: impl IntoIterator<Item = f64>) -> Vec<(usize, f64)> {
    values.into_iter().enumerate().map(|(index, value)| (first + index, value)).collect()
}

/// Returns a statement's text with other numbers and without its remark, as a new statement in its form.
pub(super) fn copy_statement(
    editor: &ProgramEditor,
    statement: StatementId,
    numbers: &[(usize, f64)],
) -> Vec<u8> {
    let program = editor.program();
    let found = program.statement(statement);
    copy_with_numbers(&strip_remark(program.statement_text(found)), found.record(), numbers, editor.style())
}

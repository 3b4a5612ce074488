//! This module writes a tool axis that the file leaves unstated, in the notation of its dialect.

use crate::diagnostic::Failure;
use crate::parse;
use crate::program::{Dialect, NumberRole, Record, StatementId};
use crate::write::ProgramEditor;
use nalgebra::Vector3;

/// The notation of tool axes in a dialect.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum AxisNotation {
    /// Six values where the axis changes. The axis stays in force for GOTOs with three values (NX).
    Modal,
    /// Six values in every GOTO whose axis is not z (Creo and ISO under MULTAX, SolidWorks without it).
    EveryLine,
    /// A TLAXIS line, and six values under MULTAX (CATIA).
    Word,
    /// Six values in FROM only (Makino FF).
    FromOnly,
    /// No notation: coordinates are in the setup (CAMWorks).
    Never,
}

impl AxisNotation {
    /// Returns the notation of a dialect.
    pub(super) fn for_dialect(dialect: Dialect) -> Self {
        match dialect {
            Dialect::Nx => Self::Modal,
            Dialect::Catia | Dialect::CatiaIcam => Self::Word,
            Dialect::MakinoFf => Self::FromOnly,
            Dialect::CamWorks => Self::Never,
            Dialect::Creo | Dialect::CreoGpost | Dialect::SolidWorks | Dialect::Iso => Self::EveryLine,
        }
    }
}

/// An axis that a motion must state.
#[derive(Debug, Clone, Copy)]
pub(super) struct RequiredAxis {
    /// The axis.
    pub axis: Vector3<f64>,
    /// The first statement that belongs to this motion alone (its RAPID, CIRCLE or INDIRV).
    pub first: StatementId,
}

/// The outcome of writing an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum AxisWriteOutcome {
    /// The axis was written.
    Done,
    /// The axis was written, and MULTAX was inserted before it.
    WithMultax,
    /// The statement cannot hold an axis in this dialect.
    Impossible,
}

/// Writes the axis of a motion, after its own numbers have changed.
///
/// # Errors
/// Returns an error if the new text does not read back.
pub(super) fn write_axis(
    editor: &mut ProgramEditor,
    id: StatementId,
    need: RequiredAxis,
    multi_axis: bool,
    six_values_seen: bool,
) -> Result<AxisWriteOutcome, Failure> {
    let dialect = editor.program().dialect();
    let form = AxisNotation::for_dialect(dialect);
    let record = editor.program().statement(id).record();
    let holds_axis = matches!(record, Record::Goto(_) | Record::From(_) | Record::GoHome(Some(_)));
    let is_from = matches!(record, Record::From(_));
    match form {
        AxisNotation::Word if !multi_axis => {
            let line = format!("TLAXIS/{}", format_catia_axis(editor, need.axis));
            editor.insert_before(need.first, line.as_bytes())?;
            Ok(AxisWriteOutcome::Done)
        }
        AxisNotation::Never => Ok(AxisWriteOutcome::Impossible),
        AxisNotation::FromOnly if !is_from => Ok(AxisWriteOutcome::Impossible),
        _ if !holds_axis => Ok(AxisWriteOutcome::Impossible),
        _ => {
            let multax = match dialect {
                Dialect::Creo | Dialect::CreoGpost => Some("MULTAX / ON"),
                Dialect::Iso if !six_values_seen => Some("MULTAX/ON"),
                _ => None,
            };
            let multax = multax.filter(|_| !multi_axis);
            if let Some(line) = multax {
                editor.insert_before(need.first, line.as_bytes())?;
            }
            append_axis(editor, id, need.axis)?;
            Ok(if multax.is_some() { AxisWriteOutcome::WithMultax } else { AxisWriteOutcome::Done })
        }
    }
}

/// Extends a GOTO of three values to six values.
fn append_axis(editor: &mut ProgramEditor, id: StatementId, axis: Vector3<f64>) -> Result<(), Failure> {
    let statement = editor.program().statement(id);
    let text = editor.program().statement_text(statement);
    let numbers = parse::statement_numbers(text);
    let [_, (second, _), (third, _)] = numbers.as_slice() else { return Ok(()) };
    let end = third.end;
    // The new numbers are separated like the last two numbers of the statement.
    let between = text.get(second.end..third.start).unwrap_or_default();
    // The separator may hold a continuation mark and a line break, which must not be repeated between the new
    // numbers.
    let plain = between.iter().all(|byte| matches!(byte, b' ' | b','));
    let between = if plain { String::from_utf8_lossy(between).into_owned() } else { ",".to_owned() };
    let line_end = editor.style().line_end;
    let dialect = editor.program().dialect();
    let tail = match dialect {
        Dialect::Catia | Dialect::CatiaIcam => format!(",{}", format_catia_axis(editor, axis)),
        // Creo never writes six values on one line.
        Dialect::Creo => format!(",  ${line_end}{}", join_axis_numbers(editor, axis, ", ")),
        Dialect::CreoGpost => format!(",${line_end}{}", join_axis_numbers(editor, axis, ", ")),
        _ => format!("{between}{}", join_axis_numbers(editor, axis, &between)),
    };
    editor.replace_parts(id, &[(end..end, tail.as_bytes())])
}

/// Formats an axis in CATIA's columns: nine characters wide, with six decimals.
fn format_catia_axis(editor: &ProgramEditor, axis: Vector3<f64>) -> String {
    format_axis_numbers(editor, axis).map(|number| format!("{number:>9}")).join(",")
}

fn join_axis_numbers(editor: &ProgramEditor, axis: Vector3<f64>, between: &str) -> String {
    format_axis_numbers(editor, axis).join(between)
}

fn format_axis_numbers(editor: &ProgramEditor, axis: Vector3<f64>) -> [String; 3] {
    let mut form = editor.style().new_format(NumberRole::Direction(0));
    // A file that prints no axis shows no number of decimals for one. These were measured for each dialect.
    form.decimals = match editor.program().dialect() {
        Dialect::Catia | Dialect::CatiaIcam | Dialect::SolidWorks => 6,
        Dialect::Nx | Dialect::MakinoFf => 7,
        Dialect::Creo | Dialect::CreoGpost => 10,
        Dialect::CamWorks | Dialect::Iso => form.decimals,
    };
    [axis.x, axis.y, axis.z].map(|part| form.format_number(part, 0.0))
}

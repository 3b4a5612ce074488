//! Writing out a tool axis that the file leaves unsaid, in the way that its dialect states axes.

use super::walk::Need;
use crate::diagnostic::Diagnostic;
use crate::parse;
use crate::program::{Dialect, Record, Role};
use crate::write::Editor;
use nalgebra::Vector3;

/// How a dialect states tool axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisForm {
    /// Six values where the axis changes; it stays for three-value GOTOs (NX).
    Modal,
    /// Six values in every GOTO whose axis is not z (Creo and ISO under MULTAX, SolidWorks without).
    EveryLine,
    /// A TLAXIS line, and six values under MULTAX (CATIA).
    Word,
    /// Six values in FROM only (Makino FF).
    FromOnly,
    /// Not at all: coordinates stand in the setup (CAMWorks).
    Never,
}

impl AxisForm {
    /// The form of a dialect.
    pub fn of(dialect: Dialect) -> Self {
        match dialect {
            Dialect::Nx => Self::Modal,
            Dialect::Catia | Dialect::CatiaIcam => Self::Word,
            Dialect::MakinoFf => Self::FromOnly,
            Dialect::CamWorks => Self::Never,
            Dialect::Creo | Dialect::CreoGpost | Dialect::SolidWorks | Dialect::Iso => Self::EveryLine,
        }
    }
}

/// What became of a wish for an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Written {
    /// It is written.
    Done,
    /// It is written, and MULTAX was put in before it.
    WithMultax,
    /// The statement cannot hold an axis in this dialect.
    Impossible,
}

/// Writes the axis of a motion out, after its own numbers have changed.
///
/// # Errors
/// When the new text does not read back.
pub fn write(
    editor: &mut Editor,
    index: usize,
    need: Need,
    multi_axis: bool,
    six_values_seen: bool,
) -> Result<Written, Box<Diagnostic>> {
    let dialect = editor.program().dialect();
    let form = AxisForm::of(dialect);
    let Some(record) = editor.program().statement(index).map(crate::program::Statement::record) else {
        return Ok(Written::Impossible);
    };
    let holds_axis = matches!(record, Record::Goto(_) | Record::From(_) | Record::GoHome(Some(_)));
    let is_from = matches!(record, Record::From(_));
    match form {
        AxisForm::Word if !multi_axis => {
            let line = format!("TLAXIS/{}", catia_numbers(editor, need.axis));
            editor.insert_before(need.first, line.as_bytes())?;
            Ok(Written::Done)
        }
        AxisForm::Never => Ok(Written::Impossible),
        AxisForm::FromOnly if !is_from => Ok(Written::Impossible),
        _ if !holds_axis => Ok(Written::Impossible),
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
            extend(editor, index, need.axis)?;
            Ok(if multax.is_some() { Written::WithMultax } else { Written::Done })
        }
    }
}

/// Makes six values of three.
fn extend(editor: &mut Editor, index: usize, axis: Vector3<f64>) -> Result<(), Box<Diagnostic>> {
    let Some(statement) = editor.program().statement(index) else { return Ok(()) };
    let text = editor.program().text(statement);
    let numbers = parse::numbers(text);
    let [_, (second, _), (third, _)] = numbers.as_slice() else { return Ok(()) };
    let end = third.end;
    // What separates the last two numbers separates the new ones too.
    let between = text.get(second.end..third.start).unwrap_or_default();
    let plain = between.iter().all(|byte| matches!(byte, b' ' | b','));
    let between = if plain { String::from_utf8_lossy(between).into_owned() } else { ",".to_owned() };
    let line_end = editor.style().line_end;
    let dialect = editor.program().dialect();
    let tail = match dialect {
        Dialect::Catia | Dialect::CatiaIcam => format!(",{}", catia_numbers(editor, axis)),
        // Creo never writes six values on one line.
        Dialect::Creo => format!(",  ${line_end}{}", joined(editor, axis, ", ")),
        Dialect::CreoGpost => format!(",${line_end}{}", joined(editor, axis, ", ")),
        _ => format!("{between}{}", joined(editor, axis, &between)),
    };
    editor.replace_parts(index, &[(end..end, tail.as_bytes())])
}

/// CATIA's columns for axes: nine wide, six decimals.
fn catia_numbers(editor: &Editor, axis: Vector3<f64>) -> String {
    printed(editor, axis).map(|number| format!("{number:>9}")).join(",")
}

fn joined(editor: &Editor, axis: Vector3<f64>, between: &str) -> String {
    printed(editor, axis).join(between)
}

fn printed(editor: &Editor, axis: Vector3<f64>) -> [String; 3] {
    let mut form = editor.style().fresh(Role::Direction(0));
    // A file that prints no axis shows no decimals for one; these are measured for its dialect.
    form.decimals = match editor.program().dialect() {
        Dialect::Catia | Dialect::CatiaIcam | Dialect::SolidWorks => 6,
        Dialect::Nx | Dialect::MakinoFf => 7,
        Dialect::Creo | Dialect::CreoGpost => 10,
        Dialect::CamWorks | Dialect::Iso => form.decimals,
    };
    [axis.x, axis.y, axis.z].map(|part| form.print(part, 0.0))
}

//! With `change: points`, every number of the path gets its new value.

use super::move_tracker::{MoveRefusal, MoveTracker};
use super::{axis_notation, handedness_words};
use crate::diagnostic::Failure;
use crate::parse;
use crate::program::record::{ArcSense, CutterCompensation};
use crate::program::{NumberRole, Program, Record, StatementId};
use crate::transform::statement_numbers::{self, major_word};
use crate::transform::{Affine, SelectedStatements, StepContext};
use crate::write::{self, ProgramEditor};
use nalgebra::Vector3;

/// Moves the points of the selected operations.
///
/// # Errors
/// Returns an error if the file does not allow the move. The program is lost then, so nothing is left
/// half-moved.
pub(super) fn move_points(
    program: Program,
    place: &Affine,
    scope: &SelectedStatements,
    context: &mut StepContext<'_>,
) -> Result<Program, Failure> {
    let mut walk = MoveTracker::new(place, program.dialect());
    let six_values_seen = program
        .live_statements()
        .any(|(_, it)| matches!(it.record(), Record::Goto(goto) if goto.axis.is_some()));
    let mut editor = ProgramEditor::new(program, context.step);
    let mut plane_reported = false;
    for id in editor.program().statement_ids() {
        let program = editor.program();
        let statement = program.statement(id);
        if !statement.is_live() {
            continue;
        }
        let moved = scope.contains(id);
        let text = program.statement_text(statement);
        let record = statement.record();
        let refused = |refusal: MoveRefusal| {
            context.statement_failure(refusal.message, program, refusal.statement, refusal.label)
        };
        let need = walk.observe_statement(id, record, text, moved).map_err(refused)?;
        if moved {
            if let Some(refusal) = refuse_unmovable(record, text, id) {
                return Err(refused(refusal));
            }
            let edits = compute_edits(record, text, place, walk.is_multi_axis());
            let words = HandednessWords::from_record(record, text);
            if words == HandednessWords::Sides
                && !is_compensation_plane_kept(program, id, record, place, &walk).map_err(refused)?
            {
                if !plane_reported {
                    let message = "this CUTCOM names no plane, and the tool axis it works about turns";
                    context.report_unchanged(message, editor.program(), id);
                }
                plane_reported = true;
            }
            if !edits.is_empty() {
                editor.set_numbers(id, &edits)?;
            }
            if place.has_mirror() {
                match words {
                    HandednessWords::Sides => handedness_words::swap_sides(&mut editor, id)?,
                    HandednessWords::Senses => handedness_words::swap_senses(&mut editor, id)?,
                    HandednessWords::None => {}
                }
            }
        }
        if let Some(need) = need {
            match axis_notation::write_axis(&mut editor, id, need, walk.is_multi_axis(), six_values_seen)? {
                axis_notation::AxisWriteOutcome::Done => {}
                axis_notation::AxisWriteOutcome::WithMultax => walk.note_multax(),
                axis_notation::AxisWriteOutcome::Impossible => {
                    let message = "the transform rotates the tool axis, but this motion cannot state one in this dialect, and nothing \
                                   before it does either";
                    let label = "has the axis 0,0,1 only by default";
                    return Err(context.statement_failure(message, editor.program(), id, label));
                }
            }
        }
    }
    walk.finish().map_err(|refusal| {
        context.statement_failure(refusal.message, editor.program(), refusal.statement, refusal.label)
    })?;
    editor.finish()
}

/// Returns the new values of a statement's numbers.
fn compute_edits(record: &Record, text: &[u8], place: &Affine, multi_axis: bool) -> Vec<(usize, f64)> {
    let in_words = matches!(record, Record::Circle(circle) if circle.sense != ArcSense::OfDialect);
    let change = |role: NumberRole, value: Vector3<f64>| match role {
        NumberRole::Point(_) => Some(place.transform_point(value.into()).coords),
        _ if !place.changes_directions() => None,
        // When the sense of an arc is stated by a word, that word is swapped, and the axis is a plain
        // direction.
        NumberRole::ArcAxis(_) if !in_words => Some(place.transform_arc_axis(value)),
        NumberRole::ArcAxis(_) | NumberRole::Step(_) | NumberRole::Direction(_) => {
            Some(place.transform_vector(value))
        }
        _ => None,
    };
    match record {
        Record::Goto(goto) => {
            let axis = goto.axis.unwrap_or_default();
            let values = [goto.point.x, goto.point.y, goto.point.z, axis.x, axis.y, axis.z];
            let roles =
                [NumberRole::Point(0), NumberRole::Plain, NumberRole::Plain, NumberRole::Direction(0)];
            let count = if goto.axis.is_some() { 4 } else { 1 };
            statement_numbers::map_triples(&values, roles.get(..count).unwrap_or_default(), change)
        }
        Record::Points(_)
        | Record::From(_)
        | Record::GoHome(Some(_))
        | Record::GoDelta(_)
        | Record::Circle(_)
        | Record::MoveArc(_)
        | Record::StartDirection(_)
        | Record::DriveArc(_)
        | Record::AxialArc(_)
        | Record::Known
        | Record::Control(_)
        | Record::ToolAxis(_) => {
            let values: Vec<f64> =
                parse::statement_numbers(text).into_iter().map(|(_, value)| value).collect();
            statement_numbers::map_triples(
                &values,
                &statement_numbers::number_roles(record, text, multi_axis),
                change,
            )
        }
        _ => Vec::new(),
    }
}

/// The words of left and right in a statement.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum HandednessWords {
    None,
    Sides,
    Senses,
}

impl HandednessWords {
    fn from_record(record: &Record, text: &[u8]) -> Self {
        match record {
            Record::CutterCompensation(_) => Self::Sides,
            Record::Known if major_word(text) == "CUTCOM" => Self::Sides,
            Record::Circle(circle) if circle.sense != ArcSense::OfDialect => Self::Senses,
            _ => Self::None,
        }
    }
}

/// Checks that the plane of compensation is still the one that its record means. A plane that is named by a
/// word cannot turn.
fn is_compensation_plane_kept(
    program: &Program,
    id: StatementId,
    record: &Record,
    place: &Affine,
    walk: &MoveTracker<'_>,
) -> Result<bool, MoveRefusal> {
    let normal = handedness_words::named_plane_normal(&write::statement_syntax(program, id));
    match normal {
        Some(normal) if !handedness_words::keeps_plane(place, normal) => Err(MoveRefusal {
            message: "the transform turns the plane of cutter compensation away from the one that CUTCOM names",
            statement: id,
            label: "names its plane",
        }),
        Some(_) => Ok(true),
        None => {
            Ok(!matches!(record, Record::CutterCompensation(CutterCompensation::On(_))) || walk.keeps_axis())
        }
    }
}

/// Refuses motions of part programs that no record describes. Their points cannot be changed, and leaving
/// them would cut through the part.
fn refuse_unmovable(record: &Record, text: &[u8], id: StatementId) -> Option<MoveRefusal> {
    const MOTIONS: &[&str] =
        &["TLON", "TLLFT", "TLRGT", "GOFWD", "GOBACK", "GOLFT", "GORGT", "GOUP", "GODOWN", "POCKET"];
    let stands_in_the_way = *record == Record::Other && {
        let word = major_word(text);
        MOTIONS.iter().any(|motion| word.starts_with(motion))
    };
    stands_in_the_way.then_some(MoveRefusal {
        message: "this motion has a form that clsmith does not understand, so it cannot be moved with the others",
        statement: id,
        label: "would stay where it is",
    })
}

//! With `change: points`, every number of the path gets its new value.

use super::axis_notation::{AxisWriteOutcome, RequiredAxis};
use super::move_tracker::{MoveRefusal, MoveTracker};
use super::moved_statements::MovedStatements;
use super::{axis_notation, handedness_words};
use crate::diagnostic::Failure;
use crate::program::record::{ArcSense, CutterCompensation};
use crate::program::{Program, Record, StatementId};
use crate::transform::statement_numbers::major_word;
use crate::transform::{Affine, SelectedStatements, StepContext};
use crate::write::{self, ProgramEditor};

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
    let six_values_seen = program
        .live_statements()
        .any(|(_, it)| matches!(it.record(), Record::Goto(goto) if goto.axis.is_some()));
    let mut walk = PointWalk {
        place,
        tracker: MoveTracker::new(place, program.dialect()),
        editor: ProgramEditor::new(program, context.step),
        moved: MovedStatements::new(place),
        six_values_seen,
        plane_reported: false,
    };
    let walked = walk.move_statements(scope, context);
    // What stopped at a statement comes behind what stops at one before it.
    walk.moved.move_waiting(&mut walk.editor)?;
    walked?;
    walk.tracker.finish().map_err(|refusal| walk.describe_refusal(refusal, context))?;
    walk.editor.finish()
}

/// A walk through a program that moves its statements.
struct PointWalk<'p> {
    place: &'p Affine,
    tracker: MoveTracker<'p>,
    editor: ProgramEditor,
    moved: MovedStatements<'p>,
    /// Whether a GOTO of the program has an axis.
    six_values_seen: bool,
    /// Whether a CUTCOM that names no plane was reported.
    plane_reported: bool,
}

impl PointWalk<'_> {
    fn describe_refusal(&self, refusal: MoveRefusal, context: &StepContext<'_>) -> Failure {
        context.statement_failure(refusal.message, self.editor.program(), refusal.statement, refusal.label)
    }

    fn move_statements(
        &mut self,
        scope: &SelectedStatements,
        context: &mut StepContext<'_>,
    ) -> Result<(), Failure> {
        for id in self.editor.program().statement_ids() {
            let program = self.editor.program();
            let statement = program.statement(id);
            if !statement.is_live() {
                continue;
            }
            let moved = scope.contains(id);
            let (record, text) = (statement.record(), program.statement_text(statement));
            let observed = self.tracker.observe_statement(id, record, text, moved);
            let refusal = if moved { refuse_unmovable(record, text, id) } else { None };
            let words =
                if moved { HandednessWords::from_record(record, text) } else { HandednessWords::None };
            let moves = moved && MovedStatements::has_place(record);
            let need = observed.map_err(|refusal| self.describe_refusal(refusal, context))?;
            if let Some(refusal) = refusal {
                return Err(self.describe_refusal(refusal, context));
            }
            if words == HandednessWords::Sides {
                self.check_compensation_plane(id, context)?;
            }
            if moves {
                self.moved.add(id, self.tracker.is_multi_axis(), &mut self.editor)?;
            }
            if self.place.has_mirror() && words != HandednessWords::None {
                self.moved.move_waiting(&mut self.editor)?;
                match words {
                    HandednessWords::Sides => handedness_words::swap_sides(&mut self.editor, id)?,
                    HandednessWords::Senses => handedness_words::swap_senses(&mut self.editor, id)?,
                    HandednessWords::None => {}
                }
            }
            if let Some(need) = need {
                self.write_axis(id, need, context)?;
            }
        }
        Ok(())
    }

    /// Checks the plane of a CUTCOM, and reports the first one that names none and turns.
    fn check_compensation_plane(
        &mut self,
        id: StatementId,
        context: &mut StepContext<'_>,
    ) -> Result<(), Failure> {
        let program = self.editor.program();
        let record = program.statement(id).record();
        let kept = is_compensation_plane_kept(program, id, record, self.place, &self.tracker)
            .map_err(|refusal| self.describe_refusal(refusal, context))?;
        if !kept && !self.plane_reported {
            self.plane_reported = true;
            self.moved.move_waiting(&mut self.editor)?;
            let message = "this CUTCOM names no plane, and the tool axis it works about turns";
            context.report_unchanged(message, self.editor.program(), id);
        }
        Ok(())
    }

    fn write_axis(
        &mut self,
        id: StatementId,
        need: RequiredAxis,
        context: &StepContext<'_>,
    ) -> Result<(), Failure> {
        self.moved.move_waiting(&mut self.editor)?;
        let multi_axis = self.tracker.is_multi_axis();
        match axis_notation::write_axis(&mut self.editor, id, need, multi_axis, self.six_values_seen)? {
            AxisWriteOutcome::Done => {}
            AxisWriteOutcome::WithMultax => self.tracker.note_multax(),
            AxisWriteOutcome::Impossible => {
                let message = "the transform rotates the tool axis, but this motion cannot state one in this dialect, and nothing \
                               before it does either";
                let label = "has the axis 0,0,1 only by default";
                return Err(context.statement_failure(message, self.editor.program(), id, label));
            }
        }
        Ok(())
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

//! Ends of motions around passes, in the CL text.

use super::pass_writer::{PassWriter, UnwritableMotion, delete_announcements, is_motion_record};
use crate::diagnostic::Failure;
use crate::parse;
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::program::{NumberRole, Record};
use crate::transform::statement_numbers::map_triples;
use crate::write::ProgramEditor;
use nalgebra::{Point3, Vector3};

impl PassWriter<'_> {
    /// Gives a motion that stays another end; an arc whose ends no longer move alike becomes straight.
    ///
    /// # Errors
    /// When a statement does not read back, and for records that cannot be moved.
    pub fn move_end(
        &self,
        editor: &mut ProgramEditor,
        index: usize,
        end: Point3<f64>,
        start: Point3<f64>,
    ) -> Result<Result<(), UnwritableMotion>, Failure> {
        let Some(motion) = self.motions.get(index) else {
            debug_assert!(false, "motion {index} of {} gets another end", self.motions.len());
            return Ok(Err(UnwritableMotion::NoGoto));
        };
        let (by, from) =
            (end - motion.to.point * self.mm_per_unit, start - motion.from.point * self.mm_per_unit);
        let last = motion.last_statement();
        let moves = |by: Vector3<f64>| by.amax() > 1e-9;
        let record = editor.program().statement(last).record();
        if moves(from) && matches!(record, Record::GoDelta(_)) {
            // A step from a place that has moved would end elsewhere.
            return Ok(Err(UnwritableMotion::NoGoto));
        }
        match &motion.path {
            MotionPath::Line | MotionPath::Start if moves(by) => {
                editor.set_numbers(last, &self.point_numbers(end))?;
            }
            MotionPath::Arc(_) if moves(by) || moves(from) => {
                if let Err(why) = self.check_writable(editor.program(), index) {
                    return Ok(Err(why));
                }
                if (by - from).amax() <= 1e-6 {
                    self.shift_points(editor, motion, by)?;
                } else if matches!(editor.program().statement(last).record(), Record::Goto(_)) {
                    delete_announcements(editor, motion)?;
                    editor.set_numbers(last, &self.point_numbers(end))?;
                } else {
                    return Ok(Err(UnwritableMotion::Arc));
                }
            }
            MotionPath::Spline(_) if moves(by) || moves(from) => {
                if (by - from).amax() > 1e-6 {
                    return Ok(Err(UnwritableMotion::Arc));
                }
                self.shift_points(editor, motion, by)?;
            }
            _ => {}
        }
        Ok(Ok(()))
    }

    /// Moves all points of a motion's statements.
    fn shift_points(
        &self,
        editor: &mut ProgramEditor,
        motion: &Motion,
        by: Vector3<f64>,
    ) -> Result<(), Failure> {
        for statement in motion.statements.ids() {
            let program = editor.program();
            let found = program.statement(statement);
            if !found.is_live() || !is_motion_record(found.record()) {
                continue;
            }
            let text = program.statement_text(found);
            let values: Vec<f64> =
                parse::statement_numbers(text).into_iter().map(|(_, value)| value).collect();
            let roles = parse::number_roles(found.record(), text);
            let edits = map_triples(&values, &roles, |role, point| {
                matches!(role, NumberRole::Point(0)).then(|| point + by / self.mm_per_unit)
            });
            editor.set_numbers(statement, &edits)?;
        }
        Ok(())
    }
}

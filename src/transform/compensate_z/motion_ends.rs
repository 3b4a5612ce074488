//! This module writes new ends of motions around passes into the CL text.

use super::pass_writer::{PassWriter, UnwritableMotion, WriteFault, delete_announcements, is_motion_record};
use crate::diagnostic::Failure;
use crate::parse;
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::program::{NumberRole, Record};
use crate::transform::statement_numbers::map_triples;
use crate::write::ProgramEditor;
use nalgebra::{Point3, Vector3};

impl PassWriter<'_> {
    /// Gives a motion another end. An arc whose two ends are not displaced alike becomes straight.
    ///
    /// # Errors
    /// Returns an error if a statement does not read back, and for records that cannot be moved.
    pub(super) fn move_end(
        &self,
        editor: &mut ProgramEditor,
        index: usize,
        end: Point3<f64>,
        start: Point3<f64>,
    ) -> Result<(), WriteFault> {
        let Some(motion) = self.motions.get(index) else {
            debug_assert!(false, "motion {index} of {} does not exist", self.motions.len());
            return Err(UnwritableMotion::NoGoto.into());
        };
        let (by, from) =
            (end - motion.to.point * self.mm_per_unit, start - motion.from.point * self.mm_per_unit);
        let last = motion.last_statement();
        let moves = |by: Vector3<f64>| by.amax() > 1e-9;
        let record = editor.program().statement(last).record();
        if moves(from) && matches!(record, Record::GoDelta(_)) {
            // GODLTA states a displacement, so it would end elsewhere when its start has moved.
            return Err(UnwritableMotion::NoGoto.into());
        }
        match &motion.path {
            MotionPath::Line | MotionPath::Start if moves(by) => {
                editor.set_numbers(last, &self.point_numbers(end))?;
            }
            MotionPath::Arc(_) if moves(by) || moves(from) => {
                self.check_writable(editor.program(), index)?;
                // An arc that moves as a whole keeps its shape; with unequal ends no circle of its record
                // fits.
                if (by - from).amax() <= 1e-6 {
                    self.shift_points(editor, motion, by)?;
                } else if matches!(editor.program().statement(last).record(), Record::Goto(_)) {
                    delete_announcements(editor, motion)?;
                    editor.set_numbers(last, &self.point_numbers(end))?;
                } else {
                    return Err(UnwritableMotion::Arc.into());
                }
            }
            MotionPath::Spline(_) if moves(by) || moves(from) => {
                if (by - from).amax() > 1e-6 {
                    return Err(UnwritableMotion::Arc.into());
                }
                self.shift_points(editor, motion, by)?;
            }
            _ => {}
        }
        Ok(())
    }

    /// Displaces all points of a motion's statements.
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

//! Ends of motions around passes, in the CL text.

use super::write::{Unwritable, Writer, drop_announced, is_motion};
use crate::diagnostic::Diagnostic;
use crate::parse;
use crate::program::geometry::Path;
use crate::program::motion::Motion;
use crate::program::{Record, Role, Statement};
use crate::transform::numbers::change_triples;
use crate::write::Editor;
use nalgebra::{Point3, Vector3};

impl Writer<'_> {
    /// Gives a motion that stays another end; an arc whose ends no longer move alike becomes straight.
    ///
    /// # Errors
    /// When a statement does not read back, and for records that cannot be moved.
    pub fn move_end(
        &self,
        editor: &mut Editor,
        index: usize,
        end: Point3<f64>,
        start: Point3<f64>,
    ) -> Result<Result<(), Unwritable>, Box<Diagnostic>> {
        let Some(motion) = self.motions.get(index) else { return Ok(Ok(())) };
        let (by, from) = (end - motion.to.point * self.mm, start - motion.from.point * self.mm);
        let last = motion.last_statement();
        let moves = |by: Vector3<f64>| by.amax() > 1e-9;
        let record = editor.program().statement(last).map(Statement::record);
        if moves(from) && matches!(record, Some(Record::GoDelta(_))) {
            // A step from a place that has moved would end elsewhere.
            return Ok(Err(Unwritable::NoGoto));
        }
        match &motion.path {
            Path::Line | Path::Start if moves(by) => {
                editor.set_numbers(last, &self.numbers(end))?;
            }
            Path::Arc(_) if moves(by) || moves(from) => {
                if let Err(why) = self.check(editor.program(), index) {
                    return Ok(Err(why));
                }
                if (by - from).amax() <= 1e-6 {
                    self.shift(editor, motion, by)?;
                } else if matches!(
                    editor.program().statement(last).map(Statement::record),
                    Some(Record::Goto(_))
                ) {
                    drop_announced(editor, motion);
                    editor.set_numbers(last, &self.numbers(end))?;
                } else {
                    return Ok(Err(Unwritable::Arc));
                }
            }
            Path::Spline(_) if moves(by) || moves(from) => {
                if (by - from).amax() > 1e-6 {
                    return Ok(Err(Unwritable::Arc));
                }
                self.shift(editor, motion, by)?;
            }
            _ => {}
        }
        Ok(Ok(()))
    }

    /// Moves all points of a motion's statements.
    fn shift(&self, editor: &mut Editor, motion: &Motion, by: Vector3<f64>) -> Result<(), Box<Diagnostic>> {
        for statement in motion.statements.clone() {
            let program = editor.program();
            let Some(found) = program.statement(statement).filter(|found| found.is_live()) else { continue };
            if !is_motion(found.record()) {
                continue;
            }
            let text = program.text(found);
            let values: Vec<f64> = parse::numbers(text).into_iter().map(|(_, value)| value).collect();
            let roles = parse::roles(found.record(), text);
            let edits = change_triples(&values, &roles, |role, point| {
                matches!(role, Role::Point(0)).then(|| point + by / self.mm)
            });
            editor.set_numbers(statement, &edits)?;
        }
        Ok(())
    }
}

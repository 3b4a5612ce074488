//! This module checks tool axes and axes of arcs: their length, MULTAX, and jumps.

use super::{Lint, LintFindings};
use crate::diagnostic::codes;
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::program::{Dialect, Record, Statement, StatementId};
use nalgebra::Vector3;
use std::ops::Range;

/// Rounding to three decimals stays below this. Hand-written axes have at least three.
const UNIT_TOLERANCE: f64 = 1e-3;

/// Numbers that are off by more than this are not an axis that was rounded or mistyped in its last digits.
const NO_AXIS_FROM: f64 = 0.1;

/// Reports axes that are no unit vectors.
#[derive(Default)]
pub(super) struct UnitAxisLint;

impl Lint for UnitAxisLint {
    fn check_statement(&mut self, id: StatementId, statement: &Statement, found: &mut LintFindings<'_>) {
        let (axis, place) = match statement.record() {
            Record::Goto(goto) => match &goto.axis {
                Some(axis) => (axis, 3..6),
                None => return,
            },
            Record::From(goto) | Record::GoHome(Some(goto)) => match &goto.axis {
                Some(axis) => (axis, 3..6),
                None => return,
            },
            Record::ToolAxis(axis) => (axis.as_ref(), 0..3),
            Record::Circle(circle) => (&circle.axis, 3..6),
            Record::MoveArc(arc) => (&arc.axis, 3..6),
            _ => return,
        };
        // The square is compared first, which saves 1.6 million square roots in a large file.
        if (axis.norm_squared() - 1.0).abs() > UNIT_TOLERANCE {
            report_axis(id, axis, place, found);
        }
    }
}

fn report_axis(id: StatementId, axis: &Vector3<f64>, place: Range<usize>, found: &mut LintFindings<'_>) {
    let length = axis.norm();
    let off = (length - 1.0).abs();
    if off <= UNIT_TOLERANCE {
        return;
    }
    let span = found.numbers_span(id, place);
    if off > NO_AXIS_FROM {
        let message = format!("these numbers are no axis: their length is {length:.4}, not 1");
        found.report(codes::NO_AXIS, span, message, "not a direction");
    } else {
        let message = format!("this axis has the length {length:.6}, not 1");
        found.report(codes::AXIS_NOT_UNIT, span, message, "");
    }
}

/// Axes with a smaller squared sine of their angle are the same axis. It is half a hundredth of a degree.
const SAME_AXIS: f64 = 1e-8;

/// Reports an axis that changes without MULTAX, in the dialects that write it.
#[derive(Default)]
pub(super) struct MultaxLint {
    on: bool,
    axis: Option<Vector3<f64>>,
    reported: bool,
}

impl Lint for MultaxLint {
    fn check_statement(&mut self, id: StatementId, statement: &Statement, found: &mut LintFindings<'_>) {
        match statement.record() {
            Record::MultiAxis(on) => (self.on, self.reported) = (*on, false),
            Record::ToolAxis(axis) => self.axis = Some(**axis),
            Record::Goto(goto) => {
                let Some(axis) = goto.axis else { return };
                let before = self.axis.replace(axis);
                if self.on || self.reported || !writes_multax(found.program.dialect()) {
                    return;
                }
                if before.is_some_and(|before| (axis - before).norm_squared() > SAME_AXIS) {
                    self.reported = true;
                    let message = "the tool axis changes here, but MULTAX is not on";
                    found.report(
                        codes::AXIS_WITHOUT_MULTAX,
                        found.numbers_span(id, 3..6),
                        message,
                        "another axis",
                    );
                }
            }
            _ => {}
        }
    }
}

fn writes_multax(dialect: Dialect) -> bool {
    matches!(dialect, Dialect::Catia | Dialect::CatiaIcam | Dialect::Creo | Dialect::CreoGpost)
}

/// The cosine of 45 degrees. A feed motion that turns the axis farther is reported.
const JUMP_COSINE: f64 = std::f64::consts::FRAC_1_SQRT_2;

/// Reports axes that turn far within one feed motion.
#[derive(Default)]
pub(super) struct AxisJumpLint {
    /// Whether the axis was set by a record of its own, or an operation has begun. Then the next motion does
    /// not interpolate it.
    set: bool,
}

impl Lint for AxisJumpLint {
    fn check_statement(&mut self, _id: StatementId, statement: &Statement, _found: &mut LintFindings<'_>) {
        self.set |= matches!(statement.record(), Record::ToolAxis(_) | Record::OperationStart(_));
    }

    fn check_motion(&mut self, motion: &Motion, found: &mut LintFindings<'_>) {
        if std::mem::take(&mut self.set) {
            return;
        }
        let (from, to) = (motion.from.axis, motion.to.axis);
        let cosine = from.dot(&to);
        // Axes that are no unit vectors have a finding of their own.
        if cosine >= JUMP_COSINE
            || matches!(motion.path, MotionPath::Start)
            || from.norm() < 0.9
            || to.norm() < 0.9
        {
            return;
        }
        if found.is_cutting_motion(motion) {
            let degrees = (cosine / (from.norm() * to.norm())).clamp(-1.0, 1.0).acos().to_degrees();
            let message = format!("the tool axis turns by {degrees:.1} degrees in this feed motion");
            let span = found.numbers_span(motion.last_statement(), 3..6);
            found.report(codes::AXIS_JUMP, span, message, "");
        }
    }
}

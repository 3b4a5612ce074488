//! This module checks arcs, splines and rapids: the problems that motions met, and arcs at rapid.

use super::{Lint, LintFindings};
use crate::diagnostic::{DiagnosticCode, codes};
use crate::number::format_trimmed_number;
use crate::program::geometry::{MotionPath, PathEnd, SAME_POINT};
use crate::program::motion::{Motion, MotionProblem, MotionProblemKind};
use crate::program::{NumberRole, Record, StatementId, StatementRange};
use crate::source::Span;
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};

pub(super) const CODES: &[DiagnosticCode] = &[
    codes::RAPID_WITHOUT_MOTION,
    codes::ARC_WITHOUT_END,
    codes::ARC_END_OFF_CIRCLE,
    codes::ARC_RADIUS_DIFFERS,
    codes::ARC_ROUGH,
    codes::UNKNOWN_START,
    codes::TANGENT_MISMATCH,
    codes::BROKEN_SPLINE,
    codes::ASSUMED_SENSE,
    codes::SENSE_FROM_ANGLE,
    codes::BROKEN_FRAME,
];

/// No control refuses an arc for an error below this, in mm.
const REFUSED_FROM: f64 = 0.01;

/// Reports the problems that the state machine of motions has met.
#[derive(Default)]
pub(super) struct MotionProblemLint;

impl Lint for MotionProblemLint {
    fn check_problem(
        &mut self,
        problem: &MotionProblem,
        motion: Option<&Motion>,
        found: &mut LintFindings<'_>,
    ) {
        let at = problem.statement;
        let (code, message, label) = match &problem.kind {
            MotionProblemKind::RapidWithoutMotion => {
                (codes::RAPID_WITHOUT_MOTION, "no motion follows this RAPID".to_owned(), "")
            }
            MotionProblemKind::ArcWithoutEnd => {
                (codes::ARC_WITHOUT_END, "this arc has no end point".to_owned(), "")
            }
            MotionProblemKind::ArcEndOffCircle(off) => return report_end_off_circle(at, *off, motion, found),
            MotionProblemKind::ArcStartOffCircle(off) => return report_radius_difference(at, *off, found),
            MotionProblemKind::UnknownStart => {
                (codes::UNKNOWN_START, "the position of the tool before this is not known".to_owned(), "")
            }
            MotionProblemKind::TangentMismatch => {
                let message = "the start direction and the arc contradict each other".to_owned();
                (codes::TANGENT_MISMATCH, message, "this arc, with the INDIRV before it")
            }
            MotionProblemKind::ArcPointsOffCircle(off) => {
                let code = choose_code(codes::ARC_END_OFF_CIRCLE, *off, found);
                let message =
                    format!("points of this arc are up to {} off its circle", format_off(*off, found));
                (code, message, "the arc")
            }
            MotionProblemKind::ArcPointsOutOfOrder => {
                let message =
                    "the points of this arc go back and forth on it, so its sweep is not known".to_owned();
                (codes::TANGENT_MISMATCH, message, "this arc")
            }
            MotionProblemKind::TurnsDiffer { turns, degrees } => {
                let print = |value: f64| format_trimmed_number(value, 4);
                let message = format!(
                    "ROUND says {} turns ({} degrees), but ANGLE {} degrees; the angle was followed",
                    print(*turns),
                    print(*turns * 360.0),
                    print(*degrees)
                );
                (codes::TANGENT_MISMATCH, message, "this helix")
            }
            MotionProblemKind::BrokenSpline => (
                codes::BROKEN_SPLINE,
                "the knots and control points of this spline do not match".to_owned(),
                "",
            ),
            MotionProblemKind::AssumedSense => {
                let message = "nothing states the sense of this arc; right-hand was assumed".to_owned();
                return found.report(
                    codes::ASSUMED_SENSE,
                    axis_span(at, found),
                    message,
                    "counter-clockwise about this axis",
                );
            }
            MotionProblemKind::SenseFromAngle => {
                let message =
                    "the angle of this arc tells the other sense than its axis; the angle was followed";
                return found.report(codes::SENSE_FROM_ANGLE, axis_span(at, found), message, "");
            }
            MotionProblemKind::BrokenFrame => {
                (codes::BROKEN_FRAME, "three rows of four numbers should follow this mark".to_owned(), "")
            }
        };
        found.report(code, found.word_span(at), message, label);
    }
}

fn axis_span(at: StatementId, found: &LintFindings<'_>) -> Span {
    found.numbers_span(at, 3..6)
}

fn report_end_off_circle(at: StatementId, off: f64, motion: Option<&Motion>, found: &mut LintFindings<'_>) {
    let code = choose_code(codes::ARC_END_OFF_CIRCLE, off, found);
    let message = format!("the end of this arc is {} off its circle", format_off(off, found));
    let arc = (found.statement_span(at), "the arc");
    match motion {
        Some(motion) if motion.last_statement() != at => {
            found.report_at_two_spans(code, message, (found.end_point_span(motion), "ends here"), arc);
        }
        Some(motion) => found.report(code, found.end_point_span(motion), message, "the end"),
        None => found.report(code, arc.0, message, ""),
    }
}

fn report_radius_difference(at: StatementId, off: f64, found: &mut LintFindings<'_>) {
    let code = choose_code(codes::ARC_RADIUS_DIFFERS, off, found);
    let message = format!(
        "the radius is {} off the distance from the centre to where the tool starts",
        format_off(off, found)
    );
    let span = match found.program.statement(at).record() {
        Record::Circle(_) => found.numbers_span(at, 6..7),
        _ => found.role_span(at, NumberRole::Length),
    };
    found.report(code, span, message, "this radius");
}

/// A distance; coordinates of hundreds of digits are farther apart than numbers reach.
fn format_off(off: f64, found: &LintFindings<'_>) -> String {
    if off.is_finite() { found.format_length(off) } else { "immeasurably far".to_owned() }
}

fn choose_code(code: DiagnosticCode, off: f64, found: &LintFindings<'_>) -> DiagnosticCode {
    if off < found.mm_to_file_unit(REFUSED_FROM) { codes::ARC_ROUGH } else { code }
}

/// Arcs that turn back where the path comes from and where it goes, although their other sense would go on smoothly.
#[derive(Default)]
pub(super) struct OtherSenseLint {
    /// The end of the feed motion before.
    before: Option<PathEnd>,
    /// The arc that starts against it, its tangent at the end, and its sweep in degrees.
    arc: Option<(StatementRange, Vector3<f64>, f64)>,
}

/// The cosine beyond which two tangents are opposite: 8 degrees.
const OPPOSITE: f64 = -0.99;

impl Lint for OtherSenseLint {
    fn check_motion(&mut self, motion: &Motion, found: &mut LintFindings<'_>) {
        if let Some((statements, end, degrees)) = self.arc.take()
            && let Some(start) = start_tangent(motion)
            && end.dot(&start) < OPPOSITE
        {
            let message = format!(
                "this arc of {degrees:.0} degrees turns back at both ends; the other sense ({:.0} degrees) would be tangent",
                360.0 - degrees
            );
            let span = found.statement_span(statements.first());
            found.report(codes::OTHER_SENSE_FITS, span, message, "the sense of this arc");
        }
        // A cusp in a corner is the smaller part of its circle; only the larger part is suspicious.
        if let (MotionPath::Arc(arc), Some(before)) = (&motion.path, self.before)
            && (PI..TAU - 1e-3).contains(&arc.sweep)
            && let Some(start) = start_tangent(motion)
            && before.tangent().dot(&start) < OPPOSITE
        {
            self.arc = Some((motion.statements, arc.tangent_at(1.0), arc.sweep.to_degrees()));
        }
        self.before = match motion.rapid {
            true => None,
            false => motion.path.end_direction(motion.from.point, motion.to.point).or(self.before),
        };
    }
}

/// Returns the unit tangent at the start of a line or an arc at feed.
fn start_tangent(motion: &Motion) -> Option<Vector3<f64>> {
    match &motion.path {
        _ if motion.rapid => None,
        MotionPath::Arc(arc) => Some(arc.tangent_at(0.0)),
        MotionPath::Line => (motion.to.point - motion.from.point).try_normalize(SAME_POINT),
        MotionPath::Spline(_) | MotionPath::Start => None,
    }
}

/// Arcs and splines at rapid.
#[derive(Default)]
pub(super) struct RapidArcLint;

impl Lint for RapidArcLint {
    fn check_motion(&mut self, motion: &Motion, found: &mut LintFindings<'_>) {
        if !motion.rapid {
            return;
        }
        let what = match motion.path {
            MotionPath::Arc(_) => "arc",
            MotionPath::Spline(_) => "spline",
            MotionPath::Line | MotionPath::Start => return,
        };
        let span = found.statement_span(motion.last_statement());
        found.report(codes::RAPID_ARC, span, format!("this {what} is to be driven at rapid"), "");
    }
}

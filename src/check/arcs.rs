//! Arcs, splines and rapids: what the motions found wrong, and arcs at rapid.

use super::{Findings, Lint};
use crate::diagnostic::{Code, codes};
use crate::program::geometry::Path;
use crate::program::motion::{Motion, Problem, ProblemKind};
use crate::program::{Record, Role};
use crate::source::Span;

pub(super) const CODES: &[Code] = &[
    codes::RAPID_WITHOUT_MOTION,
    codes::ARC_WITHOUT_END,
    codes::ARC_END_OFF_CIRCLE,
    codes::ARC_RADIUS_DIFFERS,
    codes::ARC_ROUGH,
    codes::UNKNOWN_START,
    codes::TANGENT_MISMATCH,
    codes::BROKEN_SPLINE,
    codes::ASSUMED_SENSE,
    codes::BROKEN_FRAME,
];

/// Below this many millimetres no control refuses an arc.
const REFUSED_FROM: f64 = 0.01;

/// The problems that the state machine of motions reports.
#[derive(Default)]
pub(super) struct Problems;

impl Lint for Problems {
    fn problem(&mut self, problem: &Problem, motion: Option<&Motion>, found: &mut Findings<'_>) {
        let at = problem.statement;
        let (code, message, label) = match &problem.kind {
            ProblemKind::RapidWithoutMotion => {
                (codes::RAPID_WITHOUT_MOTION, "no motion follows this RAPID".to_owned(), "")
            }
            ProblemKind::ArcWithoutEnd => {
                (codes::ARC_WITHOUT_END, "this arc has no end point".to_owned(), "")
            }
            ProblemKind::ArcEndOffCircle(off) => return end_off_circle(at, *off, motion, found),
            ProblemKind::ArcStartOffCircle(off) => return radius_differs(at, *off, found),
            ProblemKind::UnknownStart => {
                (codes::UNKNOWN_START, "it is not known where the tool is before this".to_owned(), "")
            }
            ProblemKind::TangentMismatch => {
                let message = "the start direction and the arc do not fit each other".to_owned();
                (codes::TANGENT_MISMATCH, message, "this arc, with the INDIRV before it")
            }
            ProblemKind::BrokenSpline => (
                codes::BROKEN_SPLINE,
                "the knots and control points of this spline do not fit".to_owned(),
                "",
            ),
            ProblemKind::AssumedSense => {
                let message = "nothing tells the sense of this arc; right-hand was assumed".to_owned();
                return found.report(
                    codes::ASSUMED_SENSE,
                    axis(at, found),
                    message,
                    "counter-clockwise about this axis",
                );
            }
            ProblemKind::BrokenFrame => {
                (codes::BROKEN_FRAME, "three rows of four numbers should follow this mark".to_owned(), "")
            }
        };
        found.report(code, found.word(at), message, label);
    }
}

fn axis(at: usize, found: &Findings<'_>) -> Span {
    found.numbers(at, 3..6)
}

fn end_off_circle(at: usize, off: f64, motion: Option<&Motion>, found: &mut Findings<'_>) {
    let code = code_of(codes::ARC_END_OFF_CIRCLE, off, found);
    let message = format!("the end of this arc is {} off its circle", found.length(off));
    let arc = (found.whole(at), "the arc");
    match motion {
        Some(motion) if motion.last_statement() != at => {
            found.report_two(code, message, (found.end_point(motion), "ends here"), arc);
        }
        Some(motion) => found.report(code, found.end_point(motion), message, "the end"),
        None => found.report(code, arc.0, message, ""),
    }
}

fn radius_differs(at: usize, off: f64, found: &mut Findings<'_>) {
    let code = code_of(codes::ARC_RADIUS_DIFFERS, off, found);
    let message = format!(
        "the radius is {} off the distance from the centre to where the tool starts",
        found.length(off)
    );
    let span = match found.program.statement(at).map(|statement| statement.record()) {
        Some(Record::Circle(_)) => found.numbers(at, 6..7),
        _ => found.role(at, Role::Length),
    };
    found.report(code, span, message, "this radius");
}

fn code_of(code: Code, off: f64, found: &Findings<'_>) -> Code {
    if off < found.millimetres(REFUSED_FROM) { codes::ARC_ROUGH } else { code }
}

/// Arcs and splines at rapid.
#[derive(Default)]
pub(super) struct RapidArc;

impl Lint for RapidArc {
    fn motion(&mut self, motion: &Motion, found: &mut Findings<'_>) {
        if !motion.rapid {
            return;
        }
        let what = match motion.path {
            Path::Arc(_) => "arc",
            Path::Spline(_) => "spline",
            Path::Line | Path::Start => return,
        };
        let span = found.whole(motion.last_statement());
        found.report(codes::RAPID_ARC, span, format!("this {what} is to be driven at rapid"), "");
    }
}

//! This module checks frames whose axes are no perpendicular unit vectors, or whose axes mirror.

use super::{Lint, LintFindings};
use crate::diagnostic::codes;
use crate::number::count_decimals;
use crate::program::record::FrameWord;
use crate::program::{Record, Statement, StatementId};
use crate::source::Span;
use nalgebra::Matrix3;

/// Checks the frames of records, and those of CATIA in comments.
#[derive(Default)]
pub(super) struct FrameLint {
    /// The rows of a CATIA0 matrix: their statements and numbers.
    rows: Option<Vec<(StatementId, [f64; 4])>>,
}

impl Lint for FrameLint {
    fn check_statement(&mut self, id: StatementId, statement: &Statement, found: &mut LintFindings<'_>) {
        match statement.record() {
            Record::Frame(frame) => {
                let axes = match (frame.word, frame.numbers.as_slice()) {
                    (FrameWord::Msys, [_, _, _, a, b, c, d, e, f]) => {
                        // The third axis is the cross product of the others, so two perpendicular unit
                        // vectors make a frame.
                        let (x, y) = (nalgebra::Vector3::new(*a, *b, *c), nalgebra::Vector3::new(*d, *e, *f));
                        Matrix3::from_columns(&[x, y, x.cross(&y)])
                    }
                    (FrameWord::Csys, [a, b, c, _, d, e, f, _, g, h, i, _]) => {
                        Matrix3::new(*a, *b, *c, *d, *e, *f, *g, *h, *i)
                    }
                    _ => return,
                };
                check_axes(&axes, &[id], found);
            }
            Record::FrameMark => self.rows = Some(Vec::new()),
            Record::MatrixRow(row) => {
                let Some(rows) = &mut self.rows else { return };
                rows.push((id, **row));
                if let [(first, a), (second, b), (third, c)] = rows.as_slice() {
                    let axes = Matrix3::new(a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]);
                    let places = [*first, *second, *third];
                    self.rows = None;
                    check_axes(&axes, &places, found);
                }
            }
            Record::Comment => {}
            _ => self.rows = None,
        }
    }
}

fn check_axes(axes: &Matrix3<f64>, places: &[StatementId], found: &mut LintFindings<'_>) {
    let off = (axes.transpose() * axes - Matrix3::identity()).abs().max();
    // The grammar is only asked for the decimals if they matter.
    if off > 1e-12 && off > rounding_tolerance(places, found) {
        let message = format!("the axes of this frame are off perpendicular unit vectors by {off:.6}");
        found.report(codes::FRAME_SKEWED, frame_span(places, found), message, "");
    } else if axes.determinant() < 0.0 {
        found.report(
            codes::FRAME_LEFT_HANDED,
            frame_span(places, found),
            "the axes of this frame are left-handed",
            "",
        );
    }
}

/// Returns the error that rounding explains. Each component is off by half its last decimal, and a product of
/// two axes by twice the square root of three of that. Files that omit trailing zeros are assumed to have
/// three decimals.
fn rounding_tolerance(places: &[StatementId], found: &LintFindings<'_>) -> f64 {
    let of = |id: &StatementId| {
        let syntax = found.statement_syntax(*id);
        syntax.numbers().iter().map(|(at, _)| count_decimals(syntax.bytes_at(at))).max().unwrap_or(0)
    };
    let printed = places.iter().map(of).max().unwrap_or(0).clamp(3, 12);
    2.0 * 10f64.powi(-(printed as i32))
}

fn frame_span(places: &[StatementId], found: &LintFindings<'_>) -> Span {
    match (places.first(), places.last()) {
        (Some(first), Some(last)) => {
            Span { start: found.statement_span(*first).start, end: found.statement_span(*last).end }
        }
        _ => {
            debug_assert!(false, "a frame has a statement at least");
            Span::default()
        }
    }
}

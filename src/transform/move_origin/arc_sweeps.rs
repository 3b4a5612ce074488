//! This module checks arcs after a move. An arc whose sweep was reversed by rounding is found before anything
//! is written.
//!
//! The end of an arc of a few microns may be rounded onto its start, which every reader takes for a full
//! circle.

use crate::program::Program;
use crate::program::geometry::MotionPath;
use crate::source::Span;
use std::f64::consts::PI;

/// An arc of the program before the move.
pub(super) struct ArcSweep {
    /// The place in the source of the statement that ends it.
    place: Span,
    /// The sweep in radians.
    sweep: f64,
}

/// Returns all arcs of a program in order.
pub(super) fn collect_sweeps(program: &Program) -> Vec<ArcSweep> {
    let mut sweeps = Vec::new();
    program.motions().for_each_motion(|motion| {
        if let MotionPath::Arc(arc) = &motion.path {
            let place = program.statement(motion.last_statement()).origin();
            sweeps.push(ArcSweep { place, sweep: arc.sweep });
        }
    });
    sweeps
}

/// Compares the arcs after a move with those before it.
///
/// # Errors
/// Returns the place of the first arc that has gained or lost most of a turn, or that is no arc any more.
pub(super) fn check_sweeps(program: &Program, before: &[ArcSweep]) -> Result<(), Span> {
    let mut before = before.iter();
    for after in collect_sweeps(program) {
        // Moving a program keeps the sweep of its arcs, and rounding changes it very little. A change by more
        // than half a turn means that a short arc is read as a full turn now, or the other way round.
        if before.next().is_none_or(|before| (before.sweep - after.sweep).abs() > PI) {
            return Err(after.place);
        }
    }
    before.next().map_or(Ok(()), |lost| Err(lost.place))
}

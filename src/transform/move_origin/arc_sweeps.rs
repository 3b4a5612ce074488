//! Arcs after a move: a sweep that rounding has turned round is found before anything is written.
//!
//! The end of an arc of a few microns may round onto its start, which every reader takes for a full circle.

use super::move_tracker::MoveRefusal;
use crate::program::Program;
use crate::program::geometry::MotionPath;
use std::f64::consts::PI;

/// Sweeps of all arcs of a program, in order, in radians.
pub fn collect_sweeps(program: &Program) -> Vec<f64> {
    iter_arcs(program).map(|(_, sweep)| sweep).collect()
}

/// Compares the sweeps after a move with those before it.
///
/// # Errors
/// The first arc that has gained or lost most of a turn, or has become something else.
pub fn check_sweeps(program: &Program, before: &[f64]) -> Result<(), MoveRefusal> {
    let mut before = before.iter();
    let mut last = 0;
    for (statement, sweep) in iter_arcs(program) {
        last = statement;
        if before.next().is_none_or(|before| (before - sweep).abs() > PI) {
            return Err(arc_refusal(statement));
        }
    }
    if before.next().is_some() { Err(arc_refusal(last)) } else { Ok(()) }
}

fn iter_arcs(program: &Program) -> impl Iterator<Item = (usize, f64)> + '_ {
    program.motions().filter_map(|motion| match &motion.path {
        MotionPath::Arc(arc) => Some((motion.last_statement(), arc.sweep)),
        _ => None,
    })
}

fn arc_refusal(statement: usize) -> MoveRefusal {
    MoveRefusal {
        message: "this arc is so short that its ends meet when they are rounded to the file's decimals, and would be read as a \
                  full turn. Quarter turns and mirrors in x, y or z do not round",
        statement,
        label: "the arc ends here",
    }
}

//! Arcs after a move: a sweep that rounding has turned round is found before anything is written.
//!
//! The end of an arc of a few microns may round onto its start, which every reader takes for a full circle.

use super::walk::Refusal;
use crate::program::Program;
use crate::program::geometry::Path;
use std::f64::consts::PI;

/// Sweeps of all arcs of a program, in order, in radians.
pub fn sweeps(program: &Program) -> Vec<f64> {
    arcs(program).map(|(_, sweep)| sweep).collect()
}

/// Compares the sweeps after a move with those before it.
///
/// # Errors
/// The first arc that has gained or lost most of a turn, or has become something else.
pub fn check(program: &Program, before: &[f64]) -> Result<(), Refusal> {
    let mut before = before.iter();
    let mut last = 0;
    for (statement, sweep) in arcs(program) {
        last = statement;
        if before.next().is_none_or(|before| (before - sweep).abs() > PI) {
            return Err(refusal(statement));
        }
    }
    if before.next().is_some() { Err(refusal(last)) } else { Ok(()) }
}

fn arcs(program: &Program) -> impl Iterator<Item = (usize, f64)> + '_ {
    program.motions().filter_map(|motion| match &motion.path {
        Path::Arc(arc) => Some((motion.last_statement(), arc.sweep)),
        _ => None,
    })
}

fn refusal(statement: usize) -> Refusal {
    Refusal {
        message: "this arc is so short that its ends meet when they are rounded to the file's decimals, and would be read as a \
                  full turn. Quarter turns and mirrors in x, y or z do not round",
        statement,
        label: "the arc ends here",
    }
}

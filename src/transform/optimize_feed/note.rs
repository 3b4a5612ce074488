//! What is said of each FEDRAT that the step wrote, for the comments of `provenance:`: the largest load of the motions that it
//! governs, before and after.

use super::gather::{Gathered, Mark};
use super::parameters::Criterion;
use super::step::Job;
use crate::program::{LengthUnit, Program, StepId};
use std::collections::BTreeMap;
use std::ops::Range;

impl Job {
    /// Adds the notes; nothing for a program that keeps no history. `parts` are the motions that each motion of `before` is now.
    pub(super) fn note(
        &self,
        (program, step): (&mut Program, StepId),
        before: &Gathered,
        after: &Gathered,
        parts: &[Range<usize>],
    ) {
        let Some((criterion, _)) = self.limits.first().copied().filter(|_| program.keeps_history()) else {
            return;
        };
        let governors: Vec<Option<usize>> = program.motions().map(|motion| motion.feed_from).collect();
        let mut loads: BTreeMap<usize, [f64; 2]> = BTreeMap::new();
        let estimate = |mark: &Mark| mark.measured.first().map_or(0.0, |[estimate, _]| *estimate);
        let mut add = |motion: usize, which: usize, load: f64| {
            let Some(governor) = governors.get(motion).copied().flatten() else { return };
            if let Some(largest) = loads.entry(governor).or_default().get_mut(which) {
                *largest = largest.max(load);
            }
        };
        for mark in &before.marks {
            for motion in parts.get(mark.motion).cloned().unwrap_or_default() {
                add(motion, 0, estimate(mark));
            }
        }
        after.marks.iter().for_each(|mark| add(mark.motion, 1, estimate(mark)));
        for (statement, [old, new]) in loads.into_iter().filter(|(_, loads)| *loads != [0.0; 2]) {
            program.note(statement, step, text(criterion, self.units, old, new));
        }
    }
}

/// `h 0.040 -> 0.065`; the unit where it is not the file's.
fn text(criterion: Criterion, file: LengthUnit, old: f64, new: f64) -> String {
    let (symbol, decimals) = match criterion {
        Criterion::ChipThickness => ("h", 3),
        Criterion::RemovalRate => ("Q", 0),
        Criterion::Force => ("F", 0),
        Criterion::Torque => ("M", 2),
        Criterion::Power => ("P", 2),
    };
    let told = criterion == Criterion::ChipThickness && file == LengthUnit::Mm;
    let unit = if told { String::new() } else { format!(" {}", criterion.unit()) };
    format!("{symbol} {old:.decimals$} -> {new:.decimals$}{unit}")
}

//! This module makes the notes of the FEDRATs that the step wrote, for the comments of `provenance:`: the
//! largest load of the motions that a FEDRAT governs, before and after the change. The parts of a split
//! motion have no load of their own before the change, so their note only has the one after it.

use crate::program::{LengthUnit, Program, StatementId, StepId};
use crate::transform::optimize_feed::limit::FeedGoals;
use crate::transform::optimize_feed::measure::{BlockMeasurement, LoadCriterion, MeasuredBlocks};
use std::collections::BTreeMap;
use std::ops::Range;

/// The largest loads of the motions that a FEDRAT governs.
#[derive(Default)]
struct GovernedLoads {
    before: f64,
    after: f64,
    /// Whether it governs a part of a motion that was split.
    split: bool,
}

/// Adds the notes. A program without history gets none. `parts` are the motions that each motion of `before`
/// has become.
pub(in crate::transform::optimize_feed) fn add_load_notes(
    goals: &FeedGoals,
    (program, step): (&mut Program, StepId),
    before: &MeasuredBlocks,
    after: &MeasuredBlocks,
    parts: &[Range<usize>],
) {
    let Some((criterion, _)) = goals.limits.first().copied().filter(|_| program.has_history()) else {
        return;
    };
    let governors: Vec<Option<StatementId>> = program.motions().map(|motion| motion.feed_from).collect();
    let governor = |motion: usize| governors.get(motion).copied().flatten();
    let mut loads: BTreeMap<StatementId, GovernedLoads> = BTreeMap::new();
    let estimate =
        |measurement: &BlockMeasurement| measurement.measured.first().map_or(0.0, |[estimate, _]| *estimate);
    for measurement in &before.measurements {
        let parts = parts.get(measurement.motion);
        debug_assert!(parts.is_some(), "every motion of the program before has parts");
        let parts = parts.cloned().unwrap_or_default();
        let split = parts.len() > 1;
        for governor in parts.filter_map(governor) {
            let loads = loads.entry(governor).or_default();
            loads.before = loads.before.max(estimate(measurement));
            loads.split |= split;
        }
    }
    for measurement in &after.measurements {
        if let Some(governor) = governor(measurement.motion) {
            let loads = loads.entry(governor).or_default();
            loads.after = loads.after.max(estimate(measurement));
        }
    }
    for (statement, loads) in loads {
        if let Some(text) = render_load_note(criterion, goals.units, &loads) {
            program.add_edit_note(statement, step, text);
        }
    }
}

/// Formats a note: `h 0.040 -> 0.065`, or `h 0.065` for split motions, with the unit if it is not the file's.
/// Returns `None` if both loads are zero.
fn render_load_note(criterion: LoadCriterion, file: LengthUnit, loads: &GovernedLoads) -> Option<String> {
    let (symbol, decimals) = match criterion {
        LoadCriterion::ChipThickness => ("h", 3),
        LoadCriterion::RemovalRate => ("Q", 0),
        LoadCriterion::Force => ("F", 0),
        LoadCriterion::Torque => ("M", 2),
        LoadCriterion::Power => ("P", 2),
        LoadCriterion::Deflection => ("d", 3),
        LoadCriterion::BendingStress => ("s", 0),
    };
    let has_file_unit = criterion == LoadCriterion::ChipThickness && file == LengthUnit::Mm;
    let unit = if has_file_unit { String::new() } else { format!(" {}", criterion.unit()) };
    let [none, old, new] = [0.0, loads.before, loads.after].map(|load| format!("{load:.decimals$}"));
    match loads.split {
        true => (new != none).then(|| format!("{symbol} {new}{unit}")),
        false => (old != none || new != none).then(|| format!("{symbol} {old} -> {new}{unit}")),
    }
}

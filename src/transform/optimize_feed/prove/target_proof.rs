//! This module compares the corrected program with its targets.

use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::presentation::display_units::DisplayUnits;
use crate::program::Program;
use crate::transform::StepContext;
use crate::transform::optimize_feed::limit::{FeedGoals, FeedWindow};
use crate::transform::optimize_feed::measure::{BlockMeasurement, FeedBlock, LoadCriterion, MeasuredBlocks};
use std::collections::BTreeSet;

/// The fraction by which a load may differ between two simulations of the same path. Chords of arcs differ
/// once a block is split, and split points are rounded to the file's decimals.
const PATH_TOLERANCE: f64 = 5e-3;

/// Fails if a block that the step may touch exceeds a limit by more than the uncertainty of the simulation.
/// Motions at the lowest allowed feed are excused. With the paper's window this is expected, and each such block is a
/// finding.
pub(in crate::transform::optimize_feed) fn prove_targets(
    goals: &FeedGoals,
    program: &Program,
    after: &MeasuredBlocks,
    excused: &BTreeSet<usize>,
    context: &mut StepContext<'_>,
) -> Result<(), Failure> {
    let mut passed = Vec::new();
    for (_, measurement) in touched_blocks(after) {
        if excused.contains(&measurement.motion) {
            continue;
        }
        for ((criterion, limit), [estimate, bound]) in goals.limits.iter().zip(&measurement.measured) {
            let allowed = limit * (1.0 + PATH_TOLERANCE) + (bound - estimate).max(0.0);
            if *estimate > allowed && goals.rules.window == FeedWindow::HalfBlocks {
                passed.push(describe_passed_target(
                    program,
                    measurement,
                    (*criterion, *limit),
                    *estimate,
                    context,
                ));
            } else if *estimate > allowed {
                let span = program.statement(measurement.statement).origin();
                let units = DisplayUnits::from_mm(context.units);
                let message = format!(
                    "simulated again, the {} is {} here; the target is {}",
                    criterion.display_name(),
                    units.tell_fixed(criterion.column_unit(), *estimate, 6),
                    units.tell_trimmed(criterion.column_unit(), *limit, 6)
                );
                let found = Diagnostic::new(codes::TARGET_EXCEEDED, message).with_label(
                    program.source(),
                    span,
                    "exceeds the target",
                );
                return Err(context.label_parameter(found, &["target"], "the target").into());
            }
        }
    }
    context.findings.extend(passed);
    Ok(())
}

/// Describes a block that passes its target because its first half runs at the feed of the block before it.
fn describe_passed_target(
    program: &Program,
    measurement: &BlockMeasurement,
    (criterion, limit): (LoadCriterion, f64),
    estimate: f64,
    context: &StepContext<'_>,
) -> Diagnostic {
    let units = DisplayUnits::from_mm(context.units);
    let message = format!(
        "with `window: half_blocks` the {} is {} here, above the target of {}: the first half of this block runs at the \
         feed of the block before it",
        criterion.display_name(),
        units.tell_fixed(criterion.column_unit(), estimate, 4),
        units.tell_trimmed(criterion.column_unit(), limit, 4)
    );
    let span = program.statement(measurement.statement).origin();
    let found = Diagnostic::new(codes::PASSED_BY_WINDOW, message).with_label(
        program.source(),
        span,
        "above the target",
    );
    context.label_parameter(found, &["window"], "asked for here").with_magnitude(estimate / limit)
}

pub(super) fn touched_blocks(
    gathered: &MeasuredBlocks,
) -> impl Iterator<Item = (&FeedBlock, &BlockMeasurement)> {
    gathered.blocks.iter().zip(&gathered.measurements).filter(|(block, _)| block.touched)
}

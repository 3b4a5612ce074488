//! The corrected program against its targets, and both programs in numbers.

use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::program::Program;
use crate::transform::StepContext;
use crate::transform::optimize_feed::limit::{FeedGoals, FeedWindow};
use crate::transform::optimize_feed::measure::{BlockMeasurement, FeedBlock, MeasuredBlocks};
use std::collections::BTreeSet;

/// Share by which a load may differ between two simulations of the same path: chords of arcs fall elsewhere once a block is split,
/// and split points are rounded to the file's decimals.
const PATH: f64 = 5e-3;

/// Fails when a block that the step may touch passes a limit by more than the simulation's uncertainty; motions that run at the
/// lowest feed allowed are excused. With the paper's window, that is to be expected and only reported.
pub(in crate::transform::optimize_feed) fn prove_targets(
    goals: &FeedGoals,
    program: &Program,
    after: &MeasuredBlocks,
    excused: &BTreeSet<usize>,
    context: &StepContext<'_>,
) -> Result<(), Failure> {
    if goals.rules.window == FeedWindow::HalfBlocks {
        return Ok(());
    }
    for (_, measurement) in touched_blocks(after) {
        if excused.contains(&measurement.motion) {
            continue;
        }
        for ((criterion, limit), [estimate, bound]) in goals.limits.iter().zip(&measurement.measured) {
            let allowed = limit * (1.0 + PATH) + (bound - estimate).max(0.0);
            if *estimate > allowed {
                let span = program.statement(measurement.statement).origin();
                let message = format!(
                    "simulated again, the {} is {estimate:.6} {} here; the target is {limit}",
                    criterion.display_name(),
                    criterion.unit()
                );
                let found = Diagnostic::new(codes::TARGET_EXCEEDED, message).with_label(
                    program.source(),
                    span,
                    "passes the target",
                );
                return Err(context.label_parameter(found, &["target"], "the target").into());
            }
        }
    }
    Ok(())
}

pub(super) fn touched_blocks(
    gathered: &MeasuredBlocks,
) -> impl Iterator<Item = (&FeedBlock, &BlockMeasurement)> {
    gathered.blocks.iter().zip(&gathered.measurements).filter(|(block, _)| block.touched)
}

//! The corrected program against its targets, and both programs in numbers.

use super::acceleration::{TimedSegment, path_time_s};
use super::block_feeds::{FeedBlock, FeedWindow};
use super::block_measurement::{BlockMeasurement, MeasuredBlocks};
use super::report::{OperationFeedReport, OptimizeFeedReport};
use super::step::OptimizeFeedJob;
use crate::diagnostic::{Diagnostic, codes, Failure};
use crate::program::{Program, Record, Statement, StatementChange, StepId, operation};
use crate::simulation_run::StockResolution;
use crate::transform::StepContext;
use std::collections::BTreeSet;

/// Share by which a load may differ between two simulations of the same path: chords of arcs fall elsewhere once a block is split,
/// and split points are rounded to the file's decimals.
const PATH: f64 = 5e-3;

impl OptimizeFeedJob {
    /// Fails when a block that the step may touch passes a limit by more than the simulation's uncertainty; motions that run at the
    /// lowest feed allowed are excused. With the paper's window, that is to be expected and only reported.
    pub(super) fn prove_targets(
        &self,
        program: &Program,
        after: &MeasuredBlocks,
        excused: &BTreeSet<usize>,
        context: &StepContext<'_>,
    ) -> Result<(), Failure> {
        if self.rules.window == FeedWindow::HalfBlocks {
            return Ok(());
        }
        for (_, mark) in touched_blocks(after) {
            if excused.contains(&mark.motion) {
                continue;
            }
            for ((criterion, limit), [estimate, bound]) in self.limits.iter().zip(&mark.measured) {
                let allowed = limit * (1.0 + PATH) + (bound - estimate).max(0.0);
                if *estimate > allowed {
                    let span = program.statement(mark.statement).origin();
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

    pub(super) fn build_report(
        &self,
        program: &Program,
        before: &MeasuredBlocks,
        after: &MeasuredBlocks,
        grain: StockResolution,
        step: StepId,
    ) -> OptimizeFeedReport {
        let (cell, layer) = match grain {
            StockResolution::Cell(cell) => (Some(cell), None),
            StockResolution::Layer(layer) => (None, Some(layer)),
        };
        let (criterion, target) = self.limits.first().copied().unwrap_or_default();
        let uncertainty = touched_blocks(after)
            .filter_map(|(_, mark)| mark.measured.first())
            .map(|[estimate, bound]| bound - estimate)
            .fold(0.0, f64::max);
        let names: Vec<String> =
            operation::find_operations(program).into_iter().map(|operation| operation.name).collect();
        let of = |operation: Option<usize>| {
            let name = operation.and_then(|index| names.get(index)).cloned().unwrap_or_default();
            let [one, other] =
                [before, after].map(|gathered| self.sum_up_blocks(gathered, operation, target));
            OperationFeedReport {
                name,
                seconds_before: one.seconds,
                seconds_after: other.seconds,
                largest_before: one.largest,
                largest_after: other.largest,
                at_target_before: one.at_target,
                at_target_after: other.at_target,
            }
        };
        let used: BTreeSet<usize> = before.marks.iter().map(|mark| mark.operation).collect();
        let count = |fits: fn(&Record) -> bool, inserted: bool| {
            let mine = |statement: &&Statement| match statement.change() {
                StatementChange::Inserted(by) => inserted && by == step,
                StatementChange::Edited(by) => !inserted && by == step,
                _ => false,
            };
            program.statements().iter().filter(mine).filter(|statement| fits(statement.record())).count()
        };
        let is_feed = |record: &Record| matches!(record, Record::Feed(_) | Record::Cycle(_));
        OptimizeFeedReport {
            criterion,
            unit: criterion.unit(),
            target,
            cell_mm: cell,
            layer_mm: layer,
            uncertainty,
            acceleration: self.rules.max_acceleration,
            whole: of(None),
            operations: used.into_iter().map(|operation| of(Some(operation))).collect(),
            feeds_added: count(is_feed, true),
            feeds_changed: count(is_feed, false),
            points_added: count(
                |record| matches!(record, Record::Goto(_) | Record::Points(_) | Record::DriveArc(_)),
                true,
            ),
        }
    }

    fn sum_up_blocks(&self, gathered: &MeasuredBlocks, operation: Option<usize>, target: f64) -> BlockTotals {
        let mine = |mark: &BlockMeasurement| operation.is_none_or(|operation| mark.operation == operation);
        let pairs = || gathered.blocks.iter().zip(&gathered.marks).filter(|(_, mark)| mine(mark));
        let stretches: Vec<TimedSegment> = pairs()
            .map(|(block, _)| TimedSegment {
                length: block.length,
                feed: block.programmed,
                breaks_chain: block.breaks_chain,
            })
            .collect();
        let (mut largest, mut cutting, mut at_target) = (0.0_f64, 0.0, 0.0);
        for (block, mark) in pairs().filter(|(block, mark)| block.touched && mark.cuts) {
            let estimate = mark.measured.first().map_or(0.0, |[_, bound]| *bound);
            largest = largest.max(mark.measured.first().map_or(0.0, |[estimate, _]| *estimate));
            cutting += block.length;
            if (0.9..=1.0 + 1e-3).contains(&(estimate / target)) {
                at_target += block.length;
            }
        }
        BlockTotals {
            seconds: path_time_s(&stretches, self.rules.max_acceleration),
            largest,
            at_target: if cutting > 0.0 { at_target / cutting } else { 0.0 },
        }
    }
}

struct BlockTotals {
    seconds: f64,
    largest: f64,
    at_target: f64,
}

fn touched_blocks(gathered: &MeasuredBlocks) -> impl Iterator<Item = (&FeedBlock, &BlockMeasurement)> {
    gathered.blocks.iter().zip(&gathered.marks).filter(|(block, _)| block.touched)
}

//! This module builds the report from the measurements of both programs.

use super::report::{OperationFeedReport, OptimizeFeedReport};
use super::target_proof::touched_blocks;
use crate::program::{Program, Record, Statement, StatementChange, StepId, operation};
use crate::simulation_run::StockResolution;
use crate::transform::optimize_feed::limit::FeedGoals;
use crate::transform::optimize_feed::measure::{BlockMeasurement, MeasuredBlocks};
use crate::transform::optimize_feed::plan::{TimedSegment, path_time_s};
use std::collections::BTreeSet;

pub(in crate::transform::optimize_feed) fn build_report(
    goals: &FeedGoals,
    program: &Program,
    before: &MeasuredBlocks,
    after: &MeasuredBlocks,
    resolution: StockResolution,
    step: StepId,
) -> OptimizeFeedReport {
    let (cell, layer) = match resolution {
        StockResolution::Cell(cell) => (Some(cell), None),
        StockResolution::Layer(layer) => (None, Some(layer)),
    };
    debug_assert!(!goals.limits.is_empty(), "the target is the first limit");
    let (criterion, target) = goals.limits.first().copied().unwrap_or_default();
    let uncertainty = touched_blocks(after)
        .filter_map(|(_, measurement)| measurement.measured.first())
        .map(|[estimate, bound]| bound - estimate)
        .fold(0.0, f64::max);
    let names: Vec<String> =
        operation::find_operations(program).into_iter().map(|operation| operation.name).collect();
    let of = |operation: Option<usize>| {
        let name = operation.and_then(|index| names.get(index)).cloned().unwrap_or_default();
        let [one, other] = [before, after].map(|gathered| sum_up_blocks(goals, gathered, operation, target));
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
    let used: BTreeSet<usize> = before.measurements.iter().map(|measurement| measurement.operation).collect();
    let count = |fits: fn(&Record) -> bool, inserted: bool| count_changes(program, step, fits, inserted);
    let is_feed = |record: &Record| matches!(record, Record::Feed(_) | Record::Cycle(_));
    OptimizeFeedReport {
        criterion,
        unit: criterion.unit(),
        target,
        cell_mm: cell,
        layer_mm: layer,
        uncertainty,
        acceleration: goals.rules.max_acceleration,
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

/// Counts the statements of a kind that a step put in, or that it changed.
fn count_changes(program: &Program, step: StepId, fits: fn(&Record) -> bool, inserted: bool) -> usize {
    let mine = |statement: &&Statement| match statement.change() {
        StatementChange::Inserted(by) => inserted && by == step,
        StatementChange::Edited(by) => !inserted && by == step,
        _ => false,
    };
    program.statements().iter().filter(mine).filter(|statement| fits(statement.record())).count()
}

fn sum_up_blocks(
    goals: &FeedGoals,
    gathered: &MeasuredBlocks,
    operation: Option<usize>,
    target: f64,
) -> BlockTotals {
    let mine =
        |measurement: &BlockMeasurement| operation.is_none_or(|operation| measurement.operation == operation);
    let pairs =
        || gathered.blocks.iter().zip(&gathered.measurements).filter(|(_, measurement)| mine(measurement));
    let segments: Vec<TimedSegment> = pairs()
        .map(|(block, _)| TimedSegment {
            length: block.length,
            feed: block.programmed,
            breaks_chain: block.breaks_chain,
        })
        .collect();
    let (mut largest, mut cutting, mut at_target) = (0.0_f64, 0.0, 0.0);
    for (block, measurement) in pairs().filter(|(block, measurement)| block.touched && measurement.cuts) {
        let estimate = measurement.measured.first().map_or(0.0, |[_, bound]| *bound);
        largest = largest.max(measurement.measured.first().map_or(0.0, |[estimate, _]| *estimate));
        cutting += block.length;
        if (0.9..=1.0 + 1e-3).contains(&(estimate / target)) {
            at_target += block.length;
        }
    }
    BlockTotals {
        seconds: path_time_s(&segments, goals.rules.max_acceleration),
        largest,
        at_target: if cutting > 0.0 { at_target / cutting } else { 0.0 },
    }
}

struct BlockTotals {
    seconds: f64,
    largest: f64,
    at_target: f64,
}

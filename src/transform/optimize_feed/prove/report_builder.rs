//! This module builds the report from the measurements of both programs.

use super::report::{OperationFeedReport, OptimizeFeedReport};
use super::target_proof::touched_blocks;
use crate::program::{Program, Record, Statement, StatementChange, StepId, operation};
use crate::simulation_run::StockResolution;
use crate::transform::optimize_feed::limit::FeedGoals;
use crate::transform::optimize_feed::measure::{BlockMeasurement, ChipProof, FeedBlock, MeasuredBlocks};
use crate::transform::optimize_feed::plan::{TimedSegment, path_time_s};
use std::collections::BTreeMap;

pub(in crate::transform::optimize_feed) fn build_report(
    goals: &FeedGoals,
    program: &Program,
    (before, after): (&MeasuredBlocks, &MeasuredBlocks),
    (resolution, is_certified, proof): (StockResolution, bool, Option<ChipProof>),
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
    let sum_up = |pairs: &[MeasuredBlock<'_>]| sum_up_blocks(goals, pairs, target);
    let of = |name: String, [one, other]: [BlockTotals; 2]| OperationFeedReport {
        name,
        seconds_before: one.seconds,
        seconds_after: other.seconds,
        largest_before: one.largest,
        largest_after: other.largest,
        at_target_before: one.at_target,
        at_target_after: other.at_target,
    };
    // A program may have tens of thousands of operations, so the blocks are gone through once for all of them.
    let [by_operation, mut by_operation_after] = [before, after].map(group_by_operation);
    let operations = by_operation.iter().map(|(operation, blocks)| {
        let name = names.get(*operation).cloned().unwrap_or_default();
        let blocks_after = by_operation_after.remove(operation).unwrap_or_default();
        of(name, [sum_up(blocks), sum_up(&blocks_after)])
    });
    let operations = operations.collect();
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
        is_certified,
        proof_points: proof.map(|proof| proof.samples),
        proof_largest_mm: proof.map(|proof| proof.largest_mm),
        uncertainty,
        acceleration: goals.rules.max_acceleration,
        machine_seconds_before: None,
        machine_seconds_after: None,
        whole: of(String::new(), [before, after].map(|gathered| sum_up(&list_blocks(gathered)))),
        operations,
        feeds_added: count(is_feed, true),
        feeds_changed: count(is_feed, false),
        points_added: count(
            |record| matches!(record, Record::Goto(_) | Record::Points(_) | Record::DriveArc(_)),
            true,
        ),
    }
}

/// A block with its measurement.
type MeasuredBlock<'b> = (&'b FeedBlock, &'b BlockMeasurement);

fn list_blocks(gathered: &MeasuredBlocks) -> Vec<MeasuredBlock<'_>> {
    gathered.blocks.iter().zip(&gathered.measurements).collect()
}

/// The blocks of each operation, in their order.
fn group_by_operation(gathered: &MeasuredBlocks) -> BTreeMap<usize, Vec<MeasuredBlock<'_>>> {
    let mut groups: BTreeMap<usize, Vec<MeasuredBlock<'_>>> = BTreeMap::new();
    for pair in list_blocks(gathered) {
        groups.entry(pair.1.operation).or_default().push(pair);
    }
    groups
}

fn sum_up_blocks(goals: &FeedGoals, pairs: &[MeasuredBlock<'_>], target: f64) -> BlockTotals {
    let segments: Vec<TimedSegment> = pairs
        .iter()
        .map(|(block, _)| TimedSegment {
            length: block.length,
            feed: block.programmed,
            breaks_chain: block.breaks_chain,
        })
        .collect();
    let (mut largest, mut cutting, mut at_target) = (0.0_f64, 0.0, 0.0);
    for (block, measurement) in pairs.iter().filter(|(block, measurement)| block.touched && measurement.cuts)
    {
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

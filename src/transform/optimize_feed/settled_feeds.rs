//! This module plans and writes feeds until they are settled, so that a second run changes nothing.

use super::measure::MeasuredProgram;
use super::parameters::OptimizeFeed;
use super::step::OptimizeFeedJob;
use super::write::{OptimizedProgram, plan_and_write_feeds};
use crate::diagnostic::Failure;
use crate::program::Program;
use crate::simulation_run::RunPhase;
use crate::transform::StepContext;
use std::collections::BTreeSet;
use std::ops::Range;

/// How often the step plans feeds, at the most: each round measures the parts that the round before has made.
const MOST_ROUNDS: usize = 6;

/// The corrected program, and what was measured of it.
pub(super) struct SettledFeeds {
    pub program: Program,
    /// The motions that exceed a target at the lowest allowed feed.
    pub excused: BTreeSet<usize>,
    /// For each motion before the step, the motions that it has become.
    pub parts: Vec<Range<usize>>,
    pub after: MeasuredProgram,
}

/// Returns for each motion what it has become after two changes, one after the other.
fn follow_parts(first: &[Range<usize>], second: &[Range<usize>]) -> Vec<Range<usize>> {
    let follow = |parts: &Range<usize>| {
        let begin = second.get(parts.start).map_or(0, |range| range.start);
        let end = parts.end.checked_sub(1).and_then(|last| second.get(last)).map_or(begin, |range| range.end);
        begin..end
    };
    first.iter().map(follow).collect()
}

impl OptimizeFeedJob {
    /// Plans and writes feeds until nothing changes any more: parts that a split has made are measured on their own, and
    /// may then run at other feeds. A second run finds what the last round has found, so it changes nothing.
    pub(super) fn settle_feeds(
        &self,
        step: &OptimizeFeed,
        program: Program,
        before: &MeasuredProgram,
        context: &mut StepContext<'_>,
    ) -> Result<SettledFeeds, Failure> {
        context.watch.begin_phase(RunPhase::Planning);
        let OptimizedProgram { program, excused, parts } =
            plan_and_write_feeds(&self.goals, program, &before.blocks, context)?;
        // What the rounds find is what the first one has found.
        let kept_findings = std::mem::take(&mut context.findings);
        let after = self.simulate_blocks(step, &program, Some(before), context);
        let settled = after.and_then(|after| {
            let first = SettledFeeds { program, excused, parts, after };
            self.settle_parts(step, first, context)
        });
        context.findings = kept_findings;
        settled
    }

    /// Repeats what the first round has done, as long as it splits.
    fn settle_parts(
        &self,
        step: &OptimizeFeed,
        first: SettledFeeds,
        context: &mut StepContext<'_>,
    ) -> Result<SettledFeeds, Failure> {
        let mut settled = first;
        // Ratios are those of the programmed feed, which a second round no longer knows.
        if self.goals.rules.has_ratios() {
            return Ok(settled);
        }
        let mut has_split = settled.parts.iter().any(|parts| parts.len() > 1);
        for _ in 1..MOST_ROUNDS {
            if !has_split {
                break;
            }
            let again =
                plan_and_write_feeds(&self.goals, settled.program.clone(), &settled.after.blocks, context)?;
            if again.program.to_bytes() == settled.program.to_bytes() {
                break;
            }
            has_split = again.parts.iter().any(|parts| parts.len() > 1);
            settled.after = self.simulate_blocks(step, &again.program, Some(&settled.after), context)?;
            settled.parts = follow_parts(&settled.parts, &again.parts);
            settled.excused = again.excused;
            settled.program = again.program;
        }
        Ok(settled)
    }
}

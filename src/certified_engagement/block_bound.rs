//! This module bounds the largest value of a block.

use super::certified_program::{CertifiedProgram, SearchedStep};
use super::known_patches::KnownPatches;
use super::material_witness::{EngagementWitness, WitnessPlace};
use super::step_search::{EngagementCriterion, StepSearch};

/// The options of a search. They change the width of the interval and the time, never whether it is true.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EngagementOptions {
    /// The part of the lower bound by which the upper one may be larger.
    pub tolerance: f64,
    /// The largest number of patches of one block.
    pub most_patches: usize,
    /// About the largest number of lines that are tested against sweeps for one block, which is what takes the time.
    pub most_line_tests: u64,
}

impl Default for EngagementOptions {
    fn default() -> Self {
        Self { tolerance: 0.01, most_patches: 30_000, most_line_tests: 500_000 }
    }
}

/// An interval that contains the true largest value of a block.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CertifiedEngagement {
    /// What was found: a point that is material has this value.
    pub lower: f64,
    /// What no point exceeds.
    pub upper: f64,
    /// Whether the interval is as narrow as was asked. If not, the budget was used, and the interval is true
    /// but wider.
    pub is_within_tolerance: bool,
    /// The number of patches that were examined.
    pub patches: usize,
    /// The number of lines that were tested against sweeps.
    pub line_tests: u64,
    /// Where the lower bound was found; `None` if nothing was.
    pub witness: Option<EngagementWitness>,
}

impl CertifiedEngagement {
    /// Returns the interval of which nothing is known: from 0 to infinity.
    fn unknown() -> Self {
        Self {
            lower: 0.0,
            upper: f64::INFINITY,
            is_within_tolerance: false,
            patches: 0,
            line_tests: 0,
            witness: None,
        }
    }
}

/// What a block leaves for the next one: where to look first.
#[derive(Debug, Clone, Default)]
pub struct WarmStart {
    witness: Option<WitnessPlace>,
    hot: Vec<u32>,
    known: KnownPatches,
}

/// The number of patches in the first look at each of several steps.
const PATCHES_OF_A_LOOK: usize = 24;
/// The number of tests of lines that each of many steps has at least; one step has what the options say.
const LINE_TESTS_OF_A_STEP: u64 = 20_000;
/// By how much the looks at the same step grow.
const GROWTH_OF_ROUNDS: usize = 6;

impl CertifiedProgram {
    /// Bounds the largest value of a block. `warm` is carried from block to block; it changes only the time.
    pub fn certify_block(
        &self,
        block: usize,
        criterion: EngagementCriterion,
        options: &EngagementOptions,
        warm: &mut WarmStart,
    ) -> CertifiedEngagement {
        // Nothing is known of a block that does not exist, or of chips without a feed.
        let is_known = block < self.block_count() && (0.0..f64::INFINITY).contains(&criterion.scale());
        if !is_known {
            return CertifiedEngagement::unknown();
        }
        let steps = self.searched_steps(block);
        let (mut lower, mut upper, mut patches, mut witness) = (0.0, 0.0_f64, 0, None);
        let mut line_tests = 0;
        // Many steps have a budget of their own each.
        let least = if steps.len() > 1 { steps.len().saturating_mul(PATCHES_OF_A_LOOK * 4) } else { 0 };
        let most_patches = options.most_patches.max(least);
        let most_line_tests = match steps.len() {
            0 | 1 => options.most_line_tests,
            count => options.most_line_tests.max(count as u64 * LINE_TESTS_OF_A_STEP),
        };
        let is_single_step = steps.len() == 1;
        let mut run = |step: &SearchedStep<'_>, rounds: usize, lower: &mut f64, patches: &mut usize| {
            let mut search = StepSearch::new(self, options, criterion, step)?;
            search.lower = *lower;
            search.budget = most_patches.saturating_sub(*patches);
            search.rounds = rounds;
            search.most_line_tests = most_line_tests.saturating_sub(line_tests);
            search.witness = warm.witness;
            search.hot = std::mem::take(&mut warm.hot);
            // A chip's patches have depths that depend on what is known of its block. On slopes of an upright cutter what a
            // patch needs changes so much from block to block that beginning anew is quicker.
            let is_alike = step.step.turn > 0.0 || step.step.is_level();
            let goes_on = is_single_step && is_alike && criterion == EngagementCriterion::Share;
            search.known = goes_on.then(|| std::mem::take(&mut warm.known));
            let most = search.run();
            warm.known = search.known.take().unwrap_or_default();
            *lower = search.lower;
            *patches += search.patches;
            line_tests += search.buffers.tests;
            warm.witness = search.witness.or(warm.witness);
            warm.hot = std::mem::take(&mut search.hot);
            witness = search.found.or(witness);
            Some(most)
        };
        // A short look at every step finds a lower bound that spares most of them a long one.
        let looks = if steps.len() > 1 { PATCHES_OF_A_LOOK } else { most_patches };
        let mut open: Vec<(f64, &SearchedStep<'_>)> = Vec::new();
        for step in &steps {
            let Some(most) = run(step, looks, &mut lower, &mut patches) else { continue };
            open.push((most, step));
        }
        // One hard step must not use what the others need: the steps that are open are searched again and
        // again, each time longer.
        let is_single = open.len() == 1;
        let mut rounds = PATCHES_OF_A_LOOK * GROWTH_OF_ROUNDS;
        loop {
            open.sort_by(|a, b| b.0.total_cmp(&a.0));
            let threshold = |lower: f64| (lower * (1.0 + options.tolerance)).max(criterion.floor());
            let is_last = rounds >= most_patches;
            let mut is_open = false;
            for (most, step) in &mut open {
                if is_single || *most <= threshold(lower) || patches >= most_patches {
                    continue;
                }
                let again = run(step, rounds, &mut lower, &mut patches);
                *most = again.map_or(*most, |again| again.min(*most));
                is_open |= *most > threshold(lower);
            }
            if !is_open || is_last || patches >= most_patches {
                break;
            }
            rounds = rounds.saturating_mul(GROWTH_OF_ROUNDS);
        }
        for (most, _) in open {
            upper = upper.max(most);
        }
        if lower == 0.0 && upper <= criterion.floor() {
            upper = 0.0;
        }
        let is_within_tolerance = upper <= lower * (1.0 + options.tolerance) * (1.0 + 1e-9);
        CertifiedEngagement { lower, upper, is_within_tolerance, patches, line_tests, witness }
    }
}

//! This module finds steps that go where another one goes, only higher: a pocket in many levels goes the same way again
//! and again. What the lower one of two removes is all that both remove, so that a search need not know the other. Without
//! this, every level of a program would cost as much as all levels above it.

use super::certified_program::CertifiedProgram;
use super::step_runs::NEVER;
use super::swept_step::SweptStep;
use std::collections::HashMap;

/// What is equal for steps that go the same way at different heights: the cutter, and the numbers of both ends and of the
/// arc, as bits.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct LevelWay {
    cutter: usize,
    ends: [[u64; 2]; 2],
    arc: Option<[u64; 3]>,
}

/// The lowest step so far on every way.
pub(super) type LowestOnWay = HashMap<LevelWay, u32>;

fn lowest_of(step: &SweptStep) -> f64 {
    step.tips[0].z.min(step.tips[1].z)
}

impl CertifiedProgram {
    /// Compares the last step with the one that went the same way last, and notes which of them adds nothing to the other.
    pub(super) fn replace_repeated(&mut self, number: u32) {
        self.replaced.push(NEVER);
        let Some(step) = self.steps.get(number as usize) else { return };
        let Some(way) = self.way_of(step) else { return };
        let Some(known) = self.lowest_on_way.insert(way, number) else { return };
        let height_of = |number: u32| self.steps.get(number as usize).map(lowest_of);
        if height_of(number) <= height_of(known) {
            self.replace(known, number);
        } else {
            self.lowest_on_way.insert(way, known);
            self.replace(number, known);
        }
    }

    /// Notes that a step adds nothing to another one.
    fn replace(&mut self, step: u32, by: u32) {
        if let Some(replaced) = self.replaced.get_mut(step as usize) {
            *replaced = by;
        }
        self.replace_in_index(step);
    }

    /// Returns the way of a level or vertical step of an upright cutter that reaches over the top of the stock, so that of
    /// two on one way the lower one removes all that the other does.
    fn way_of(&self, step: &SweptStep) -> Option<LevelWay> {
        let contour = self.cutters.get(step.cutter)?;
        let is_vertical = step.is_straight() && step.tips[0].xy() == step.tips[1].xy();
        let is_simple = step.is_upright() && step.is_exact() && (step.is_level() || is_vertical);
        let is_whole = contour.widens_upwards() && lowest_of(step) + contour.height_mm() >= self.stock_top();
        if !(is_simple && is_whole) {
            return None;
        }
        // Zero has two signs.
        let bits = |number: f64| (number + 0.0).to_bits();
        let mut ends = step.tips.map(|tip| [bits(tip.x), bits(tip.y)]);
        let arc = step.arc.map(|arc| {
            let sense = arc.normal.z.signum();
            [bits(arc.center.x), bits(arc.center.y), bits(arc.angle * sense)]
        });
        if arc.is_none() {
            ends.sort_unstable();
        }
        Some(LevelWay { cutter: step.cutter, ends, arc })
    }
}

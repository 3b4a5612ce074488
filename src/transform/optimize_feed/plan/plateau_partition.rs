//! This module divides a path into plateaus, stretches of one feed, so that time and the number of FEDRATs together
//! are least (`shared/science.md`, section 5, "few FEDRATs").
//!
//! A plateau runs at the lowest feed of its segments. With a price for each plateau, the least cost of the first `j`
//! segments is `D_j = min over i < j of D_i + (P_j - P_i) S_ij + price`, where `P` is the length of path so far and
//! `S_ij` the largest slowness (minutes per mm) of the segments between. The starts `i` with one value of `S_ij` are a
//! group. Each start is a line over the slowness, so a group keeps the lower envelope of its lines. The whole takes
//! some `n log n` steps.

use std::collections::VecDeque;

/// A stretch of path that is to get one feed, alone or with its neighbours.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FreeStretch {
    /// Its length in mm, above 0.
    pub length_mm: f64,
    /// The largest feed that it may have, mm/min, above 0.
    pub feed_mm_min: f64,
}

/// Divides stretches into plateaus and returns the index behind the last stretch of each. The sum of the times, each
/// plateau at the lowest feed of its stretches, and of `price_min` minutes for each plateau is the least that any
/// division has. Equal sums may be divided either way, but always in the same way.
///
/// ```
/// use clsmith::internals::transform::optimize_feed::{FreeStretch, partition_into_plateaus};
///
/// let path = [1000.0, 990.0, 4000.0].map(|feed_mm_min| FreeStretch { length_mm: 10.0, feed_mm_min });
/// assert_eq!(partition_into_plateaus(&path, 0.001), [2, 3]);
/// assert_eq!(partition_into_plateaus(&path, 1.0), [3]);
/// ```
pub fn partition_into_plateaus(path: &[FreeStretch], price_min: f64) -> Vec<usize> {
    let mut plan = PlateauPlan::default();
    plan.ends.push(PlannedEnd { cost_min: 0.0, at_mm: 0.0, start: 0 });
    for stretch in path {
        plan.add_stretch(stretch, price_min);
    }
    plan.collect_ends()
}

/// The cheapest division of the path up to the end of a stretch.
#[derive(Debug, Clone, Copy)]
struct PlannedEnd {
    cost_min: f64,
    at_mm: f64,
    /// The start of the last plateau, as the number of stretches before it.
    start: usize,
}

/// The starts from which the largest slowness up to the present end is the same.
#[derive(Debug)]
struct StartGroup {
    /// That slowness, minutes per mm.
    slowness: f64,
    /// The first of its starts.
    first: usize,
    /// The starts that are best at this slowness or at a larger one, in order.
    envelope: VecDeque<usize>,
}

#[derive(Debug, Default)]
struct PlateauPlan {
    ends: Vec<PlannedEnd>,
    /// In order of their starts, and so with falling slowness.
    groups: Vec<StartGroup>,
}

impl PlateauPlan {
    fn add_stretch(&mut self, stretch: &FreeStretch, price_min: f64) {
        let slowness = 1.0 / stretch.feed_mm_min;
        let start = self.ends.len() - 1;
        self.open_group(start, slowness);
        let at_mm = self.end(start).at_mm + stretch.length_mm;
        let mut best = PlannedEnd { cost_min: f64::INFINITY, at_mm, start };
        for group in self.groups.iter().rev() {
            let Some(start) = group.envelope.front() else { continue };
            let cost = |start: usize| {
                let before = self.end(start);
                before.cost_min + (at_mm - before.at_mm) * group.slowness
            };
            let whole = cost(*start) + price_min;
            if whole < best.cost_min {
                best = PlannedEnd { cost_min: whole, at_mm, start: *start };
            }
            // A plateau from an earlier start costs at least what it costs from here on without its price: the
            // division up to here is at most one price dearer than what the earlier plateau spends up to here.
            if cost(group.first) >= best.cost_min {
                break;
            }
        }
        self.ends.push(best);
    }

    /// Adds a start, and joins to it the groups whose largest slowness is now that of the new stretch.
    fn open_group(&mut self, start: usize, slowness: f64) {
        let mut group = StartGroup { slowness, first: start, envelope: VecDeque::from([start]) };
        while let Some(before) = self.groups.pop_if(|before| before.slowness <= slowness) {
            group.first = before.first;
            group.envelope = self.join_envelopes(before.envelope, group.envelope);
        }
        // The slowness of a group only grows, and then later starts get better: what is worse now never counts again.
        while let [Some(one), Some(other)] = [group.envelope.front(), group.envelope.get(1)] {
            if self.value_at(*one, slowness) < self.value_at(*other, slowness) {
                break;
            }
            group.envelope.pop_front();
        }
        self.groups.push(group);
    }

    /// Joins the envelopes of two groups; the smaller one moves.
    fn join_envelopes(&self, mut before: VecDeque<usize>, mut after: VecDeque<usize>) -> VecDeque<usize> {
        if after.len() <= before.len() {
            for start in after {
                while let [Some(one), Some(other)] =
                    [before.len().checked_sub(2).and_then(|at| before.get(at)), before.back()]
                {
                    if self.crossing(*one, *other) < self.crossing(*other, start) {
                        break;
                    }
                    before.pop_back();
                }
                before.push_back(start);
            }
            return before;
        }
        for start in before.into_iter().rev() {
            while let [Some(one), Some(other)] = [after.front(), after.get(1)] {
                if self.crossing(start, *one) < self.crossing(*one, *other) {
                    break;
                }
                after.pop_front();
            }
            after.push_front(start);
        }
        after
    }

    /// Returns the slowness above which the later of two starts is better.
    fn crossing(&self, before: usize, after: usize) -> f64 {
        let [before, after] = [before, after].map(|start| self.end(start));
        (after.cost_min - before.cost_min) / (after.at_mm - before.at_mm)
    }

    fn value_at(&self, start: usize, slowness: f64) -> f64 {
        let end = self.end(start);
        end.cost_min - end.at_mm * slowness
    }

    fn end(&self, stretches: usize) -> PlannedEnd {
        let found = self.ends.get(stretches).copied();
        debug_assert!(found.is_some(), "every start is an end before it");
        found.unwrap_or(PlannedEnd { cost_min: f64::INFINITY, at_mm: 0.0, start: 0 })
    }

    fn collect_ends(&self) -> Vec<usize> {
        let mut found = Vec::new();
        let mut end = self.ends.len() - 1;
        while end > 0 {
            found.push(end);
            end = self.end(end).start;
        }
        found.reverse();
        found
    }
}

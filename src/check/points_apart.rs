//! This module checks for points that lie far outside everything else in their operation.
//!
//! A lost decimal point or a digit too many puts one point far away from all the others. A point is reported if one of
//! its coordinates lies 500 mm or more outside those of all other points, and further from their middle half than ten
//! times its width. Two points out there support each other, so a way out and back to a place far away is none of it.
//! Nor are the rapids before the first and behind the last feed motion of an operation: they come from a home position
//! and go to it.

use super::{Lint, LintFindings};
use crate::diagnostic::codes;
use crate::program::motion::{CoordinateFrame, Motion};
use crate::program::{Record, StatementId};
use std::sync::Arc;

/// A point must lie so far outside all others, mm.
const APART: f64 = 500.0;

/// It must lie so many widths of the middle half of the points away from that half.
const WIDTHS: f64 = 10.0;

/// Fewer points say nothing about where the others are.
const FEWEST: usize = 8;

/// The middle half is taken from so many coordinates at most.
const SAMPLES: usize = 2048;

/// Reports points far outside all others of their operation.
#[derive(Default)]
pub(super) struct PointApartLint {
    group: Option<PointGroup>,
}

/// Points in one frame, of one operation and one tool.
struct PointGroup {
    operation: usize,
    tool: Option<u32>,
    frame: Option<Arc<CoordinateFrame>>,
    points: usize,
    axes: [AxisValues; 3],
    /// The last motion at feed.
    last_feed: Option<StatementId>,
}

/// The coordinates of one axis: the two outermost at either side, and samples of all.
#[derive(Default)]
struct AxisValues {
    /// The two lowest coordinates, negative, and the two highest ones: the outer one first.
    sides: [[Option<OuterValue>; 2]; 2],
    samples: Vec<f64>,
    /// How many coordinates one sample stands for, and how many were passed since the last one.
    stride: usize,
    passed: usize,
}

/// A coordinate at the end of a range, counted outwards.
#[derive(Debug, Clone, Copy)]
struct OuterValue {
    value: f64,
    at: StatementId,
    /// Whether it may be reported: a rapid before the first feed motion may not.
    counts: bool,
}

impl AxisValues {
    fn add_value(&mut self, value: f64, at: StatementId, counts: bool) {
        for (side, sign) in self.sides.iter_mut().zip([-1.0, 1.0]) {
            let new = OuterValue { value: value * sign, at, counts };
            let is_outer = |known: &Option<OuterValue>| known.is_none_or(|known| new.value > known.value);
            if is_outer(&side[0]) {
                *side = [Some(new), side[0]];
            } else if is_outer(&side[1]) {
                side[1] = Some(new);
            }
        }
        self.passed += 1;
        if self.passed < self.stride {
            return;
        }
        self.passed = 0;
        self.samples.push(value);
        if self.samples.len() >= 2 * SAMPLES {
            let mut keep = false;
            self.samples.retain(|_| {
                keep = !keep;
                keep
            });
            self.stride = self.stride.max(1) * 2;
        }
    }

    /// Returns the ends of the middle half of the samples.
    fn middle_half(&mut self) -> Option<[f64; 2]> {
        self.samples.sort_unstable_by(f64::total_cmp);
        let quarter = self.samples.len() / 4;
        let upper = self.samples.len().checked_sub(quarter + 1)?;
        Some([*self.samples.get(quarter)?, *self.samples.get(upper)?])
    }

    /// Returns the places that lie far outside, each with its distance from all other coordinates. `apart` is the
    /// least distance.
    fn find_apart(&mut self, apart: f64) -> Vec<(OuterValue, f64)> {
        let gap = |side: &[Option<OuterValue>; 2]| match side {
            [Some(outer), Some(next)] if outer.value - next.value >= apart => {
                Some((*outer, outer.value - next.value))
            }
            _ => None,
        };
        let gaps = [gap(&self.sides[0]), gap(&self.sides[1])];
        if gaps.iter().all(Option::is_none) {
            return Vec::new();
        }
        let Some([low, high]) = self.middle_half() else { return Vec::new() };
        let far = |(found, _): &(OuterValue, f64), edge: f64| found.value - edge > WIDTHS * (high - low);
        let [below, above] = gaps;
        let below = below.filter(|found| far(found, -low));
        let above = above.filter(|found| far(found, high));
        below.into_iter().chain(above).collect()
    }
}

impl PointGroup {
    fn begin(motion: &Motion) -> Self {
        Self {
            operation: motion.operation,
            tool: motion.tool.as_ref().and_then(|tool| tool.number),
            frame: motion.frame.clone(),
            points: 0,
            axes: std::array::from_fn(|_| AxisValues::default()),
            last_feed: None,
        }
    }

    fn contains(&self, motion: &Motion) -> bool {
        let same_frame = match (&self.frame, &motion.frame) {
            (Some(one), Some(other)) => Arc::ptr_eq(one, other),
            (one, other) => one.is_none() && other.is_none(),
        };
        same_frame
            && self.operation == motion.operation
            && self.tool == motion.tool.as_ref().and_then(|tool| tool.number)
    }

    fn add_motion(&mut self, motion: &Motion) {
        let at = motion.last_statement();
        if !motion.rapid {
            self.last_feed = Some(at);
        }
        self.points += 1;
        for (axis, value) in self.axes.iter_mut().zip(motion.to.point.iter()) {
            axis.add_value(*value, at, self.last_feed.is_some());
        }
    }

    fn report(mut self, found: &mut LintFindings<'_>) {
        if self.points < FEWEST {
            return;
        }
        let (apart, far) = (found.mm_to_file_unit(APART), found.mm_to_file_unit(super::points::FAR));
        for (index, axis) in self.axes.iter_mut().enumerate() {
            for (place, gap) in axis.find_apart(apart) {
                let is_homing = !place.counts || self.last_feed.is_none_or(|last| place.at > last);
                // What is farther away than machines are large has a finding of its own.
                if is_homing || place.value.abs() > far {
                    continue;
                }
                let span = match found.program.statement(place.at).record() {
                    Record::Goto(_) | Record::Control(_) => found.numbers_span(place.at, index..index + 1),
                    Record::From(_) | Record::GoHome(_) => continue,
                    _ => found.statement_span(place.at),
                };
                let message = format!(
                    "this coordinate lies {} outside all other points of the operation",
                    found.format_length(gap)
                );
                found.report(codes::POINT_APART, span, message, "alone out here");
            }
        }
    }
}

impl Lint for PointApartLint {
    fn check_motion(&mut self, motion: &Motion, found: &mut LintFindings<'_>) {
        if let Some(ended) = self.group.take_if(|group| !group.contains(motion)) {
            ended.report(found);
        }
        self.group.get_or_insert_with(|| PointGroup::begin(motion)).add_motion(motion);
    }

    fn finish(&mut self, found: &mut LintFindings<'_>) {
        if let Some(ended) = self.group.take() {
            ended.report(found);
        }
    }
}

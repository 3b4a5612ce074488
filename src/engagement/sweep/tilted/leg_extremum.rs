//! This module finds the lowest (or highest) point of a leg's sweep over a column.
//!
//! Let f(t) be the height of the cutter's lower surface over one column at time t. While the axis does not
//! turn, f is convex, because the cutter is. So tangents bound f from below, and the point where two of them
//! meet is both the next guess and a bound for what can still be gained. If the cutter is over the column
//! neither at the start nor at the end, the time of its passage is needed first; [`PassingTime`] has it in
//! closed form.

use super::leg::{SolidColumnSample, SolidSpanEnd, SweepLeg};
use super::revolved_solid::RevolvedSolid;
use nalgebra::Vector3;

/// The question about a column.
#[derive(Debug, Clone, Copy)]
pub(super) struct LegExtremumQuery {
    pub side: SolidSpanEnd,
    /// The search may stop at a value this low.
    pub enough: f64,
    /// Values from this one upwards change nothing.
    pub useless: f64,
    /// The result may be too high by this much.
    pub tolerance: f64,
}

/// The answer: the least value, and the furthest height of the other end in any sample.
#[derive(Debug, Clone, Copy)]
pub(super) struct LegExtremum {
    pub value: f64,
    pub other: f64,
}

/// The time at which the cutter passes over a column most centrally. Seen from above, the cutter is a stack
/// of ellipses. The lateral distance of the column selects the ellipse that reaches furthest over the
/// column's line of travel, and the middle of that ellipse's chord along the travel is inside whenever the
/// column is passed at all. This is exact while the axis does not turn; otherwise it holds for the middle of
/// the leg.
#[derive(Debug, Clone, Copy)]
pub(super) struct PassingTime {
    tip: [f64; 2],
    direction: [f64; 2],
    /// The components of the axis to the left of the travel and along it.
    left: f64,
    ahead: f64,
    /// The heights of the ellipses that reach furthest to the right and to the left, in ascending order.
    heights: [f64; 2],
    /// The shift of a chord's middle along the travel per lateral distance.
    skew: f64,
    /// The speed along the travel at the tip, and its growth with height.
    speed: [f64; 2],
}

impl PassingTime {
    /// Prepares the time for a leg; returns `None` if the cutter does not move sideways.
    pub(super) fn new(leg: &SweepLeg, solid: &RevolvedSolid) -> Option<Self> {
        let middle = leg.pose_at(0.5);
        let axis = middle.axis;
        let swing = leg.spin.cross(&axis);
        let at = |height: f64| leg.travel + swing * height;
        let wide = |v: &Vector3<f64>| v.x.hypot(v.y) > 1e-9;
        let typical = [0.5 * solid.top_mm(), solid.top_mm()].map(at).into_iter().find(wide)?;
        let norm = typical.x.hypot(typical.y);
        let direction = [typical.x / norm, typical.y / norm];
        let [ux, uy] = direction;
        let (left, ahead) = (axis.y * ux - axis.x * uy, axis.x * ux + axis.y * uy);
        let width2 = (1.0 - left * left).max(0.0);
        // The direction to the left has the component `left` along the axis and sqrt(1 - left^2) across it.
        let [_, one] = solid.furthest_meridian_point(width2.sqrt(), left);
        let [_, two] = solid.furthest_meridian_point(width2.sqrt(), -left);
        let along = |v: &Vector3<f64>| v.x * ux + v.y * uy;
        Some(Self {
            tip: [middle.tip.x, middle.tip.y],
            direction,
            left,
            ahead,
            heights: [one.min(two), one.max(two)],
            skew: if width2 > 1e-12 { -left * ahead / width2 } else { 0.0 },
            speed: [along(&leg.travel), along(&swing)],
        })
    }

    /// Returns the time for a column, from 0 to 1.
    fn time_over(&self, [x, y]: [f64; 2]) -> f64 {
        let [ux, uy] = self.direction;
        let (x, y) = (x - self.tip[0], y - self.tip[1]);
        let (along, aside) = (x * ux + y * uy, y * ux - x * uy);
        let [low, high] = self.heights;
        // The centres of the ellipses are on the projected axis; take the one at the column's lateral
        // distance, if it exists.
        let crossing = if self.left.abs() > 1e-12 { aside / self.left } else { low };
        let height = crossing.max(low).min(high);
        let rest = along - height * self.ahead - self.skew * (aside - height * self.left);
        let speed = self.speed[0] + self.speed[1] * height;
        if speed.abs() > 1e-12 { (0.5 + rest / speed).clamp(0.0, 1.0) } else { 0.5 }
    }
}

/// One end of the time interval that is still searched.
#[derive(Debug, Clone, Copy)]
struct TimeBracketEnd {
    at: f64,
    /// The sample, or `None` if the cutter is not over the column then.
    sample: Option<SolidColumnSample>,
}

/// Where the leg before has left the cutter over a column: the leg that goes on from there need not look again. The outer
/// `None` says that nobody looked, the inner one that the cutter is not over the column.
pub(super) type KnownStart = Option<Option<SolidColumnSample>>;

/// Returns the least value over a column on a leg, or `None` if the leg changes nothing there. `start` is what is known of
/// the leg's start, and becomes what is known of its end.
pub(super) fn find_leg_extremum(
    leg: &SweepLeg,
    solid: &RevolvedSolid,
    passing: Option<&PassingTime>,
    column: [f64; 2],
    ask: LegExtremumQuery,
    start: &mut KnownStart,
) -> Option<LegExtremum> {
    let sample = |at: f64| TimeBracketEnd { at, sample: leg.sample_column(solid, column, ask.side, at) };
    let mut best = LegExtremum {
        value: f64::INFINITY,
        other: if ask.side == SolidSpanEnd::Lower { f64::NEG_INFINITY } else { f64::INFINITY },
    };
    let mut note = |end: &TimeBracketEnd| {
        if let Some(sample) = &end.sample {
            best.value = best.value.min(sample.value);
            best.other = if ask.side == SolidSpanEnd::Lower {
                best.other.max(sample.other)
            } else {
                best.other.min(sample.other)
            };
        }
        best
    };
    let first = match start.take() {
        Some(known) => TimeBracketEnd { at: 0.0, sample: known },
        None => sample(0.0),
    };
    let rises = |end: &TimeBracketEnd| end.sample.is_some_and(|sample| sample.slope >= 0.0);
    let falls = |end: &TimeBracketEnd| end.sample.is_some_and(|sample| sample.slope <= 0.0);
    // The usual case is a column behind a cutter that moves away, or far ahead of it. It is decided by one
    // sample and its tangent.
    if first.sample.is_some_and(|sample| sample.value + sample.slope.min(0.0) >= ask.useless) {
        return None;
    }
    note(&first);
    let last = sample(1.0);
    *start = Some(last.sample);
    let mut found = note(&last);
    let done = |found: LegExtremum| (found.value < ask.useless).then_some(found);
    // A convex function that rises at the start or falls at the end has its minimum there.
    if rises(&first) || falls(&last) || found.value <= ask.enough {
        return done(found);
    }
    let (mut low, mut high) = (first, last);
    let finest = 0.02 * ask.tolerance / (leg.travel.norm() + leg.angle * solid.top_mm()).max(1e-12);
    for round in 0..48 {
        let width = high.at - low.at;
        let at = match (&low.sample, &high.sample) {
            (Some(left), Some(right)) => {
                // The tangents at both ends meet at `step`, and their height there bounds the minimum from
                // below.
                let step = (right.value - left.value - right.slope * width) / (left.slope - right.slope);
                let bound = left.value + left.slope * step;
                if bound >= ask.useless || found.value - bound <= ask.tolerance {
                    break;
                }
                // Every third round bisects, so that a slow side cannot stall the search.
                let step = if round % 3 == 2 { width / 2.0 } else { step };
                low.at + step.clamp(0.1 * width, 0.9 * width)
            }
            _ if round == 0 => passing.map_or(0.5, |passing| passing.time_over(column)),
            _ => low.at + width / 2.0,
        };
        if width <= finest {
            break;
        }
        let here = sample(at);
        found = note(&here);
        if found.value <= ask.enough {
            break;
        }
        // A sample without the cutter over the column lies on the side that has no sample either.
        match &here.sample {
            Some(sample) if sample.slope < 0.0 => low = here,
            Some(_) => high = here,
            None if low.sample.is_none() && high.sample.is_none() => return None,
            None if low.sample.is_none() => low = here,
            None => high = here,
        }
    }
    done(found)
}

//! This module follows the middle of an indexable cutter, which does not cut, along a straight piece.
//!
//! A column is under the middle on one interval of the path: the disc of radius D/2 - r is convex. Before and after it the
//! inserts pass over the column. A convex cutter that descends, or stays level, has its lowest contact with a
//! column at the latest of them, and one that rises at the earliest. So where the whole interval lies on the piece the column
//! ends as low as under a cutter without a recess. Only a column that is under the middle at an end of the piece keeps
//! more: on a descent it is as high as the inserts left it when it came under the middle. That is the pillar. It may stand as
//! high as the recess; what is higher meets the body. As with a shank, that is told and the material stays, until inserts
//! take it.

use crate::cutter::{DeadMiddle, Meridian};

/// A body that is pushed less deep into a pillar (mm) is not told: printed coordinates and columns are no better.
const LEAST_DEPTH_MM: f64 = 0.01;

/// The middle on a piece. Heights count from the grid's base.
#[derive(Debug, Clone, Copy)]
pub(super) struct DeadMiddleSweep {
    middle: DeadMiddle,
    /// The height of the cutter's bottom at the edge of the middle, above the tip.
    edge: f64,
    /// The heights of the tip at the start and at the end.
    tips: [f64; 2],
    /// The length of the piece across the axis; 0 straight along it.
    length: f64,
}

/// What a piece does to a column under the middle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct ColumnUnderMiddle {
    /// The height down to which the inserts remove the column; infinite if they do not reach it.
    pub height: f64,
    /// How high the column stands above the tip when the body meets it, and its top there. `None` if it is cleared.
    pub pillar: Option<[f64; 2]>,
}

impl DeadMiddleSweep {
    /// Prepares the middle for a piece; `None` for a cutter that cuts up to its axis.
    pub(super) fn new(profile: &Meridian, tips: [f64; 2], length: f64) -> Option<Self> {
        let middle = profile.dead_middle()?;
        let edge = profile.height_at_radius_mm(middle.radius_mm);
        Some(Self { middle, edge, tips, length })
    }

    /// Returns how much the recess clears, mm.
    pub(super) fn clearance_mm(&self) -> f64 {
        self.middle.clearance_mm
    }

    /// Judges a column `along` ahead of the start and `left` of the path, whose material ends at `top`. `swept` is the height
    /// down to which a cutter without a recess would remove it. Returns `None` if the column never comes under the middle.
    pub(super) fn judge_column(
        &self,
        [along, left]: [f64; 2],
        swept: f64,
        top: f64,
    ) -> Option<ColumnUnderMiddle> {
        let half = self.middle.radius_mm * self.middle.radius_mm - left * left;
        if half <= 0.0 {
            return None;
        }
        let half = half.sqrt();
        let [enters, leaves] = [along - half, along + half];
        if leaves <= 0.0 || enters >= self.length {
            return None;
        }
        let [first, last] = self.tips;
        let tip_at = |at: f64| {
            let share = if self.length > 0.0 { (at / self.length).clamp(0.0, 1.0) } else { 0.0 };
            first + (last - first) * share
        };
        let (starts_under, ends_under) = (enters < 0.0, leaves > self.length);
        let lowest_tip = if self.length > 0.0 { tip_at(enters).min(tip_at(leaves)) } else { first.min(last) };
        // What the inserts leave of the column before it comes under the middle, or take of it afterwards.
        let descends = last <= first;
        let by_inserts = match (starts_under, ends_under) {
            (true, true) => f64::INFINITY,
            (false, true) if descends => tip_at(enters) + self.edge,
            (true, false) if !descends => tip_at(leaves) + self.edge,
            _ => swept,
        };
        let stands = if starts_under { top } else { top.min(tip_at(enters) + self.edge) };
        let above = stands - lowest_tip;
        let pillar = (above - self.middle.clearance_mm > LEAST_DEPTH_MM).then_some([above, stands]);
        Some(ColumnUnderMiddle { height: by_inserts, pillar })
    }
}

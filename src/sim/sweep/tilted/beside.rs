//! What a tilted piece passes closely: material beside the flank, and collars in material.

use super::ground::Ground;
use super::leg::{Leg, Side, across};
use super::search::{Ask, Passing, least};
use super::solid::Solid;
use crate::sim::dexel::{Band, Layout};
use nalgebra::Vector3;

/// Where the flank is widest across the path: a line of points on each side that moves with the cutter.
#[derive(Debug, Clone)]
pub(super) struct Beside {
    /// Radius where the flank begins, and its growth with height.
    pub radius: f64,
    pub slope: f64,
    /// Heights above the tip.
    pub heights: [f64; 2],
    /// Part of the travel across the axis.
    pub across: f64,
    pub direction: Option<Vector3<f64>>,
}

impl Beside {
    /// Share of a sliver that the grid may hide beside the flank, if there is material in any column one cell further out
    /// than the flank passes, at a height where the flank passes it; else 0. Slivers above or below, where columns know
    /// exact heights, are not hidden.
    pub fn graze(&self, leg: &Leg, band: &Band, layout: &Layout, known: f64) -> f64 {
        let cell = layout.cell;
        let (from, to) = (self.heights[0], self.heights[1]);
        let axis = leg.pose(0.5).axis;
        let direction = self.direction.unwrap_or_else(|| leg.spin.cross(&axis));
        let aside = direction - axis * direction.dot(&axis);
        let ahead = if aside.norm() > 1e-6 * direction.norm() { aside.normalize() } else { across(&axis) };
        let left = axis.cross(&ahead);
        let level = left.x.hypot(left.y);
        if level < 1e-6 || from >= to {
            return 0.0;
        }
        let inner = (self.radius - cell * level).max(0.0) / self.radius;
        let share = self.across * (1.0 - inner * inner).max(0.0).sqrt();
        if share <= known {
            return 0.0;
        }
        let lean = axis.x.hypot(axis.y);
        let length = leg.travel.norm() + leg.spin.norm() * to;
        let steps = (length / cell).ceil().max(1.0) as usize;
        let stack = ((to - from) * lean / cell).ceil().max(1.0) as usize;
        for step in 0..=steps {
            let pose = leg.pose(step as f64 / steps as f64);
            for side in [1.0, -1.0] {
                let out = [left.x / level * cell * side, left.y / level * cell * side];
                let at = |part: usize| from + (to - from) * part as f64 / stack as f64;
                for part in 0..stack {
                    let ends = [at(part), at(part + 1)].map(|height| {
                        let radius = self.radius + self.slope * (height - from);
                        pose.tip + pose.axis * height + left * (radius * side)
                    });
                    let [x, y] =
                        [(ends[0].x + ends[1].x) / 2.0 + out[0], (ends[0].y + ends[1].y) / 2.0 + out[1]];
                    let heights = [ends[0].z.min(ends[1].z), ends[0].z.max(ends[1].z)];
                    if holds(band, layout, [x, y], heights) {
                        return share;
                    }
                }
            }
        }
        0.0
    }
}

/// Whether the column next to a place holds material between two heights.
fn holds(band: &Band, layout: &Layout, [x, y]: [f64; 2], [low, high]: [f64; 2]) -> bool {
    let [x0, y0] = layout.origin;
    let (column, row) = (((x - x0) / layout.cell).round(), ((y - y0) / layout.cell).round());
    let first = band.first_row as f64;
    if column < 0.0 || column >= band.columns as f64 || row < first || row >= first + band.rows() as f64 {
        return false;
    }
    let index = (row as usize - band.first_row) * band.columns + column as usize;
    // Ground that the cutter itself left touches it; a thousandth is no sliver.
    let (low, high) = ((low + 1e-3) as f32, (high - 1e-3) as f32);
    band.intervals(index).any(|[from, to]| from < high && to > low)
}

/// A collar of a piece.
#[derive(Debug, Clone)]
pub(super) struct Guard {
    pub index: usize,
    pub solid: Solid,
}

impl Guard {
    /// Ground under a leg.
    pub fn ground(&self, leg: &Leg) -> Ground {
        Ground::new(leg, self.solid.radius(), [self.solid.floor(), self.solid.top()])
    }

    /// Greatest depth in a row to which the collar is below the top of material, where the topmost interval meets it.
    pub fn depth(&self, leg: &Leg, band: &Band, layout: &Layout, row: usize, tolerance: f64) -> f64 {
        let passing = Passing::new(leg, &self.solid);
        let offset = (row - band.first_row) * band.columns;
        let lowest = lowest(leg, &self.solid) as f32;
        let mut deepest = 0.0f64;
        for column in self.ground(leg).columns(row, layout) {
            let Some(top) = band.top.get(offset + column).filter(|top| **top > lowest) else { continue };
            for [from, to] in band.intervals(offset + column) {
                // Only what is deeper than known matters.
                let useless = f64::from(to) - deepest.max(tolerance);
                let ask = Ask { side: Side::Lower, enough: f64::NEG_INFINITY, useless, tolerance };
                let center = layout.center(column, row);
                let Some(found) = least(leg, &self.solid, passing.as_ref(), center, ask) else { continue };
                if found.other > f64::from(from) {
                    deepest = deepest.max((f64::from(to) - found.value).min(f64::from(top - lowest)));
                }
            }
        }
        deepest
    }
}

/// Lowest height that a solid reaches on a leg, not above the true one.
pub(super) fn lowest(leg: &Leg, solid: &Solid) -> f64 {
    let at = |tip: &Vector3<f64>, axis: &Vector3<f64>| {
        let [down, _] = solid.furthest(axis.x.hypot(axis.y), -axis.z);
        tip.z - down
    };
    let reach = solid.top().hypot(solid.radius());
    at(&leg.from.tip, &leg.from.axis).min(at(&leg.to.tip, &leg.to.axis)) - reach * leg.angle * leg.angle / 8.0
}

//! What a tilted piece passes closely: material beside the flank, and collars in material.

use super::leg::{SolidSpanEnd, SweepLeg, unit_vector_across};
use super::leg_extremum::{LegExtremumQuery, PassingTime, find_leg_extremum};
use super::leg_footprint::LegFootprint;
use super::revolved_solid::RevolvedSolid;
use crate::sim::dexel::{DexelBand, DexelGrid};
use nalgebra::Vector3;

/// Where the flank is widest across the path: a line of points on each side that moves with the cutter.
#[derive(Debug, Clone)]
pub(super) struct FlankSilhouette {
    /// Radius where the flank begins, and its growth with height.
    pub radius: f64,
    pub slope: f64,
    /// Heights above the tip.
    pub heights: [f64; 2],
    /// Part of the travel across the axis.
    pub across: f64,
    pub direction: Option<Vector3<f64>>,
}

impl FlankSilhouette {
    /// Share of a sliver that the grid may hide beside the flank, if there is material in any column one cell further out
    /// than the flank passes, at a height where the flank passes it; else 0. Slivers above or below, where columns know
    /// exact heights, are not hidden.
    pub fn hidden_sliver_ratio(
        &self,
        leg: &SweepLeg,
        band: &DexelBand,
        layout: &DexelGrid,
        known: f64,
    ) -> f64 {
        let cell = layout.cell;
        let (from, to) = (self.heights[0], self.heights[1]);
        let axis = leg.pose_at(0.5).axis;
        let direction = self.direction.unwrap_or_else(|| leg.spin.cross(&axis));
        let aside = direction - axis * direction.dot(&axis);
        let ahead = if aside.norm() > 1e-6 * direction.norm() {
            aside.normalize()
        } else {
            unit_vector_across(&axis)
        };
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
            let pose = leg.pose_at(step as f64 / steps as f64);
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
                    if has_material_between(band, layout, [x, y], heights) {
                        return share;
                    }
                }
            }
        }
        0.0
    }
}

/// Whether the column next to a place holds material between two heights.
fn has_material_between(
    band: &DexelBand,
    layout: &DexelGrid,
    [x, y]: [f64; 2],
    [low, high]: [f64; 2],
) -> bool {
    let [x0, y0] = layout.origin;
    let (column, row) = (((x - x0) / layout.cell).round(), ((y - y0) / layout.cell).round());
    let first = band.first_row as f64;
    if column < 0.0 || column >= band.columns as f64 || row < first || row >= first + band.row_count() as f64
    {
        return false;
    }
    let index = (row as usize - band.first_row) * band.columns + column as usize;
    // Ground that the cutter itself left touches it; a thousandth is no sliver.
    let (low, high) = ((low + 1e-3) as f32, (high - 1e-3) as f32);
    band.column_spans(index).any(|[from, to]| from < high && to > low)
}

/// A collar of a piece.
#[derive(Debug, Clone)]
pub(super) struct NonCuttingSolid {
    pub index: usize,
    pub solid: RevolvedSolid,
}

impl NonCuttingSolid {
    /// Ground under a leg.
    pub fn leg_footprint(&self, leg: &SweepLeg) -> LegFootprint {
        LegFootprint::new(leg, self.solid.radius_mm(), [self.solid.floor_mm(), self.solid.top_mm()])
    }

    /// Greatest depth in a row to which the collar is below the top of material, where the topmost interval meets it.
    pub fn collision_depth_mm(
        &self,
        leg: &SweepLeg,
        band: &DexelBand,
        layout: &DexelGrid,
        row: usize,
        tolerance: f64,
    ) -> f64 {
        let passing = PassingTime::new(leg, &self.solid);
        let offset = (row - band.first_row) * band.columns;
        let lowest = lowest_height_on_leg(leg, &self.solid) as f32;
        let mut deepest = 0.0f64;
        for column in self.leg_footprint(leg).column_range(row, layout) {
            let Some(top) = band.top.get(offset + column).filter(|top| **top > lowest) else { continue };
            for [from, to] in band.column_spans(offset + column) {
                // Only what is deeper than known matters.
                let useless = f64::from(to) - deepest.max(tolerance);
                let ask = LegExtremumQuery {
                    side: SolidSpanEnd::Lower,
                    enough: f64::NEG_INFINITY,
                    useless,
                    tolerance,
                };
                let center = layout.column_center(column, row);
                let Some(found) = find_leg_extremum(leg, &self.solid, passing.as_ref(), center, ask) else {
                    continue;
                };
                if found.other > f64::from(from) {
                    deepest = deepest.max((f64::from(to) - found.value).min(f64::from(top - lowest)));
                }
            }
        }
        deepest
    }
}

/// Lowest height that a solid reaches on a leg, not above the true one.
pub(super) fn lowest_height_on_leg(leg: &SweepLeg, solid: &RevolvedSolid) -> f64 {
    let at = |tip: &Vector3<f64>, axis: &Vector3<f64>| {
        let [down, _] = solid.furthest_meridian_point(axis.x.hypot(axis.y), -axis.z);
        tip.z - down
    };
    let reach = solid.top_mm().hypot(solid.radius_mm());
    at(&leg.from.tip, &leg.from.axis).min(at(&leg.to.tip, &leg.to.axis)) - reach * leg.angle * leg.angle / 8.0
}

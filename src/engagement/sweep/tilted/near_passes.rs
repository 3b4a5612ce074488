//! This module examines what a tilted piece passes closely: material beside the flank, and shanks and holders
//! in material.

use super::leg::{SolidSpanEnd, SweepLeg, unit_vector_across};
use super::leg_extremum::{LegExtremumQuery, PassingTime, find_leg_extremum};
use super::leg_footprint::LegFootprint;
use super::revolved_solid::RevolvedSolid;
use crate::stock::dexel::{DexelBand, DexelGrid};
use nalgebra::Vector3;

/// The two lines on the flank where it is widest across the path, one on each side. They move with the
/// cutter.
#[derive(Debug, Clone)]
pub(super) struct FlankSilhouette {
    /// The radius where the flank begins, and its growth with height.
    pub radius: f64,
    pub slope: f64,
    /// The lowest and the highest height above the tip, mm.
    pub heights: [f64; 2],
    /// The component of the travel across the axis.
    pub across: f64,
    pub direction: Option<Vector3<f64>>,
}

impl FlankSilhouette {
    /// Returns the advance ratio of a sliver that the grid may hide beside the flank. It is not 0 if a column
    /// one cell further out than the flank has material at a height where the flank passes. Slivers above or
    /// below are not hidden, since columns have exact heights.
    pub(super) fn hidden_sliver_ratio(
        &self,
        leg: &SweepLeg,
        band: &DexelBand,
        layout: &DexelGrid,
        known: f64,
    ) -> f64 {
        let cell = layout.cell_mm;
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
        // A sliver begins at most a cell inside the flank, where cos(theta) = sqrt(1 - (inner / R)^2).
        let inner = (self.radius - cell * level).max(0.0) / self.radius;
        let share = self.across * (1.0 - inner * inner).max(0.0).sqrt();
        if share <= known {
            return 0.0;
        }
        let lean = axis.x.hypot(axis.y);
        let length = leg.travel.norm() + leg.spin.norm() * to;
        // Steps along the leg and along the lines are at most a cell, so that no column is left out.
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

/// Returns whether the column nearest to a point has material between two heights.
fn has_material_between(
    band: &DexelBand,
    layout: &DexelGrid,
    [x, y]: [f64; 2],
    [low, high]: [f64; 2],
) -> bool {
    let [x0, y0] = layout.origin_mm;
    let (column, row) = (((x - x0) / layout.cell_mm).round(), ((y - y0) / layout.cell_mm).round());
    let first = band.first_row as f64;
    if column < 0.0 || column >= band.columns as f64 || row < first || row >= first + band.row_count() as f64
    {
        return false;
    }
    let index = (row as usize - band.first_row) * band.columns + column as usize;
    // The ground that the cutter itself left touches it, so a thousandth of a mm does not count.
    let (low, high) = ((low + 1e-3) as f32, (high - 1e-3) as f32);
    band.column_spans(index).any(|[from, to]| from < high && to > low)
}

/// A shank or holder of a piece, with its index in the cutter's list.
#[derive(Debug, Clone)]
pub(super) struct NonCuttingSolid {
    pub index: usize,
    pub solid: RevolvedSolid,
}

impl NonCuttingSolid {
    /// Returns the ground under a leg.
    pub(super) fn leg_footprint(&self, leg: &SweepLeg) -> LegFootprint {
        LegFootprint::new(leg, self.solid.radius_mm(), [self.solid.floor_mm(), self.solid.top_mm()])
    }

    /// Returns the greatest depth in a row by which the solid is below the top of material that it meets, mm;
    /// 0 if it meets none.
    pub(super) fn collision_depth_mm(
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
                // Only a greater depth than the known one matters.
                let useless = f64::from(to) - deepest.max(tolerance);
                let ask = LegExtremumQuery {
                    side: SolidSpanEnd::Lower,
                    enough: f64::NEG_INFINITY,
                    useless,
                    tolerance,
                };
                let center = layout.column_center(column, row);
                let found = find_leg_extremum(leg, &self.solid, passing.as_ref(), center, ask, &mut None);
                let Some(found) = found else { continue };
                if found.other > f64::from(from) {
                    deepest = deepest.max((f64::from(to) - found.value).min(f64::from(top - lowest)));
                }
            }
        }
        deepest
    }
}

/// Returns a lower bound of the heights that a solid reaches on a leg.
pub(super) fn lowest_height_on_leg(leg: &SweepLeg, solid: &RevolvedSolid) -> f64 {
    let at = |tip: &Vector3<f64>, axis: &Vector3<f64>| {
        let [down, _] = solid.furthest_meridian_point(axis.x.hypot(axis.y), -axis.z);
        tip.z - down
    };
    let reach = solid.top_mm().hypot(solid.radius_mm());
    at(&leg.from.tip, &leg.from.axis).min(at(&leg.to.tip, &leg.to.axis)) - reach * leg.angle * leg.angle / 8.0
}

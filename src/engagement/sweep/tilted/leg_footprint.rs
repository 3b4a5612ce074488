//! This module finds the ground under a leg: the columns of a row that it can change.

use super::leg::SweepLeg;
use crate::stock::dexel::DexelGrid;
use nalgebra::Vector3;
use std::ops::Range;

/// The convex hull, seen from above, of four discs of one radius around the lower and upper end of the axis
/// at the start and at the end of a leg.
#[derive(Debug, Clone, Copy)]
pub(super) struct LegFootprint {
    centers: [[f64; 2]; 4],
    radius: f64,
}

impl LegFootprint {
    /// Makes the ground of everything within a radius of the axis between two heights. While the axis turns,
    /// a point leaves the straight line between its two ends by at most `distance angle^2 / 8`, so the radius
    /// is increased by that.
    pub(super) fn new(leg: &SweepLeg, radius: f64, heights: [f64; 2]) -> Self {
        let [low, high] = heights;
        let at = |tip: &Vector3<f64>, axis: &Vector3<f64>, height: f64| {
            let point = tip + axis * height;
            [point.x, point.y]
        };
        let centers = [
            at(&leg.from.tip, &leg.from.axis, low),
            at(&leg.from.tip, &leg.from.axis, high),
            at(&leg.to.tip, &leg.to.axis, low),
            at(&leg.to.tip, &leg.to.axis, high),
        ];
        Self { centers, radius: radius + high.hypot(radius) * leg.angle * leg.angle / 8.0 }
    }

    /// Returns the rows of a grid that the ground touches.
    pub(super) fn row_range(&self, layout: &DexelGrid) -> Range<usize> {
        let low = self.centers.iter().fold(f64::INFINITY, |least, [_, y]| least.min(*y)) - self.radius;
        let high = self.centers.iter().fold(f64::NEG_INFINITY, |most, [_, y]| most.max(*y)) + self.radius;
        center_index_range([low, high], layout.origin_mm[1], layout.cell_mm, layout.rows)
    }

    /// Returns the columns of a row of a grid that the ground touches.
    pub(super) fn column_range(&self, row: usize, layout: &DexelGrid) -> Range<usize> {
        let y = layout.column_center(0, row)[1];
        match self.x_range_at(y) {
            Some(stretch) => center_index_range(stretch, layout.origin_mm[0], layout.cell_mm, layout.columns),
            None => 0..0,
        }
    }

    /// Returns the least and the greatest x at y. They are ends of chords of the discs, or points on the
    /// lines that touch two discs.
    fn x_range_at(&self, y: f64) -> Option<[f64; 2]> {
        let radius = self.radius;
        let mut found = [f64::INFINITY, f64::NEG_INFINITY];
        let mut add = |low: f64, high: f64| found = [found[0].min(low), found[1].max(high)];
        for (index, [cx, cy]) in self.centers.iter().enumerate() {
            let half2 = radius * radius - (y - cy) * (y - cy);
            if half2 >= 0.0 {
                add(cx - half2.sqrt(), cx + half2.sqrt());
            }
            for [ox, oy] in self.centers.iter().skip(index + 1) {
                let (dx, dy) = (ox - cx, oy - cy);
                let length = dx.hypot(dy);
                if dy.abs() <= 1e-9 * (1.0 + length) {
                    continue;
                }
                // A common tangent of two equal discs is their centre line moved by R to one side.
                for side in [radius, -radius] {
                    let share = (y - cy - side * dx / length) / dy;
                    if (0.0..=1.0).contains(&share) {
                        let x = cx + share * dx - side * dy / length;
                        add(x, x);
                    }
                }
            }
        }
        (found[0] <= found[1]).then_some(found)
    }
}

/// Returns the columns or rows whose centres are between two coordinates.
fn center_index_range([low, high]: [f64; 2], origin: f64, cell: f64, count: usize) -> Range<usize> {
    let first = ((low - origin) / cell).ceil().clamp(0.0, count as f64) as usize;
    let end = (((high - origin) / cell).floor() + 1.0).clamp(0.0, count as f64) as usize;
    first..end.max(first)
}

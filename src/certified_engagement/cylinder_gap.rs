//! This module holds a round bar as stock.

use super::arc_stock::{add_arc_times_beyond, add_chord_times};
use super::cutter_pose::{PointArc, PointLine};
use super::plane_path::{Crossings, PlanePath};
use super::stock_gap::{HullMargin, StockGap, add_times_beyond};
use super::time_spans::TimeSpans;
use nalgebra::{Vector2, Vector3};

/// A round bar in any direction.
#[derive(Debug, Clone, PartialEq)]
pub struct CylinderGap {
    from: Vector3<f64>,
    axis: Vector3<f64>,
    length: f64,
    radius: f64,
}

impl CylinderGap {
    /// Makes the bar between the centres of its ends, mm; `None` if it has no length.
    pub fn new(radius_mm: f64, from: Vector3<f64>, to: Vector3<f64>) -> Option<Self> {
        let axis = (to - from).try_normalize(1e-9)?;
        Some(Self { from, axis, length: (to - from).norm(), radius: radius_mm })
    }

    fn across(&self, point: &Vector3<f64>) -> Vector3<f64> {
        let offset = point - self.from;
        offset - self.axis * offset.dot(&self.axis)
    }
}

impl StockGap for CylinderGap {
    fn gap(&self, point: &Vector3<f64>) -> f64 {
        let along = (point - self.from).dot(&self.axis);
        (self.across(point).norm() - self.radius).max(-along).max(along - self.length)
    }

    fn bounds(&self) -> [Vector3<f64>; 2] {
        let to = self.from + self.axis * self.length;
        let across = self.axis.map(|part| self.radius * (1.0 - part * part).max(0.0).sqrt());
        [self.from.inf(&to) - across, self.from.sup(&to) + across]
    }

    /// The round side is replaced by tangent planes towards the middle line at the ends of `need` and where
    /// it crosses the side, so what is lost grows with the square of the patch.
    fn add_outside_times(
        &self,
        lines: &[PointLine],
        need: [f64; 2],
        margin: HullMargin,
        out: &mut Vec<[f64; 2]>,
    ) {
        let base = self.axis.dot(&self.from);
        add_times_beyond(lines, &self.axis, base + self.length, margin, out);
        add_times_beyond(lines, &-self.axis, -base, margin, out);
        let Some(middle) = lines.first() else { return };
        let (start, travel) = (self.across(&middle.start), middle.travel);
        let travel = travel - self.axis * travel.dot(&self.axis);
        let squared = travel.norm_squared();
        let mut times = [Some(need[0]), Some(need[1]), None, None];
        if squared > 1e-24 {
            let closest = -start.dot(&travel) / squared;
            let reach = self.radius + (margin.all + margin.skew).max(0.0);
            let root = reach * reach - (start + travel * closest).norm_squared();
            if root >= 0.0 {
                let half = (root / squared).sqrt();
                times[2] = Some(closest - half);
                times[3] = Some(closest + half);
            } else {
                times[2] = Some(closest);
            }
        }
        for time in times.into_iter().flatten() {
            if let Some(normal) = (start + travel * time).try_normalize(1e-9) {
                add_times_beyond(lines, &normal, normal.dot(&self.from) + self.radius, margin, out);
            }
        }
    }

    /// About a parallel to the bar's axis the distance of the corners tells. In between, points of a hull may
    /// be nearer to the bar's axis by what its bend leaves.
    fn add_outside_arc_times(
        &self,
        arcs: &[PointArc],
        need: [f64; 2],
        margin: HullMargin,
        out: &mut Vec<[f64; 2]>,
    ) {
        let base = self.axis.dot(&self.from);
        add_arc_times_beyond(arcs, &self.axis, base + self.length, need, margin, out);
        add_arc_times_beyond(arcs, &-self.axis, -base, need, margin, out);
        let Some(middle) = arcs.first() else { return };
        let is_along = |arc: &PointArc| {
            arc.first.dot(&self.axis).abs() < 1e-12 && arc.second.dot(&self.axis).abs() < 1e-12
        };
        let across = self.axis.cross(&middle.first).try_normalize(1e-9);
        let (true, Some(across)) = (arcs.iter().all(is_along), across) else {
            let mut of_chord =
                |lines: &[PointLine], need: [f64; 2], margin: HullMargin, out: &mut Vec<[f64; 2]>| {
                    self.add_outside_times(lines, need, margin, out);
                };
            return add_chord_times(arcs, need, margin, &mut of_chord, out);
        };
        let other = across.cross(&self.axis);
        let plane = |vector: &Vector3<f64>| Vector2::new(vector.dot(&other), vector.dot(&across));
        let apart = |arc: &PointArc| (arc.at(need[0]) - middle.at(need[0])).norm();
        let spread = arcs.iter().map(apart).fold(0.0, f64::max);
        let low = (self.radius * self.radius - spread * spread).max(0.0).sqrt();
        // The distance from the bar's axis less R²/(2 low) is concave in R wherever R is at least low.
        let excess = if low > spread * 0.25 { spread * spread / (2.0 * low) } else { 2.0 * spread };
        let reach = self.radius + margin.towards(&other).max(margin.towards(&across)) + excess;
        let mut both = TimeSpans::one(need, false);
        for arc in arcs {
            let path = PlanePath::Arc {
                center: plane(&(arc.center - self.from)),
                first: plane(&arc.first),
                second: plane(&arc.second),
                angle: arc.angle,
            };
            let mut crossings = Crossings::new(need);
            path.cross_circle(&Vector2::zeros(), reach, &mut crossings);
            both = both.common(&crossings.spans(false, &|time| path.at(time).norm() >= reach));
        }
        out.extend_from_slice(both.spans());
    }

    fn contains_segment(&self, from: &Vector3<f64>, to: &Vector3<f64>, margin: f64) -> bool {
        self.gap(from) < -margin && self.gap(to) < -margin
    }
}

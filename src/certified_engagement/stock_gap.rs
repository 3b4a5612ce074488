//! This module holds what certified engagement needs to know of the initial stock: its gap, and when it is
//! far.

use super::arc_stock::{add_arc_times_beyond, add_chord_times};
use super::cutter_pose::{PointArc, PointLine};
use nalgebra::Vector3;

/// How far points may be from a hull: in all directions, and further across an axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct HullMargin {
    /// The distance in all directions, mm.
    pub all: f64,
    /// The distance across the axis that is added to it.
    pub aside: f64,
    /// The distance that may be added in its place, in all directions.
    pub skew: f64,
    /// The axis, a unit vector; zero counts every direction as across it.
    pub axis: Vector3<f64>,
}

impl Default for HullMargin {
    fn default() -> Self {
        Self { all: 0.0, aside: 0.0, skew: 0.0, axis: Vector3::zeros() }
    }
}

impl HullMargin {
    /// Returns the distance in the direction of a unit vector.
    pub fn towards(&self, direction: &Vector3<f64>) -> f64 {
        // The cross product is exact for parallel directions, where one minus the squared cosine would be
        // rounded.
        let across =
            if self.axis == Vector3::zeros() { 1.0 } else { direction.cross(&self.axis).norm().min(1.0) };
        self.all + self.skew.min(self.aside * across)
    }
}

/// A body of stock. What a body does not prove to be outside counts as material.
pub trait StockGap: Send + Sync {
    /// Returns the gap of a point, mm: negative inside, at most the distance outside, at least minus the
    /// depth inside, and so 1-Lipschitz.
    fn gap(&self, point: &Vector3<f64>) -> f64;

    /// Returns the lowest and the highest corner of a box around the body, mm.
    fn bounds(&self) -> [Vector3<f64>; 2];

    /// Adds times within `need` at which all points within the `margin` of the hull of the lines' points are
    /// outside. The first line is the middle of the others.
    ///
    /// The general form halves the times until the gap of the middle line tells.
    fn add_outside_times(
        &self,
        lines: &[PointLine],
        need: [f64; 2],
        margin: HullMargin,
        out: &mut Vec<[f64; 2]>,
    ) {
        let Some(middle) = lines.first() else { return };
        let margin = margin.all + margin.skew;
        let apart = |line: &PointLine, time: f64| (line.at(time) - middle.at(time)).norm();
        let spread = lines.iter().map(|line| apart(line, need[0]).max(apart(line, need[1])));
        let radius = spread.fold(0.0, f64::max) + margin;
        let speed = middle.travel.norm();
        let mut waiting = std::collections::VecDeque::from([need]);
        let mut spans = 0;
        while let Some([from, to]) = waiting.pop_front() {
            spans += 1;
            let half = speed * (to - from) / 2.0;
            let free = self.gap(&middle.at((from + to) / 2.0)) - radius;
            if free > half {
                out.push([from, to]);
            } else if free > -half && half > (radius * 0.05).max(1e-7) && spans + waiting.len() < 128 {
                let middle = (from + to) / 2.0;
                waiting.push_back([from, middle]);
                waiting.push_back([middle, to]);
            } else if free > 0.0 {
                let (center, reach) = ((from + to) / 2.0, free / speed.max(1e-12));
                out.push([(center - reach).max(from), (center + reach).min(to)]);
            }
        }
    }

    /// Adds times within `need` at which all points within the `margin` of the hull of points on arcs about one
    /// axis are outside. The first arc is the middle of the others.
    ///
    /// The general form takes chords as lines, and adds their sagitta to the margin.
    fn add_outside_arc_times(
        &self,
        arcs: &[PointArc],
        need: [f64; 2],
        margin: HullMargin,
        out: &mut Vec<[f64; 2]>,
    ) {
        let mut of_chord =
            |lines: &[PointLine], need: [f64; 2], margin: HullMargin, out: &mut Vec<[f64; 2]>| {
                self.add_outside_times(lines, need, margin, out);
            };
        add_chord_times(arcs, need, margin, &mut of_chord, out);
    }

    /// Returns whether a segment is inside, at least `margin` deep. Claiming too little is allowed.
    fn contains_segment(&self, from: &Vector3<f64>, to: &Vector3<f64>, margin: f64) -> bool {
        let length = (to - from).norm();
        let mut at = 0.0;
        for _ in 0..1000 {
            let place = if length > 0.0 { from + (to - from) * (at / length) } else { *from };
            let depth = -self.gap(&place) - margin;
            if depth <= 0.0 {
                return false;
            }
            if at >= length {
                return true;
            }
            at = (at + depth.max(1e-9)).min(length);
        }
        false
    }
}

/// Adds the times at which all lines are at least `margin` beyond a plane.
pub(super) fn add_times_beyond(
    lines: &[PointLine],
    normal: &Vector3<f64>,
    offset: f64,
    margin: HullMargin,
    out: &mut Vec<[f64; 2]>,
) {
    let margin = margin.towards(normal);
    let mut both = [f64::NEG_INFINITY, f64::INFINITY];
    for line in lines {
        let (start, rate) = (normal.dot(&line.start) - offset - margin, normal.dot(&line.travel));
        if rate > 0.0 {
            both[0] = both[0].max(-start / rate);
        } else if rate < 0.0 {
            both[1] = both[1].min(-start / rate);
        } else if start < 0.0 {
            return;
        }
    }
    if both[0] <= both[1] {
        out.push(both);
    }
}

/// Everything below a plane, within a box that limits it.
#[derive(Debug, Clone, PartialEq)]
pub struct HalfSpaceGap {
    normal: Vector3<f64>,
    offset: f64,
    bounds: [Vector3<f64>; 2],
}

impl HalfSpaceGap {
    /// Makes the points of the box whose product with the unit normal is at most the offset.
    pub fn new(normal: Vector3<f64>, offset_mm: f64, bounds: [Vector3<f64>; 2]) -> Self {
        Self { normal, offset: offset_mm, bounds }
    }
}

impl StockGap for HalfSpaceGap {
    fn gap(&self, point: &Vector3<f64>) -> f64 {
        (self.normal.dot(point) - self.offset).max(box_gap(&self.bounds, point))
    }

    fn bounds(&self) -> [Vector3<f64>; 2] {
        self.bounds
    }

    fn add_outside_times(
        &self,
        lines: &[PointLine],
        _: [f64; 2],
        margin: HullMargin,
        out: &mut Vec<[f64; 2]>,
    ) {
        add_times_beyond(lines, &self.normal, self.offset, margin, out);
        add_times_outside_box(&self.bounds, lines, margin, out);
    }

    fn add_outside_arc_times(
        &self,
        arcs: &[PointArc],
        need: [f64; 2],
        margin: HullMargin,
        out: &mut Vec<[f64; 2]>,
    ) {
        add_arc_times_beyond(arcs, &self.normal, self.offset, need, margin, out);
        add_arc_times_outside_box(&self.bounds, arcs, need, margin, out);
    }

    fn contains_segment(&self, from: &Vector3<f64>, to: &Vector3<f64>, margin: f64) -> bool {
        self.gap(from) < -margin && self.gap(to) < -margin
    }
}

/// A box along the axes.
#[derive(Debug, Clone, PartialEq)]
pub struct BoxGap {
    corners: [Vector3<f64>; 2],
}

impl BoxGap {
    /// Makes the box between its lowest and its highest corner, mm.
    pub fn new(lowest: Vector3<f64>, highest: Vector3<f64>) -> Self {
        Self { corners: [lowest, highest] }
    }
}

fn box_gap([low, high]: &[Vector3<f64>; 2], point: &Vector3<f64>) -> f64 {
    (low - point).max().max((point - high).max())
}

fn add_times_outside_box(
    [low, high]: &[Vector3<f64>; 2],
    lines: &[PointLine],
    margin: HullMargin,
    out: &mut Vec<[f64; 2]>,
) {
    let axes = [(Vector3::x(), low.x, high.x), (Vector3::y(), low.y, high.y), (Vector3::z(), low.z, high.z)];
    for (axis, low, high) in axes {
        add_times_beyond(lines, &axis, high, margin, out);
        add_times_beyond(lines, &-axis, -low, margin, out);
    }
}

fn add_arc_times_outside_box(
    [low, high]: &[Vector3<f64>; 2],
    arcs: &[PointArc],
    need: [f64; 2],
    margin: HullMargin,
    out: &mut Vec<[f64; 2]>,
) {
    let axes = [(Vector3::x(), low.x, high.x), (Vector3::y(), low.y, high.y), (Vector3::z(), low.z, high.z)];
    for (axis, low, high) in axes {
        add_arc_times_beyond(arcs, &axis, high, need, margin, out);
        add_arc_times_beyond(arcs, &-axis, -low, need, margin, out);
    }
}

impl StockGap for BoxGap {
    fn gap(&self, point: &Vector3<f64>) -> f64 {
        box_gap(&self.corners, point)
    }

    fn bounds(&self) -> [Vector3<f64>; 2] {
        self.corners
    }

    fn add_outside_times(
        &self,
        lines: &[PointLine],
        _: [f64; 2],
        margin: HullMargin,
        out: &mut Vec<[f64; 2]>,
    ) {
        add_times_outside_box(&self.corners, lines, margin, out);
    }

    fn add_outside_arc_times(
        &self,
        arcs: &[PointArc],
        need: [f64; 2],
        margin: HullMargin,
        out: &mut Vec<[f64; 2]>,
    ) {
        add_arc_times_outside_box(&self.corners, arcs, need, margin, out);
    }

    fn contains_segment(&self, from: &Vector3<f64>, to: &Vector3<f64>, margin: f64) -> bool {
        self.gap(from) < -margin && self.gap(to) < -margin
    }
}

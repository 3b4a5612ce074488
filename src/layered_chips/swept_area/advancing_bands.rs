//! This module traces the advancing regions of a diagram in bands: on the ellipse between two branches, and
//! on the chords.
//!
//! A point of a chord between its ends A and B (in the direction of the outline) moves along the normal with
//! a speed that is linear along the chord. So the advancing part of a chord begins or ends at a point with a
//! closed form, which is on the envelope of the chord's line.

use super::rim_directions::RimDirections;
use crate::layered_chips::boundary_diagram::time_segments::{RootTrack, TimeSegment};
use crate::layered_chips::section_family::{DiagramCurve, SectionFamily};
use crate::layered_chips::trig_polynomial::AngleSinCos;
use std::f64::consts::TAU;

/// The most bisections of a side.
const DEEPEST: usize = 12;

/// The number of pieces with which a side begins, per radian that the axis turns, besides one.
const PIECES: f64 = 16.0;

/// One side of a band.
#[derive(Clone, Copy)]
enum BandSide<'s> {
    /// The side is a root: a branch of the envelope, or an end of a chord.
    Root(&'s TrackRoot<'s>),
    /// The side is the point between two roots where the chord's speed changes its sign.
    Still(&'s TrackRoot<'s>, &'s TrackRoot<'s>),
}

/// A track with its angles at the beginning, middle and end of the segment of time, which are needed most
/// often.
pub(super) struct TrackRoot<'s> {
    track: &'s RootTrack,
    t: [f64; 3],
    angles: [f64; 3],
}

impl<'s> TrackRoot<'s> {
    /// Returns the roots of a segment of time.
    pub(super) fn roots_of_segment(family: &SectionFamily, stretch: &'s TimeSegment) -> Vec<Self> {
        let [from, to] = stretch.t;
        let t = [from, 0.5 * (from + to), to];
        let root = |track| Self { track, t, angles: t.map(|t| stretch.track_angle_at(family, track, t)) };
        stretch.tracks.iter().map(root).collect()
    }

    /// Returns the curve that the root belongs to.
    pub(super) fn curve(&self) -> DiagramCurve {
        self.track.curve
    }

    /// Returns the angles at the beginning and the end, radians.
    pub(super) fn end_angles(&self) -> [f64; 2] {
        let [first, _, last] = self.angles;
        [first, last]
    }

    fn middle_angle(&self) -> f64 {
        let [_, middle, _] = self.angles;
        middle
    }
}

/// A part of the outline that advances during a whole segment of time.
struct AdvancingBand<'s> {
    left: BandSide<'s>,
    right: BandSide<'s>,
    /// Whether the part is a chord; otherwise it is an arc of the ellipse.
    straight: bool,
}

/// Adds the boundaries of the areas that are entered in a segment of time. `nodes` are the angles at which
/// the edges at its beginning and its end need vertices.
pub(super) fn add_advancing_boundaries(
    family: &SectionFamily,
    rim: &RimDirections,
    stretch: &TimeSegment,
    roots: &[TrackRoot<'_>],
    nodes: [&[f64]; 2],
    out: &mut Vec<Vec<[f64; 2]>>,
) {
    let middle = 0.5 * (stretch.t[0] + stretch.t[1]);
    let mut roots: Vec<(f64, &TrackRoot<'_>)> =
        roots.iter().map(|root| (root.middle_angle().rem_euclid(TAU), root)).collect();
    roots.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    // Without roots the whole edge either advances or not.
    let walk = BandTracer { family, rim, stretch, nodes };
    if roots.is_empty() {
        if walk.is_advancing(0.0, middle) {
            walk.add_ring(out);
        }
        return;
    }
    let next = roots.iter().cycle().skip(1);
    for ((from, left), (to, right)) in roots.iter().zip(next) {
        let width = (to - from).rem_euclid(TAU);
        let width = if width == 0.0 { TAU } else { width };
        if walk.is_advancing(from + 0.5 * width, middle) {
            let band =
                AdvancingBand { left: BandSide::Root(left), right: BandSide::Root(right), straight: false };
            out.push(walk.trace_boundary(&band));
        }
    }
    // The chords: where both ends advance the whole chord does, and where one does the point without speed is
    // the other side.
    for (curve, sign) in [(DiagramCurve::Bottom, 1.0), (DiagramCurve::Top, -1.0)] {
        let of = |rising: bool| {
            roots.iter().find(|(_, root)| root.curve() == curve && root.track.rising == rising)
        };
        let (Some((from, a)), Some((to, b))) = (of(false), of(true)) else { continue };
        let face = family.curve_at(DiagramCurve::Face, middle);
        let speed = |angle: f64| sign * face.value_at(&AngleSinCos::from_radians(angle));
        let still = BandSide::Still(a, b);
        let (left, right) = match (speed(*from) > 0.0, speed(*to) > 0.0) {
            (true, true) => (BandSide::Root(a), BandSide::Root(b)),
            (true, false) => (BandSide::Root(a), still),
            (false, true) => (still, BandSide::Root(b)),
            (false, false) => continue,
        };
        out.push(walk.trace_boundary(&AdvancingBand { left, right, straight: true }));
    }
}

/// The data that tracing bands of one segment of time needs.
struct BandTracer<'s> {
    family: &'s SectionFamily,
    rim: &'s RimDirections,
    stretch: &'s TimeSegment,
    nodes: [&'s [f64]; 2],
}

impl BandTracer<'_> {
    /// Returns whether the edge exists and advances at an angle and a time.
    fn is_advancing(&self, theta: f64, t: f64) -> bool {
        let angle = AngleSinCos::from_radians(theta);
        let value = |curve| self.family.curve_at(curve, t).value_at(&angle);
        value(DiagramCurve::Edge) < -self.family.zero_threshold()
            && value(DiagramCurve::Bottom) > 0.0
            && (!self.family.has_top() || value(DiagramCurve::Top) > 0.0)
    }

    /// Adds the ring between the last and the first outline, if the whole edge advances.
    fn add_ring(&self, out: &mut Vec<Vec<[f64; 2]>>) {
        let [from, to] = self.stretch.t;
        let [first, last] = self.nodes;
        out.push(self.trace_ellipse_arc(to, [0.0, TAU], last));
        let mut inner = self.trace_ellipse_arc(from, [0.0, TAU], first);
        inner.reverse();
        out.push(inner);
    }

    /// Returns the boundary of a band's image, in the direction in which it winds positively: along the edge
    /// at the end, back along the right side, backwards along the edge at the beginning, and along the left
    /// side.
    fn trace_boundary(&self, band: &AdvancingBand<'_>) -> Vec<[f64; 2]> {
        let [from, to] = self.stretch.t;
        let [first, last] = self.nodes;
        let mut border = self.trace_edge(band, to, last);
        let mut right = Vec::new();
        self.trace_side(&band.right, &mut right);
        right.reverse();
        border.extend(right);
        let mut inner = self.trace_edge(band, from, first);
        inner.reverse();
        border.extend(inner);
        self.trace_side(&band.left, &mut border);
        border
    }

    /// Returns the band's part of the outline at a time, with both ends.
    fn trace_edge(&self, band: &AdvancingBand<'_>, t: f64, nodes: &[f64]) -> Vec<[f64; 2]> {
        match (band.straight, band.left, band.right) {
            (false, BandSide::Root(left), BandSide::Root(right)) => {
                let (from, to) = (self.root_angle_at(left, t), self.root_angle_at(right, t));
                let width = (to - from).rem_euclid(TAU);
                // Two roots that have met enclose nothing or the whole circle. Rounding must not decide
                // which, so the middle of the segment does.
                let usual = (right.middle_angle() - left.middle_angle()).rem_euclid(TAU);
                let width = match width {
                    width if width > TAU - 1e-3 && usual < 0.5 * TAU => 0.0,
                    width if width < 1e-3 && (usual > 0.5 * TAU || usual == 0.0) => TAU,
                    width => width,
                };
                self.trace_ellipse_arc(t, [from, from + width], nodes)
            }
            _ => vec![self.side_point_at(&band.left, t), self.side_point_at(&band.right, t)],
        }
    }

    /// Returns the ellipse from one angle to another with both ends; a full turn has no end.
    fn trace_ellipse_arc(&self, t: f64, [from, to]: [f64; 2], nodes: &[f64]) -> Vec<[f64; 2]> {
        let ellipse = self.family.ellipse_at(t);
        let direction = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            [cos, sin]
        };
        let mut corners: Vec<(f64, [f64; 2])> =
            Vec::with_capacity(self.rim.direction_count() + nodes.len() + 2);
        corners.push((from, direction(from)));
        corners.extend(self.rim.directions_between(from, to));
        for node in nodes {
            let angle = from + (node - from).rem_euclid(TAU);
            if angle < to {
                corners.push((angle, direction(*node)));
            }
        }
        if to - from < TAU {
            corners.push((to, direction(to)));
        }
        corners.sort_by(|(a, _), (b, _)| a.total_cmp(b));
        corners.dedup_by(|(a, _), (b, _)| (*a - *b).abs() < 1e-9);
        corners.into_iter().map(|(_, direction)| ellipse.point_towards(direction)).collect()
    }

    fn root_angle_at(&self, root: &TrackRoot<'_>, t: f64) -> f64 {
        let mut known = root.t.iter().zip(&root.angles);
        let known = known.find_map(|(at, angle)| (*at == t).then_some(*angle));
        known.unwrap_or_else(|| self.stretch.track_angle_at(self.family, root.track, t))
    }

    /// Returns the point of a side at a time.
    fn side_point_at(&self, side: &BandSide<'_>, t: f64) -> [f64; 2] {
        let ellipse = self.family.ellipse_at(t);
        let angle = |root: &TrackRoot<'_>| AngleSinCos::from_radians(self.root_angle_at(root, t));
        match side {
            BandSide::Root(root) => {
                let AngleSinCos { cos, sin, .. } = angle(root);
                ellipse.point_towards([cos, sin])
            }
            BandSide::Still(a, b) => {
                // The speed is linear along the chord, so its zero is found by linear interpolation.
                let face = self.family.curve_at(DiagramCurve::Face, t);
                let (a, b) = (angle(a), angle(b));
                let (at_a, at_b) = (face.value_at(&a), face.value_at(&b));
                let share = at_a / (at_a - at_b);
                let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.5 };
                let ([ax, ay], [bx, by]) =
                    (ellipse.point_towards([a.cos, a.sin]), ellipse.point_towards([b.cos, b.sin]));
                [ax + (bx - ax) * share, ay + (by - ay) * share]
            }
        }
    }

    /// Adds the points of a side between the ends of the segment, without both ends, from its beginning on.
    /// There are as many as keep the chords within the tolerance.
    fn trace_side(&self, side: &BandSide<'_>, out: &mut Vec<[f64; 2]>) {
        let [from, to] = self.stretch.t;
        let pieces = 1 + (self.family.step().turn * (to - from) * PIECES) as usize;
        let at = |index: usize| from + (to - from) * index as f64 / pieces as f64;
        let mut begin = (from, self.side_point_at(side, from));
        for index in 1..=pieces {
            let end = (at(index), self.side_point_at(side, at(index)));
            self.bisect_side(side, begin, end, DEEPEST, out);
            if index < pieces {
                out.push(end.1);
            }
            begin = end;
        }
    }

    fn bisect_side(
        &self,
        side: &BandSide<'_>,
        begin: (f64, [f64; 2]),
        end: (f64, [f64; 2]),
        depth: usize,
        out: &mut Vec<[f64; 2]>,
    ) {
        let at = |share: f64| {
            let t = begin.0 + (end.0 - begin.0) * share;
            (t, self.side_point_at(side, t))
        };
        let close = |(_, point): (f64, [f64; 2])| {
            distance_to_line_mm(point, begin.1, end.1) <= 0.5 * self.rim.tolerance_mm()
        };
        let middle = at(0.5);
        // A curve may cross its chord at the middle, so another point is tested too.
        if depth == 0 || (close(middle) && close(at(0.31))) {
            return;
        }
        self.bisect_side(side, begin, middle, depth - 1, out);
        out.push(middle.1);
        self.bisect_side(side, middle, end, depth - 1, out);
    }
}

/// Returns the distance of a point from a line segment, mm.
fn distance_to_line_mm([x, y]: [f64; 2], [ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> f64 {
    let (dx, dy) = (bx - ax, by - ay);
    let square = dx * dx + dy * dy;
    let along = if square > 0.0 { (((x - ax) * dx + (y - ay) * dy) / square).clamp(0.0, 1.0) } else { 0.0 };
    let (x, y) = (x - ax - along * dx, y - ay - along * dy);
    (x * x + y * y).sqrt()
}

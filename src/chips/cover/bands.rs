//! The advancing regions of a diagram, band by band: between two branches on the ellipse, and on the chords.
//!
//! A point of a chord between its ends A and B (in the outline's sense) moves along the normal with a speed that is linear along the chord,
//! so what of it advances begins or ends at a point in the same closed form: the envelope of the chord's line.

use super::rim::Rim;
use crate::chips::diagram::stretch::{Stretch, Track};
use crate::chips::family::{Curve, Family};
use crate::chips::trig::Angle;
use std::f64::consts::TAU;

/// Halvings of a side at most.
const DEEPEST: usize = 12;

/// Sides begin with this many pieces for each radian that the axis turns, and one more.
const PIECES: f64 = 16.0;

/// One end of a band.
#[derive(Clone, Copy)]
enum Side<'s> {
    /// A root: a branch of the envelope, or an end of a chord.
    Root(&'s Root<'s>),
    /// Where the speed of the chord between two roots changes its sign.
    Still(&'s Root<'s>, &'s Root<'s>),
}

/// A track with its angles at the stretch's beginning, middle and end, which are asked for most.
pub(super) struct Root<'s> {
    track: &'s Track,
    t: [f64; 3],
    angles: [f64; 3],
}

impl<'s> Root<'s> {
    /// The roots of a stretch.
    pub fn all(family: &Family, stretch: &'s Stretch) -> Vec<Self> {
        let [from, to] = stretch.t;
        let t = [from, 0.5 * (from + to), to];
        let root = |track| Self { track, t, angles: t.map(|t| stretch.theta(family, track, t)) };
        stretch.tracks.iter().map(root).collect()
    }

    /// Whose root it is.
    pub fn curve(&self) -> Curve {
        self.track.curve
    }

    /// Its angles at the beginning and the end, radians.
    pub fn ends(&self) -> [f64; 2] {
        let [first, _, last] = self.angles;
        [first, last]
    }

    fn middle(&self) -> f64 {
        let [_, middle, _] = self.angles;
        middle
    }
}

/// An advancing part of the outline, all through a stretch.
struct Band<'s> {
    left: Side<'s>,
    right: Side<'s>,
    /// Whether it is a chord; else it is an arc of the ellipse.
    straight: bool,
}

/// Adds the borders of what advances in a stretch. `nodes` are the corners that the edges at its beginning and end need.
pub(super) fn borders(
    family: &Family,
    rim: &Rim,
    stretch: &Stretch,
    roots: &[Root<'_>],
    nodes: [&[f64]; 2],
    out: &mut Vec<Vec<[f64; 2]>>,
) {
    let middle = 0.5 * (stretch.t[0] + stretch.t[1]);
    let mut roots: Vec<(f64, &Root<'_>)> =
        roots.iter().map(|root| (root.middle().rem_euclid(TAU), root)).collect();
    roots.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    let walk = Walk { family, rim, stretch, nodes };
    if roots.is_empty() {
        if walk.advances(0.0, middle) {
            walk.ring(out);
        }
        return;
    }
    let next = roots.iter().cycle().skip(1);
    for ((from, left), (to, right)) in roots.iter().zip(next) {
        let width = (to - from).rem_euclid(TAU);
        let width = if width == 0.0 { TAU } else { width };
        if walk.advances(from + 0.5 * width, middle) {
            let band = Band { left: Side::Root(left), right: Side::Root(right), straight: false };
            out.push(walk.border(&band));
        }
    }
    for (curve, sign) in [(Curve::Bottom, 1.0), (Curve::Top, -1.0)] {
        let of = |rising: bool| {
            roots.iter().find(|(_, root)| root.curve() == curve && root.track.rising == rising)
        };
        let (Some((from, a)), Some((to, b))) = (of(false), of(true)) else { continue };
        let face = family.curve(Curve::Face, middle);
        let speed = |angle: f64| sign * face.value(&Angle::of(angle));
        let still = Side::Still(a, b);
        let (left, right) = match (speed(*from) > 0.0, speed(*to) > 0.0) {
            (true, true) => (Side::Root(a), Side::Root(b)),
            (true, false) => (Side::Root(a), still),
            (false, true) => (still, Side::Root(b)),
            (false, false) => continue,
        };
        out.push(walk.border(&Band { left, right, straight: true }));
    }
}

struct Walk<'s> {
    family: &'s Family,
    rim: &'s Rim,
    stretch: &'s Stretch,
    nodes: [&'s [f64]; 2],
}

impl Walk<'_> {
    fn advances(&self, theta: f64, t: f64) -> bool {
        let angle = Angle::of(theta);
        let value = |curve| self.family.curve(curve, t).value(&angle);
        value(Curve::Edge) < -self.family.still()
            && value(Curve::Bottom) > 0.0
            && (!self.family.has_top() || value(Curve::Top) > 0.0)
    }

    /// All of the edge advances: what is between the last outline and the first.
    fn ring(&self, out: &mut Vec<Vec<[f64; 2]>>) {
        let [from, to] = self.stretch.t;
        let [first, last] = self.nodes;
        out.push(self.arc(to, [0.0, TAU], last));
        let mut inner = self.arc(from, [0.0, TAU], first);
        inner.reverse();
        out.push(inner);
    }

    /// The border of a band's image, so that it winds positively: the edge at the end, back along the right side, the edge at the beginning
    /// backwards, and along the left side.
    fn border(&self, band: &Band<'_>) -> Vec<[f64; 2]> {
        let [from, to] = self.stretch.t;
        let [first, last] = self.nodes;
        let mut border = self.edge(band, to, last);
        let mut right = Vec::new();
        self.side(&band.right, &mut right);
        right.reverse();
        border.extend(right);
        let mut inner = self.edge(band, from, first);
        inner.reverse();
        border.extend(inner);
        self.side(&band.left, &mut border);
        border
    }

    /// The band's part of the outline at a time, with both ends.
    fn edge(&self, band: &Band<'_>, t: f64, nodes: &[f64]) -> Vec<[f64; 2]> {
        match (band.straight, band.left, band.right) {
            (false, Side::Root(left), Side::Root(right)) => {
                let (from, to) = (self.theta(left, t), self.theta(right, t));
                let width = (to - from).rem_euclid(TAU);
                // Two roots that have met enclose nothing or everything; rounding must not decide which.
                let usual = (right.middle() - left.middle()).rem_euclid(TAU);
                let width = match width {
                    width if width > TAU - 1e-3 && usual < 0.5 * TAU => 0.0,
                    width if width < 1e-3 && (usual > 0.5 * TAU || usual == 0.0) => TAU,
                    width => width,
                };
                self.arc(t, [from, from + width], nodes)
            }
            _ => vec![self.point(&band.left, t), self.point(&band.right, t)],
        }
    }

    /// The ellipse from one angle to another, with both ends (a full turn has its end left out).
    fn arc(&self, t: f64, [from, to]: [f64; 2], nodes: &[f64]) -> Vec<[f64; 2]> {
        let ellipse = self.family.ellipse(t);
        let direction = |angle: f64| {
            let (sin, cos) = angle.sin_cos();
            [cos, sin]
        };
        let mut corners: Vec<(f64, [f64; 2])> = Vec::with_capacity(self.rim.count() + nodes.len() + 2);
        corners.push((from, direction(from)));
        corners.extend(self.rim.between(from, to));
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
        corners.into_iter().map(|(_, direction)| ellipse.point(direction)).collect()
    }

    fn theta(&self, root: &Root<'_>, t: f64) -> f64 {
        let mut known = root.t.iter().zip(&root.angles);
        let known = known.find_map(|(at, angle)| (*at == t).then_some(*angle));
        known.unwrap_or_else(|| self.stretch.theta(self.family, root.track, t))
    }

    fn point(&self, side: &Side<'_>, t: f64) -> [f64; 2] {
        let ellipse = self.family.ellipse(t);
        let angle = |root: &Root<'_>| Angle::of(self.theta(root, t));
        match side {
            Side::Root(root) => {
                let Angle { cos, sin, .. } = angle(root);
                ellipse.point([cos, sin])
            }
            Side::Still(a, b) => {
                let face = self.family.curve(Curve::Face, t);
                let (a, b) = (angle(a), angle(b));
                let (at_a, at_b) = (face.value(&a), face.value(&b));
                let share = at_a / (at_a - at_b);
                let share = if share.is_finite() { share.clamp(0.0, 1.0) } else { 0.5 };
                let ([ax, ay], [bx, by]) = (ellipse.point([a.cos, a.sin]), ellipse.point([b.cos, b.sin]));
                [ax + (bx - ax) * share, ay + (by - ay) * share]
            }
        }
    }

    /// Points of a side between the ends of the stretch, both left out, from the beginning on: as many as keep chords within the tolerance.
    fn side(&self, side: &Side<'_>, out: &mut Vec<[f64; 2]>) {
        let [from, to] = self.stretch.t;
        let pieces = 1 + (self.family.step().turn * (to - from) * PIECES) as usize;
        let at = |index: usize| from + (to - from) * index as f64 / pieces as f64;
        let mut begin = (from, self.point(side, from));
        for index in 1..=pieces {
            let end = (at(index), self.point(side, at(index)));
            self.halve(side, begin, end, DEEPEST, out);
            if index < pieces {
                out.push(end.1);
            }
            begin = end;
        }
    }

    fn halve(
        &self,
        side: &Side<'_>,
        begin: (f64, [f64; 2]),
        end: (f64, [f64; 2]),
        depth: usize,
        out: &mut Vec<[f64; 2]>,
    ) {
        let at = |share: f64| {
            let t = begin.0 + (end.0 - begin.0) * share;
            (t, self.point(side, t))
        };
        let close = |(_, point): (f64, [f64; 2])| off(point, begin.1, end.1) <= 0.5 * self.rim.tolerance();
        let middle = at(0.5);
        // Off the middle as well: a curve may cross its chord there.
        if depth == 0 || (close(middle) && close(at(0.31))) {
            return;
        }
        self.halve(side, begin, middle, depth - 1, out);
        out.push(middle.1);
        self.halve(side, middle, end, depth - 1, out);
    }
}

/// Distance of a point from a piece of line, mm.
fn off([x, y]: [f64; 2], [ax, ay]: [f64; 2], [bx, by]: [f64; 2]) -> f64 {
    let (dx, dy) = (bx - ax, by - ay);
    let square = dx * dx + dy * dy;
    let along = if square > 0.0 { (((x - ax) * dx + (y - ay) * dy) / square).clamp(0.0, 1.0) } else { 0.0 };
    let (x, y) = (x - ax - along * dx, y - ay - along * dy);
    (x * x + y * y).sqrt()
}

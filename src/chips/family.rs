//! The family of sections along a step, on one layer: `P(theta, t) = c(t) + M(t) (cos theta, sin theta)`.
//!
//! With b the part of the axis in the layer, `M = R (I + b b^T / (a_z (1 + a_z)))`: symmetric, R across the tilt and R / a_z along it,
//! and smooth through an upright axis. So theta is the angle of a tooth about the tool axis, carried over by the shortest turn from z to
//! the axis. What happens on the ellipse is, at each time, a trigonometric polynomial in theta:
//!
//! - [`Curve::Edge`]: `f = det[dP/dtheta, dP/dt]`; negative where the edge advances, zero on the envelope;
//! - [`Curve::Bottom`], [`Curve::Top`]: height above the bottom disc and below the upper end of the flutes, by R / a_z; positive inside;
//! - [`Curve::Face`]: speed of the bottom disc's plane through that point along its normal; positive where the disc advances.

use super::ellipse::Ellipse;
use super::interval::Interval;
use super::jet::{Jet, Scalar};
use super::section::Step;
use super::trig::{Angle, Trig};

/// The functions of angle and time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Curve {
    /// The determinant whose zeros are the envelope.
    Edge,
    /// Above the bottom disc.
    Bottom,
    /// Below the upper end of the flutes.
    Top,
    /// How the bottom disc's plane moves.
    Face,
}

impl Curve {
    /// All of them.
    pub const ALL: [Self; 4] = [Self::Edge, Self::Bottom, Self::Top, Self::Face];
}

/// A step seen on one layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Family {
    step: Step,
    /// Height of the layer, mm, mirrored with the step.
    z: f64,
    /// Bound on the speed of the section, mm for the whole step.
    pace: f64,
}

/// The family at one time, or over an interval of times.
#[derive(Debug, Clone, Copy)]
struct At<S> {
    tip: [Jet<S>; 3],
    axis: [Jet<S>; 3],
    /// Centre of the ellipse.
    centre: [Jet<S>; 2],
    /// xx, xy and yy of M / R.
    shape: [Jet<S>; 3],
}

impl Family {
    /// A step on the layer at height z, mm.
    pub fn new(step: &Step, z: f64) -> Self {
        Self { step: *step, z: z * step.up, pace: step.pace(z) }
    }

    /// The step.
    pub fn step(&self) -> &Step {
        &self.step
    }

    /// Values of `f` that are as good as zero: the section moves by less than a billionth of the step.
    pub(super) fn still(&self) -> f64 {
        1e-9 * self.step.mill.radius * self.pace
    }

    /// Whether the tip stays where it is, as far as angles of a millionth can tell.
    pub(super) fn pivots_about_tip(&self) -> bool {
        self.step.way.norm() <= 1e-6 * self.step.mill.radius * self.step.turn
    }

    /// Whether a curve means anything for this mill.
    pub(super) fn has(&self, curve: Curve) -> bool {
        curve != Curve::Top || self.has_top()
    }

    /// Whether the upper end of the flutes may reach the layer.
    pub(super) fn has_top(&self) -> bool {
        self.step.mill.flutes.is_finite()
    }

    fn at<S: Scalar>(&self, t: S) -> At<S> {
        let (tip, axis) = self.pose(t);
        self.section(tip, axis)
    }

    /// The family at a number's time; at the end with the place to the bit.
    fn instant(&self, t: f64) -> At<f64> {
        let (mut tip, mut axis) = self.pose(t);
        if t == 1.0 {
            let [last_tip, last_axis] = self.step.end;
            let jets = tip.iter_mut().chain(&mut axis);
            jets.zip(last_tip.iter().chain(&last_axis)).for_each(|(jet, exact)| jet.v = *exact);
        }
        self.section(tip, axis)
    }

    /// Tip and axis.
    fn pose<S: Scalar>(&self, t: S) -> ([Jet<S>; 3], [Jet<S>; 3]) {
        let step = &self.step;
        let zero = S::of(0.0);
        let line = |from: f64, way: f64| Jet { v: S::of(from) + S::of(way) * t, d: S::of(way), dd: zero };
        let tip = [line(step.tip.x, step.way.x), line(step.tip.y, step.way.y), line(step.tip.z, step.way.z)];
        let (sin, cos) = (S::of(step.turn) * t).sin_cos();
        let turn = S::of(step.turn);
        let turned = |from: f64, across: f64| {
            if step.turn == 0.0 {
                return Jet::constant(from);
            }
            let (from, across) = (S::of(from), S::of(across));
            let v = from * cos + across * sin;
            Jet { v, d: turn * (across * cos - from * sin), dd: -(turn * turn * v) }
        };
        let axis = [
            turned(step.from.x, step.across.x),
            turned(step.from.y, step.across.y),
            turned(step.from.z, step.across.z),
        ];
        (tip, axis)
    }

    fn section<S: Scalar>(&self, tip: [Jet<S>; 3], axis: [Jet<S>; 3]) -> At<S> {
        let [bx, by, az] = axis;
        let up = az.recip();
        let height = (Jet::constant(self.z) - tip[2]) * up;
        let centre = [tip[0] + height * bx, tip[1] + height * by];
        let one = Jet::constant(1.0);
        let k = up * (one + az).recip();
        let shape = [one + k * bx * bx, k * bx * by, one + k * by * by];
        At { tip, axis, centre, shape }
    }

    /// The ellipse at a time.
    pub fn ellipse(&self, t: f64) -> Ellipse {
        let At { axis, centre: [x, y], shape, .. } = self.instant(t);
        let radius = self.step.mill.radius;
        Ellipse {
            centre: [x.v, y.v],
            velocity: [x.d, y.d],
            shape: shape.map(|m| radius * m.v),
            axis: axis.map(|a| a.v),
        }
    }

    /// The coefficients of a curve with their derivatives by time.
    fn expand<S: Scalar>(&self, curve: Curve, at: &At<S>) -> ([S; 5], [S; 5]) {
        let radius = self.step.mill.radius;
        let split = |k: [(S, S); 5]| (k.map(|(v, _)| v), k.map(|(_, d)| d));
        let none = (S::of(0.0), S::of(0.0));
        let pair = |jet: Jet<S>| (jet.v, jet.d);
        match curve {
            Curve::Edge => {
                let [x, y] = at.centre;
                let [xx, xy, yy] = at.shape;
                let half = S::of(0.5 * radius * radius);
                let line = S::of(radius);
                // The velocity of the shape, with its own derivative.
                let rate = |m: Jet<S>| (m.d, m.dd);
                let of = |m: Jet<S>| (m.v, m.d);
                let mul = |(a, da): (S, S), (b, db): (S, S)| (a * b, da * b + a * db);
                let add = |(a, da): (S, S), (b, db): (S, S)| (a + b, da + db);
                let sub = |(a, da): (S, S), (b, db): (S, S)| (a - b, da - db);
                let scaled = |by: S, (a, da): (S, S)| (by * a, by * da);
                // f = det[M w, c' + M' v] with v = (cos, sin), w = (-sin, cos).
                let cos = sub(mul(of(xy), rate(y)), mul(of(yy), rate(x)));
                let sin = sub(mul(of(xy), rate(x)), mul(of(xx), rate(y)));
                let cos_cos = sub(mul(of(xy), rate(xy)), mul(of(yy), rate(xx)));
                let sin_sin = sub(mul(of(xy), rate(xy)), mul(of(xx), rate(yy)));
                let sum = add(rate(xx), rate(yy));
                let sin_cos = sub(mul(of(xy), sum), mul(add(of(xx), of(yy)), rate(xy)));
                split([
                    scaled(half, add(cos_cos, sin_sin)),
                    scaled(line, cos),
                    scaled(line, sin),
                    scaled(half, sub(cos_cos, sin_sin)),
                    scaled(half, sin_cos),
                ])
            }
            Curve::Bottom => {
                let above = (Jet::constant(self.z) - at.tip[2]).times(1.0 / radius);
                split([pair(above), pair(at.axis[0]), pair(at.axis[1]), none, none])
            }
            Curve::Top => {
                let end = at.tip[2] + at.axis[2].times(self.step.mill.flutes);
                let below = (end - Jet::constant(self.z)).times(1.0 / radius);
                let minus = |jet: Jet<S>| (-jet.v, -jet.d);
                split([pair(below), minus(at.axis[0]), minus(at.axis[1]), none, none])
            }
            Curve::Face => {
                // -tip'.a + (M v).b', since what the centre's lever adds cancels for a unit axis.
                let [xx, xy, yy] = at.shape;
                let [bx, by, _] = at.axis;
                let line = S::of(radius);
                let way = [self.step.way.x, self.step.way.y, self.step.way.z];
                let along = |k: fn(&Jet<S>) -> S| {
                    let [x, y, z] = [&at.axis[0], &at.axis[1], &at.axis[2]].map(k);
                    -(S::of(way[0]) * x + S::of(way[1]) * y + S::of(way[2]) * z)
                };
                let row = |p: Jet<S>, q: Jet<S>| {
                    let v = p.v * bx.d + q.v * by.d;
                    let d = p.d * bx.d + p.v * bx.dd + q.d * by.d + q.v * by.dd;
                    (line * v, line * d)
                };
                split([(along(|a| a.v), along(|a| a.d)), row(xx, xy), row(xy, yy), none, none])
            }
        }
    }

    /// Coefficients of a curve at a time: `k0 + k1 cos x + k2 sin x + k3 cos 2x + k4 sin 2x`.
    pub fn coefficients(&self, curve: Curve, t: f64) -> [f64; 5] {
        self.curve(curve, t).0
    }

    /// A curve at a time.
    pub(super) fn curve(&self, curve: Curve, t: f64) -> Trig<f64> {
        Trig(self.expand(curve, &self.instant(t)).0)
    }

    /// The family over all times of an interval.
    pub(super) fn over(&self, t: Interval) -> Window<'_> {
        let middle = Interval::point(t.middle());
        Window { family: self, whole: self.at(t), middle: self.at(middle), offset: t - middle }
    }

    /// How fast the edge advances along the normal of the cutter's surface in space, mm for the whole step.
    pub(super) fn advance(&self, ellipse: &Ellipse, edge: &Trig<f64>, theta: f64) -> f64 {
        let angle = Angle::of(theta);
        let direction = [angle.cos, angle.sin];
        let [bx, by, _] = ellipse.axis;
        // The radial normal's part along z is that of the tilt.
        let lean = bx * angle.cos + by * angle.sin;
        let level = (1.0 - lean * lean).max(0.0).sqrt();
        -edge.value(&angle) / ellipse.stretch(direction) * level
    }
}

/// The family over an interval of times.
pub(super) struct Window<'f> {
    family: &'f Family,
    whole: At<Interval>,
    middle: At<Interval>,
    offset: Interval,
}

impl Window<'_> {
    /// Half the length of the interval.
    pub fn half(&self) -> f64 {
        self.offset.magnitude()
    }

    /// A curve at the time in the middle.
    pub fn now(&self, curve: Curve) -> Trig<Interval> {
        Trig(self.family.expand(curve, &self.middle).0)
    }

    /// A curve at all these times: enclosures of its coefficients, and of their derivatives by time.
    pub fn curve(&self, curve: Curve) -> (Trig<Interval>, Trig<Interval>) {
        let (mut all, rate) = self.family.expand(curve, &self.whole);
        let (middle, _) = self.family.expand(curve, &self.middle);
        // The mean value theorem's enclosure is narrower for short times.
        for ((all, middle), rate) in all.iter_mut().zip(middle).zip(rate) {
            *all = all.meet(middle + rate * self.offset);
        }
        (Trig(all), Trig(rate))
    }
}

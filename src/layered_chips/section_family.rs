//! This module describes the family of sections of a step on one layer: `P(theta, t) = c(t) + M(t) (cos
//! theta, sin theta)`.
//!
//! With b the part of the axis in the layer, `M = R (I + b b^T / (a_z (1 + a_z)))`. M is symmetric, has the
//! factor R across the tilt and R / a_z along it, and is smooth at a vertical axis. So theta is the angle of
//! a tooth around the tool axis, carried over by the shortest rotation from z to the axis. The functions on
//! the ellipse are, at each time, trigonometric polynomials in theta:
//!
//! - [`DiagramCurve::Edge`] is `f = det[dP/dtheta, dP/dt]`; it is negative where the edge advances, and zero
//!   on the envelope.
//! - [`DiagramCurve::Bottom`] and [`DiagramCurve::Top`] are the height above the bottom disc and below the
//!   upper end of the flutes, divided by R / a_z; they are positive inside.
//! - [`DiagramCurve::Face`] is the speed of the bottom disc's plane at that point along its normal; it is
//!   positive where the disc advances.

use super::interval::IntervalF64;
use super::jet::{Jet, Scalar};
use super::layer_ellipse::LayerEllipse;
use super::mill_step::MillStep;
use super::trig_polynomial::{AngleSinCos, TrigPolynomial};

/// The height, as a fraction of the radius, below which the end of a vertical mill counts as being at the
/// layer's height. The layer is then outside of it.
pub(super) const GRAZES: f64 = 1e-9;

/// The functions of angle and time.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
#[non_exhaustive]
pub enum DiagramCurve {
    /// The determinant whose zeros are the envelope.
    Edge,
    /// The height above the bottom disc.
    Bottom,
    /// The height below the upper end of the flutes.
    Top,
    /// The speed of the bottom disc's plane along its normal.
    Face,
}

impl DiagramCurve {
    /// All curves, in the order in which other lists have them.
    pub const ALL: [Self; 4] = [Self::Edge, Self::Bottom, Self::Top, Self::Face];
}

/// A step on one layer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionFamily {
    step: MillStep,
    /// The height of the layer, mm, mirrored if the step is.
    z: f64,
    /// An upper bound of the section's displacement, mm for the whole step.
    pace: f64,
}

/// The family at one time, or over an interval of times.
#[derive(Debug, Clone, Copy)]
struct FamilyState<S> {
    tip: [Jet<S>; 3],
    axis: [Jet<S>; 3],
    /// The centre of the ellipse.
    centre: [Jet<S>; 2],
    /// The entries xx, xy and yy of M / R.
    shape: [Jet<S>; 3],
}

impl SectionFamily {
    /// Makes the family of a step on the layer at height z, mm.
    pub fn new(step: &MillStep, z_mm: f64) -> Self {
        Self { step: *step, z: z_mm * step.up, pace: step.max_displacement_mm(z_mm) }
    }

    /// Returns the step.
    pub fn step(&self) -> &MillStep {
        &self.step
    }

    /// Returns the absolute value of `f` below which it counts as zero: the section then moves by less than a
    /// billionth of the step.
    pub(super) fn zero_threshold(&self) -> f64 {
        1e-9 * self.step.mill.radius_mm * self.pace
    }

    /// Returns whether the tip does not move, up to a millionth of the displacement of the rim.
    pub(super) fn pivots_about_tip(&self) -> bool {
        self.step.way.norm() <= 1e-6 * self.step.mill.radius_mm * self.step.turn
    }

    /// Returns whether a curve exists for this mill.
    pub(super) fn has_curve(&self, curve: DiagramCurve) -> bool {
        curve != DiagramCurve::Top || self.has_top()
    }

    /// Returns whether the flutes have an upper end that may reach the layer.
    pub(super) fn has_top(&self) -> bool {
        self.step.mill.flute_length_mm.is_finite()
    }

    /// Returns the family at a time, or over an interval of times.
    fn state_over<S: Scalar>(&self, t: S) -> FamilyState<S> {
        let (tip, axis) = self.tool_pose_at(t);
        self.section_state(tip, axis)
    }

    /// Returns the family at a time given as a number. At the end it uses the given pose to the bit.
    fn exact_state_at(&self, t: f64) -> FamilyState<f64> {
        let (mut tip, mut axis) = self.tool_pose_at(t);
        if t == 1.0 {
            let [last_tip, last_axis] = self.step.end;
            let jets = tip.iter_mut().chain(&mut axis);
            jets.zip(last_tip.iter().chain(&last_axis)).for_each(|(jet, exact)| jet.v = *exact);
        }
        self.section_state(tip, axis)
    }

    /// Returns the tip and the axis with their derivatives.
    fn tool_pose_at<S: Scalar>(&self, t: S) -> ([Jet<S>; 3], [Jet<S>; 3]) {
        let step = &self.step;
        let zero = S::from_f64(0.0);
        let line = |from: f64, way: f64| Jet {
            v: S::from_f64(from) + S::from_f64(way) * t,
            d: S::from_f64(way),
            dd: zero,
        };
        let tip = [line(step.tip.x, step.way.x), line(step.tip.y, step.way.y), line(step.tip.z, step.way.z)];
        let (sin, cos) = (S::from_f64(step.turn) * t).sin_cos();
        let turn = S::from_f64(step.turn);
        // a(t) = from cos + across sin, so a' = turn (across cos - from sin) and a'' = -turn^2 a.
        let turned = |from: f64, across: f64| {
            if step.turn == 0.0 {
                return Jet::constant(from);
            }
            let (from, across) = (S::from_f64(from), S::from_f64(across));
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

    /// Returns the section of a pose: the centre and the matrix of the ellipse.
    fn section_state<S: Scalar>(&self, tip: [Jet<S>; 3], axis: [Jet<S>; 3]) -> FamilyState<S> {
        let [bx, by, az] = axis;
        let up = az.recip();
        // The axis line meets the layer at the length (z - tip_z) / a_z above the tip.
        let height = (Jet::constant(self.z) - tip[2]) * up;
        let centre = [tip[0] + height * bx, tip[1] + height * by];
        let one = Jet::constant(1.0);
        let k = up * (one + az).recip();
        let shape = [one + k * bx * bx, k * bx * by, one + k * by * by];
        FamilyState { tip, axis, centre, shape }
    }

    /// Returns the ellipse at a time.
    pub fn ellipse_at(&self, t: f64) -> LayerEllipse {
        let FamilyState { axis, centre: [x, y], shape, .. } = self.exact_state_at(t);
        let radius = self.step.mill.radius_mm;
        LayerEllipse {
            centre: [x.v, y.v],
            velocity: [x.d, y.d],
            shape: shape.map(|m| radius * m.v),
            axis: axis.map(|a| a.v),
        }
    }

    /// Returns the coefficients of a curve and their derivatives with respect to time.
    fn expand_curve<S: Scalar>(&self, curve: DiagramCurve, at: &FamilyState<S>) -> ([S; 5], [S; 5]) {
        let radius = self.step.mill.radius_mm;
        let split = |k: [(S, S); 5]| (k.map(|(v, _)| v), k.map(|(_, d)| d));
        let none = (S::from_f64(0.0), S::from_f64(0.0));
        let pair = |jet: Jet<S>| (jet.v, jet.d);
        match curve {
            DiagramCurve::Edge => {
                let [x, y] = at.centre;
                let [xx, xy, yy] = at.shape;
                let half = S::from_f64(0.5 * radius * radius);
                let line = S::from_f64(radius);
                // The derivative of the shape, together with its own derivative.
                let rate = |m: Jet<S>| (m.d, m.dd);
                let of = |m: Jet<S>| (m.v, m.d);
                let mul = |(a, da): (S, S), (b, db): (S, S)| (a * b, da * b + a * db);
                let add = |(a, da): (S, S), (b, db): (S, S)| (a + b, da + db);
                let sub = |(a, da): (S, S), (b, db): (S, S)| (a - b, da - db);
                let scaled = |by: S, (a, da): (S, S)| (by * a, by * da);
                // f = det[M w, c' + M' v] with v = (cos, sin) and w = (-sin, cos), sorted by 1, cos, sin, cos
                // 2x and sin 2x.
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
            DiagramCurve::Bottom => {
                let above = (Jet::constant(self.z) - at.tip[2]).scaled_by(1.0 / radius);
                split([pair(above), pair(at.axis[0]), pair(at.axis[1]), none, none])
            }
            DiagramCurve::Top => {
                let end = at.tip[2] + at.axis[2].scaled_by(self.step.mill.flute_length_mm);
                let below = (end - Jet::constant(self.z)).scaled_by(1.0 / radius);
                let minus = |jet: Jet<S>| (-jet.v, -jet.d);
                split([pair(below), minus(at.axis[0]), minus(at.axis[1]), none, none])
            }
            DiagramCurve::Face => {
                // The speed is -tip'.a + (M v).b', because the contribution of the centre's distance from the
                // tip cancels for a unit axis.
                let [xx, xy, yy] = at.shape;
                let [bx, by, _] = at.axis;
                let line = S::from_f64(radius);
                let way = [self.step.way.x, self.step.way.y, self.step.way.z];
                let along = |k: fn(&Jet<S>) -> S| {
                    let [x, y, z] = [&at.axis[0], &at.axis[1], &at.axis[2]].map(k);
                    -(S::from_f64(way[0]) * x + S::from_f64(way[1]) * y + S::from_f64(way[2]) * z)
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

    /// Returns the coefficients of a curve at a time: `k0 + k1 cos x + k2 sin x + k3 cos 2x + k4 sin 2x`.
    pub fn curve_coefficients(&self, curve: DiagramCurve, t: f64) -> [f64; 5] {
        self.curve_at(curve, t).0
    }

    /// Returns a curve at a time.
    pub(super) fn curve_at(&self, curve: DiagramCurve, t: f64) -> TrigPolynomial<f64> {
        TrigPolynomial(self.expand_curve(curve, &self.exact_state_at(t)).0)
    }

    /// Returns the family over all times of an interval.
    pub(super) fn window_over(&self, t: IntervalF64) -> FamilyWindow<'_> {
        let middle = IntervalF64::from_point(t.middle());
        FamilyWindow {
            family: self,
            whole: self.state_over(t),
            middle: self.state_over(middle),
            offset: t - middle,
        }
    }

    /// Returns the advance of the edge along the normal of the cutter's surface in space, mm for the whole
    /// step.
    pub(super) fn edge_advance_mm(
        &self,
        ellipse: &LayerEllipse,
        edge: &TrigPolynomial<f64>,
        theta: f64,
    ) -> f64 {
        let angle = AngleSinCos::from_radians(theta);
        let direction = [angle.cos, angle.sin];
        let [bx, by, _] = ellipse.axis;
        // The surface's normal leans out of the layer; `level` is the cosine of that lean.
        let lean = bx * angle.cos + by * angle.sin;
        let level = (1.0 - lean * lean).max(0.0).sqrt();
        -edge.value_at(&angle) / ellipse.tangent_length_mm(direction) * level
    }
}

/// The family over an interval of times.
pub(super) struct FamilyWindow<'f> {
    family: &'f SectionFamily,
    whole: FamilyState<IntervalF64>,
    middle: FamilyState<IntervalF64>,
    offset: IntervalF64,
}

impl FamilyWindow<'_> {
    /// Returns half the length of the interval.
    pub(super) fn half_length(&self) -> f64 {
        self.offset.magnitude()
    }

    /// Returns a curve at the time in the middle of the interval.
    pub(super) fn curve_at_middle(&self, curve: DiagramCurve) -> TrigPolynomial<IntervalF64> {
        TrigPolynomial(self.family.expand_curve(curve, &self.middle).0)
    }

    /// Encloses a curve over all times of the interval: returns enclosures of its coefficients and of their
    /// derivatives with respect to time.
    pub(super) fn enclose_curve(
        &self,
        curve: DiagramCurve,
    ) -> (TrigPolynomial<IntervalF64>, TrigPolynomial<IntervalF64>) {
        let (mut all, rate) = self.family.expand_curve(curve, &self.whole);
        let (middle, _) = self.family.expand_curve(curve, &self.middle);
        // For short intervals the enclosure of the mean value theorem, k(m) + k' (t - m), is narrower.
        for ((all, middle), rate) in all.iter_mut().zip(middle).zip(rate) {
            *all = all.intersect_or_self(middle + rate * self.offset);
        }
        (TrigPolynomial(all), TrigPolynomial(rate))
    }
}

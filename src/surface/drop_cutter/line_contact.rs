//! This module finds where a straight line touches a cutter's bottom.
//!
//! The line passes the axis at the distance `d` and rises by `m >= 0` per millimetre of `s`, which counts
//! from the point nearest to the axis. The touching point has the largest `m s - h(r)` with `r^2 = d^2 +
//! s^2`. In the vertical plane through the line, a ball is a circle of radius `sqrt(R^2 - d^2)`, and a flat
//! end is a rectangle. For a bull-nose the equation is of fourth degree (the offset-ellipse problem). With `r
//! = e + c sigma`, where `e` is the radius of the flat, `c` the corner radius and `sigma` the sine of the
//! normal's angle from the axis, the slopes are equal at
//!
//! ```text
//! sigma = m r / sqrt((1 + m^2) r^2 - d^2)
//! ```
//!
//! The right side falls as `r` grows, so left minus right rises with a slope of at least 1. So there is
//! exactly one root, it is well conditioned, and a bracket contains it. The function is concave, so after the
//! first of Newton's steps the others come from the left and do not overshoot.

use super::DropCutterShape;

/// The search for a bull-nose's touching point ends when a step of the sine is below this. The error after
/// such a Newton step is about its square, and the height is stationary there.
const SINE: f64 = 1e-10;

/// The most steps of the search, which bisection alone would need.
const STEPS: u32 = 60;

impl DropCutterShape {
    /// Returns the point between `from` and `to` at which a line touches, as the distance from the point
    /// nearest to the axis towards the rising side, mm. `distance` is the distance of that point from the
    /// axis, and `slope` is at least 0. Everything between the ends must be under the cutter.
    pub(super) fn find_line_contact(&self, distance: f64, slope: f64, from: f64, to: f64) -> f64 {
        // The touching point is never on the falling side.
        if slope <= 0.0 || to <= 0.0 {
            return to.min(0.0).max(from);
        }
        let (corner, flat, radius) = (self.corner_radius_mm(), self.flat_radius_mm(), self.radius_mm());
        let square = distance * distance;
        // The sine of the line's angle from the horizontal; 1 for a vertical line.
        let sine = 1.0 / (1.0 + 1.0 / (slope * slope)).sqrt();
        if corner <= 0.0 || flat <= 0.0 {
            let half = (radius * radius - square).max(0.0).sqrt();
            return if corner <= 0.0 { to } else { (half * sine).max(from).min(to) };
        }
        // The term ((1 + m^2) r^2 - d^2) is divided by 1 + m^2, so that steep lines do not overflow.
        let shrunk = square * (1.0 - sine * sine);
        // Left minus right side of the equation, and its slope. Where the root does not exist, the value is
        // that of a point to the left of the solution.
        let over = |lean: f64| {
            let r = flat + corner * lean;
            let below = r * r - shrunk;
            if below <= 0.0 {
                return (-1.0, 1.0);
            }
            let root = below.sqrt();
            (lean - sine * r / root, 1.0 + corner * sine * shrunk / (below * root))
        };
        let lean = |s: f64| ((square + s * s).sqrt() - flat) / corner;
        let (first, last) = (lean(from.max(0.0)), lean(to).min(1.0));
        // Short edges are mostly touched at an end.
        if last <= sine || over(last).0 <= 0.0 {
            return to;
        }
        if from > 0.0 && first >= sine && over(first).0 >= 0.0 {
            return from;
        }
        let (mut low, mut high) = (first.max(sine), last);
        // Newton's method within a bracket; a step that leaves the bracket is replaced by bisection.
        let mut lean = f64::midpoint(low, high);
        for _ in 0..STEPS {
            let (over, rise) = over(lean);
            if over > 0.0 {
                high = lean;
            } else {
                low = lean;
            }
            let mut next = lean - over / rise;
            if !(next > low && next < high) {
                next = f64::midpoint(low, high);
            }
            let step = (next - lean).abs();
            lean = next;
            if step <= SINE {
                break;
            }
        }
        let r = flat + corner * lean;
        (r * r - square).max(0.0).sqrt().max(from).min(to)
    }
}

//! Where a straight line touches a cutter's bottom.
//!
//! The line passes the axis at the distance `d` and rises by `m >= 0` for every millimetre that `s`, counted from the place nearest to
//! the axis, grows. The touching point has the largest `m s - h(r)` with `r^2 = d^2 + s^2`. In the vertical plane through the line
//! a ball is a circle of radius `sqrt(R^2 - d^2)`, a flat end a rectangle. A bull-nose is a quartic (the offset-ellipse problem). With
//! `r = e + c sigma`, where `e` is the flat's radius, `c` the corner's and `sigma` the sine of the normal's lean, the slopes are equal at
//!
//! ```text
//! sigma = m r / sqrt((1 + m^2) r^2 - d^2)
//! ```
//!
//! The right side falls as `r` grows, so left minus right rises, with a slope of 1 at least: there is one root, it is well conditioned,
//! and a bracket holds it. The function is concave, so Newton's steps come from the left after the first and do not overshoot.

use super::DropCutterShape;

/// A step of the sine at which the search for a bull-nose's touching point ends. The error behind such a step of Newton's is about its
/// square, and the height is stationary there.
const SINE: f64 = 1e-10;

/// A bound on the steps of that search that halvings alone would keep.
const STEPS: u32 = 60;

impl DropCutterShape {
    /// Where between `from` and `to` a line touches, as the distance from the place nearest to the axis towards its rising side, mm.
    /// `distance` is that place's from the axis, `slope` at least 0; all between the ends is under the cutter.
    pub(super) fn find_line_contact(&self, distance: f64, slope: f64, from: f64, to: f64) -> f64 {
        // The touch is never on the falling side.
        if slope <= 0.0 || to <= 0.0 {
            return to.min(0.0).max(from);
        }
        let (corner, flat, radius) = (self.corner_radius_mm(), self.flat_radius_mm(), self.radius_mm());
        let square = distance * distance;
        // Of the line's angle against the level; 1 where it is upright.
        let sine = 1.0 / (1.0 + 1.0 / (slope * slope)).sqrt();
        if corner <= 0.0 || flat <= 0.0 {
            let half = (radius * radius - square).max(0.0).sqrt();
            return if corner <= 0.0 { to } else { (half * sine).max(from).min(to) };
        }
        // (1 + m^2) r^2 - d^2 divided by 1 + m^2, so that steep lines stay within range.
        let shrunk = square * (1.0 - sine * sine);
        // Left minus right side of the equation, and its slope; on the left of the root where there is none.
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

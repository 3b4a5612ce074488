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

use super::Cutter;

/// Error of the sine at which the search for a bull-nose's touching point ends. The height is stationary there.
const SINE: f64 = 1e-13;

/// A bound on the steps of that search that halvings alone would keep.
const STEPS: u32 = 60;

impl Cutter {
    /// How far from the place nearest to the axis an endless line touches, towards its rising side; mm. `distance` (less than the
    /// radius) is that place's from the axis, `slope` at least 0. Where the line is level it is 0.
    pub(super) fn along(&self, distance: f64, slope: f64) -> f64 {
        if slope <= 0.0 {
            return 0.0;
        }
        let (corner, flat, radius) = (self.corner_radius(), self.flat_radius(), self.radius());
        let square = distance * distance;
        // Of the plane through the line and parallel to the axis; 1 where the line is upright.
        let sine = 1.0 / (1.0 + 1.0 / (slope * slope)).sqrt();
        if corner <= 0.0 || flat <= 0.0 {
            let half = (radius * radius - square).max(0.0).sqrt();
            return if corner <= 0.0 { half } else { half * sine };
        }
        // (1 + m^2) r^2 - d^2 divided by 1 + m^2, so that steep lines stay within range.
        let shrunk = square * (1.0 - sine * sine);
        let mut low = sine.max((distance - flat) / corner).min(1.0);
        let mut high = 1.0;
        let mut lean = if distance < flat { low } else { high };
        for _ in 0..STEPS {
            let r = flat + corner * lean;
            let below = r * r - shrunk;
            if below <= 0.0 {
                break;
            }
            let root = below.sqrt();
            let over = lean - sine * r / root;
            if over > 0.0 {
                high = lean;
            } else {
                low = lean;
            }
            let mut next = lean - over / (1.0 + corner * sine * shrunk / (below * root));
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
        (r * r - square).max(0.0).sqrt()
    }
}

//! Roots that move along together: seen from one of them, the other moves slowly.

use super::cells::Bracket;
use crate::chips::family::{Curve, Window};
use crate::chips::interval::Interval;
use crate::chips::trig::{Angle, Trig};

/// Whether the root of one curve in a bracket never meets a root of another curve.
///
/// With r the root in the middle of the time and v its velocity, angles are r + v (t - middle) + y. First comes a |y| within which the root
/// stays, by the mean value theorem along the moving angle; then the other curve's sign must be certain there.
pub(super) fn apart(bracket: &Bracket, curve: Curve, other: Curve, window: &Window<'_>) -> bool {
    let (now, (all, rate)) = (window.now(curve), window.curve(curve));
    let root = Trig(now.0.map(Interval::middle)).root(bracket.lo, bracket.hi, bracket.rising);
    let at = Angle::over(Interval::point(root));
    let velocity = -rate.value(&at).middle() / now.slope(&at).middle();
    if !velocity.is_finite() {
        return false;
    }
    let half = window.half();
    let time = Interval { lo: -half, hi: half };
    let near = |y: f64| Interval { lo: root - y, hi: root + y };
    // How a curve changes along the moving angle, over all angles within y of it.
    let drift = |all: &Trig<Interval>, rate: &Trig<Interval>, y: f64| {
        let there = Angle::over(near(y + velocity.abs() * half));
        (all.slope(&there) * Interval::point(velocity) + rate.value(&there)) * time
    };
    let (below, above) = if bracket.rising { (Some(-1), Some(1)) } else { (Some(1), Some(-1)) };
    // About what the root's acceleration takes it away.
    let mut y = 1e-13 + 2.0 * drift(&all, &rate, 1e-13).magnitude() / now.slope(&at).magnitude();
    while y < bracket.hi - bracket.lo {
        let change = drift(&all, &rate, y);
        let sign = |angle: f64| (now.value(&Angle::over(Interval::point(angle))) + change).sign();
        if sign(root - y) == below && sign(root + y) == above {
            let (now, (all, rate)) = (window.now(other), window.curve(other));
            let across = now.slope(&Angle::over(near(y))) * Interval { lo: -y, hi: y };
            return (now.value(&at) + across + drift(&all, &rate, y)).sign().is_some();
        }
        y *= 8.0;
    }
    false
}

//! This module separates roots that move together: relative to one of them, the other one moves slowly.

use super::circle_cells::RootBracket;
use crate::layered_chips::interval::IntervalF64;
use crate::layered_chips::section_family::{DiagramCurve, FamilyWindow};
use crate::layered_chips::trig_polynomial::{AngleSinCos, TrigPolynomial};

/// Returns whether the root of one curve in a bracket never meets a root of another curve.
///
/// Let r be the root at the middle of the time and v its velocity, and write angles as r + v (t - middle) +
/// y. First a |y| is found within which the root stays, by the mean value theorem along the moving angle.
/// Then the other curve's sign must be certain within that |y|.
pub(super) fn is_root_apart(
    bracket: &RootBracket,
    curve: DiagramCurve,
    other: DiagramCurve,
    window: &FamilyWindow<'_>,
) -> bool {
    let (now, (all, rate)) = (window.curve_at_middle(curve), window.enclose_curve(curve));
    let root =
        TrigPolynomial(now.0.map(IntervalF64::middle)).find_root(bracket.lo, bracket.hi, bracket.rising);
    let at = AngleSinCos::from_interval(IntervalF64::from_point(root));
    // From f(theta, t) = 0: dtheta/dt = -f_t / f_theta.
    let velocity = -rate.value_at(&at).middle() / now.derivative_at(&at).middle();
    if !velocity.is_finite() {
        return false;
    }
    let half = window.half_length();
    let time = IntervalF64 { lo: -half, hi: half };
    let near = |y: f64| IntervalF64 { lo: root - y, hi: root + y };
    // The change of a curve along the moving angle over the interval, for all angles within y of it: (f_theta
    // v + f_t) dt.
    let drift = |all: &TrigPolynomial<IntervalF64>, rate: &TrigPolynomial<IntervalF64>, y: f64| {
        let there = AngleSinCos::from_interval(near(y + velocity.abs() * half));
        (all.derivative_at(&there) * IntervalF64::from_point(velocity) + rate.value_at(&there)) * time
    };
    let (below, above) = if bracket.rising { (Some(-1), Some(1)) } else { (Some(1), Some(-1)) };
    // The first y is about the distance that the root's acceleration moves it.
    let mut y = 1e-13 + 2.0 * drift(&all, &rate, 1e-13).magnitude() / now.derivative_at(&at).magnitude();
    while y < bracket.hi - bracket.lo {
        let change = drift(&all, &rate, y);
        let sign = |angle: f64| {
            (now.value_at(&AngleSinCos::from_interval(IntervalF64::from_point(angle))) + change).sign()
        };
        // The curve has opposite signs on both sides at all times, so the root stays within y.
        if sign(root - y) == below && sign(root + y) == above {
            let (now, (all, rate)) = (window.curve_at_middle(other), window.enclose_curve(other));
            let across =
                now.derivative_at(&AngleSinCos::from_interval(near(y))) * IntervalF64 { lo: -y, hi: y };
            return (now.value_at(&at) + across + drift(&all, &rate, y)).sign().is_some();
        }
        y *= 8.0;
    }
    false
}

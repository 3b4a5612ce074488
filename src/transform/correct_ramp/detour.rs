//! This module makes longer ramps where the circle does not fit: two or three long legs along a line, and
//! wider helices.

use super::ramp::{NOTHING, Ramp, RampStep};
use super::ramp_kind::Helix;
use super::ramp_passes::build_helix_steps;
use nalgebra::{Point2, Point3, Vector2};

/// Chords of a widened helix need not be narrower than this angle (degrees). On a circle of 1 m radius, such
/// chords are within 0.4 um of it.
const NARROWEST_CHORD: f64 = 0.1;

/// Builds a ramp over turning points across the axis. Its height is divided in proportion to the lengths of
/// the legs.
fn build_over_turns(ramp: &Ramp, turns: &[Point2<f64>]) -> Option<Ramp> {
    let (start, end) = (ramp.start, ramp.end_point());
    let places: Vec<Point2<f64>> =
        std::iter::once(start.xy()).chain(turns.iter().copied()).chain([end.xy()]).collect();
    let lengths: Vec<f64> = places
        .windows(2)
        .map(|pair| match pair {
            [a, b] => (b - a).norm(),
            _ => 0.0,
        })
        .collect();
    let whole: f64 = lengths.iter().sum();
    let mut gone = 0.0;
    let mut points = vec![start];
    for (place, length) in places.iter().skip(1).zip(&lengths) {
        gone += length;
        let z = start.z - ramp.height_mm() * gone / whole;
        points.push(Point3::new(place.x, place.y, z));
    }
    if let Some(last) = points.last_mut() {
        *last = end;
    }
    Ramp::from_points(&points)
}

/// Returns ramps along the chord P1-Pn with legs of at least `least` (mm), the shortest first. If the chord
/// is long enough, the ramp runs along it. Otherwise the ramp runs beyond the end and back, or starts
/// backwards, or does both. A closed ramp has no chord, so the list is empty.
pub(super) fn lengthen_along_chord(ramp: &Ramp, least: f64) -> Vec<Ramp> {
    let (start, end) = (ramp.start.xy(), ramp.end_point().xy());
    let s = (end - start).norm();
    let Some(along) = (end - start).try_normalize(NOTHING) else { return Vec::new() };
    if s >= least {
        return build_over_turns(ramp, &[]).into_iter().collect();
    }
    let at = |distance: f64| start + along * distance;
    // With l for `least`, the legs are s + l and l; l and s + l; l, 2 l - s and l. As s < l here, none is
    // shorter than l.
    let turns = [vec![at(s + least)], vec![at(-least)], vec![at(least), at(s - least)]];
    turns.iter().filter_map(|turns| build_over_turns(ramp, turns)).collect()
}

/// Returns a ramp from P1 to a point beyond Pn in a direction, and back to Pn. The operation's first cutting
/// pass runs there anyway. The point is no farther away than both legs need.
pub(super) fn lengthen_along_pass(ramp: &Ramp, direction: Vector2<f64>, least: f64) -> Option<Ramp> {
    let direction =
        direction.try_normalize(1e-9).filter(|vector| vector.iter().all(|value| value.is_finite()))?;
    let back = ramp.end_point().xy() - ramp.start.xy();
    let reach = if (back + direction * least).norm() >= least {
        least
    } else {
        // Both legs need |back + t direction| >= least and t >= least. The quadratic equation t^2 + 2 half t
        // + rest = 0 has `least` between its roots here, so the larger root is the shortest detour.
        let (half, rest) = (back.dot(&direction), back.norm_squared() - least * least);
        (half * half - rest).max(0.0).sqrt() - half
    };
    build_over_turns(ramp, &[ramp.end_point().xy() + direction * reach])
}

/// Returns the helix about the same axis with the radius `radius` (mm). A level link leads from P1 out to it,
/// and another one from its end to Pn. Its chords stay as close to their circle as before.
pub(super) fn widen_helix(ramp: &Ramp, helix: &Helix, radius: f64) -> Ramp {
    let ratio = radius / helix.radius;
    let out = |point: Point3<f64>| {
        let at = helix.centre + (point.xy() - helix.centre) * ratio;
        Point3::new(at.x, at.y, point.z)
    };
    let widest_step = if helix.arcs {
        helix.widest_step
    } else {
        // The distance of a chord from its circle is R (1 - cos(sweep / 2)) = 2 R sin^2(sweep / 4). It stays
        // the same if the sine shrinks with the square root of the radius.
        let narrowed = 4.0 * ((helix.widest_step / 4.0).sin() / ratio.sqrt()).asin();
        narrowed.max(NARROWEST_CHORD.to_radians().min(helix.widest_step))
    };
    let wide = Helix { radius, widest_step, ..*helix };
    let descent = ramp.descending_steps();
    let (start, end) = (out(ramp.point_before_step(descent.start)), out(ramp.point_before_step(descent.end)));
    let mut steps = vec![RampStep::straight_to(start)];
    steps.extend(build_helix_steps(&wide, start, end));
    steps.push(RampStep::straight_to(ramp.end_point()));
    Ramp { start: ramp.start, steps }
}

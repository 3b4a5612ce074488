//! Longer ramps where the circle does not fit: two or three long legs along a line, and wider helices.

use super::ramp::{NOTHING, Ramp, RampStep};
use super::ramp_kind::Helix;
use super::ramp_passes::build_helix_steps;
use nalgebra::{Point2, Point3, Vector2};

/// Chords of a widened helix need not be narrower than this, degrees: on a circle of 1 m they are within 0.2 um.
const NARROWEST_CHORD: f64 = 0.1;

/// A ramp over turning points across the axis, its height shared out by length.
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

/// Ramps along the chord P1-Pn with legs of at least `least` (mm): the chord itself where it is long enough, else beyond its end and
/// back, from behind its start, and to and fro over both. The shortest comes first. None for a closed ramp.
pub fn lengthen_along_chord(ramp: &Ramp, least: f64) -> Vec<Ramp> {
    let (start, end) = (ramp.start.xy(), ramp.end_point().xy());
    let s = (end - start).norm();
    let Some(along) = (end - start).try_normalize(NOTHING) else { return Vec::new() };
    if s >= least {
        return build_over_turns(ramp, &[]).into_iter().collect();
    }
    let at = |distance: f64| start + along * distance;
    let turns = [vec![at(s + least)], vec![at(-least)], vec![at(least), at(s - least)]];
    turns.iter().filter_map(|turns| build_over_turns(ramp, turns)).collect()
}

/// A ramp out along a direction from Pn, no farther than both legs need, and back to Pn: where the operation's first cutting pass
/// will go anyway.
pub fn lengthen_along_pass(ramp: &Ramp, direction: Vector2<f64>, least: f64) -> Option<Ramp> {
    let direction = direction.try_normalize(1e-9).filter(|way| way.iter().all(|value| value.is_finite()))?;
    let back = ramp.end_point().xy() - ramp.start.xy();
    let reach = if (back + direction * least).norm() >= least {
        least
    } else {
        // |back + t direction| = least: too short between the roots, and `least` lies there.
        let (half, rest) = (back.dot(&direction), back.norm_squared() - least * least);
        (half * half - rest).max(0.0).sqrt() - half
    };
    build_over_turns(ramp, &[ramp.end_point().xy() + direction * reach])
}

/// The helix about the same axis with radius `radius` (mm): a level link from P1 out to it, and one from its end to Pn. Chords stay
/// as close to their circle as they were.
pub fn widen_helix(ramp: &Ramp, helix: &Helix, radius: f64) -> Ramp {
    let ratio = radius / helix.radius;
    let out = |point: Point3<f64>| {
        let at = helix.centre + (point.xy() - helix.centre) * ratio;
        Point3::new(at.x, at.y, point.z)
    };
    let widest_step = if helix.arcs {
        helix.widest_step
    } else {
        // A chord's distance from its circle is 2 R sin^2(sweep / 4).
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

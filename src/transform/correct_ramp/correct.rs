//! One ramp corrected: length, then height, then layers, inside the region.

use super::circle::{on_circle, own_side};
use super::detour::{along_chord, along_pass, widened};
use super::kind::Kind;
use super::layers::{TooMany, compressed, shallow};
use super::limits::{Limits, keeps, long_enough, shallow_enough};
use super::ramp::{Ramp, is_sensible};
use super::region::Region;
use nalgebra::{Point2, Point3, Vector2};

/// What a ramp is corrected by. Lengths in mm, in the tool's frame.
#[derive(Debug, Clone, Copy)]
pub struct Task<'a> {
    /// The cutter's limits.
    pub limits: Limits,
    /// Height above the ramp's end at which it may begin: depth of cut and clearance (h1'); `None` keeps its own.
    pub begin: Option<f64>,
    /// Where the tool may go.
    pub region: &'a Region,
    /// Directions in which the operation cuts on from the ramp's end, the first pass first.
    pub passes: &'a [Vector2<f64>],
    /// How far printed coordinates may be off: legs are made that much longer, so that they keep the limit as printed.
    pub rounding: f64,
}

/// How a ramp became longer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Lengthened {
    /// It was long enough.
    No,
    /// Its turning points moved onto the circumscribed circle.
    Circle,
    /// Onto the circle's mirror image, since the circle left the region.
    MirroredCircle,
    /// The helix became wider.
    WidenedHelix,
    /// Long legs along the chord from start to end.
    AlongChord,
    /// Long legs along the first cutting pass.
    AlongPass,
}

/// A corrected ramp.
#[derive(Debug, Clone, PartialEq)]
pub struct Corrected {
    /// The ramp.
    pub ramp: Ramp,
    /// How it became longer.
    pub lengthened: Lengthened,
    /// Ratio nu of the compression; 1 for none.
    pub compression: f64,
    /// How many times it goes over its path; of a helix 1 and its additional turns.
    pub passes: usize,
}

/// Why a ramp cannot be corrected.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum Impossible {
    /// Every longer ramp leaves the region.
    #[error("every way to make its legs {0:.3} mm long leaves the region where the tool may go")]
    Region(f64),
    /// No direction to be longer in.
    #[error("it has one leg only, and no chord or cutting pass to lengthen it along")]
    NoDirection,
    /// So flat a limit that no sensible number of layers keeps it.
    #[error("it would need {0:.0} passes to be shallow enough")]
    TooMany(f64),
    /// Its own path is too short for its printed decimals, or one of its coordinates or limits is no
    /// number of a sensible size.
    #[error("it cannot be made to keep the limits")]
    Limits,
}

/// The corrected ramp; `None` when it keeps the limits as it is.
///
/// Order: length, compression (only when a step is too steep and the ramp begins too high), layers. P1 keeps its place across the
/// axis and Pn its place altogether; the result descends all the way and keeps both limits.
///
/// # Errors
/// [`Impossible`]; a ramp is never corrected in part.
pub fn correct(ramp: &Ramp, task: &Task<'_>) -> Result<Option<Corrected>, Impossible> {
    let numbers = [task.limits.shortest_leg, task.limits.steepest, task.rounding];
    if !ramp.is_sensible() || !numbers.into_iter().all(is_sensible) {
        return Err(Impossible::Limits);
    }
    if keeps(ramp, &task.limits, task.rounding) {
        return Ok(None);
    }
    if long_enough(ramp, &task.limits, task.rounding) {
        return shallower(ramp, Lengthened::No, task).map(Some);
    }
    let least = task.limits.shortest_leg + task.rounding;
    let longer = candidates(ramp, least, task.passes);
    if longer.is_empty() {
        return Err(Impossible::NoDirection);
    }
    let mut why = Impossible::Region(task.limits.shortest_leg);
    for (lengthened, candidate) in longer {
        if !task.region.holds(&candidate.path()) || !long_enough(&candidate, &task.limits, 0.0) {
            continue;
        }
        match shallower(&candidate, lengthened, task) {
            Ok(found) => return Ok(Some(found)),
            Err(reason) => why = reason,
        }
    }
    Err(why)
}

/// Longer ramps in the order in which they are tried.
fn candidates(ramp: &Ramp, least: f64, passes: &[Vector2<f64>]) -> Vec<(Lengthened, Ramp)> {
    let mut found = Vec::new();
    match Kind::of(ramp) {
        Kind::Helix(helix) => {
            found.push((Lengthened::WidenedHelix, widened(ramp, &helix, 0.5 * least)));
        }
        Kind::Zigzag | Kind::Plunge => {
            let points = turning_points(ramp);
            let places: Vec<Point2<f64>> = points.iter().map(Point3::xy).collect();
            let legs = points.len().saturating_sub(1).max(1);
            let path: f64 = ramp.walk().map(|(from, step)| step.across(from)).sum();
            let (leg, closed) = (least.max(path / legs as f64), ramp.is_closed());
            let own = own_side(&places, closed);
            let sides = [(Lengthened::Circle, own), (Lengthened::MirroredCircle, own.mirrored())];
            for (how, side) in sides {
                let moved = on_circle(&places, leg, side, closed);
                found.extend(moved.and_then(|moved| raised(&moved, &points)).map(|ramp| (how, ramp)));
            }
        }
        Kind::AlongShape => {}
    }
    found.extend(along_chord(ramp, least).into_iter().map(|ramp| (Lengthened::AlongChord, ramp)));
    let along = passes.iter().filter_map(|direction| along_pass(ramp, *direction, least));
    found.extend(along.map(|ramp| (Lengthened::AlongPass, ramp)));
    found
}

/// P1..Pn: the turning points between straight legs that descend. Level legs have no part in it, but Pn stays Pn.
fn turning_points(ramp: &Ramp) -> Vec<Point3<f64>> {
    let legs = ramp.legs();
    let inner = legs.iter().take(legs.len().saturating_sub(1)).map(|leg| ramp.point(leg.steps.end));
    std::iter::once(ramp.start).chain(inner).chain([ramp.end()]).collect()
}

/// New places across the axis with the old heights; P1 and Pn as they were.
fn raised(places: &[Point2<f64>], points: &[Point3<f64>]) -> Option<Ramp> {
    let raised = places.iter().zip(points).map(|(place, point)| Point3::new(place.x, place.y, point.z));
    let mut raised: Vec<Point3<f64>> = raised.collect();
    if let (Some(last), Some(end)) = (raised.last_mut(), points.last()) {
        *last = *end;
    }
    Ramp::through(&raised)
}

/// The same turning points with an even slope between them, where every leg is straight: an arc in a vertical plane, say, is steep only
/// where it begins. `None` where the ramp has no other points, or level legs.
fn straightened(ramp: &Ramp) -> Option<Ramp> {
    let descending: usize = ramp.legs().iter().map(|leg| leg.steps.len()).sum();
    if Kind::of(ramp) != Kind::Zigzag || descending < ramp.steps.len() {
        return None;
    }
    let points = turning_points(ramp);
    if points.len() > ramp.steps.len() { None } else { Ramp::through(&points) }
}

fn shallower(ramp: &Ramp, lengthened: Lengthened, task: &Task<'_>) -> Result<Corrected, Impossible> {
    let straight = if shallow_enough(ramp, &task.limits, task.rounding) { None } else { straightened(ramp) };
    let ramp = straight.as_ref().unwrap_or(ramp);
    let mut ratio = 1.0;
    let mut lowered = ramp.clone();
    if !shallow_enough(ramp, &task.limits, task.rounding) {
        let begin = task.begin.filter(|begin| *begin > 0.0 && *begin < ramp.height());
        if let Some(begin) = begin {
            ratio = begin / ramp.height();
            lowered = compressed(ramp, ratio);
        }
    }
    let (ramp, passes) = shallow(&lowered, &task.limits, task.rounding, task.region)
        .map_err(|TooMany(passes)| Impossible::TooMany(passes))?;
    if !keeps(&ramp, &task.limits, task.rounding) {
        return Err(Impossible::Limits);
    }
    Ok(Corrected { ramp, lengthened, compression: ratio, passes })
}

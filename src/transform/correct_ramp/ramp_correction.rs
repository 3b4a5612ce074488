//! This module corrects a single ramp: first its length, then its height, then its layers, all inside the
//! region.

use super::circumscribed_circle::{find_own_side, place_on_circle};
use super::detour::{lengthen_along_chord, lengthen_along_pass, widen_helix};
use super::ramp::{Ramp, is_sensible};
use super::ramp_kind::RampKind;
use super::ramp_limits::{RampLimits, is_long_enough, is_shallow_enough, is_within_limits};
use super::ramp_passes::{TooManyPasses, add_passes_or_turns, compress_heights};
use super::tool_region::ToolRegion;
use nalgebra::{Point2, Point3, Vector2};

/// The data by which a ramp is corrected. Lengths are in mm, in the tool's frame.
#[derive(Debug, Clone, Copy)]
pub struct RampTask<'a> {
    /// The limits of the cutter.
    pub limits: RampLimits,
    /// The height above the ramp's end at which it may begin: depth of cut plus clearance (h1'). With `None`,
    /// it begins where it did before.
    pub begin: Option<f64>,
    /// The region in which the tool may move.
    pub region: &'a ToolRegion,
    /// The directions in which the operation cuts from the ramp's end, with the first pass first.
    pub passes: &'a [Vector2<f64>],
    /// How far printed coordinates may be off. Legs are made longer by this, so that they keep the limit as
    /// printed.
    pub rounding: f64,
}

/// How a ramp became longer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LengtheningMethod {
    /// It was long enough.
    No,
    /// Its turning points were moved onto the circumscribed circle.
    Circle,
    /// Its turning points were moved onto the mirrored circle, because the circle left the region.
    MirroredCircle,
    /// The helix was widened.
    WidenedHelix,
    /// It got long legs along the chord from start to end.
    AlongChord,
    /// It got long legs along the first cutting pass.
    AlongPass,
    /// It became an entry straight down over a drilled hole.
    OverHole,
}

/// A corrected ramp.
#[derive(Debug, Clone, PartialEq)]
pub struct CorrectedRamp {
    /// The ramp.
    pub ramp: Ramp,
    /// How it was lengthened.
    pub lengthened: LengtheningMethod,
    /// The ratio nu of the compression; 1 if it was not compressed.
    pub compression: f64,
    /// How many times it runs over its path. For a helix it is 1 plus the number of added turns.
    pub passes: usize,
}

/// The reason why a ramp cannot be corrected.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ImpossibleCorrection {
    /// Every longer ramp leaves the region.
    #[error("every longer path with legs of {0:.3} mm leaves the region where the tool may go")]
    Region(f64),
    /// There is no direction in which to lengthen it.
    #[error("it has one leg only, and no chord or cutting pass to lengthen it along")]
    NoDirection,
    /// The limit is so flat that it would need too many layers.
    #[error("it would need {0:.0} passes to be shallow enough")]
    TooMany(f64),
    /// Its own path is too short for its printed decimals, or one of its coordinates or limits is no number
    /// of a plausible size.
    #[error("it cannot be made to keep the limits")]
    Limits,
}

/// Corrects a ramp. Returns `None` if it already keeps the limits.
///
/// The length is corrected first. Then the ramp is compressed, if a step is too steep and the ramp begins too
/// high. Then layers are added. P1 stays where it is across the axis, and Pn stays altogether. The result
/// descends all the way and keeps both limits.
///
/// # Errors
/// Returns [`ImpossibleCorrection`]. A ramp is never corrected in part.
pub fn correct_ramp(ramp: &Ramp, task: &RampTask<'_>) -> Result<Option<CorrectedRamp>, ImpossibleCorrection> {
    let numbers = [task.limits.shortest_leg, task.limits.steepest, task.rounding];
    if !ramp.is_sensible() || !numbers.into_iter().all(is_sensible) {
        return Err(ImpossibleCorrection::Limits);
    }
    if is_within_limits(ramp, &task.limits, task.rounding) {
        return Ok(None);
    }
    if is_long_enough(ramp, &task.limits, task.rounding) {
        return make_shallower(ramp, LengtheningMethod::No, task).map(Some);
    }
    // The length comes before the angle, as in the paper, because longer legs over the same height are
    // shallower already.
    let least = task.limits.shortest_leg + task.rounding;
    let longer = find_longer_ramps(ramp, least, task.passes);
    if longer.is_empty() {
        return Err(ImpossibleCorrection::NoDirection);
    }
    // The last reason is reported: a candidate that only fails its slope is nearer to a solution than one
    // that leaves the region.
    let mut why = ImpossibleCorrection::Region(task.limits.shortest_leg);
    for (lengthened, candidate) in longer {
        // No rounding is granted to a new ramp, because printing may still shorten its legs by as much.
        if !task.region.contains_path(&candidate.path_across())
            || !is_long_enough(&candidate, &task.limits, 0.0)
        {
            continue;
        }
        match make_shallower(&candidate, lengthened, task) {
            Ok(found) => return Ok(Some(found)),
            Err(reason) => why = reason,
        }
    }
    Err(why)
}

/// Returns longer ramps in the order in which they are tried.
fn find_longer_ramps(ramp: &Ramp, least: f64, passes: &[Vector2<f64>]) -> Vec<(LengtheningMethod, Ramp)> {
    let mut found = Vec::new();
    match RampKind::classify_ramp(ramp) {
        RampKind::Helix(helix) => {
            found.push((LengtheningMethod::WidenedHelix, widen_helix(ramp, &helix, 0.5 * least)));
        }
        RampKind::Zigzag | RampKind::Plunge => {
            let points = find_turning_points(ramp);
            let places: Vec<Point2<f64>> = points.iter().map(Point3::xy).collect();
            let legs = points.len().saturating_sub(1).max(1);
            let path: f64 = ramp.steps_with_starts().map(|(from, step)| step.length_across_mm(from)).sum();
            // The paper leaves the position e of the centre open. This leg is the shortest one that is long
            // enough and not shorter than the legs are on average, which would make them steeper.
            let (leg, closed) = (least.max(path / legs as f64), ramp.is_closed());
            let own = find_own_side(&places, closed);
            let sides =
                [(LengtheningMethod::Circle, own), (LengtheningMethod::MirroredCircle, own.mirrored())];
            for (how, side) in sides {
                let moved = place_on_circle(&places, leg, side, closed);
                found
                    .extend(moved.and_then(|moved| restore_heights(&moved, &points)).map(|ramp| (how, ramp)));
            }
        }
        RampKind::AlongShape => {}
    }
    found.extend(
        lengthen_along_chord(ramp, least).into_iter().map(|ramp| (LengtheningMethod::AlongChord, ramp)),
    );
    let along = passes.iter().filter_map(|direction| lengthen_along_pass(ramp, *direction, least));
    found.extend(along.map(|ramp| (LengtheningMethod::AlongPass, ramp)));
    found
}

/// Returns P1..Pn: the ends of the ramp, and the turning points between its straight descending legs. Level
/// legs are left out.
fn find_turning_points(ramp: &Ramp) -> Vec<Point3<f64>> {
    let legs = ramp.descending_legs();
    let inner =
        legs.iter().take(legs.len().saturating_sub(1)).map(|leg| ramp.point_before_step(leg.steps.end));
    std::iter::once(ramp.start).chain(inner).chain([ramp.end_point()]).collect()
}

/// Raises new points across the axis to the old heights. P1 and Pn stay as they were.
fn restore_heights(places: &[Point2<f64>], points: &[Point3<f64>]) -> Option<Ramp> {
    let raised = places.iter().zip(points).map(|(place, point)| Point3::new(place.x, place.y, point.z));
    let mut raised: Vec<Point3<f64>> = raised.collect();
    if let (Some(last), Some(end)) = (raised.last_mut(), points.last()) {
        *last = *end;
    }
    Ramp::from_points(&raised)
}

/// Makes the slope even between the turning points, where every leg is straight. An arc in a vertical plane,
/// for example, is only steep where it begins. Returns `None` if that would add points, or if the ramp has
/// level legs.
fn straighten_legs(ramp: &Ramp) -> Option<Ramp> {
    let descending: usize = ramp.descending_legs().iter().map(|leg| leg.steps.len()).sum();
    if RampKind::classify_ramp(ramp) != RampKind::Zigzag || descending < ramp.steps.len() {
        return None;
    }
    let points = find_turning_points(ramp);
    if points.len() > ramp.steps.len() { None } else { Ramp::from_points(&points) }
}

fn make_shallower(
    ramp: &Ramp,
    lengthened: LengtheningMethod,
    task: &RampTask<'_>,
) -> Result<CorrectedRamp, ImpossibleCorrection> {
    let straight =
        // An even slope is tried first, because it needs neither a lower start nor more passes.
        if is_shallow_enough(ramp, &task.limits, task.rounding) { None } else { straighten_legs(ramp) };
    let ramp = straight.as_ref().unwrap_or(ramp);
    let mut ratio = 1.0;
    let mut lowered = ramp.clone();
    if !is_shallow_enough(ramp, &task.limits, task.rounding) {
        // Compression only removes height above the depth of cut, where there is air anyway.
        let begin = task.begin.filter(|begin| *begin > 0.0 && *begin < ramp.height_mm());
        if let Some(begin) = begin {
            // nu = h1' / h1, with both heights above the ramp's end. The paper prints z2' = z2 + h1', but its
            // figure measures from the end.
            ratio = begin / ramp.height_mm();
            lowered = compress_heights(ramp, ratio);
        }
    }
    let (ramp, passes) = add_passes_or_turns(&lowered, &task.limits, task.rounding, task.region)
        .map_err(|TooManyPasses(passes)| ImpossibleCorrection::TooMany(passes))?;
    if !is_within_limits(&ramp, &task.limits, task.rounding) {
        return Err(ImpossibleCorrection::Limits);
    }
    Ok(CorrectedRamp { ramp, lengthened, compression: ratio, passes })
}

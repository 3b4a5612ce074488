//! One ramp corrected: length, then height, then layers, inside the region.

use super::circumscribed_circle::{find_own_side, place_on_circle};
use super::detour::{lengthen_along_chord, lengthen_along_pass, widen_helix};
use super::ramp::{Ramp, is_sensible};
use super::ramp_kind::RampKind;
use super::ramp_limits::{RampLimits, is_long_enough, is_shallow_enough, is_within_limits};
use super::ramp_passes::{TooManyPasses, add_passes_or_turns, compress_heights};
use super::tool_region::ToolRegion;
use nalgebra::{Point2, Point3, Vector2};

/// What a ramp is corrected by. Lengths in mm, in the tool's frame.
#[derive(Debug, Clone, Copy)]
pub struct RampTask<'a> {
    /// The cutter's limits.
    pub limits: RampLimits,
    /// Height above the ramp's end at which it may begin: depth of cut and clearance (h1'); `None` keeps its own.
    pub begin: Option<f64>,
    /// Where the tool may go.
    pub region: &'a ToolRegion,
    /// Directions in which the operation cuts on from the ramp's end, the first pass first.
    pub passes: &'a [Vector2<f64>],
    /// How far printed coordinates may be off: legs are made that much longer, so that they keep the limit as printed.
    pub rounding: f64,
}

/// How a ramp became longer.
#[derive(Debug, Clone, Copy, PartialEq, Eq, serde::Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LengtheningMethod {
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
pub struct CorrectedRamp {
    /// The ramp.
    pub ramp: Ramp,
    /// How it became longer.
    pub lengthened: LengtheningMethod,
    /// Ratio nu of the compression; 1 for none.
    pub compression: f64,
    /// How many times it goes over its path; of a helix 1 and its additional turns.
    pub passes: usize,
}

/// Why a ramp cannot be corrected.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ImpossibleCorrection {
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
/// [`ImpossibleCorrection`]; a ramp is never corrected in part.
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
    let least = task.limits.shortest_leg + task.rounding;
    let longer = find_longer_ramps(ramp, least, task.passes);
    if longer.is_empty() {
        return Err(ImpossibleCorrection::NoDirection);
    }
    let mut why = ImpossibleCorrection::Region(task.limits.shortest_leg);
    for (lengthened, candidate) in longer {
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

/// Longer ramps in the order in which they are tried.
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

/// P1..Pn: the turning points between straight legs that descend. Level legs have no part in it, but Pn stays Pn.
fn find_turning_points(ramp: &Ramp) -> Vec<Point3<f64>> {
    let legs = ramp.descending_legs();
    let inner =
        legs.iter().take(legs.len().saturating_sub(1)).map(|leg| ramp.point_before_step(leg.steps.end));
    std::iter::once(ramp.start).chain(inner).chain([ramp.end_point()]).collect()
}

/// New places across the axis with the old heights; P1 and Pn as they were.
fn restore_heights(places: &[Point2<f64>], points: &[Point3<f64>]) -> Option<Ramp> {
    let raised = places.iter().zip(points).map(|(place, point)| Point3::new(place.x, place.y, point.z));
    let mut raised: Vec<Point3<f64>> = raised.collect();
    if let (Some(last), Some(end)) = (raised.last_mut(), points.last()) {
        *last = *end;
    }
    Ramp::from_points(&raised)
}

/// The same turning points with an even slope between them, where every leg is straight: an arc in a vertical plane, say, is steep only
/// where it begins. `None` where the ramp has no other points, or level legs.
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
        if is_shallow_enough(ramp, &task.limits, task.rounding) { None } else { straighten_legs(ramp) };
    let ramp = straight.as_ref().unwrap_or(ramp);
    let mut ratio = 1.0;
    let mut lowered = ramp.clone();
    if !is_shallow_enough(ramp, &task.limits, task.rounding) {
        let begin = task.begin.filter(|begin| *begin > 0.0 && *begin < ramp.height_mm());
        if let Some(begin) = begin {
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

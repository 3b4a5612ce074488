//! This module makes ramps shallower by equal-ratio compression, then by more layers (Zhou 2020, "ramp angle
//! correction").

use super::ramp::{Ramp, RampArc, RampStep};
use super::ramp_kind::{Helix, RampKind};
use super::ramp_limits::{RampLimits, is_shallow_enough};
use super::tool_region::ToolRegion;
use nalgebra::{Point3, Rotation2};
use std::f64::consts::TAU;

/// A ramp with more passes than this is no correction but another operation.
pub const MOST_PASSES: usize = 1000;

/// When counts are rounded up, an excess of this size is ignored, so that a ramp on the limit gets no extra
/// pass.
const SLACK: f64 = 1e-9;

/// The error of a ramp that would need this many passes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TooManyPasses(pub f64);

/// Multiplies the heights above the end by `ratio` (nu): `z' = z_n + nu (z - z_n)`.
pub fn compress_heights(ramp: &Ramp, ratio: f64) -> Ramp {
    let end = ramp.end_point().z;
    let lower = |point: Point3<f64>| Point3::new(point.x, point.y, end + ratio * (point.z - end));
    let steps = ramp.steps.iter().map(|step| RampStep { to: lower(step.to), ..*step }).collect();
    Ramp { start: lower(ramp.start), steps }
}

/// Returns how many passes keep the limit: `1 + w` around a closed ramp, `1 + 2 w` to and fro over an open
/// one.
///
/// # Errors
/// Returns [`TooManyPasses`] above [`MOST_PASSES`], and for a ramp that goes straight down.
pub fn count_passes(steepest: f64, limit: f64, closed: bool) -> Result<usize, TooManyPasses> {
    let ratio = limit / steepest;
    if ratio >= 1.0 - SLACK {
        return Ok(1);
    }
    // Each pass descends by limit / steepest of the height. A closed ramp needs w more of them with
    // 1 + w >= 1 / ratio, an open one goes forward and back, so w counts pairs.
    let step = if closed { ratio } else { 2.0 * ratio };
    let more = ((1.0 - ratio) / step - SLACK).ceil();
    let passes = 1.0 + if closed { more } else { 2.0 * more };
    if passes <= MOST_PASSES as f64 { Ok(passes as usize) } else { Err(TooManyPasses(passes)) }
}

/// Divides the height of a ramp among passes (at least one). A closed ramp runs around again. An open one
/// runs forward, back and forward.
pub fn repeat_in_passes(ramp: &Ramp, passes: usize) -> Ramp {
    let passes = passes.max(1);
    let (closed, height, top) = (ramp.is_closed(), ramp.height_mm(), ramp.start.z);
    let fallen = |z: f64| if height > 0.0 { (top - z) / height } else { 0.0 };
    let count = passes as f64;
    let mut steps = Vec::with_capacity(ramp.steps.len() * passes);
    for pass in 0..passes {
        // Every pass takes an equal part of the height (nu = 1 / passes), so all are equally steep and the
        // last one ends at Pn.
        let at = |fraction: f64| top - height * (pass as f64 + fraction) / count;
        if pass % 2 == 0 || closed {
            steps.extend(ramp.steps.iter().map(|step| {
                let to = Point3::new(step.to.x, step.to.y, at(fallen(step.to.z)));
                RampStep { to, bend: step.bend }
            }));
        } else {
            let back = ramp.steps_with_starts().map(|(from, step)| {
                // On the way back a step ends where it began on the way forward. The part of the height that
                // lay ahead of that point then lies behind it.
                let to = Point3::new(from.x, from.y, at(1.0 - fallen(from.z)));
                RampStep { to, bend: step.bend.map(|bend| RampArc { sweep: -bend.sweep, ..bend }) }
            });
            let mut back: Vec<RampStep> = back.collect();
            back.reverse();
            steps.extend(back);
        }
    }
    // Rounding errors of the sum must not move the end of the ramp.
    if let Some(last) = steps.last_mut() {
        last.to = ramp.end_point();
    }
    Ramp { start: ramp.start, steps }
}

/// Makes the ramp no steeper than the limit (`rounding` as in [`is_shallow_enough`]) by more passes, or for a
/// helix by more turns. Returns the ramp and its number of passes. Where more turns leave the region, a
/// helix, too, gets passes over its own path.
///
/// # Errors
/// Returns [`TooManyPasses`].
pub fn add_passes_or_turns(
    ramp: &Ramp,
    limits: &RampLimits,
    rounding: f64,
    region: &ToolRegion,
) -> Result<(Ramp, usize), TooManyPasses> {
    let fits = |ramp: &Ramp| is_shallow_enough(ramp, limits, rounding);
    if fits(ramp) {
        return Ok((ramp.clone(), 1));
    }
    // Ends that are slightly off their circle, or off each other, make some step shorter than in the first
    // pass. Then one more turn is needed.
    if let RampKind::Helix(helix) = RampKind::classify_ramp(ramp) {
        let more = count_added_turns(ramp, &helix, limits)?;
        let found = [more, more + 1].map(|more| (add_turns(ramp, &helix, more), 1 + more));
        if let Some(found) =
            found.into_iter().find(|(turned, _)| fits(turned) && region.contains_path(&turned.path_across()))
        {
            return Ok(found);
        }
    }
    let closed = ramp.is_closed();
    let least = count_passes(ramp.steepest_slope(), limits.steepest, closed)?;
    let found = repeat_in_passes(ramp, least);
    if fits(&found) {
        return Ok((found, least));
    }
    // An open ramp only ends at Pn after an odd number of passes, so it gets two more.
    let more = least + if closed { 1 } else { 2 };
    Ok((repeat_in_passes(ramp, more), more))
}

/// Returns how many whole turns a helix needs in addition.
fn count_added_turns(ramp: &Ramp, helix: &Helix, limits: &RampLimits) -> Result<usize, TooManyPasses> {
    // A chord of sweep 2h is shorter than its arc by sin(h) / h, and so it is steeper.
    let half = helix.widest_step / 2.0;
    let chords = if helix.arcs || half <= 0.0 { 1.0 } else { half.sin() / half };
    // The slope of a helix is height / (radius * sweep), so the limit of the slope gives the least sweep.
    let needed = ramp.height_mm() / (helix.radius * chords * limits.steepest);
    let more = ((needed - helix.sweep.abs()) / TAU - SLACK).ceil().max(0.0);
    let turns = helix.sweep.abs() / TAU + more;
    if turns <= MOST_PASSES as f64 { Ok(more as usize) } else { Err(TooManyPasses(turns)) }
}

/// Adds whole turns to a helix. Each is a layer of its own, and the ends stay.
fn add_turns(ramp: &Ramp, helix: &Helix, more: usize) -> Ramp {
    let longer = Helix { sweep: helix.sweep + TAU * more as f64 * helix.sweep.signum(), ..*helix };
    let descent = ramp.descending_steps();
    let mut steps: Vec<RampStep> = ramp.steps.iter().take(descent.start).copied().collect();
    steps.extend(build_helix_steps(
        &longer,
        ramp.point_before_step(descent.start),
        ramp.point_before_step(descent.end),
    ));
    steps.extend(ramp.steps.iter().skip(descent.end));
    Ramp { start: ramp.start, steps }
}

/// Returns the steps of a helix from `start` down to `end`, none of them wider than its widest step. Both
/// points lie on its circle.
pub fn build_helix_steps(helix: &Helix, start: Point3<f64>, end: Point3<f64>) -> Vec<RampStep> {
    let count = (helix.sweep.abs() / helix.widest_step - 1e-6).ceil().max(1.0) as usize;
    let spoke = start.xy() - helix.centre;
    let fraction = |index: usize| index as f64 / count as f64;
    let point = |index: usize| {
        if index == count {
            return end;
        }
        let at = helix.centre + Rotation2::new(helix.sweep * fraction(index)) * spoke;
        Point3::new(at.x, at.y, start.z + (end.z - start.z) * fraction(index))
    };
    let bend = helix.arcs.then_some(RampArc { centre: helix.centre, sweep: helix.sweep / count as f64 });
    (1..=count).map(|index| RampStep { to: point(index), bend }).collect()
}

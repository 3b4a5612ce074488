//! Shallower ramps: equal-ratio compression, then more layers (Zhou 2020, "ramp angle correction").

use super::kind::{Helix, Kind};
use super::limits::{Limits, shallow_enough};
use super::ramp::{Bend, Ramp, Step};
use super::region::Region;
use nalgebra::{Point3, Rotation2};
use std::f64::consts::TAU;

/// More passes than this are no correction but another operation.
pub const MOST_PASSES: usize = 1000;

/// Rounding up takes this little for nothing, so that a ramp on the limit gets no pass too many.
const SLACK: f64 = 1e-9;

/// A ramp would need this many passes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TooMany(pub f64);

/// The ramp with its heights above the end multiplied by `ratio` (nu): `z' = z_n + nu (z - z_n)`.
pub fn compressed(ramp: &Ramp, ratio: f64) -> Ramp {
    let end = ramp.end().z;
    let lower = |point: Point3<f64>| Point3::new(point.x, point.y, end + ratio * (point.z - end));
    let steps = ramp.steps.iter().map(|step| Step { to: lower(step.to), ..*step }).collect();
    Ramp { start: lower(ramp.start), steps }
}

/// How many passes keep the limit: `1 + w` around a closed ramp, `1 + 2 w` to and fro over an open one.
///
/// # Errors
/// [`TooMany`] above [`MOST_PASSES`], and for a ramp that goes straight down.
pub fn passes(steepest: f64, limit: f64, closed: bool) -> Result<usize, TooMany> {
    let ratio = limit / steepest;
    if ratio >= 1.0 - SLACK {
        return Ok(1);
    }
    let step = if closed { ratio } else { 2.0 * ratio };
    let more = ((1.0 - ratio) / step - SLACK).ceil();
    let passes = 1.0 + if closed { more } else { 2.0 * more };
    if passes <= MOST_PASSES as f64 { Ok(passes as usize) } else { Err(TooMany(passes)) }
}

/// The ramp in passes (at least one) that share its height: around again where it is closed, forward, back and forward where it is
/// open.
pub fn layered(ramp: &Ramp, passes: usize) -> Ramp {
    let passes = passes.max(1);
    let (closed, height, top) = (ramp.is_closed(), ramp.height(), ramp.start.z);
    let fallen = |z: f64| if height > 0.0 { (top - z) / height } else { 0.0 };
    let count = passes as f64;
    let mut steps = Vec::with_capacity(ramp.steps.len() * passes);
    for pass in 0..passes {
        let at = |share: f64| top - height * (pass as f64 + share) / count;
        if pass % 2 == 0 || closed {
            steps.extend(ramp.steps.iter().map(|step| {
                let to = Point3::new(step.to.x, step.to.y, at(fallen(step.to.z)));
                Step { to, bend: step.bend }
            }));
        } else {
            let back = ramp.walk().map(|(from, step)| {
                let to = Point3::new(from.x, from.y, at(1.0 - fallen(from.z)));
                Step { to, bend: step.bend.map(|bend| Bend { sweep: -bend.sweep, ..bend }) }
            });
            let mut back: Vec<Step> = back.collect();
            back.reverse();
            steps.extend(back);
        }
    }
    // The sum of the passes is the whole, to the bit.
    if let Some(last) = steps.last_mut() {
        last.to = ramp.end();
    }
    Ramp { start: ramp.start, steps }
}

/// The ramp no steeper than the limit (`rounding` as in [`shallow_enough`]), by more passes or, of a helix, more turns; and how many
/// passes it has. Where more turns leave the region, a helix too gets passes over its own path.
///
/// # Errors
/// [`TooMany`].
pub fn shallow(
    ramp: &Ramp,
    limits: &Limits,
    rounding: f64,
    region: &Region,
) -> Result<(Ramp, usize), TooMany> {
    let fits = |ramp: &Ramp| shallow_enough(ramp, limits, rounding);
    if fits(ramp) {
        return Ok((ramp.clone(), 1));
    }
    // Ends that are a little off their circle, or off one another, make some step shorter than in the first pass: then one more.
    if let Kind::Helix(helix) = Kind::of(ramp) {
        let more = turns(ramp, &helix, limits)?;
        let found = [more, more + 1].map(|more| (turned(ramp, &helix, more), 1 + more));
        if let Some(found) =
            found.into_iter().find(|(turned, _)| fits(turned) && region.holds(&turned.path()))
        {
            return Ok(found);
        }
    }
    let closed = ramp.is_closed();
    let least = passes(ramp.steepest(), limits.steepest, closed)?;
    let found = layered(ramp, least);
    if fits(&found) {
        return Ok((found, least));
    }
    let more = least + if closed { 1 } else { 2 };
    Ok((layered(ramp, more), more))
}

/// How many whole turns more a helix needs.
fn turns(ramp: &Ramp, helix: &Helix, limits: &Limits) -> Result<usize, TooMany> {
    // Chords are shorter than their arcs, hence steeper.
    let half = helix.widest_step / 2.0;
    let chords = if helix.arcs || half <= 0.0 { 1.0 } else { half.sin() / half };
    let needed = ramp.height() / (helix.radius * chords * limits.steepest);
    let more = ((needed - helix.sweep.abs()) / TAU - SLACK).ceil().max(0.0);
    let turns = helix.sweep.abs() / TAU + more;
    if turns <= MOST_PASSES as f64 { Ok(more as usize) } else { Err(TooMany(turns)) }
}

/// A helix with whole turns more: each is a layer of its own, and its ends stay where they are.
fn turned(ramp: &Ramp, helix: &Helix, more: usize) -> Ramp {
    let longer = Helix { sweep: helix.sweep + TAU * more as f64 * helix.sweep.signum(), ..*helix };
    let descent = ramp.descent();
    let mut steps: Vec<Step> = ramp.steps.iter().take(descent.start).copied().collect();
    steps.extend(around(&longer, ramp.point(descent.start), ramp.point(descent.end)));
    steps.extend(ramp.steps.iter().skip(descent.end));
    Ramp { start: ramp.start, steps }
}

/// The steps of a helix from `start` down to `end`, none wider than its widest step; both lie on its circle.
pub fn around(helix: &Helix, start: Point3<f64>, end: Point3<f64>) -> Vec<Step> {
    let count = (helix.sweep.abs() / helix.widest_step - 1e-6).ceil().max(1.0) as usize;
    let spoke = start.xy() - helix.centre;
    let share = |index: usize| index as f64 / count as f64;
    let point = |index: usize| {
        if index == count {
            return end;
        }
        let at = helix.centre + Rotation2::new(helix.sweep * share(index)) * spoke;
        Point3::new(at.x, at.y, start.z + (end.z - start.z) * share(index))
    };
    let bend = helix.arcs.then_some(Bend { centre: helix.centre, sweep: helix.sweep / count as f64 });
    (1..=count).map(|index| Step { to: point(index), bend }).collect()
}

//! Whether the corrected ramps read back as they were meant, and keep the limits as written.

use super::find::read;
use super::limits::{Measured, keeps};
use super::ramp::Ramp;
use super::report::RampReport;
use super::step::Plan;
use super::write::Written;
use crate::program::motion::Motion;
use crate::program::{LengthUnit, Program};

/// Why a written ramp is not what was meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub(super) enum Unproven {
    #[error("the program with the new points does not read back with the motions it should have")]
    Count,
    #[error("a motion outside of the ramps does not read back as it was")]
    Outside,
    #[error("the new points do not read back where they should be")]
    Points,
    #[error("measured again, a leg is too short or too steep")]
    Limits,
    #[error("measured again, it goes up")]
    Rises,
}

/// Compares the written program with the plans and completes the reports.
///
/// # Errors
/// The plan that is to blame, and why.
pub(super) fn prove(
    program: &Program,
    before: &[Motion],
    plans: &[Plan],
    written: &[Written],
    (file, rounding): (LengthUnit, f64),
    reports: &mut [RampReport],
) -> Result<(), (usize, Unproven)> {
    let mm = file.in_mm();
    let after: Vec<Motion> = program.motions().collect();
    let (mut old, mut new) = (0, 0);
    for (index, (plan, written)) in plans.iter().zip(written).enumerate() {
        let fault = |why: Unproven| (index, why);
        let range = &plan.found.motions;
        let gap = range.start.checked_sub(old).ok_or(fault(Unproven::Count))?;
        // The motion before a ramp may end lower than it did.
        let same = gap - usize::from(written.lowered && gap > 0);
        same_motions(before, after.as_slice(), (old, new), same).map_err(fault)?;
        let start = new + gap + usize::from(written.lead);
        let end = start + written.ramp.steps.len();
        let motions = after.get(start..end).ok_or(fault(Unproven::Count))?;
        let ramp = read(motions, &plan.found.frame, mm).ok_or(fault(Unproven::Points))?;
        check(&ramp, written, plan, rounding).map_err(fault)?;
        let (first, last) = (before.get(range.start), before.get(range.end.saturating_sub(1)));
        // The slowest feed is the last one, or the only one.
        let alike = motions.iter().all(|motion| {
            last.is_some_and(|last| {
                (motion.rapid, motion.operation, motion.feed) == (false, last.operation, last.feed)
            })
        });
        if !alike {
            return Err(fault(Unproven::Points));
        }
        if let Some(report) = reports.get_mut(plan.report) {
            complete(report, &ramp, plan, first, file);
        }
        (old, new) = (range.end, end);
    }
    let rest = before.len().saturating_sub(old);
    let last = plans.len().saturating_sub(1);
    same_motions(before, &after, (old, new), rest).map_err(|why| (last, why))?;
    if after.len() == new + rest { Ok(()) } else { Err((last, Unproven::Count)) }
}

fn same_motions(
    before: &[Motion],
    after: &[Motion],
    (old, new): (usize, usize),
    count: usize,
) -> Result<(), Unproven> {
    let one = before.get(old..old + count).ok_or(Unproven::Count)?;
    let other = after.get(new..new + count).ok_or(Unproven::Count)?;
    let same = |(one, other): (&Motion, &Motion)| {
        one.to == other.to
            && one.path == other.path
            && one.feed == other.feed
            && one.rapid == other.rapid
            && one.class == other.class
            && one.operation == other.operation
            && one.tool == other.tool
    };
    if one.iter().zip(other).all(same) { Ok(()) } else { Err(Unproven::Outside) }
}

fn check(ramp: &Ramp, written: &Written, plan: &Plan, rounding: f64) -> Result<(), Unproven> {
    let near = ramp.points().zip(written.ramp.points()).all(|(one, other)| (one - other).amax() <= rounding);
    let bends = ramp.steps.iter().zip(&written.ramp.steps).all(|(one, other)| match (one.bend, other.bend) {
        (None, None) => true,
        (Some(one), Some(other)) => {
            (one.centre - other.centre).amax() <= rounding && (one.sweep - other.sweep).abs() <= 1e-2
        }
        _ => false,
    });
    if !near || !bends || ramp.end() != plan.found.ramp.end() {
        return Err(Unproven::Points);
    }
    if ramp.walk().any(|(from, step)| step.to.z > from.z + 1e-9) {
        return Err(Unproven::Rises);
    }
    if keeps(ramp, &plan.limits, rounding) { Ok(()) } else { Err(Unproven::Limits) }
}

fn complete(report: &mut RampReport, ramp: &Ramp, plan: &Plan, first: Option<&Motion>, file: LengthUnit) {
    let after = Measured::of(ramp);
    let lead = plan.found.ramp.start.z - ramp.start.z;
    report.added_mm = after.length_mm + lead - report.before.length_mm;
    let feed = first.and_then(|motion| motion.feed?.mm_per_minute(file, motion.spindle_rpm(), None));
    report.added_seconds = feed.filter(|feed| *feed > 0.0).map(|feed| report.added_mm / feed * 60.0);
    report.after = Some(after);
    report.path_after = drawn(ramp);
    if lead > 0.0 {
        let top = plan.found.ramp.start;
        report.path_after.insert(0, top.coords.into());
    }
}

/// A ramp as points to draw, arcs in steps.
pub(super) fn drawn(ramp: &Ramp) -> Vec<[f64; 3]> {
    let mut points = vec![ramp.start.coords.into()];
    for (from, step) in ramp.walk() {
        let samples = step.samples(from);
        let count = samples.len() as f64;
        points.extend(samples.iter().enumerate().map(|(index, at)| {
            let share = (index + 1) as f64 / count;
            [at.x, at.y, from.z + (step.to.z - from.z) * share]
        }));
    }
    points
}

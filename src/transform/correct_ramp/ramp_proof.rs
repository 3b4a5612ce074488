//! This module checks that the corrected ramps read back as planned, and that they keep the limits as
//! written.

use super::planned_ramp::PlannedRamp;
use super::ramp::Ramp;
use super::ramp_correction::LengtheningMethod;
use super::ramp_limits::{RampMeasurement, is_within_limits};
use super::ramp_pillar::{PillarSearch, find_pillar};
use super::ramp_search::read_ramp;
use super::ramp_writer::WrittenRamp;
use super::report::{RampPillar, RampReport};
use crate::program::motion::Motion;
use crate::program::{LengthUnit, Program};

/// The reason why a written ramp is not as planned.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub(super) enum RampProofError {
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
    #[error(
        "cut out of a block, it leaves a pillar under the middle of the cutter that the inserts do not clear"
    )]
    Pillar,
}

/// Compares the written program with the plans and completes the reports.
///
/// # Errors
/// Returns the plan that does not fit, and the reason.
pub(super) fn prove_ramps(
    program: &Program,
    before: &[Motion],
    plans: &[PlannedRamp],
    written: &[WrittenRamp],
    (file, rounding): (LengthUnit, f64),
    reports: &mut [RampReport],
) -> Result<(), (usize, RampProofError)> {
    let mm_per_unit = file.mm_per_unit();
    let after: Vec<Motion> = program.motions().collect();
    let (mut old, mut new) = (0, 0);
    for (index, (plan, written)) in plans.iter().zip(written).enumerate() {
        let fault = |why: RampProofError| (index, why);
        let range = &plan.found.motions;
        let gap = range.start.checked_sub(old).ok_or(fault(RampProofError::Count))?;
        // The motion before a ramp may end lower than before, so it is not compared.
        let same = gap - usize::from(written.lowered && gap > 0);
        check_same_motions(before, after.as_slice(), (old, new), same).map_err(fault)?;
        let start = new + gap + usize::from(written.lead);
        let end = start + written.ramp.steps.len();
        let motions = after.get(start..end).ok_or(fault(RampProofError::Count))?;
        let ramp = read_ramp(motions, &plan.found.frame, mm_per_unit).ok_or(fault(RampProofError::Points))?;
        check_ramp(&ramp, written, plan, rounding).map_err(fault)?;
        let (first, last) = (before.get(range.start), before.get(range.end.saturating_sub(1)));
        // The slowest feed is the last one, or the only one.
        let alike = motions.iter().all(|motion| {
            last.is_some_and(|last| {
                (motion.rapid, motion.operation, motion.feed) == (false, last.operation, last.feed)
            })
        });
        if !alike {
            return Err(fault(RampProofError::Points));
        }
        // Over a hole there is nothing under the middle, whose pillars a block would have.
        let cutter =
            plan.cutter.as_ref().filter(|_| plan.corrected.lengthened != LengtheningMethod::OverHole);
        let pillar = cutter.map(|cutter| find_pillar(&ramp, cutter, PillarSearch::AtColumns));
        if matches!(pillar, Some(Some(_))) {
            return Err(fault(RampProofError::Pillar));
        }
        if let Some(report) = reports.get_mut(plan.report) {
            report.pillar_after = pillar.map(|_| RampPillar::default());
            complete_report(report, &ramp, plan, first, file);
        }
        (old, new) = (range.end, end);
    }
    let rest = before.len().saturating_sub(old);
    let last = plans.len().saturating_sub(1);
    check_same_motions(before, &after, (old, new), rest).map_err(|why| (last, why))?;
    if after.len() == new + rest { Ok(()) } else { Err((last, RampProofError::Count)) }
}

fn check_same_motions(
    before: &[Motion],
    after: &[Motion],
    (old, new): (usize, usize),
    count: usize,
) -> Result<(), RampProofError> {
    let one = before.get(old..old + count).ok_or(RampProofError::Count)?;
    let other = after.get(new..new + count).ok_or(RampProofError::Count)?;
    let same = |(one, other): (&Motion, &Motion)| {
        one.to == other.to
            && one.path == other.path
            && one.feed == other.feed
            && one.rapid == other.rapid
            && one.class == other.class
            && one.operation == other.operation
            && one.tool == other.tool
    };
    if one.iter().zip(other).all(same) { Ok(()) } else { Err(RampProofError::Outside) }
}

fn check_ramp(
    ramp: &Ramp,
    written: &WrittenRamp,
    plan: &PlannedRamp,
    rounding: f64,
) -> Result<(), RampProofError> {
    let near = ramp.points().zip(written.ramp.points()).all(|(one, other)| (one - other).amax() <= rounding);
    let bends = ramp.steps.iter().zip(&written.ramp.steps).all(|(one, other)| match (one.bend, other.bend) {
        (None, None) => true,
        (Some(one), Some(other)) => {
            (one.centre - other.centre).amax() <= rounding && (one.sweep - other.sweep).abs() <= 1e-2
        }
        _ => false,
    });
    // Pn is compared exactly, because everything behind the ramp starts from it and must not change.
    if !near || !bends || ramp.end_point() != plan.found.ramp.end_point() {
        return Err(RampProofError::Points);
    }
    if ramp.steps_with_starts().any(|(from, step)| step.to.z > from.z + 1e-9) {
        return Err(RampProofError::Rises);
    }
    let over_hole = plan.corrected.lengthened == LengtheningMethod::OverHole;
    if over_hole || is_within_limits(ramp, &plan.limits, rounding) {
        Ok(())
    } else {
        Err(RampProofError::Limits)
    }
}

fn complete_report(
    report: &mut RampReport,
    ramp: &Ramp,
    plan: &PlannedRamp,
    first: Option<&Motion>,
    file: LengthUnit,
) {
    let after = RampMeasurement::measure_ramp(ramp);
    let lead = plan.found.ramp.start.z - ramp.start.z;
    report.added_mm = after.length_mm + lead - report.before.length_mm;
    let feed = first.and_then(|motion| motion.feed?.mm_per_minute(file, motion.spindle_rpm(), None));
    report.added_seconds = feed.filter(|feed| *feed > 0.0).map(|feed| report.added_mm / feed * 60.0);
    report.after = Some(after);
    report.path_after = to_drawing_points(ramp);
    if lead > 0.0 {
        let top = plan.found.ramp.start;
        report.path_after.insert(0, top.coords.into());
    }
}

/// Returns a ramp as points for a drawing, with sampled arcs.
pub(super) fn to_drawing_points(ramp: &Ramp) -> Vec<[f64; 3]> {
    let mut points = vec![ramp.start.coords.into()];
    for (from, step) in ramp.steps_with_starts() {
        let samples = step.sample_points_across(from);
        let count = samples.len() as f64;
        points.extend(samples.iter().enumerate().map(|(index, at)| {
            let share = (index + 1) as f64 / count;
            [at.x, at.y, from.z + (step.to.z - from.z) * share]
        }));
    }
    points
}

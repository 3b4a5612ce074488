//! Targets that look like a slip of units: they are compared with the tools and with what the program does.

use super::limit::FeedGoals;
use super::measure::{LoadCriterion, MeasuredBlocks};
use crate::diagnostic::{Diagnostic, codes};
use crate::presentation::display_units::{ColumnUnit, DisplayUnits};
use crate::simulation_run::Tooling;
use crate::transform::StepContext;

/// A target that is so many times what the program does, or so small a part of it, is unusual.
const DISTANT: f64 = 20.0;

/// A target that is so small a part of what the program does is a slip of units.
const ABSURD: f64 = 500.0;

/// A target is reached where a load comes so near to it: feeds are rounded down, and small changes are left
/// out.
const NEAR: f64 = 0.8;

/// Reports a chip thickness that is above the radius of every tool: no tooth can take it.
pub(super) fn warn_of_thick_target(goals: &FeedGoals, tooling: &Tooling, context: &mut StepContext<'_>) {
    let radius = tooling.cutters().iter().map(|cutter| cutter.profile.radius_mm()).fold(0.0, f64::max);
    let thick = goals
        .limits
        .iter()
        .find(|(criterion, limit)| *criterion == LoadCriterion::ChipThickness && *limit > radius);
    if let Some((_, limit)) = thick.filter(|_| radius > 0.0) {
        let units = DisplayUnits::from_mm(context.units);
        let [limit, radius] = [*limit, radius].map(|mm| units.tell_trimmed(ColumnUnit::Length, mm, 4));
        let message =
            format!("the target is a chip of {limit}, and the largest tool has a radius of {radius}");
        let found =
            context.step_finding(codes::ABSURD_VALUE, message, &["target"], "thicker than the tool's radius");
        context.findings.push(found);
    }
}

/// Reports targets that are far from what the program does at its programmed feeds.
pub(super) fn warn_of_distant_targets(
    goals: &FeedGoals,
    before: &MeasuredBlocks,
    context: &mut StepContext<'_>,
) {
    for (index, (criterion, limit)) in goals.limits.iter().enumerate() {
        let largest = largest_load(before, index);
        if largest <= 0.0 || (limit / DISTANT..=limit * DISTANT).contains(&largest) {
            continue;
        }
        let (name, units) = (criterion.display_name(), DisplayUnits::from_mm(context.units));
        let message = format!(
            "the largest {name} of the program is {} today, and the target is {}",
            units.tell_fixed(criterion.column_unit(), largest, 4),
            units.tell_trimmed(criterion.column_unit(), *limit, 4)
        );
        // A limit far above all loads limits nothing, and may be written for the programs to come.
        let is_absurd = largest > limit * ABSURD;
        let found =
            Diagnostic::new(if is_absurd { codes::ABSURD_VALUE } else { codes::UNUSUAL_VALUE }, message);
        let key = if index == 0 { "target" } else { "limits" };
        context.findings.push(context.label_parameter(found, &[key], "a slip of units?"));
    }
}

/// Reports that no load of the corrected program comes near to any target.
pub(super) fn warn_of_unreached_targets(
    goals: &FeedGoals,
    after: &MeasuredBlocks,
    context: &mut StepContext<'_>,
) {
    let units = DisplayUnits::from_mm(context.units);
    let loads = goals.limits.iter().enumerate().map(|(index, (criterion, limit))| {
        let largest = largest_load(after, index);
        (
            largest / limit,
            format!(
                "the largest {} is {} of {}",
                criterion.display_name(),
                units.tell_fixed(criterion.column_unit(), largest, 4),
                units.tell_trimmed(criterion.column_unit(), *limit, 4)
            ),
        )
    });
    let nearest = loads.max_by(|(one, _), (other, _)| one.total_cmp(other));
    if let Some((_, said)) = nearest.filter(|(reached, _)| *reached < NEAR) {
        let message = format!("no motion comes near to a target: {said}");
        let found = context.step_finding(codes::TARGET_NOT_REACHED, message, &["target"], "decides nothing");
        context.findings.push(found);
    }
}

/// Returns the largest estimate of a load over all cuts; `index` is that of its limit.
fn largest_load(blocks: &MeasuredBlocks, index: usize) -> f64 {
    let cuts = blocks.measurements.iter().filter(|measurement| measurement.cuts);
    let loads = cuts.filter_map(|measurement| measurement.measured.get(index));
    loads.map(|[estimate, _]| *estimate).filter(|load| load.is_finite()).fold(0.0, f64::max)
}

//! Slips that a person makes with units and decimal points, found before they reach a machine: factors,
//! targets and feeds that are far from anything that is milled.
//!
//! What is unusual is a warning; what no machine does is an error, which `--allow` passes.

use super::StepContext;
use crate::diagnostic::{Diagnostic, codes};
use crate::number::format_significant_number;
use crate::presentation::display_units::{ColumnUnit, DisplayUnits};
use crate::program::{LengthUnit, Program, StatementId};
use crate::setup::Setup;
use std::collections::BTreeMap;
use std::ops::RangeInclusive;

/// Factors outside are unusual: nobody makes a program twenty times slower or ten times faster on purpose.
const USUAL_FACTORS: RangeInclusive<f64> = 0.05..=10.0;

/// Factors outside are absurd: a percentage that was not divided by 100 mostly is.
const POSSIBLE_FACTORS: RangeInclusive<f64> = 0.01..=50.0;

/// A feed that is so many times the machine's highest is a slip of units (25.4) or of a decimal point, no
/// request.
const ABSURD_FEED: f64 = 20.0;

/// Reports a factor that looks like a slip. `keys` lead to it in the step.
pub(super) fn check_factor(factor: f64, keys: &[&str], context: &mut StepContext<'_>) {
    if USUAL_FACTORS.contains(&factor) {
        return;
    }
    let message = format!("the factor {factor} is outside 0.05 to 10");
    let code = if POSSIBLE_FACTORS.contains(&factor) { codes::UNUSUAL_VALUE } else { codes::ABSURD_VALUE };
    let found = context.step_finding(code, message, keys, "a slip of the decimal point?");
    let help = "0.8 means 80 %: a percentage is divided by 100.";
    context.findings.push(found.with_help(help));
}

/// Reports a step that changes every value it selects so much that it looks like a slip. `mildest` is the factor of the
/// value that changes least, and `keys` lead to the cause in the step.
pub(super) fn check_mildest_factor(
    mildest: Option<f64>,
    what: &str,
    keys: &[&str],
    context: &mut StepContext<'_>,
) {
    let Some(factor) = mildest.filter(|factor| !USUAL_FACTORS.contains(factor)) else { return };
    let change = match factor < 1.0 {
        true => format!("divides every {what} by {} or more", format_significant_number(1.0 / factor, 3, 6)),
        false => format!("multiplies every {what} by {} or more", format_significant_number(factor, 3, 6)),
    };
    let code = if POSSIBLE_FACTORS.contains(&factor) { codes::UNUSUAL_VALUE } else { codes::ABSURD_VALUE };
    let found = context.step_finding(
        code,
        format!("this {change}"),
        keys,
        "a slip of units or of the decimal point?",
    );
    context.findings.push(found);
}

/// Returns the one of two factors that changes less.
pub(super) fn choose_milder_factor(one: Option<f64>, other: f64) -> Option<f64> {
    let strength = |factor: f64| factor.ln().abs();
    match one {
        Some(one) if strength(one) <= strength(other) => Some(one),
        _ => Some(other),
    }
}

/// Coordinates further apart than this, in mm, are on no usual machine: 10 m.
const LARGEST_MACHINE_MM: f64 = 1e4;

/// Coordinates further apart than this, in mm, are on no machine: 1 km.
const LARGEST_PLACE_MM: f64 = 1e6;

/// Reports a displacement that leaves every machine. `mm` is its largest part in mm, and `keys` lead to it in the step.
pub(super) fn check_displacement(mm: f64, keys: &[&str], context: &mut StepContext<'_>) {
    if mm.abs() <= LARGEST_MACHINE_MM {
        return;
    }
    let code = if mm.abs() > LARGEST_PLACE_MM { codes::ABSURD_VALUE } else { codes::UNUSUAL_VALUE };
    let message =
        format!("{} m is more than a machine travels", format_significant_number(mm.abs() / 1e3, 3, 3));
    let found = context.step_finding(code, message, keys, "a slip of units?");
    let help = format!("Lengths of this recipe are in {}.", context.units);
    context.findings.push(found.with_help(help));
}

/// Spindle speeds above are on no usual mill, in rev/min.
const USUAL_SPEED_RPM: f64 = 100_000.0;

/// Spindle speeds above are on no mill, in rev/min.
const POSSIBLE_SPEED_RPM: f64 = 400_000.0;

/// Reports a spindle speed in rev/min that no mill has.
pub(super) fn check_speed(rpm: f64, keys: &[&str], context: &mut StepContext<'_>) {
    if rpm <= USUAL_SPEED_RPM {
        return;
    }
    let code = if rpm > POSSIBLE_SPEED_RPM { codes::ABSURD_VALUE } else { codes::UNUSUAL_VALUE };
    let message = format!("{rpm} rev/min is more than a mill turns");
    let found = context.step_finding(code, message, keys, "a slip of the decimal point?");
    context.findings.push(found);
}

/// Finds the feeds of a program that are above the machine's `max_feed`, one finding for each statement that
/// sets one.
pub fn find_feeds_above_machine(program: &Program, setup: &Setup, unit: LengthUnit) -> Vec<Diagnostic> {
    let Some(most) = setup.machine.max_feed.map(|feed| feed.get()) else { return Vec::new() };
    let mut highest: BTreeMap<StatementId, f64> = BTreeMap::new();
    let feeds_above = program.motions().filter(|motion| !motion.rapid).filter_map(|motion| {
        let length = Some(motion.length());
        let actual = motion.feed?.mm_per_minute(unit, motion.spindle_rpm(), length)?;
        // What arithmetic makes of the limit itself is not above it.
        (actual > most * (1.0 + 1e-6)).then_some((motion.feed_from?, actual))
    });
    for (statement, actual) in feeds_above {
        let known = highest.entry(statement).or_insert(actual);
        *known = known.max(actual);
    }
    let units = DisplayUnits::from_mm(unit);
    let describe = |(statement, actual): (StatementId, f64)| {
        let code = if actual > ABSURD_FEED * most { codes::ABSURD_VALUE } else { codes::FEED_ABOVE_MACHINE };
        let [told, most] = [actual, most].map(|feed| units.tell_fixed(ColumnUnit::FeedPerMinute, feed, 0));
        let message = format!("this feed is {told}; the machine's `max_feed` is {most}");
        let span = program.statement(statement).origin();
        let found =
            Diagnostic::new(code, message).with_label(program.source(), span, "above what the machine does");
        let help = "Put `clamp_feed: {}` behind the other steps, or correct `machine: { max_feed: ... }` in the setup.";
        found.with_help(help).with_magnitude(actual)
    };
    highest.into_iter().map(describe).collect()
}

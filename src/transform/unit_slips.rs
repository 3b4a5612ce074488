//! Slips that a person makes with units and decimal points, found before they reach a machine: factors,
//! targets and feeds that are far from anything that is milled.
//!
//! What is unusual is a warning; what no machine does is an error, which `--allow` passes.

use super::StepContext;
use crate::diagnostic::{Diagnostic, codes};
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
    let describe = |(statement, actual): (StatementId, f64)| {
        let code = if actual > ABSURD_FEED * most { codes::ABSURD_VALUE } else { codes::FEED_ABOVE_MACHINE };
        let message = format!("this feed is {actual:.0} mm/min; the machine's `max_feed` is {most:.0}");
        let span = program.statement(statement).origin();
        let found =
            Diagnostic::new(code, message).with_label(program.source(), span, "above what the machine does");
        let help = "Put `clamp_feed: {}` behind the other steps, or correct `machine: { max_feed: ... }` in the setup.";
        found.with_help(help).with_magnitude(actual)
    };
    highest.into_iter().map(describe).collect()
}

//! This module simulates a corrected program before it may be written, so that what it would do to the machine stops
//! the run, whichever outputs were asked for.

use crate::diagnostic::{Diagnostic, DiagnosticCode, Failure, codes};
use crate::program::Program;
use crate::report::simulation::SimulationAttempt;
use crate::report::stats::ResolvedLengthUnit;
use crate::setup::Setup;
use crate::simulation_run::{RunWatcher, SimulationRunOptions};
use crate::source::Span;
use crate::transform::Recipe;
use std::collections::BTreeSet;

/// Simulates a program in the stock of its setup. Returns `None` where the setup has none, or the recipe asks for no
/// simulation.
///
/// # Errors
/// Returns [`Failure::Interrupted`] if `watch` has stopped it.
pub(super) fn simulate_result(
    program: &Program,
    recipe: &Recipe,
    setup: &Setup,
    watch: &dyn RunWatcher,
) -> Result<Option<SimulationAttempt>, Failure> {
    if !recipe.simulate || setup.stock.is_none() {
        return Ok(None);
    }
    let units = ResolvedLengthUnit::from_program(program, Some(recipe.units)).unit;
    let options = SimulationRunOptions::default();
    SimulationAttempt::simulate_program(program, setup, units, &options, watch).map(Some)
}

/// Returns what a simulation adds to the findings of a run. A fault that a step has found at the same place is not
/// found again; a simulation that could not be made is a warning.
pub(super) fn find_in_simulation(attempt: &SimulationAttempt, known: &[Diagnostic]) -> Vec<Diagnostic> {
    match &attempt.outcome {
        Ok(report) => {
            let known: BTreeSet<_> = known.iter().filter_map(place_of_finding).collect();
            let is_known =
                |found: &Diagnostic| place_of_finding(found).is_some_and(|place| known.contains(&place));
            report.findings.iter().filter(|found| !is_known(found)).cloned().collect()
        }
        Err(missing) => vec![report_not_simulated(missing)],
    }
}

/// Returns what a finding is known by: its code, its file and its place there.
fn place_of_finding(found: &Diagnostic) -> Option<(DiagnosticCode, &str, Span)> {
    let label = found.labels.first()?;
    Some((found.code, label.source.name(), label.span))
}

fn report_not_simulated(missing: &[Diagnostic]) -> Diagnostic {
    let first = missing.first().map_or("", |reason| reason.message.as_str());
    let more = match missing.len() {
        0 | 1 => String::new(),
        count => format!(" (and {} more)", count - 1),
    };
    let message = format!("the corrected program was not simulated: {first}{more}");
    let mut finding = Diagnostic::new(codes::RESULT_NOT_SIMULATED, message);
    if let Some(reason) = missing.first() {
        finding.labels.clone_from(&reason.labels);
    }
    finding
}

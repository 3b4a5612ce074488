//! This module makes the simulations of a comparison, as far as that is possible.

use super::ComparisonSubject;
use crate::diagnostic::{Diagnostic, Failure};
use crate::program::{Program, StatementChange};
use crate::report::simulation::{SimulationAttempt, SimulationReport};
use crate::simulation_run::{KnownShares, RunWatcher, SimulationRunOptions};

/// Simulations, and the reasons why some are missing.
#[derive(Debug, Default)]
pub struct ComparisonRuns {
    /// The simulation of the program before.
    pub before: Option<SimulationReport>,
    /// The simulation of the current program.
    pub after: Option<SimulationReport>,
    /// The reasons why simulations are missing, in one sentence each.
    pub missing: Vec<String>,
    /// The assumptions of the simulations, in sentences.
    pub assumptions: Vec<String>,
}

impl ComparisonRuns {
    /// Simulates both programs of a subject. If one cannot be simulated, the reasons are in `missing`,
    /// because a report must not fail for that.
    /// `result` is the simulation of the current program if it exists already.
    ///
    /// # Errors
    /// Returns [`Failure::Interrupted`] if `watch` stopped the run, and no other failure.
    pub fn simulate_subject(
        subject: &ComparisonSubject<'_>,
        result: Option<SimulationAttempt>,
        options: &SimulationRunOptions,
        watch: &dyn RunWatcher,
    ) -> Result<Self, Failure> {
        let mut runs = Self::default();
        if subject.recipe.is_some_and(|recipe| !recipe.simulate) {
            runs.missing.push("the recipe says `simulate: false`, so nothing was simulated".to_owned());
            return Ok(runs);
        }
        let mut result = match result {
            Some(result) => result,
            None => try_simulation(subject, subject.program, options, watch)?,
        };
        let known = std::mem::take(&mut result.known);
        certify_chips(&mut result, subject, (subject.program, &known), watch)?;
        runs.assumptions.extend(result.assumptions);
        match result.outcome {
            Ok(simulated) => runs.after = Some(simulated),
            Err(found) => {
                runs.missing = distinct_messages(&found);
                return Ok(runs);
            }
        }
        let is_other = subject.other_file().is_some();
        let is_changed = is_other
            || subject
                .program
                .statements()
                .iter()
                .any(|statement| statement.change() != StatementChange::Untouched);
        if let Some(before) = subject.before.filter(|_| is_changed) {
            let mut simulated = try_simulation(subject, before, options, watch)?;
            certify_chips(&mut simulated, subject, (before, &known), watch)?;
            let before = simulated;
            runs.assumptions.extend(before.assumptions);
            match before.outcome {
                Ok(simulated) => runs.before = Some(simulated),
                Err(found) => {
                    let before =
                        distinct_messages(&found).into_iter().map(|sentence| format!("before: {sentence}"));
                    runs.missing = before.collect();
                }
            }
        }
        Ok(runs)
    }
}

fn try_simulation(
    subject: &ComparisonSubject<'_>,
    program: &Program,
    options: &SimulationRunOptions,
    watch: &dyn RunWatcher,
) -> Result<SimulationAttempt, Failure> {
    let units = subject.resolve_length_unit(program).unit;
    SimulationAttempt::simulate_program(program, subject.setup, units, options, watch)
}

fn certify_chips(
    attempt: &mut SimulationAttempt,
    subject: &ComparisonSubject<'_>,
    (program, known): (&Program, &KnownShares),
    watch: &dyn RunWatcher,
) -> Result<(), Failure> {
    let units = subject.resolve_length_unit(program).unit;
    attempt.certify_chips(program, subject.setup, units, known, watch)
}

fn distinct_messages(found: &[Diagnostic]) -> Vec<String> {
    let mut all: Vec<String> = found.iter().map(|found| found.message.clone()).collect();
    all.dedup();
    all
}

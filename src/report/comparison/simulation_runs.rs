//! This module makes the simulations of a comparison, as far as that is possible.

use super::ComparisonSubject;
use crate::diagnostic::{Diagnostic, Failure};
use crate::program::{Program, StatementChange};
use crate::report::simulation::SimulationReport;
use crate::simulation_run::{Machining, RunWatcher, SimulationRunOptions};

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
    ///
    /// # Errors
    /// Returns [`Failure::Interrupted`] if `watch` stopped the run, and no other failure.
    pub fn simulate_subject(
        subject: &ComparisonSubject<'_>,
        options: &SimulationRunOptions,
        watch: &dyn RunWatcher,
    ) -> Result<Self, Failure> {
        let mut runs = Self::default();
        match try_simulation(subject, subject.program, options, watch, &mut runs.assumptions) {
            Ok(simulated) => runs.after = Some(simulated),
            Err(Failure::Interrupted) => return Err(Failure::Interrupted),
            Err(Failure::Found(found)) => {
                runs.missing = distinct_messages(&found);
                return Ok(runs);
            }
        }
        let is_changed = subject
            .program
            .statements()
            .iter()
            .any(|statement| statement.change() != StatementChange::Untouched);
        if let Some(before) = subject.before.filter(|_| is_changed) {
            match try_simulation(subject, before, options, watch, &mut runs.assumptions) {
                Ok(simulated) => runs.before = Some(simulated),
                Err(Failure::Interrupted) => return Err(Failure::Interrupted),
                Err(Failure::Found(found)) => {
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
    assumptions: &mut Vec<String>,
) -> Result<SimulationReport, Failure> {
    let mut notes = Vec::new();
    let units = subject.resolve_length_unit(program).unit;
    let machining = Machining::new(program, subject.setup, units, &mut notes)?;
    assumptions.extend(notes.into_iter().map(|note| note.message));
    SimulationReport::simulate_program(&machining, options, watch)
}

fn distinct_messages(found: &[Diagnostic]) -> Vec<String> {
    let mut all: Vec<String> = found.iter().map(|found| found.message.clone()).collect();
    all.dedup();
    all
}

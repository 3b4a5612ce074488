//! The simulations that a comparison looks at, as far as they can be made.

use super::ComparisonSubject;
use crate::diagnostic::Diagnostic;
use crate::program::{Program, StatementChange};
use crate::report::simulation::SimulationReport;
use crate::simulation_run::{Machining, RunWatcher, SimulationRunOptions};

/// Simulations, and what stands in their way.
#[derive(Debug, Default)]
pub struct ComparisonRuns {
    /// Of the program before.
    pub before: Option<SimulationReport>,
    /// Of the program as it stands.
    pub after: Option<SimulationReport>,
    /// Why there is none: one sentence each.
    pub missing: Vec<String>,
    /// What was taken for granted.
    pub assumptions: Vec<String>,
}

impl ComparisonRuns {
    /// Simulates both programs of a subject. What cannot be simulated is said in `missing`: a report must not fail for it. `None` when
    /// `watch` stopped it.
    pub fn simulate_subject(
        subject: &ComparisonSubject<'_>,
        options: &SimulationRunOptions,
        watch: &dyn RunWatcher,
    ) -> Option<Self> {
        let mut runs = Self::default();
        match try_simulation(subject, subject.program, options, watch, &mut runs.assumptions) {
            ComparisonRunOutcome::Done(simulated) => runs.after = Some(*simulated),
            ComparisonRunOutcome::Stopped => return None,
            ComparisonRunOutcome::Impossible(found) => {
                runs.missing = distinct_messages(&found);
                return Some(runs);
            }
        }
        let is_changed = subject
            .program
            .statements()
            .iter()
            .any(|statement| statement.change() != StatementChange::Untouched);
        if let Some(before) = subject.before.filter(|_| is_changed) {
            match try_simulation(subject, before, options, watch, &mut runs.assumptions) {
                ComparisonRunOutcome::Done(simulated) => runs.before = Some(*simulated),
                ComparisonRunOutcome::Stopped => return None,
                ComparisonRunOutcome::Impossible(found) => {
                    let before =
                        distinct_messages(&found).into_iter().map(|sentence| format!("before: {sentence}"));
                    runs.missing = before.collect();
                }
            }
        }
        Some(runs)
    }
}

enum ComparisonRunOutcome {
    Done(Box<SimulationReport>),
    Stopped,
    Impossible(Vec<Diagnostic>),
}

fn try_simulation(
    subject: &ComparisonSubject<'_>,
    program: &Program,
    options: &SimulationRunOptions,
    watch: &dyn RunWatcher,
    assumptions: &mut Vec<String>,
) -> ComparisonRunOutcome {
    let mut notes = Vec::new();
    let units = subject.resolve_length_unit(program).unit;
    let machining = match Machining::new(program, subject.setup, units, &mut notes) {
        Ok(machining) => machining,
        Err(found) => return ComparisonRunOutcome::Impossible(found),
    };
    assumptions.extend(notes.into_iter().map(|note| note.message));
    match SimulationReport::simulate_program(&machining, options, watch) {
        Ok(Some(simulated)) => ComparisonRunOutcome::Done(Box::new(simulated)),
        Ok(None) => ComparisonRunOutcome::Stopped,
        Err(found) => ComparisonRunOutcome::Impossible(found),
    }
}

fn distinct_messages(found: &[Diagnostic]) -> Vec<String> {
    let mut all: Vec<String> = found.iter().map(|found| found.message.clone()).collect();
    all.dedup();
    all
}

//! The simulations that a comparison looks at, as far as they can be made.

use super::Subject;
use crate::diagnostic::Diagnostic;
use crate::machining::{Machining, Options, Watch};
use crate::program::{Change, Program};
use crate::report::simulation::Simulated;

/// Simulations, and what stands in their way.
#[derive(Debug, Default)]
pub struct Runs {
    /// Of the program before.
    pub before: Option<Simulated>,
    /// Of the program as it stands.
    pub after: Option<Simulated>,
    /// Why there is none: one sentence each.
    pub missing: Vec<String>,
    /// What was taken for granted.
    pub assumptions: Vec<String>,
}

impl Runs {
    /// Simulates both programs of a subject. What cannot be simulated is said in `missing`: a report must not fail for it. `None` when
    /// `watch` stopped it.
    pub fn of(subject: &Subject<'_>, options: &Options, watch: &dyn Watch) -> Option<Self> {
        let mut runs = Self::default();
        match run(subject, subject.program, options, watch, &mut runs.assumptions) {
            Run::Done(simulated) => runs.after = Some(*simulated),
            Run::Stopped => return None,
            Run::Impossible(found) => {
                runs.missing = sentences(&found);
                return Some(runs);
            }
        }
        let is_changed =
            subject.program.statements().iter().any(|statement| statement.change() != Change::Untouched);
        if let Some(before) = subject.before.filter(|_| is_changed) {
            match run(subject, before, options, watch, &mut runs.assumptions) {
                Run::Done(simulated) => runs.before = Some(*simulated),
                Run::Stopped => return None,
                Run::Impossible(found) => {
                    let before = sentences(&found).into_iter().map(|sentence| format!("before: {sentence}"));
                    runs.missing = before.collect();
                }
            }
        }
        Some(runs)
    }
}

enum Run {
    Done(Box<Simulated>),
    Stopped,
    Impossible(Vec<Diagnostic>),
}

fn run(
    subject: &Subject<'_>,
    program: &Program,
    options: &Options,
    watch: &dyn Watch,
    assumptions: &mut Vec<String>,
) -> Run {
    let mut notes = Vec::new();
    let units = subject.units_of(program).unit;
    let machining = match Machining::new(program, subject.setup, units, &mut notes) {
        Ok(machining) => machining,
        Err(found) => return Run::Impossible(found),
    };
    assumptions.extend(notes.into_iter().map(|note| note.message));
    match Simulated::of(&machining, options, watch) {
        Ok(Some(simulated)) => Run::Done(Box::new(simulated)),
        Ok(None) => Run::Stopped,
        Err(found) => Run::Impossible(found),
    }
}

fn sentences(found: &[Diagnostic]) -> Vec<String> {
    let mut all: Vec<String> = found.iter().map(|found| found.message.clone()).collect();
    all.dedup();
    all
}

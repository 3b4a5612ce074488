//! This module simulates a program as far as its setup allows it, and keeps the reasons where it does not.

use super::SimulationReport;
use crate::diagnostic::{Diagnostic, Failure};
use crate::program::{LengthUnit, Program};
use crate::setup::Setup;
use crate::simulation_run::{Machining, RunWatcher, SimulationRunOptions};

/// A simulation that was tried: it was made, or there are reasons why it could not be.
#[derive(Debug)]
#[non_exhaustive]
pub struct SimulationAttempt {
    /// The simulation, or what was missing for it.
    pub outcome: Result<SimulationReport, Vec<Diagnostic>>,
    /// The assumptions of the run, in sentences.
    pub assumptions: Vec<String>,
}

impl SimulationAttempt {
    /// Simulates a program whose lengths are in `units`.
    ///
    /// # Errors
    /// Returns [`Failure::Interrupted`] if `watch` has stopped it. What a simulation would need and the setup does not
    /// have is no error: it stands in [`SimulationAttempt::outcome`].
    pub fn simulate_program(
        program: &Program,
        setup: &Setup,
        units: LengthUnit,
        options: &SimulationRunOptions,
        watch: &dyn RunWatcher,
    ) -> Result<Self, Failure> {
        let mut notes = Vec::new();
        let simulated = Machining::new(program, setup, units, &mut notes)
            .and_then(|machining| SimulationReport::simulate_program(&machining, options, watch));
        match simulated {
            Ok(report) => {
                let assumptions = notes.into_iter().map(|note| note.message).collect();
                Ok(Self { outcome: Ok(report), assumptions })
            }
            Err(Failure::Interrupted) => Err(Failure::Interrupted),
            // Nothing was assumed for a simulation that was not made.
            Err(Failure::Found(found)) => Ok(Self { outcome: Err(found), assumptions: Vec::new() }),
        }
    }

    /// Returns what the simulation found; nothing if there is none.
    pub fn findings(&self) -> &[Diagnostic] {
        self.outcome.as_ref().map_or(&[], |report| &report.findings)
    }
}

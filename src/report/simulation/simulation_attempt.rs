//! This module simulates a program as far as its setup allows it, and keeps the reasons where it does not.

use super::SimulationReport;
use crate::diagnostic::{Diagnostic, Failure};
use crate::program::{LengthUnit, Program};
use crate::setup::Setup;
use crate::simulation_run::{KnownShares, Machining, RunWatcher, SimulationRunOptions};

/// A simulation that was tried: it was made, or there are reasons why it could not be.
#[derive(Debug)]
#[non_exhaustive]
pub struct SimulationAttempt {
    /// The simulation, or what was missing for it.
    pub outcome: Result<SimulationReport, Vec<Diagnostic>>,
    /// The assumptions of the run, in sentences.
    pub assumptions: Vec<String>,
    /// The shares that are known of the program, or of the one that it was made of.
    pub known: KnownShares,
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
                Ok(Self { outcome: Ok(report), assumptions, known: KnownShares::default() })
            }
            Err(Failure::Interrupted) => Err(Failure::Interrupted),
            // Nothing was assumed for a simulation that was not made.
            Err(Failure::Found(found)) => {
                Ok(Self { outcome: Err(found), assumptions: Vec::new(), known: KnownShares::default() })
            }
        }
    }

    /// Returns the attempt with shares that are known already.
    #[must_use]
    pub fn with_known_shares(mut self, known: KnownShares) -> Self {
        self.known = known;
        self
    }

    /// Replaces the chips of columns by certified ones, as [`SimulationReport::certify_chips`] does; nothing where there is
    /// no simulation. The program, the setup and the unit are those of the simulation.
    ///
    /// # Errors
    /// Returns the errors of [`SimulationReport::certify_chips`].
    pub fn certify_chips(
        &mut self,
        program: &Program,
        setup: &Setup,
        units: LengthUnit,
        known: &KnownShares,
        watch: &dyn RunWatcher,
    ) -> Result<(), Failure> {
        let Ok(report) = &mut self.outcome else { return Ok(()) };
        // The notes of this program are those of the simulation.
        let machining = Machining::new(program, setup, units, &mut Vec::new())?;
        report.certify_chips(&machining, known, watch)
    }

    /// Returns what the simulation found; nothing if there is none.
    pub fn findings(&self) -> &[Diagnostic] {
        self.outcome.as_ref().map_or(&[], |report| &report.findings)
    }
}

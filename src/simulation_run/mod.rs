//! Machining: a program, its setup and the simulation put together.
//!
//! [`Machining::new`] finds the cutter of every tool and the stock, asks for what is missing and says what it assumes;
//! [`Machining::estimate_cost`] knows what a run costs; [`Machining::simulate_program`] removes material motion by motion and hands each motion on
//! with what it engaged; [`Machining::simulate_layers`] does so in layers, with the exact chips of flat end mills.

mod cost;
mod dexel_run;
mod engagement_model;
mod faults;
pub mod layer_run;
mod setup_stock;
mod tooling;
mod watcher;

pub use cost::{SimulationBudget, SimulationCost};
pub use dexel_run::{DexelRunResult, EngagedMotion, chord_tolerance_mm};
pub use engagement_model::{EngagementModel, EngagementRunResult, StockResolution};
pub use tooling::Tooling;
pub use watcher::{RunWatcher, SilentWatcher};

use crate::diagnostic::Diagnostic;
use crate::program::{LengthUnit, Program};
use crate::setup::Setup;
use crate::sim::{Mesh, Stock};
use std::sync::Arc;

/// How a run is made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SimulationRunOptions {
    /// Distance of columns, mm; else a fortieth of the smallest cutter's diameter.
    pub cell: Option<f64>,
    /// Longest piece of a motion that is looked at on its own, mm; infinite for whole motions.
    pub longest: f64,
    /// Whether forces are asked for, which takes several times as long.
    pub forces: bool,
    /// What a run may cost.
    pub budget: SimulationBudget,
}

impl Default for SimulationRunOptions {
    fn default() -> Self {
        Self { cell: None, longest: f64::INFINITY, forces: false, budget: SimulationBudget::default() }
    }
}

/// A program ready to be machined.
#[derive(Debug)]
pub struct Machining<'p> {
    program: &'p Program,
    setup: &'p Setup,
    units: LengthUnit,
    stock: Stock,
    tooling: Tooling,
}

impl<'p> Machining<'p> {
    /// Brings program and setup together. `units` is the unit of the program's lengths. Findings that are no errors (assumptions) are
    /// added to `findings`.
    ///
    /// # Errors
    /// Everything that is missing: stock, shapes of tools.
    pub fn new(
        program: &'p Program,
        setup: &'p Setup,
        units: LengthUnit,
        findings: &mut Vec<Diagnostic>,
    ) -> Result<Self, Vec<Diagnostic>> {
        let mut errors = Vec::new();
        let tooling = Tooling::from_program(program, setup, units, findings, &mut errors);
        let stock = match setup_stock::build_stock(setup) {
            Ok(stock) => Some(stock),
            Err(found) => {
                errors.extend(found);
                None
            }
        };
        match stock {
            Some(stock) if errors.is_empty() => Ok(Self { program, setup, units, stock, tooling }),
            _ => Err(errors),
        }
    }

    /// The program.
    pub fn program(&self) -> &'p Program {
        self.program
    }

    /// The setup.
    pub fn setup(&self) -> &'p Setup {
        self.setup
    }

    /// The unit of the program's lengths.
    pub fn length_unit(&self) -> LengthUnit {
        self.units
    }

    /// The tools and their cutters.
    pub fn tooling(&self) -> &Tooling {
        &self.tooling
    }

    /// The stock before the first cut.
    pub fn stock(&self) -> &Stock {
        &self.stock
    }

    /// A target part read from STL, in the units that its numbers have.
    ///
    /// # Errors
    /// Why the bytes are no closed mesh.
    pub fn read_target_part(bytes: &[u8], units: LengthUnit) -> Result<Arc<Mesh>, crate::sim::MeshError> {
        setup_stock::read_mesh_mm(bytes, units).map(Arc::new)
    }
}

//! This module puts a program, its setup and the simulation together.
//!
//! [`Machining::new`] finds the cutter of every tool and the stock, reports what is missing, and reports its
//! assumptions. [`Machining::estimate_cost`] estimates the cost of a run. [`Machining::simulate_program`]
//! removes material motion by motion and passes each motion on with its engagement.
//! [`Machining::simulate_layers`] does the same in layers, with the exact chips of flat end mills.
//!
//! Where the setup knows the axes of the machine, motions are taken on the path that these make
//! ([`crate::machine::ProgramPath`]); a note (CL0711) says where that is not the programmed one.
//!
//! The workpiece frame is the frame of the program's first motion. Shank and holder remove nothing: their
//! collisions are reported, and the material stays.

pub(crate) mod certified_contacts;
mod certified_proof;
pub(crate) mod certified_shares;
mod certified_stock;
mod cost;
mod dexel_run;
mod engagement_model;
mod faults;
mod force_search;
mod known_shares;
pub mod layer_run;
mod motion_forces;
mod motion_places;
mod piece_limit;
mod setup_stock;
mod stock_moments;
mod tooling;
mod true_path;
mod watcher;

pub(crate) use certified_proof::ShareProof;
pub(crate) use cost::describe_default_cell;
pub use cost::{SimulationBudget, SimulationCost};
#[cfg(feature = "report")]
pub(crate) use dexel_run::StockObserver;
pub(crate) use dexel_run::chord_tolerance_mm;
pub use dexel_run::{DexelRunResult, EngagedMotion};
pub(crate) use engagement_model::{
    EngagementModel, EngagementRunResult, StockResolution, describe_default_layer,
};
pub(crate) use force_search::ForceRequest;
pub use known_shares::KnownShares;
pub use motion_forces::{CuttingSpeed, EdgeMoment, ForceStretch, MotionForces, ToothPeriod};
pub use tooling::{NeededTools, Tooling};
pub(crate) use true_path::find_machine_path;
pub use watcher::{RunPhase, RunWatcher, SilentWatcher, WorkEstimate};

use crate::cutter::CutterModel;
use crate::diagnostic::{Diagnostic, Failure};
use crate::program::{LengthUnit, Program};
use crate::setup::Setup;
use crate::stock::{AirClip, Mesh, Stock};
use std::sync::Arc;

/// The options of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct SimulationRunOptions {
    /// The distance of columns, mm; if not given, a fortieth of the smallest cutter's diameter.
    pub cell_mm: Option<f64>,
    /// The longest piece of a motion that is simulated on its own, mm; infinite for whole motions.
    pub longest_piece_mm: f64,
    /// Whether the engagement must be fine enough for forces, which takes several times as long.
    pub forces: bool,
    /// Whether long pieces tell where on their way they remove how much, which largest removal rates need.
    pub removal_peaks: bool,
    /// The most that a run may cost.
    pub budget: SimulationBudget,
}

impl Default for SimulationRunOptions {
    fn default() -> Self {
        Self {
            cell_mm: None,
            longest_piece_mm: f64::INFINITY,
            forces: false,
            removal_peaks: false,
            budget: SimulationBudget::default(),
        }
    }
}

impl SimulationRunOptions {
    /// Returns the options with another distance of columns, mm.
    #[must_use]
    pub fn with_cell_mm(mut self, cell_mm: impl Into<Option<f64>>) -> Self {
        self.cell_mm = cell_mm.into();
        self
    }

    /// Returns the options with another longest piece, mm.
    #[must_use]
    pub fn with_longest_piece_mm(mut self, longest_piece_mm: f64) -> Self {
        self.longest_piece_mm = longest_piece_mm;
        self
    }

    /// Returns the options for a run that finds forces, or for one that does not.
    #[must_use]
    pub fn with_forces(mut self, forces: bool) -> Self {
        self.forces = forces;
        self
    }

    /// Returns the options with another budget.
    #[must_use]
    pub fn with_budget(mut self, budget: SimulationBudget) -> Self {
        self.budget = budget;
        self
    }

    /// Takes the memory that the watcher of a run allows as the budget. A budget that the caller chose is only
    /// lowered to it.
    #[must_use]
    pub fn within_limits(mut self, watch: &dyn RunWatcher) -> Self {
        if let Some(most) = watch.memory_limit_bytes() {
            let chosen = self.budget != SimulationBudget::default();
            self.budget.bytes = if chosen { self.budget.bytes.min(most) } else { most };
        }
        self
    }
}

/// A program that is ready to be machined.
///
/// ```
/// use clsmith::parse::parse;
/// use clsmith::program::LengthUnit;
/// use clsmith::setup::Setup;
/// use clsmith::simulation_run::{Machining, SilentWatcher, SimulationRunOptions};
/// use clsmith::source::Source;
///
/// let shop = b"stock: { block: { from: [0, -20, -10], to: [60, 20, 0] } }\n\
///     tools: [ { match: {}, diameter: 10, flute_length: 20, teeth: 4 } ]\n";
/// let setup = Setup::load(&Source::new("shop.yaml", shop.to_vec())?)?;
/// let part = b"LOAD/TOOL,3\nSPINDL/RPM,5000,CLW\nRAPID\nGOTO/-10,0,-2\nFEDRAT/MMPM,1000.\nGOTO/30,0,-2\n";
/// let program = parse(&Source::new("part.cls", part.to_vec())?, None).program;
///
/// let mut assumptions = Vec::new();
/// let machining = Machining::new(&program, &setup, LengthUnit::Mm, &mut assumptions)?;
/// let options = SimulationRunOptions::default().with_cell_mm(0.5);
/// let mut removed_mm3 = 0.0;
/// let result = machining.simulate_program(&options, &SilentWatcher, &mut |motion| {
///     removed_mm3 += motion.whole_engagement().map_or(0.0, |engagement| engagement.removed_mm3);
/// })?;
/// assert!((result.before_mm3 - result.left.volume_mm3() - removed_mm3).abs() < 1.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Machining<'p> {
    program: &'p Program,
    setup: &'p Setup,
    units: LengthUnit,
    stock: Stock,
    tooling: Tooling,
    /// The path that the machine makes, where it is not the programmed one.
    machine_path: true_path::ToldMachinePath,
}

impl<'p> Machining<'p> {
    /// Brings a program and a setup together. `units` is the unit of the program's lengths. Findings that are
    /// not errors (assumptions) are added to `findings`.
    ///
    /// # Errors
    /// Returns a finding for everything that is missing: the stock, and shapes of tools.
    pub fn new(
        program: &'p Program,
        setup: &'p Setup,
        units: LengthUnit,
        findings: &mut Vec<Diagnostic>,
    ) -> Result<Self, Failure> {
        Self::for_tools(program, setup, units, &|_| true, findings)
    }

    /// As [`Machining::new`], for a run that asks for the cuts of some tools only. The shapes of the others may be
    /// missing; then what they remove is taken to stay, and a finding says so.
    ///
    /// # Errors
    /// Returns a finding for everything that is missing: the stock, and shapes of needed tools.
    pub fn for_tools(
        program: &'p Program,
        setup: &'p Setup,
        units: LengthUnit,
        needed: NeededTools<'_>,
        findings: &mut Vec<Diagnostic>,
    ) -> Result<Self, Failure> {
        // Tools and stock are both examined before anything is returned, so that all that is missing is
        // reported at once.
        let mut errors = Vec::new();
        let tooling = Tooling::from_program(program, setup, units, needed, findings, &mut errors);
        // The faults of the tools and of the stock are reported at once.
        let stock =
            setup_stock::build_stock(setup).map_err(|failure| failure.after(std::mem::take(&mut errors)))?;
        if !errors.is_empty() {
            return Err(errors.into());
        }
        let machine_path = true_path::tell_machine_path(program, setup, units, findings).unwrap_or_default();
        Ok(Self { program, setup, units, stock, tooling, machine_path })
    }

    /// Returns the program.
    pub fn program(&self) -> &'p Program {
        self.program
    }

    /// Returns the setup.
    pub fn setup(&self) -> &'p Setup {
        self.setup
    }

    /// Returns the unit of the program's lengths.
    pub fn length_unit(&self) -> LengthUnit {
        self.units
    }

    /// Returns the tools and their cutters.
    pub fn tooling(&self) -> &Tooling {
        &self.tooling
    }

    /// Returns the stock before the first cut.
    pub fn stock(&self) -> &Stock {
        &self.stock
    }

    /// Returns the box in which any part of any tool can touch the stock.
    fn surroundings_of_stock(&self) -> AirClip {
        let reach = self.tooling.cutters().iter().map(CutterModel::reach_mm).fold(0.0, f64::max);
        AirClip::around(self.stock.bounds(), reach)
    }

    /// Reads a target part from an STL file whose numbers have these units.
    ///
    /// # Errors
    /// Returns the reason why the bytes are not a closed mesh.
    pub fn read_target_part(bytes: &[u8], units: LengthUnit) -> Result<Arc<Mesh>, crate::stock::MeshError> {
        setup_stock::read_mesh_mm(bytes, units).map(Arc::new)
    }
}

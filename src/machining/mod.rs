//! Machining: a program, its setup and the simulation put together.
//!
//! [`Machining::new`] finds the cutter of every tool and the stock, asks for what is missing and says what it assumes;
//! [`Machining::plan`] knows what a run costs; [`Machining::run`] removes material motion by motion and hands each motion on
//! with what it engaged; [`Machining::chips`](chips) does so in layers, with the exact chips of flat end mills.

pub mod chips;
mod engage;
mod faults;
mod plan;
mod run;
mod stock;
mod tooling;
mod watch;

pub use engage::{Engaged, Grain, Source};
pub use plan::{Budget, Plan};
pub use run::{Cut, Ran, chord_mm};
pub use tooling::Tooling;
pub use watch::{Unwatched, Watch};

use crate::diagnostic::Diagnostic;
use crate::program::{LengthUnit, Program};
use crate::setup::Setup;
use crate::sim::{Mesh, Stock};
use std::sync::Arc;

/// How a run is made.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// Distance of columns, mm; else a fortieth of the smallest cutter's diameter.
    pub cell: Option<f64>,
    /// Longest piece of a motion that is looked at on its own, mm; infinite for whole motions.
    pub longest: f64,
    /// Whether forces are asked for, which takes several times as long.
    pub forces: bool,
    /// What a run may cost.
    pub budget: Budget,
}

impl Default for Options {
    fn default() -> Self {
        Self { cell: None, longest: f64::INFINITY, forces: false, budget: Budget::default() }
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
        let tooling = Tooling::of(program, setup, units, findings, &mut errors);
        let stock = match stock::of(setup) {
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
    pub fn units(&self) -> LengthUnit {
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
    pub fn target(bytes: &[u8], units: LengthUnit) -> Result<Arc<Mesh>, crate::sim::MeshError> {
        stock::mesh(bytes, units).map(Arc::new)
    }
}

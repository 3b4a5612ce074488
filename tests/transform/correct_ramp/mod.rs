//! `correct_ramp`: geometry, programs, real files.

mod corpus;
mod geometry;
mod programs;
mod refused;
mod special;

use crate::support;
use clsmith::diagnostic::{Diagnostic, Failure};
use clsmith::program::Program;
use clsmith::setup::Setup;
use clsmith::source::Source;
use clsmith::transform::correct_ramp::CorrectRampReport;
use clsmith::transform::correct_ramp::{RampOutcome, RampReport};
use clsmith::transform::{Recipe, RecipeOutcome as Ran, run_recipe};

/// What a step made of a program.
pub struct Done {
    pub text: String,
    pub findings: Vec<Diagnostic>,
    pub ramps: Vec<RampReport>,
}

impl Done {
    pub fn outcomes(&self) -> Vec<RampOutcome> {
        self.ramps.iter().map(|ramp| ramp.outcome).collect()
    }

    pub fn codes(&self) -> Vec<&'static str> {
        self.findings.iter().map(|found| found.code.id()).collect()
    }
}

/// A face mill of 50 mm: legs of 38 mm or more, 7.5 degrees or less.
pub const FACE_MILL: &str = "tool: { diameter: 50, insert_radius: 6, insert_height: 5 }";

/// Runs `correct_ramp` with parameters on a text.
pub fn correct(parameters: &str, text: impl AsRef<[u8]>) -> Result<Done, Vec<Diagnostic>> {
    correct_program(parameters, "", support::program(text))
}

/// The same with a setup (the YAML below `setup:`), on a program.
pub fn correct_program(parameters: &str, setup: &str, program: Program) -> Result<Done, Vec<Diagnostic>> {
    let setup = if setup.is_empty() { String::new() } else { format!("setup: {setup}\n") };
    let recipe = format!("version: 1\nunits: mm\n{setup}steps:\n  - correct_ramp: {{ {parameters} }}\n");
    let recipe = Source::new("recipe.yaml", recipe.into_bytes()).unwrap();
    let recipe = Recipe::load(&recipe).map_err(Failure::into_findings)?;
    let setup = recipe.merge_setups(Setup::default(), Setup::default());
    let Ran { program, findings, mut reports, .. } =
        run_recipe(&recipe, &setup, program).map_err(Failure::into_findings)?;
    let report = reports.pop().expect("a report");
    let report = report.downcast_ref::<CorrectRampReport>().unwrap().clone();
    let text = String::from_utf8_lossy(&program.to_bytes()).into_owned();
    Ok(Done { text, findings, ramps: report.ramps })
}

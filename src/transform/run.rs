//! Running a recipe on a program.

use super::{Context, Recipe};
use crate::diagnostic::Diagnostic;
use crate::program::{Program, StepId};
use crate::setup::Setup;

/// What a recipe made of a program.
#[derive(Debug)]
pub struct Outcome {
    /// The program after the last step.
    pub program: Program,
    /// Findings of the steps that are no reason to stop.
    pub findings: Vec<Diagnostic>,
}

/// Applies the steps in order.
///
/// # Errors
/// What stopped a step, after the findings of the steps before it.
pub fn run(recipe: &Recipe, setup: &Setup, mut program: Program) -> Result<Outcome, Vec<Diagnostic>> {
    let mut findings = Vec::new();
    for (index, step) in recipe.steps.iter().enumerate() {
        let id = StepId(u16::try_from(index).unwrap_or(u16::MAX));
        let mut context = Context { step: id, recipe, setup, findings: std::mem::take(&mut findings) };
        match step.transform().apply(program, &mut context) {
            Ok(changed) => program = changed,
            Err(stopped) => {
                context.findings.push(*stopped);
                return Err(context.findings);
            }
        }
        findings = context.findings;
    }
    Ok(Outcome { program, findings })
}

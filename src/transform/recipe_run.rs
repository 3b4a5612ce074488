//! Running a recipe on a program.

use super::{Recipe, Step, StepContext, StepReport, step_id};
use crate::diagnostic::{Diagnostic, codes};
use crate::program::{LengthUnit, Program};
use crate::recipe::{Provenance, YamlPathSegment};
use crate::setup::Setup;
use crate::simulation_run::{RunWatcher, SilentWatcher};

/// What a recipe made of a program.
#[derive(Debug)]
pub struct RecipeOutcome {
    /// The program after the last step.
    pub program: Program,
    /// Findings of the steps that are no reason to stop.
    pub findings: Vec<Diagnostic>,
    /// What steps have to say about themselves, in the order of the steps.
    pub reports: Vec<StepReport>,
}

/// Applies the steps in order.
///
/// # Errors
/// What stopped a step, after the findings of the steps before it.
pub fn run_recipe(
    recipe: &Recipe,
    setup: &Setup,
    program: Program,
) -> Result<RecipeOutcome, Vec<Diagnostic>> {
    run_recipe_watched(recipe, setup, program, &SilentWatcher)
}

/// As [`run_recipe`], with somebody who is told how far long steps are.
///
/// # Errors
/// As [`run_recipe`].
pub fn run_recipe_watched(
    recipe: &Recipe,
    setup: &Setup,
    mut program: Program,
    watch: &dyn RunWatcher,
) -> Result<RecipeOutcome, Vec<Diagnostic>> {
    let mut findings: Vec<Diagnostic> = find_unsaid_units(recipe, &program).into_iter().collect();
    let mut reports = Vec::new();
    if recipe.provenance == Provenance::Comments {
        program.keep_history();
    }
    for (index, step) in recipe.steps.iter().enumerate() {
        let id = step_id(index);
        let mut context = StepContext {
            step: id,
            recipe,
            setup,
            watch,
            findings: std::mem::take(&mut findings),
            reports: std::mem::take(&mut reports),
        };
        match step.transform().apply(program, &mut context) {
            Ok(changed) => program = changed,
            Err(stopped) => {
                context.findings.push(*stopped);
                return Err(context.findings);
            }
        }
        (findings, reports) = (context.findings, context.reports);
    }
    Ok(RecipeOutcome { program, findings, reports })
}

/// A recipe that says no unit, has lengths or feeds, and meets a program in inches.
fn find_unsaid_units(recipe: &Recipe, program: &Program) -> Option<Diagnostic> {
    let said = recipe.value_span(&[YamlPathSegment::Key("units")]).is_some();
    let measures = |step: &Step| match step {
        Step::ClampFeed(_) | Step::OptimizeFeed(_) | Step::CorrectRamp(_) | Step::CompensateZ(_) => true,
        Step::MoveOrigin(step) => step.has_lengths(),
        _ => false,
    };
    let index = recipe.steps.iter().position(measures)?;
    let inches =
        || program.stated_length_unit().or_else(|| program.feed_length_unit()) == Some(LengthUnit::Inch);
    if said || recipe.units == LengthUnit::Inch || !inches() {
        return None;
    }
    let message = "the program is in inches, the recipe says no `units` and is taken to be in millimetres";
    let finding = Diagnostic::new(codes::UNITS_DIFFER_FROM_RECIPE, message);
    Some(finding.with_label(&recipe.source, recipe.step_span(index), "its lengths and feeds are in mm"))
}

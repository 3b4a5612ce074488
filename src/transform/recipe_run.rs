//! This module runs the steps of a recipe, or transforms that were built in Rust, on a program.

use super::thread_pitches;
use super::{Recipe, Step, StepContext, Transform, TransformReport, step_id};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::program::{LengthUnit, Program};
use crate::recipe::{Provenance, YamlPathSegment};
use crate::setup::Setup;
use crate::simulation_run::{KnownShares, RunPhase, RunWatcher, SilentWatcher};

/// The result of a recipe for a program.
#[derive(Debug)]
pub struct RecipeOutcome {
    /// The program after the last step.
    pub program: Program,
    /// Findings of the steps that do not stop them.
    pub findings: Vec<Diagnostic>,
    /// What the steps report about themselves, in the order of the steps.
    pub reports: Vec<Box<dyn TransformReport>>,
    /// The shares that steps have certified, for reports about the result.
    pub shares: KnownShares,
}

/// Applies the steps in order.
///
/// ```
/// use clsmith::parse::parse;
/// use clsmith::setup::Setup;
/// use clsmith::source::Source;
/// use clsmith::transform::{Recipe, run_recipe};
///
/// let recipe = b"version: 1\nsteps:\n  - scale_feed: { factor: 0.5 }\n  - clamp_feed: { min: 300 }\n";
/// let recipe = Recipe::load(&Source::new("recipe.yaml", recipe.to_vec())?)?;
/// let part = b"FEDRAT/MMPM,1000.\nGOTO/0,0,0\nFEDRAT/MMPM,400.\nGOTO/9,0,0\n";
/// let program = parse(&Source::new("part.cls", part.to_vec())?, None).program;
/// let outcome = run_recipe(&recipe, &Setup::default(), program)?;
/// let text = outcome.program.to_bytes();
/// assert_eq!(text, b"FEDRAT/MMPM,500.\nGOTO/0,0,0\nFEDRAT/MMPM,300.\nGOTO/9,0,0\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Returns what stopped a step, after the findings of the steps before it, or [`Failure::Interrupted`] if
/// somebody stopped it.
pub fn run_recipe(recipe: &Recipe, setup: &Setup, program: Program) -> Result<RecipeOutcome, Failure> {
    run_recipe_watched(recipe, setup, program, &SilentWatcher)
}

/// Does the same as [`run_recipe`], with a watcher that is informed about the progress of long steps.
///
/// # Errors
/// Returns the errors of [`run_recipe`].
pub fn run_recipe_watched(
    recipe: &Recipe,
    setup: &Setup,
    mut program: Program,
    watch: &dyn RunWatcher,
) -> Result<RecipeOutcome, Failure> {
    if recipe.provenance == Provenance::Comments {
        program.keep_history();
    }
    let steps: Vec<&dyn Transform> = recipe.steps.iter().map(Step::transform).collect();
    let run = StepSequence { steps: &steps, units: recipe.units, setup, recipe: Some(recipe), watch };
    let findings = find_unsaid_units(recipe, &program).into_iter().collect();
    run.apply_steps(program, findings)
}

/// Applies transforms that were built in Rust, in order. `units` is the unit of lengths among their
/// parameters.
///
/// Findings about a parameter then have no place, because there is no recipe to which they could point.
///
/// ```
/// use clsmith::parameters::{Factor, Positive};
/// use clsmith::parse::parse;
/// use clsmith::program::LengthUnit;
/// use clsmith::setup::Setup;
/// use clsmith::source::Source;
/// use clsmith::transform::{ClampFeed, ScaleFeed, run_steps};
///
/// let slower = ScaleFeed::new(Factor::new(0.5).expect("0.5 is above 0"));
/// let limited = ClampFeed { max: Positive::new(400.0), ..ClampFeed::default() };
/// let program = parse(&Source::new("part.cls", b"FEDRAT/MMPM,1000.\nGOTO/0,0,0\n".to_vec())?, None).program;
/// let outcome = run_steps(&[&slower, &limited], LengthUnit::Mm, &Setup::default(), program)?;
/// assert_eq!(outcome.program.to_bytes(), b"FEDRAT/MMPM,400.\nGOTO/0,0,0\n");
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Returns the errors of [`run_recipe`].
pub fn run_steps(
    steps: &[&dyn Transform],
    units: LengthUnit,
    setup: &Setup,
    program: Program,
) -> Result<RecipeOutcome, Failure> {
    let run = StepSequence { steps, units, setup, recipe: None, watch: &SilentWatcher };
    run.apply_steps(program, Vec::new())
}

/// Steps that are applied one after the other, and their surroundings.
struct StepSequence<'r> {
    steps: &'r [&'r dyn Transform],
    units: LengthUnit,
    setup: &'r Setup,
    recipe: Option<&'r Recipe>,
    watch: &'r dyn RunWatcher,
}

impl StepSequence<'_> {
    fn apply_steps(&self, mut program: Program, findings: Vec<Diagnostic>) -> Result<RecipeOutcome, Failure> {
        let mut context = StepContext {
            step: step_id(0),
            units: self.units,
            setup: self.setup,
            watch: self.watch,
            findings,
            reports: Vec::new(),
            shares: KnownShares::default(),
            recipe: self.recipe,
        };
        for (index, step) in self.steps.iter().enumerate() {
            context.step = step_id(index);
            self.watch.check_stop()?;
            self.watch.begin_phase(RunPhase::Step { index, count: self.steps.len() });
            let earlier = context.findings.len();
            let threads = thread_pitches::find_thread_pitches(&program);
            let applied = step.apply(program, &mut context);
            for found in context.findings.iter_mut().skip(earlier) {
                found.step = Some(index + 1);
            }
            match applied {
                Ok(changed) => {
                    program = changed;
                    // The history is recorded before the next step signs the same statements.
                    program.close_step(context.step);
                    let told = context.findings.len();
                    thread_pitches::report_changed_pitches(&threads, &program, &mut context);
                    for found in context.findings.iter_mut().skip(told) {
                        found.step = Some(index + 1);
                    }
                }
                Err(failure) => {
                    let of_step = |found| Diagnostic { step: Some(index + 1), ..found };
                    return Err(failure.map_findings(of_step).after(context.findings));
                }
            }
        }
        let StepContext { findings, reports, shares, .. } = context;
        Ok(RecipeOutcome { program, findings, reports, shares })
    }
}

/// Returns a note if a recipe states no unit, has lengths or feeds, and meets a program in inches.
fn find_unsaid_units(recipe: &Recipe, program: &Program) -> Option<Diagnostic> {
    let said = recipe.value_span(&[YamlPathSegment::Key("units")]).is_some();
    let index = recipe.steps.iter().position(|step| step.transform().measures())?;
    let inches =
        || program.stated_length_unit().or_else(|| program.feed_length_unit()) == Some(LengthUnit::Inch);
    if said || recipe.units == LengthUnit::Inch || !inches() {
        return None;
    }
    let message = "the program is in inches, the recipe says no `units` and is taken to be in millimetres";
    let finding = Diagnostic::new(codes::UNITS_DIFFER_FROM_RECIPE, message);
    Some(finding.with_label(&recipe.source, recipe.step_span(index), "its lengths and feeds are in mm"))
}

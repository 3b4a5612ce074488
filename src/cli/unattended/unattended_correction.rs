//! This module chooses the recipe for one program and applies it.

use super::{RecipeArgs, RecipeChooser};
use crate::cli::input_files::{self, LoadedRecipe};
use clsmith::diagnostic::{Diagnostic, Failure};
use clsmith::fingerprint::RecipeFingerprint;
use clsmith::job::{CorrectionJob, JobOutcome, catch_defect, is_program_changed};
use clsmith::program::Program;
use clsmith::recipe_rules::RecipeChoice;
use clsmith::report::DisplayUnits;
use clsmith::report::changes::{self, StepChanges};
use clsmith::report::finding_policy::FindingPolicy;
use clsmith::simulation_run::RunWatcher;
use clsmith::source::Source;
use clsmith::transform::TransformReport;
use serde::Serialize;
use std::sync::Arc;

/// What happened to a program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum UnattendedOutcome {
    /// The recipe changed it.
    Corrected,
    /// The recipe found nothing to change.
    Unchanged,
    /// The rules let it pass unchanged.
    Passed,
    /// It could not be corrected, and was passed on unchanged nevertheless.
    PassedOriginal,
    /// It could not be corrected, and was not passed on.
    Refused,
    /// The run was stopped by Ctrl-C.
    Stopped,
}

/// A recipe with everything on which it depends.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct LoggedRecipe {
    pub path: String,
    /// What chose it: `--recipe`, `rule 2` or `otherwise`.
    pub chosen_by: String,
    #[serde(flatten)]
    pub print: RecipeFingerprint,
}

/// A program after its recipe, or the reason why there is none.
pub(crate) struct UnattendedCorrection {
    /// What happened to it. It is `Refused` if there is an error.
    pub outcome: UnattendedOutcome,
    /// The program that is passed on. It is `None` if it is refused or passes unchanged.
    pub program: Option<Program>,
    /// The findings, after the policy.
    pub findings: Vec<Diagnostic>,
    /// What each step changed.
    pub steps: Vec<StepChanges>,
    /// What steps report about themselves.
    pub reports: Vec<Box<dyn TransformReport>>,
    /// The units that people see: those of the program.
    pub units: DisplayUnits,
    /// The recipe, once it was read.
    pub recipe: Option<LoggedRecipe>,
    /// Whether the fault is not in the program but in its recipe or setup. Then it may succeed once that is
    /// repaired.
    pub surroundings: bool,
}

impl UnattendedCorrection {
    fn without_program(outcome: UnattendedOutcome, findings: Vec<Diagnostic>) -> Self {
        Self {
            outcome,
            program: None,
            findings,
            steps: Vec::new(),
            reports: Vec::new(),
            units: DisplayUnits::MM,
            recipe: None,
            surroundings: false,
        }
    }

    /// Makes the result for a program that cannot be corrected.
    pub(crate) fn refused(findings: Vec<Diagnostic>) -> Self {
        Self::without_program(UnattendedOutcome::Refused, findings)
    }

    /// Makes the result for a program on which the work was stopped.
    pub(crate) fn stopped() -> Self {
        Self::without_program(UnattendedOutcome::Stopped, Vec::new())
    }

    /// Makes the result for a program whose recipe cannot be used.
    pub(crate) fn without_recipe(findings: Vec<Diagnostic>) -> Self {
        Self { surroundings: true, ..Self::refused(findings) }
    }

    /// Returns the bytes that are passed on: the corrected program, or the file as it was read.
    pub(crate) fn byte_chunks<'p>(&'p self, source: &'p Source) -> Box<dyn Iterator<Item = &'p [u8]> + 'p> {
        match &self.program {
            Some(program) => Box::new(program.byte_chunks()),
            None => Box::new(std::iter::once(source.bytes())),
        }
    }
}

/// Chooses the recipe for a program and applies it. `file` is the name of its file, without the folder. If
/// clsmith itself fails on a program (a defect), the program is refused, and the command can go on with the
/// next one.
pub(crate) fn correct_unattended(
    args: &RecipeArgs,
    chooser: &RecipeChooser,
    policy: &FindingPolicy,
    watch: &dyn RunWatcher,
    file: &str,
    source: &Arc<Source>,
) -> UnattendedCorrection {
    catch_defect(source.name(), || choose_and_correct(args, chooser, policy, watch, file, source))
        .unwrap_or_else(|defect| UnattendedCorrection::refused(vec![defect]))
}

fn choose_and_correct(
    args: &RecipeArgs,
    chooser: &RecipeChooser,
    policy: &FindingPolicy,
    watch: &dyn RunWatcher,
    file: &str,
    source: &Arc<Source>,
) -> UnattendedCorrection {
    let choice = chooser.choose_recipe(file, source, args.dialect);
    let (path, given, by) = match choice {
        Ok(RecipeChoice::Recipe { recipe, setup, by }) => (recipe, setup, by),
        Ok(RecipeChoice::Pass) => {
            return UnattendedCorrection::without_program(UnattendedOutcome::Passed, Vec::new());
        }
        Err(failure) => return UnattendedCorrection::refused(failure.into_findings()),
    };
    let LoadedRecipe { recipe, setup, texts } = match input_files::read_recipe(&path, given.as_deref()) {
        Ok(loaded) => loaded,
        Err(failure) => return UnattendedCorrection::without_recipe(failure.into_findings()),
    };
    let print = match RecipeFingerprint::read_files(&texts, &recipe, &setup) {
        Ok(print) => print,
        Err(failure) => return UnattendedCorrection::without_recipe(failure.into_findings()),
    };
    let used = LoggedRecipe { path: path.to_string_lossy().into_owned(), chosen_by: by, print };
    let print = Some(&used.print);
    let job = CorrectionJob::new(&recipe, &setup, policy)
        .with_print(print)
        .with_dialect(args.dialect)
        .with_watcher(watch);
    let JobOutcome { program, findings, reports, .. } = match job.correct_source(source) {
        Ok(outcome) => outcome,
        Err(failure) => {
            let outcome = match failure {
                Failure::Found(_) => UnattendedOutcome::Refused,
                Failure::Interrupted => UnattendedOutcome::Stopped,
            };
            let stopped = UnattendedCorrection::without_program(outcome, failure.into_findings());
            return UnattendedCorrection { recipe: Some(used), ..stopped };
        }
    };
    let (steps, _) = changes::count_step_changes(&program, &recipe.step_names());
    let outcome = if is_program_changed(&program) {
        UnattendedOutcome::Corrected
    } else {
        UnattendedOutcome::Unchanged
    };
    UnattendedCorrection {
        outcome,
        units: DisplayUnits::of_recipe(&program, recipe.units, None),
        program: Some(program),
        findings,
        steps,
        reports,
        recipe: Some(used),
        surroundings: false,
    }
}

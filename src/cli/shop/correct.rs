//! One program through the recipe that is chosen for it.

use super::log::RecipeRecord;
use super::{Chooser, RecipeArgs};
use crate::cli::files::{self, Loaded};
use clsmith::choice::Choice;
use clsmith::diagnostic::Diagnostic;
use clsmith::fingerprint::RecipePrint;
use clsmith::job::{Done, Job, is_changed};
use clsmith::machining::Watch;
use clsmith::parse::parse;
use clsmith::program::Program;
use clsmith::report::changes::{self, StepChanges};
use clsmith::report::policy::Policy;
use clsmith::source::Source;
use clsmith::transform::StepReport;
use serde::Serialize;
use std::sync::Arc;

/// What became of a program.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// The recipe changed it.
    Corrected,
    /// The recipe found nothing to change.
    Unchanged,
    /// A selection says that it goes on as it is.
    Passed,
    /// It could not be corrected, and goes on as it is all the same.
    PassedOriginal,
    /// It could not be corrected, and stops here.
    Refused,
    /// Ctrl-C came first.
    Stopped,
}

/// A program after its recipe, or why not.
pub struct Correction {
    /// What became of it; `Refused` when an error stands.
    pub outcome: Outcome,
    /// The program as it is to go on; `None` when it is refused or passed.
    pub program: Option<Program>,
    /// What was found.
    pub findings: Vec<Diagnostic>,
    /// What each step changed.
    pub steps: Vec<StepChanges>,
    /// What steps say about themselves.
    pub reports: Vec<StepReport>,
    /// The recipe, once it was read.
    pub recipe: Option<RecipeRecord>,
    /// Whether it is refused for what stands around it, a broken recipe say, and may go through when that is put right.
    pub surroundings: bool,
}

impl Correction {
    fn without_program(outcome: Outcome, findings: Vec<Diagnostic>) -> Self {
        Self {
            outcome,
            program: None,
            findings,
            steps: Vec::new(),
            reports: Vec::new(),
            recipe: None,
            surroundings: false,
        }
    }

    /// A program that cannot be corrected.
    pub fn refused(findings: Vec<Diagnostic>) -> Self {
        Self::without_program(Outcome::Refused, findings)
    }

    /// A program whose recipe cannot be used.
    pub fn without_recipe(findings: Vec<Diagnostic>) -> Self {
        Self { surroundings: true, ..Self::refused(findings) }
    }

    /// The bytes that go on: the corrected program, or the file as it came.
    pub fn pieces<'p>(&'p self, source: &'p Source) -> Box<dyn Iterator<Item = &'p [u8]> + 'p> {
        match &self.program {
            Some(program) => Box::new(program.pieces()),
            None => Box::new(std::iter::once(source.bytes())),
        }
    }
}

/// Chooses the recipe for a program and applies it. `file` is the name of its file, without the folder.
pub fn correct(
    args: &RecipeArgs,
    chooser: &Chooser,
    policy: &Policy,
    watch: &dyn Watch,
    file: &str,
    source: &Arc<Source>,
) -> Correction {
    let choice = match chooser {
        // The program need not be looked at before.
        Chooser::One(choice) => Ok(choice.clone()),
        Chooser::Rules(_) => chooser.choose(file, &parse(source, args.dialect).program),
    };
    let (path, given, by) = match choice {
        Ok(Choice::Recipe { recipe, setup, by }) => (recipe, setup, by),
        Ok(Choice::Pass) => return Correction::without_program(Outcome::Passed, Vec::new()),
        Err(found) => return Correction::refused(vec![*found]),
    };
    let Loaded { recipe, setup, texts } = match files::recipe(&path, given.as_deref()) {
        Ok(loaded) => loaded,
        Err(found) => return Correction::without_recipe(found),
    };
    let print = match RecipePrint::of(&texts, &recipe, &setup) {
        Ok(print) => print,
        Err(found) => return Correction::without_recipe(vec![*found]),
    };
    let used = RecipeRecord { path: path.to_string_lossy().into_owned(), chosen_by: by, print };
    let print = Some(&used.print);
    let job = Job { recipe: &recipe, setup: &setup, print, policy, dialect: args.dialect, watch };
    let Done { program, findings, reports } = job.run(source);
    let names = recipe.step_names();
    let steps = program.as_ref().map_or_else(Vec::new, |program| changes::count(program, &names).0);
    let outcome = match &program {
        Some(program) if is_changed(program) => Outcome::Corrected,
        Some(_) => Outcome::Unchanged,
        None => Outcome::Refused,
    };
    Correction { outcome, program, findings, steps, reports, recipe: Some(used), surroundings: false }
}

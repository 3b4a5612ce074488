//! What a corrected file says about its run.

mod forms;
mod history;
mod invariants;
mod words;

use crate::support;
use clsmith::diagnostic::{Diagnostic, Failure};
use clsmith::fingerprint::RecipeFingerprint;
use clsmith::job::{CorrectionJob, JobOutcome};
use clsmith::program::Program;
use clsmith::report::finding_policy::FindingPolicy;
use clsmith::setup::Setup;
use clsmith::source::Source;
use clsmith::transform::Recipe;
use std::sync::Arc;

/// A recipe called `slow.yaml` with what its file says.
pub fn recipe(text: &str) -> (Recipe, RecipeFingerprint) {
    let source = Source::new("recipes/slow.yaml", text.as_bytes().to_vec()).unwrap();
    let recipe = Recipe::load(&source).unwrap_or_else(|found| panic!("{found:?} in\n{text}"));
    let print = RecipeFingerprint::read_files(&[source], &recipe, &Setup::default()).unwrap();
    (recipe, print)
}

/// Corrects a file as `apply` does.
pub fn done(recipe_text: &str, source: &Arc<Source>) -> Result<JobOutcome, Failure> {
    let (recipe, print) = recipe(recipe_text);
    let setup = recipe.merge_setups(Setup::default(), Setup::default());
    let policy = FindingPolicy::default();
    CorrectionJob::new(&recipe, &setup, &policy).with_print(&print).correct_source(source)
}

/// The corrected program and what was found, which must be no error.
pub fn corrected(recipe_text: &str, text: impl AsRef<[u8]>) -> (Program, Vec<Diagnostic>) {
    let JobOutcome { program, findings, .. } = done(recipe_text, &support::text(text)).unwrap();
    (program, findings)
}

/// The steps of a recipe with comments.
pub fn with_comments(steps: &str) -> String {
    format!("version: 1\nprovenance: comments\nsteps:\n{steps}\n")
}

/// The corrected text.
pub fn text(recipe_text: &str, text: impl AsRef<[u8]>) -> String {
    String::from_utf8(corrected(recipe_text, text).0.to_bytes()).unwrap()
}

/// Its comments alone, without the header.
pub fn comments(steps: &str, part: &str) -> Vec<String> {
    let text = text(&with_comments(steps), part);
    let comments = text.lines().filter_map(|line| line.strip_prefix("$$ clsmith "));
    comments.filter(|line| line.contains(": ")).map(str::to_owned).collect()
}

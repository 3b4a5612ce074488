//! This module shows what a recipe makes of a program, without writing anything.

use crate::diagnostic::{Diagnostic, Failure};
use crate::job::CorrectionJob;
use crate::report::finding_policy::FindingPolicy;
use crate::report::unified_diff::{self, UnifiedDiffOptions};
use crate::setup::Setup;
use crate::simulation_run::RunWatcher;
use crate::source::{Source, SourceReadError};
use crate::transform::Recipe;
use std::path::Path;
use std::sync::Arc;

/// What a recipe makes of a program.
#[derive(Debug)]
#[non_exhaustive]
pub struct RecipePreview {
    /// The corrected text.
    pub text: Vec<u8>,
    /// The changed lines as a unified diff; empty if nothing changes.
    pub diff: Vec<u8>,
    /// What was found on the way.
    pub findings: Vec<Diagnostic>,
    /// Whether `apply` would write nothing, because one of the findings is an error.
    pub is_refused: bool,
}

/// Runs a recipe on a program. `read` gets the files that the recipe names, relative to the recipe's `folder`.
///
/// # Errors
/// Returns what is wrong with the recipe or stops it, or an interruption if `watch` asks for one.
pub fn preview_recipe(
    recipe: &Arc<Source>,
    folder: &Path,
    program: &Arc<Source>,
    read: impl Fn(&Path) -> Result<Arc<Source>, SourceReadError>,
    watch: &dyn RunWatcher,
) -> Result<RecipePreview, Failure> {
    let recipe = Recipe::load(recipe)?;
    let named = recipe.load_setup_file(|name| read(&folder.join(name)))?;
    let setup =
        recipe.merge_setups(named, Setup::default()).read_machine_file(&read)?.read_material_file(&read)?;
    let policy = FindingPolicy::default();
    let job = CorrectionJob::new(&recipe, &setup, &policy).with_watcher(watch);
    let outcome = job.try_source(program)?;
    Ok(RecipePreview {
        text: outcome.program.to_bytes(),
        diff: unified_diff::to_bytes(&outcome.program, &UnifiedDiffOptions::default()),
        is_refused: outcome.is_refused(),
        findings: outcome.findings,
    })
}

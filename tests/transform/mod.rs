//! Transforms, through one door: a recipe's steps applied to a text.

mod compensate_z;
mod composed;
mod convert_units;
mod correct_ramp;
mod defaults;
mod empty_selection;
mod feed;
mod feed_governors;
mod inverse_time;
mod linearize;
mod move_origin;
mod moved;
mod optimize_feed;
mod rewrite;
mod set_spindle;
mod unwind;
mod without_yaml;

use crate::support;
use clsmith::diagnostic::{Diagnostic, Failure};
use clsmith::setup::Setup;
use clsmith::source::Source;
use clsmith::transform::{Recipe, run_recipe};

/// Applies `steps` (the YAML below `steps:`) to a program's text; gives the new text and the findings.
pub fn apply(steps: &str, text: impl AsRef<[u8]>) -> (String, Vec<Diagnostic>) {
    match try_apply(&format!("version: 1\nsteps:\n{steps}"), text) {
        Ok(done) => done,
        Err(found) => panic!("{found:?}"),
    }
}

/// Applies a whole recipe; the error is what stopped it.
pub fn try_apply(recipe: &str, text: impl AsRef<[u8]>) -> Result<(String, Vec<Diagnostic>), Vec<Diagnostic>> {
    let recipe = Source::new("recipe.yaml", recipe.as_bytes().to_vec()).unwrap();
    let recipe = Recipe::load(&recipe).map_err(Failure::into_findings)?;
    let setup = recipe.merge_setups(Setup::default(), Setup::default());
    let outcome = run_recipe(&recipe, &setup, support::program(text)).map_err(Failure::into_findings)?;
    Ok((String::from_utf8_lossy(&outcome.program.to_bytes()).into_owned(), outcome.findings))
}

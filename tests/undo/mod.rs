//! Back to the original.

mod refused;
mod roundtrip;

use crate::provenance;
use crate::support;
use clsmith::fingerprint::RecipeFingerprint;
use clsmith::program::Program;
use clsmith::recipe::Provenance;
use clsmith::report::changes::RecipeChanges;
use clsmith::source::Source;
use clsmith::undo::{RunReport, UndoData};
use std::sync::Arc;

/// The report of a run, as `apply --json` writes it.
pub fn report(recipe_text: &str, program: &Program) -> Arc<Source> {
    let (recipe, print): (_, RecipeFingerprint) = provenance::recipe(recipe_text);
    let before = clsmith::parse::parse(program.source(), Some(program.dialect())).program;
    let changes = RecipeChanges::from_programs(&before, program, &recipe.step_names(), Some(recipe.units));
    let mut bytes = Vec::new();
    RunReport::from_program(program, Some("out.cls".to_owned()), &print, Provenance::Comments, &changes)
        .write_json(&mut bytes)
        .unwrap();
    Source::new("out.json", bytes).unwrap()
}

/// Undoes a run from its output and its report alone.
pub fn undone(program: &Program, report: &Arc<Source>) -> Vec<u8> {
    let output = support::text(program.to_bytes());
    UndoData::read_report(report).unwrap().restore_original(&output, report).unwrap().bytes
}

//! What a recipe made of a program.

use super::stats::POCKET;
use crate::support::{program, rounded_snapshots, snapshots};
use clsmith::report::changes::{RecipeChanges, to_json, to_text};
use clsmith::report::record_kind::RecordKind;
use clsmith::setup::Setup;
use clsmith::source::Source;
use clsmith::transform::{Recipe, run_recipe};

const RECIPE: &str = "version: 1
steps:
  - scale_feed: { factor: 0.5, where: { motions: [engage] } }
  - clamp_feed: { max: 500 }
  - clamp_feed: { max: 9000 }
";

fn changes() -> RecipeChanges {
    let recipe = Recipe::load(&Source::new("recipe.yaml", RECIPE.into()).unwrap()).unwrap();
    let outcome = run_recipe(&recipe, &Setup::default(), program(POCKET)).unwrap();
    let names = recipe.step_names();
    RecipeChanges::from_programs(&program(POCKET), &outcome.program, &names, None)
}

#[test]
fn a_recipe_as_text_and_json() {
    let found = changes();
    assert_eq!(found.steps[0].edited[&RecordKind::Feed], 1);
    assert!(found.steps[2].is_empty() && !found.is_empty());
    assert!(found.after.feed_seconds > found.before.feed_seconds);
    snapshots("report").bind(|| insta::assert_snapshot!("changes", to_text(&found)));
    rounded_snapshots("report").bind(|| insta::assert_snapshot!("changes_json", to_json(&found)));
}

#[test]
fn an_untouched_program_has_no_changes() {
    let found = RecipeChanges::from_programs(&program(POCKET), &program(POCKET), &["scale_feed"], None);
    assert!(found.is_empty());
    assert_eq!(found.untouched, program(POCKET).statements().len());
}

#[test]
fn lengths_before_and_after_are_in_one_unit() {
    let inch = program("UNITS/INCHES\nFEDRAT/10,IPM\nGOTO/0,0,0\nGOTO/2,0,0\n");
    let mm = program("UNITS/MM\nFEDRAT/254,MMPM\nGOTO/0,0,0\nGOTO/50.8,0,0\n");
    let found = RecipeChanges::from_programs(&inch, &mm, &[], None);
    assert!((found.before.feed_length - found.after.feed_length).abs() < 1e-9);
}

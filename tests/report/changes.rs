//! What a recipe made of a program.

use super::stats::POCKET;
use crate::support::{program, rounded_snapshots, snapshots};
use clsmith::program::RecordKind;
use clsmith::report::changes::{RecipeChanges, to_json, to_text};
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

#[test]
fn every_step_is_credited_with_its_own_changes() {
    let text = "UNITS/MM\nFEDRAT/1000.0,MMPM\nGOTO/0.0,0.0,0.0\nGOTO/20.0,0.0,0.0\nGOTO/20.0,30.0,0.0\n";
    let recipe = "version: 1\nsteps:\n  - move_origin: { translate: [1, 0, 0] }\n  - scale_feed: { factor: 0.5 }\n  - convert_units: { to: inch }\n";
    let recipe = Recipe::load(&Source::new("recipe.yaml", recipe.into()).unwrap()).unwrap();
    let outcome = run_recipe(&recipe, &Setup::default(), program(text)).unwrap();
    let found = RecipeChanges::from_programs(&program(text), &outcome.program, &recipe.step_names(), None);
    let [moved, scaled, converted] = &found.steps[..] else { panic!("{found:?}") };
    assert_eq!(moved.edited[&RecordKind::Point], 3);
    assert_eq!(scaled.edited[&RecordKind::Feed], 1);
    // The last step changed all of them again, and the unit.
    assert_eq!((converted.edited[&RecordKind::Point], converted.edited[&RecordKind::Feed]), (3, 1));
    assert_eq!(converted.edited[&RecordKind::Structure], 1);
}

#[test]
fn what_one_step_puts_in_and_the_next_edits_or_takes_out_counts_for_both() {
    let text = "UNITS/MM\nFEDRAT/1000.0,MMPM\nGOTO/0.0,0.0,0.0\nGOTO/20.0,0.0,0.0\n";
    let insert = "  - rewrite: { rules: [ { match: \"UNITS/MM\", insert_after: \"COOLNT/ON\" } ] }\n";
    let edit = "  - rewrite: { rules: [ { match: \"COOLNT/ON\", replace: \"COOLNT/MIST\" } ] }\n";
    let delete = "  - rewrite: { rules: [ { match: \"COOLNT/MIST\", delete: true } ] }\n";
    let recipe = format!("version: 1\nsteps:\n{insert}{edit}{delete}");
    let recipe = Recipe::load(&Source::new("recipe.yaml", recipe.into()).unwrap()).unwrap();
    let outcome = run_recipe(&recipe, &Setup::default(), program(text)).unwrap();
    let found = RecipeChanges::from_programs(&program(text), &outcome.program, &recipe.step_names(), None);
    let sum = |map: &std::collections::BTreeMap<RecordKind, usize>| map.values().sum::<usize>();
    let counts: Vec<_> =
        found.steps.iter().map(|step| (sum(&step.inserted), sum(&step.edited), sum(&step.deleted))).collect();
    assert_eq!(counts, [(1, 0, 0), (0, 1, 0), (0, 0, 1)]);
}

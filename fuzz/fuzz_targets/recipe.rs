//! Any bytes as a recipe: refused with a place, or run on a small program, which then reads back.

#![no_main]

use clsmith::job::CorrectionJob;
use clsmith::parse::parse;
use clsmith::report::finding_policy::FindingPolicy;
use clsmith::setup::Setup;
use clsmith::simulation_run::SilentWatcher;
use clsmith::source::Source;
use clsmith::transform::Recipe;
use libfuzzer_sys::fuzz_target;

const PART: &[u8] = include_bytes!("../../examples/pocket/part.cls");

fuzz_target!(|bytes: &[u8]| {
    let Ok(source) = Source::new("recipe.yaml", bytes.to_vec()) else { return };
    let recipe = match Recipe::load(&source) {
        Ok(recipe) => recipe,
        Err(failure) => {
            let found = failure.findings();
            assert!(!found.is_empty(), "refused without a word");
            for label in found.iter().flat_map(|found| &found.labels) {
                assert!(label.span.end as usize <= bytes.len(), "a place outside the recipe");
            }
            return;
        }
    };
    let part = Source::new("part.cls", PART.to_vec()).expect("a small file");
    let (setup, policy) = (Setup::default(), FindingPolicy::default());
    let watch = &SilentWatcher;
    let job = CorrectionJob::new(&recipe, &setup, &policy).with_watcher(watch);
    let Ok(program) = job.correct_source(&part).map(|outcome| outcome.program) else { return };
    let again = Source::new("again.cls", program.to_bytes()).expect("a small file");
    let read = parse(&again, Some(program.dialect()));
    assert!(read.diagnostics.iter().all(|found| !found.is_error()), "{:?}", read.diagnostics);
    assert_eq!(read.program.statements().len(), program.live_statements().count(), "the output reads as other statements");
});

//! After a step, only lints that look at what changed run again. The list is that of all of them.

use crate::support;
use clsmith::check::check_program;
use clsmith::diagnostic::Diagnostic;
use clsmith::internals::check::recheck_program;
use clsmith::parse::parse;
use clsmith::program::{Dialect, Program};
use clsmith::recipe::Recipe;
use clsmith::setup::Setup;
use clsmith::source::Source;
use clsmith::transform::run_recipe;
use proptest::prelude::*;
use std::fmt::Write;
use std::path::PathBuf;

/// Steps that change feeds alone, to values of all kinds, and steps that change more.
const STEPS: &[&str] = &[
    "scale_feed: { factor: 0.5 }",
    "scale_feed: { factor: 1.0e-7 }",
    "scale_feed: { factor: 1000, where: { threads: true } }",
    "clamp_feed: { min: 200, max: 210 }",
    "convert_units: { to: inch }",
    "move_origin: { translate: [10, -20, 5.5] }",
    "scale_feed: { factor: 2 } }\n  - { move_origin: { mirror: x }",
];

/// A step's outcome, or nothing where the step refuses the program.
fn run_step(step: &str, program: &Program) -> Option<Program> {
    let text = format!("version: 1\nunits: mm\nsteps:\n  - {{ {step} }}\n");
    let recipe = Recipe::load(&Source::new("recipe.yaml", text.into_bytes()).unwrap()).unwrap();
    run_recipe(&recipe, &Setup::default(), program.clone()).ok().map(|outcome| outcome.program)
}

/// Everything that a person sees of findings.
fn describe(found: &[Diagnostic]) -> Vec<String> {
    let describe = |found: &Diagnostic| {
        let mut text = format!("{} {:?} {} {:?}", found.code, found.severity, found.message, found.help);
        for label in &found.labels {
            let _ = write!(text, " [{}: {:?} {}]", label.source.name(), label.span, label.message);
        }
        text
    };
    found.iter().map(describe).collect()
}

/// Compares both lists behind each step; returns behind how many something was compared.
fn compare_lists(program: &Program) -> usize {
    let before = check_program(program);
    let compare = |step: &&&str| {
        let Some(after) = run_step(step, program) else { return false };
        let again = recheck_program(&after, before.clone());
        assert_eq!(describe(&again), describe(&check_program(&after)), "{step}");
        true
    };
    STEPS.iter().filter(compare).count()
}

/// The shared cases that are programs.
fn cases() -> Vec<PathBuf> {
    let Some(folder) = support::require_shared_folder("cases") else { return Vec::new() };
    let entries = std::fs::read_dir(folder).unwrap().flatten().map(|entry| entry.path());
    entries.filter(|path| path.is_file() && path.extension().is_none_or(|ext| ext != "yaml")).collect()
}

#[test]
fn a_recheck_of_what_changed_gives_the_list_of_all_lints() {
    let fixtures = support::fixtures().into_iter().map(|(_, path)| path);
    let files = fixtures.chain(support::require_corpus().into_iter().flatten()).chain(cases());
    let mut compared = 0;
    for path in files {
        let parsed = parse(&support::source(&path), None);
        if !parsed.refused {
            compared += compare_lists(&parsed.program);
        }
    }
    assert!(compared > 100, "{compared}");
}

/// Statements with feeds in all units, and what lints compare with them.
fn statement() -> impl Strategy<Value = String> {
    let feed =
        prop_oneof![Just("0"), Just("0.2000"), Just("0.4"), Just("30.0"), Just("800."), Just("90000.0")];
    let unit = prop::sample::select(vec!["", "MMPM,", "IPM,", "MMPR,", "IPR,", "PERMIN,", "INVERS,"]);
    prop_oneof![
        4 => (unit, feed.clone()).prop_map(|(unit, feed)| format!("FEDRAT/{unit}{feed}")),
        2 => feed.prop_map(|feed| format!("CYCLE/DRILL,RAPTO,3.0,FEDTO,-5.0,MMPM,{feed}")),
        1 => Just("CYCLE/TAP,RAPTO,3.0,FEDTO,-5.0,MMPM,1000.0".to_owned()),
        1 => Just("CYCLE/OFF".to_owned()),
        6 => (-9..9_i32, -9..9_i32).prop_map(|(x, y)| format!("GOTO/{x}.0000,{y}.0000,0.0000")),
        1 => Just("CIRCLE/0.0,0.0,0.0,0.0,0.0,-1.0,4.0".to_owned()),
        1 => Just("RAPID".to_owned()),
        1 => prop::sample::select(vec!["SPINDL/RPM,1000,CLW", "SPINDL/OFF", "SPINDL/SFM,200,CLW"])
            .prop_map(str::to_owned),
        1 => prop::sample::select(vec!["COOLNT/ON", "COOLNT/OFF", "UNITS/MM", "UNITS/INCHES", "CUTCOM/LEFT"])
            .prop_map(str::to_owned),
        1 => prop::sample::select(vec!["TOOL PATH/A,TOOL,TAP M10X1.5", "END-OF-PATH", "LOAD/TOOL,2", "GOHOME"])
            .prop_map(str::to_owned),
        1 => prop::sample::select(vec!["PAINT/COLOR,31", "PAINT/COLOR,42", "FINI", "$$ text", "LATHE/ROUGH"])
            .prop_map(str::to_owned),
    ]
}

proptest! {
    #![proptest_config(support::property(300))]

    #[test]
    fn a_recheck_gives_the_list_of_all_lints_whatever_the_program(
        statements in prop::collection::vec(statement(), 1..40),
        crlf in any::<bool>(),
        dialect in prop::sample::select(vec![Dialect::Nx, Dialect::Iso, Dialect::CreoGpost]),
    ) {
        let end = if crlf { "\r\n" } else { "\n" };
        let text = statements.join(end);
        let parsed = parse(&support::text(text), Some(dialect));
        prop_assert!(!parsed.refused);
        compare_lists(&parsed.program);
    }
}

//! The library in a browser: it opens, compares and corrects programs, and hands over what the viewer's page shows.
//!
//! The worker of the page calls it ([`give_file`], then one of [`open_program`], [`compare_programs`] and
//! [`apply_recipe`]). All files come from the page and all results go to it; nothing else can be reached from here.

mod loaded_files;
mod opened_page;
mod page_watcher;

use clsmith::check::CheckedProgram;
use clsmith::fingerprint::RecipeFingerprint;
use clsmith::job::JobOutcome;
use clsmith::parse::parse_with_vocabulary;
use clsmith::recipe::Provenance;
use clsmith::report::comparison::{Comparison, ComparisonRuns, ComparisonSubject};
use clsmith::report::stats::ResolvedLengthUnit;
use clsmith::simulation_run::{RunPhase, RunWatcher, SimulationRunOptions};
use clsmith::transform::check_with_setup;
use clsmith::{CorrectionJob, Diagnostic, Failure, FindingPolicy, LengthUnit, Program, Setup, Source};
use js_sys::Object;
use loaded_files::{LoadedRecipe, LoadedSetup, read_program};
use opened_page::{build_failure, build_page};
use page_watcher::PageWatcher;
use std::sync::Arc;
use wasm_bindgen::prelude::wasm_bindgen;

/// Tells the worker what a defect says about itself, before the module stops.
#[wasm_bindgen(start)]
pub fn start() {
    std::panic::set_hook(Box::new(|defect| page_watcher::tell_defect(&defect.to_string())));
}

/// Hands over a file that recipes and setups may name: a machine, a material, a model, a stock.
#[wasm_bindgen]
pub fn give_file(name: String, bytes: Vec<u8>) {
    clsmith::source::give_file(name, bytes);
}

/// Opens a program: what is in it, and what is wrong with it. `setup` is the name of a given file; with its stock the
/// program is simulated.
#[wasm_bindgen]
pub fn open_program(name: &str, bytes: Vec<u8>, setup: Option<String>) -> Object {
    finish(|watch| {
        let source = read_program(name, bytes)?;
        let setup = LoadedSetup::read_given(setup.as_deref())?;
        watch.begin_phase(RunPhase::Reading);
        let judged = JudgedProgram::read_source(&source, &setup.setup);
        let subject =
            ComparisonSubject { findings: &judged.findings, ..describe_program(&judged.program, &setup) };
        show(subject, find_obstacle(&[&judged], &setup), watch)
    })
}

/// Compares two programs: the first is shown as the one before.
#[wasm_bindgen]
pub fn compare_programs(
    first: &str,
    first_bytes: Vec<u8>,
    second: &str,
    second_bytes: Vec<u8>,
    setup: Option<String>,
) -> Object {
    finish(|watch| {
        let setup = LoadedSetup::read_given(setup.as_deref())?;
        watch.begin_phase(RunPhase::Reading);
        let before = JudgedProgram::read_source(&read_program(first, first_bytes)?, &setup.setup);
        let after = JudgedProgram::read_source(&read_program(second, second_bytes)?, &setup.setup);
        let subject = ComparisonSubject {
            before: Some(&before.program),
            findings: &after.findings,
            ..describe_program(&after.program, &setup)
        };
        show(subject, find_obstacle(&[&before, &after], &setup), watch)
    })
}

/// Corrects a program by a recipe, as `clsmith apply` does. The corrected program is in what is returned, unless an error
/// was found.
#[wasm_bindgen]
pub fn apply_recipe(recipe: &str, name: &str, bytes: Vec<u8>, setup: Option<String>) -> Object {
    finish(|watch| {
        let LoadedRecipe { recipe, setup, texts } = LoadedRecipe::read_given(recipe, setup.as_deref())?;
        // The header of a recipe with `provenance:` holds the fingerprint; without one, nothing needs it.
        let needed = recipe.provenance != Provenance::None;
        let print = needed.then(|| RecipeFingerprint::read_files(&texts, &recipe, &setup)).transpose()?;
        let source = read_program(name, bytes)?;
        let policy = FindingPolicy::default();
        let job = CorrectionJob::new(&recipe, &setup, &policy).with_print(print.as_ref()).with_watcher(watch);
        let read = || parse_with_vocabulary(&source, None, &setup.vocabulary).program;
        let outcome = match job.try_source(&source) {
            Ok(outcome) => outcome,
            Err(Failure::Interrupted) => return Err(Failure::Interrupted),
            // A refused program is still shown, because the page shows what is wrong with it.
            Err(Failure::Found(findings)) => {
                JobOutcome { program: read(), findings, reports: Vec::new(), simulation: None }
            }
        };
        let output = if outcome.is_refused() { None } else { Some(outcome.program.to_bytes()) };
        let before =
            parse_with_vocabulary(&source, Some(outcome.program.dialect()), outcome.program.vocabulary());
        let digits = print.as_ref().map(|print| print.sha256.to_string());
        let subject = ComparisonSubject {
            before: Some(&before.program),
            program: &outcome.program,
            recipe: Some(&recipe),
            setup: &setup,
            setup_files: texts.get(1..).unwrap_or_default(),
            units: Some(recipe.units),
            shown_in: None,
            findings: &outcome.findings,
            reports: &outcome.reports,
            print: digits.as_deref(),
        };
        let options = SimulationRunOptions::default();
        let runs = ComparisonRuns::simulate_subject(&subject, outcome.simulation, &options, watch)?;
        watch.begin_drawing();
        build_page(&Comparison::from_runs(subject, &runs), output)
    })
}

/// Runs one piece of work. What stops it is shown as the command would print it.
fn finish(work: impl FnOnce(&PageWatcher) -> Result<Object, Failure>) -> Object {
    work(&PageWatcher::default()).unwrap_or_else(|failure| build_failure(&failure.into_findings()))
}

/// A program with all that is wrong with it.
struct JudgedProgram {
    program: Program,
    findings: Vec<Diagnostic>,
}

impl JudgedProgram {
    /// Reads and checks a program, and asks the setup about it, as `clsmith check --setup` does.
    fn read_source(source: &Arc<Source>, setup: &Setup) -> Self {
        let CheckedProgram { program, of_reading, of_checks } =
            CheckedProgram::read_source(source, None, &setup.vocabulary);
        let policy = FindingPolicy::default();
        let mut findings = of_reading;
        let is_unread = policy.apply(findings.clone()).iter().any(Diagnostic::is_error);
        findings.extend(of_checks);
        if !is_unread {
            let unit = ResolvedLengthUnit::from_program(&program, None).unit;
            findings.extend(check_with_setup(&program, setup, unit));
        }
        Self { program, findings: policy.apply(findings) }
    }
}

/// Returns why programs are not simulated, if it is known before anything was computed.
fn find_obstacle(programs: &[&JudgedProgram], setup: &LoadedSetup) -> Option<&'static str> {
    if programs.iter().any(|judged| judged.findings.iter().any(Diagnostic::is_error)) {
        return Some("a program with errors is not simulated");
    }
    setup.texts.is_empty().then_some("a simulation needs a setup with stock: drop one")
}

/// Returns the inputs of the page of a program alone, without findings.
fn describe_program<'a>(program: &'a Program, setup: &'a LoadedSetup) -> ComparisonSubject<'a> {
    ComparisonSubject {
        before: None,
        program,
        recipe: None,
        setup: &setup.setup,
        setup_files: &setup.texts,
        units: None,
        shown_in: None::<LengthUnit>,
        findings: &[],
        reports: &[],
        print: None,
    }
}

/// Simulates what can be simulated, and makes the page. What the simulation finds is among the findings.
fn show(
    subject: ComparisonSubject<'_>,
    obstacle: Option<&str>,
    watch: &PageWatcher,
) -> Result<Object, Failure> {
    let options = SimulationRunOptions::default();
    let runs = match obstacle {
        None => ComparisonRuns::simulate_subject(&subject, None, &options, watch)?,
        Some(obstacle) => {
            ComparisonRuns { missing: vec![obstacle.to_owned()], ..ComparisonRuns::default() }
        }
    };
    let mut findings = subject.findings.to_vec();
    if let Some(simulated) = &runs.after {
        findings.extend(FindingPolicy::default().apply(simulated.findings.clone()));
    }
    watch.begin_drawing();
    let subject = ComparisonSubject { findings: &findings, ..subject };
    build_page(&Comparison::from_runs(subject, &runs), None)
}

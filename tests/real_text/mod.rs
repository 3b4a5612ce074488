//! CL text as shops write it: small programs that are healthy but for the one thing each is about.
//!
//! The fixtures here are the tests' own. `cases` reads the programs of `../shared/cases` too, whose right values stand
//! there beside them.

mod broken_lines;
mod card_columns;
mod cases;
mod curves;
mod field_breaks;
mod harmless_records;
mod lengths;
mod names_and_labels;
mod odd_lines;
mod own_words;
mod proofs;
pub mod record_table;
mod threads;
mod turning;

use crate::support;
use crate::transform::try_apply;
use clsmith::check::read_and_check;
use clsmith::program::Program;
use clsmith::program::motion::Motion;

/// A program read from text, whatever is found in it.
fn read(text: impl AsRef<[u8]>) -> Program {
    clsmith::parse::parse(&support::text(text), None).program
}

/// The findings of a check that are no notes: their codes with the numbers of their lines.
#[track_caller]
fn alarms(text: impl AsRef<[u8]>) -> Vec<(String, usize)> {
    findings(text, false)
}

/// The findings of a check, with notes or without.
fn findings(text: impl AsRef<[u8]>, notes: bool) -> Vec<(String, usize)> {
    let source = support::text(text);
    let (program, found) = read_and_check(&source, None);
    assert_eq!(program.to_bytes(), source.bytes(), "every byte is kept");
    let line = |at: usize| source.bytes()[..at].iter().filter(|byte| **byte == b'\n').count() + 1;
    let place = |found: &clsmith::diagnostic::Diagnostic| {
        found.labels.first().map_or(0, |label| line(label.span.start as usize))
    };
    let wanted = found.iter().filter(|found| notes || found.severity > clsmith::diagnostic::Severity::Note);
    wanted.map(|found| (found.code.to_string(), place(found))).collect()
}

/// The lengths of a program at feed and at rapid, and its seconds at feed (feeds in mm/min or mm/rev).
fn totals(program: &Program) -> (f64, f64, f64) {
    let seconds = |motion: &Motion| {
        let feed = motion.feed.and_then(|feed| {
            feed.mm_per_minute(clsmith::program::LengthUnit::Mm, motion.spindle_rpm(), Some(motion.length()))
        });
        motion.length() / feed.unwrap_or(f64::INFINITY) * 60.0
    };
    let sum = |rapid: bool, of: &dyn Fn(&Motion) -> f64| -> f64 {
        program.motions().filter(|motion| motion.rapid == rapid).map(|motion| of(&motion)).sum()
    };
    (sum(false, &Motion::length), sum(true, &Motion::length), sum(false, &seconds))
}

#[track_caller]
fn assert_near(what: &str, found: f64, wanted: f64) {
    assert!((found - wanted).abs() <= 0.01_f64.max(wanted * 1e-5), "{what}: {found}, not {wanted}");
}

/// Applies the steps (the YAML below `steps:`) to a text.
#[track_caller]
fn apply(steps: &str, text: impl AsRef<[u8]>) -> String {
    match try_apply(&format!("version: 1\nsteps:\n{steps}"), text) {
        Ok((text, _)) => text,
        Err(found) => panic!("{found:?}"),
    }
}

/// Applies the steps to a text in the words of a shop, a flow map of YAML. What is allowed is passed on.
#[track_caller]
fn apply_in_words(
    words: &str,
    steps: &str,
    text: impl AsRef<[u8]>,
) -> (String, Vec<clsmith::diagnostic::Diagnostic>) {
    let recipe = support::text(format!("version: 1\nsetup: {{ words: {words} }}\nsteps:\n{steps}"));
    let recipe = clsmith::transform::Recipe::load(&recipe).unwrap();
    let policy = clsmith::report::finding_policy::FindingPolicy::default();
    let job = clsmith::job::CorrectionJob::new(&recipe, &recipe.setup, &policy);
    let outcome = job.correct_source(&support::text(text)).unwrap_or_else(|failure| panic!("{failure:?}"));
    (String::from_utf8(outcome.program.to_bytes()).unwrap(), outcome.findings)
}

const HALF: &str = "  - scale_feed: { factor: 0.5 }\n";
const MOVE: &str = "  - move_origin: { translate: [5, -3, 2] }\n";
const TO_INCH: &str = "  - convert_units: { from: mm, to: inch }\n";

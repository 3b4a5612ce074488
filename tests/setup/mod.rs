//! Setups: what they mean, what is said about broken ones, and the cutters that come of them.

mod cutters;
mod faults;
mod gaps;
mod hostile;
mod materials;
mod merging;
mod reading;
mod stiffness;
mod teeth;

use crate::support::snapshots;
use clsmith::diagnostic::{Diagnostic, Failure};
use clsmith::program::motion::ActiveTool;
use clsmith::report::render::human::{HumanRenderOptions, render_human};
use clsmith::setup::Setup;
use clsmith::source::Source;
use std::sync::Arc;

fn source(text: impl AsRef<[u8]>) -> Arc<Source> {
    Source::new("shop/setup.yaml", text.as_ref().to_vec()).unwrap()
}

/// Reads a setup file.
fn load(text: impl AsRef<[u8]>) -> Result<Setup, Vec<Diagnostic>> {
    Setup::load(&source(text)).map_err(Failure::into_findings)
}

#[track_caller]
fn good(text: &str) -> Setup {
    load(text).unwrap_or_else(|found| panic!("{}", draw(&found)))
}

/// The tool in force at the end of a program.
fn tool(program: &str) -> ActiveTool {
    let program = crate::support::program(program);
    let mut motions = program.motions();
    while motions.next().is_some() {}
    motions.state().tool.as_deref().cloned().unwrap_or_default()
}

/// Findings as a person sees them.
fn draw(found: &[Diagnostic]) -> String {
    let mut out = Vec::new();
    let options = HumanRenderOptions::default().with_context_lines(0).with_per_code(0);
    render_human(&mut out, found, None, &options).unwrap();
    String::from_utf8(out).unwrap()
}

/// Compares findings as a person sees them with a snapshot.
#[track_caller]
fn seen(name: &str, found: &[Diagnostic]) {
    snapshots("setup").bind(|| insta::assert_snapshot!(name, draw(found)));
}

#[track_caller]
fn close(found: f64, wanted: f64) {
    // Products and sines of a few numbers: the last digits.
    assert!((found - wanted).abs() <= 1e-9 * wanted.abs().max(1.0), "{found} instead of {wanted}");
}

//! Recipes: what they mean, and what is said about broken ones.

mod faults;
mod hostile;
mod places;
mod reading;
mod schema;
mod select;

use clsmith::diagnostic::{Diagnostic, Failure};
use clsmith::recipe::parameters::{Factor, Finite, Fraction, Glob, Positive};
use clsmith::recipe::{MotionFilter, Recipe};
use clsmith::source::Source;
use schemars::JsonSchema;
use serde::Deserialize;
use std::fmt::Write;
use std::sync::Arc;

/// Steps to test with.
#[derive(Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Step {
    /// Multiplies feeds.
    ScaleFeed(ScaleFeed),
    /// Replaces text.
    Rewrite {
        /// The rules, first to last.
        rules: Vec<Rule>,
    },
    /// Everything has a default.
    Shift(Shift),
    /// Nothing to set.
    Reverse,
}

#[derive(Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ScaleFeed {
    #[serde(default, rename = "where")]
    pub part: MotionFilter,
    /// What feeds are multiplied by.
    pub factor: Factor,
    pub share: Option<Fraction>,
}

#[derive(Debug, PartialEq, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Rule {
    pub find: Glob,
    pub replace: String,
    #[serde(default)]
    pub once: bool,
}

#[derive(Debug, PartialEq, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Shift {
    pub by: Option<[Finite; 3]>,
    pub limit: Option<Positive>,
}

pub fn source(text: impl AsRef<[u8]>) -> Arc<Source> {
    Source::new("recipe.yaml", text.as_ref().to_vec()).unwrap()
}

pub fn load(text: impl AsRef<[u8]>) -> Result<Recipe<Step>, Vec<Diagnostic>> {
    Recipe::load(&source(text)).map_err(Failure::into_findings)
}

#[track_caller]
pub fn good(text: &str) -> Recipe<Step> {
    load(text).unwrap_or_else(|found| panic!("{}", describe(&found)))
}

/// The faults of a recipe that has some.
#[track_caller]
pub fn bad(text: impl AsRef<[u8]>) -> Vec<Diagnostic> {
    load(text).expect_err("a recipe with faults")
}

/// Asserts that a recipe has one fault, with this code, underlining exactly this text.
#[track_caller]
pub fn fault(text: &str, code: &str, underlined: &str) {
    let found = bad(text);
    let seen: Vec<(&str, String)> = found.iter().map(|d| (d.code.id(), underlined_by(d))).collect();
    assert_eq!(seen, [(code, underlined.to_owned())], "{}", describe(&found));
}

/// A recipe of one step.
pub fn step(step: &str) -> String {
    format!("version: 1\nsteps:\n  - {step}\n")
}

pub fn underlined_by(diagnostic: &Diagnostic) -> String {
    let label = &diagnostic.labels[0];
    String::from_utf8_lossy(label.source.slice(label.span)).into_owned()
}

/// Diagnostics as a person would read them: code, message, place, what is underlined, help.
pub fn describe(diagnostics: &[Diagnostic]) -> String {
    let mut text = String::new();
    for diagnostic in diagnostics {
        writeln!(text, "{} {}", diagnostic.code, diagnostic.message).unwrap();
        for label in &diagnostic.labels {
            let (line, column) = label.source.line_column(label.span.start);
            let underlined = String::from_utf8_lossy(label.source.slice(label.span));
            writeln!(text, "  {line}:{column} {underlined:?} {}", label.message).unwrap();
        }
        if let Some(help) = &diagnostic.help {
            writeln!(text, "  help: {help}").unwrap();
        }
    }
    text
}

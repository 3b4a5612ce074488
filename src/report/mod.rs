//! What a run has to say: findings filtered, sorted and rendered.
//!
//! [`policy`] decides which findings stand and how bad they are, [`render`] turns them into text, and [`explain`] answers
//! questions about a code. [`stats`] measures a program, [`diff`] compares two by meaning, [`unified`] shows what steps made
//! of one as a patch, and [`changes`] counts it. [`simulation`] presents what tools cut and bear, [`chips`] what
//! they cut layer by layer. Everything is written into a writer that the caller hands in, or returned.

pub mod changes;
pub mod chips;
pub mod comparison;
mod compensated;
pub mod diff;
pub mod explain;
pub mod html;
pub mod kind;
pub mod picture;
pub mod plot;
pub mod policy;
mod ramps;
pub mod render;
mod round;
pub mod simulation;
pub mod stats;
pub mod step_report;
pub mod steps;
pub mod surfacing;
pub(crate) mod table;
pub mod unified;

use crate::program::motion::Tool;
use crate::program::{Change, Program, Statement};
use serde::Serialize;

/// A report as one JSON document, indented and with a line end.
fn json_text(report: &impl Serialize) -> String {
    // Strings, numbers and lists always serialize; only a writer or a map with odd keys could fail.
    let mut text = serde_json::to_string_pretty(report).unwrap_or_default();
    text.push('\n');
    text
}

/// The 1-based line a statement stands on in its file; `None` for one that was not in the file.
fn line_of(program: &Program, statement: &Statement) -> Option<usize> {
    let in_file = !matches!(statement.change(), Change::Inserted(_));
    in_file.then(|| program.source().line_column(statement.origin().start).0)
}

/// A tool by its number where it is known, else by its name; empty for one of which nothing is known.
fn tool_name(tool: Option<&Tool>) -> String {
    let named = tool.and_then(|tool| {
        let number = tool.number.map(|number| number.to_string());
        number.or_else(|| tool.name.clone())
    });
    named.unwrap_or_default()
}

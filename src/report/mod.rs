//! This module reports the results of a run: findings, tables, pages and drawings.
//!
//! [`finding_policy`] decides which findings are shown with which severity, [`render`] turns them into text,
//! and [`explain`] explains a code. [`stats`] measures a program, [`diff`] compares two by meaning,
//! [`unified_diff`] shows what steps have made of one as a patch, and [`changes`] counts it. [`simulation`]
//! presents what tools cut and how they are loaded, and [`layered_chips`] what they cut layer by layer, [`machine_axes`] what the machine does.
//! [`comparison`] sets a program before and after side by side, [`html`] makes a page of that, and [`plot`]
//! draws curves. Everything is returned, or written to a writer of the caller.

pub mod calibration;
pub mod changes;
pub mod comparison;
pub mod diff;
mod escaping;
pub mod explain;
pub mod finding_policy;
pub mod html;
pub mod layered_chips;
pub mod machine_axes;
mod machine_time;
pub mod material_table;
pub mod measured_times;
pub(crate) mod motion_measure;
pub mod path_drawing;
pub mod plot;
pub mod render;
mod rounding;
mod schema_wording;
pub mod simulation;
pub mod starter_document;
pub mod starter_files;
pub mod stats;
pub mod step_descriptions;
pub mod surface_document;
pub mod surface_milling;
mod svg_chart;
pub(crate) mod table;
pub mod unified_diff;

pub use crate::presentation::display_units::DisplayUnits;
pub(crate) use crate::presentation::text_format;
pub use crate::presentation::{safe_json, to_safe_line};

use crate::presentation::safe_json::write_json_pretty;
use crate::program::motion::ActiveTool;
use crate::program::{Program, Statement, StatementChange};
use serde::Serialize;

/// Returns a report as a JSON document, indented and with a line end.
pub(crate) fn to_json_text(report: &impl Serialize) -> String {
    // Serializing fails only if the writer fails or the keys of a map are no text. Neither happens here.
    let mut text = Vec::new();
    let written = write_json_pretty(&mut text, report);
    debug_assert!(written.is_ok(), "{written:?}");
    text.push(b'\n');
    String::from_utf8(text).unwrap_or_default()
}

/// Returns the line of a statement in its file, counted from 1. Returns `None` for one that was not in the
/// file.
fn statement_line(program: &Program, statement: &Statement) -> Option<usize> {
    let in_file = !matches!(statement.change(), StatementChange::Inserted(_));
    in_file.then(|| program.source().line_column(statement.origin().start).0)
}

/// Returns a tool's number if it is known, else its name. The text is empty if neither is known.
fn tool_name(tool: Option<&ActiveTool>) -> String {
    let named = tool.and_then(|tool| {
        let number = tool.number.map(|number| number.to_string());
        number.or_else(|| tool.name.clone())
    });
    named.unwrap_or_default()
}

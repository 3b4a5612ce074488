//! This module writes what `clsmith init` found in a program, and what it wrote, as JSON.

use super::render::json::FindingsJson;
use super::stats::ProgramStats;
use crate::diagnostic::Diagnostic;
use serde::Serialize;

/// The JSON document of `init`. `version` goes up when a reader of the old structure would fail. New keys may
/// be added without that.
#[derive(Debug, Serialize)]
struct StarterDocument<'a> {
    version: u32,
    file: &'a str,
    /// Tools, operations, box, feeds and unit, as `stats` tells them; `null` if nothing was written because
    /// of errors.
    program: Option<&'a ProgramStats>,
    /// The words of the program that are not known.
    unknown_words: &'a [String],
    /// The files that were written.
    written: &'a [String],
    findings: FindingsJson<'a>,
}

/// Returns what was found in a program and which files were written, as a JSON document with a line end.
/// `findings` are those of the run, after the policy.
pub fn starter_to_json(
    file: &str,
    found: Option<(&ProgramStats, &[String])>,
    written: &[String],
    findings: &[Diagnostic],
) -> String {
    super::to_json_text(&StarterDocument {
        version: 1,
        file,
        program: found.map(|(stats, _)| stats),
        unknown_words: found.map(|(_, words)| words).unwrap_or_default(),
        written,
        findings: FindingsJson::from_findings(findings),
    })
}

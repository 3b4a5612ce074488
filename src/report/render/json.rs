//! This module writes findings as JSON, for programs.
//!
//! ```json
//! {
//!   "version": 1,
//!   "diagnostics": [
//!     {
//!       "code": "CL0003",
//!       "severity": "error",
//!       "allowed": false,
//!       "step": null,
//!       "message": "`1.2.3` is not a number",
//!       "help": "Numbers are digits with at most one decimal point.",
//!       "labels": [
//!         {
//!           "file": "part.cls",
//!           "start": { "line": 7, "column": 6, "offset": 112 },
//!           "end": { "line": 7, "column": 11, "offset": 117 },
//!           "message": "two decimal points",
//!           "text": "1.2.3"
//!         }
//!       ]
//!     }
//!   ],
//!   "counts": { "errors": 1, "warnings": 0, "notes": 0, "allowed": 0 }
//! }
//! ```
//!
//! `severity` is `error`, `warning` or `note`. `allowed` is true if `--allow` named the code: then the
//! finding stops nothing and is only counted as allowed. `step` is the number of the recipe's step that found
//! it, where the first step is 1. The first label is the primary one; `labels` is empty for findings about a
//! whole file or run. `help` is `null` if there is none, and the `message` of a label may be empty.
//!
//! Lines and columns count from 1, offsets from 0. Columns and offsets count bytes, and `end` is one past the
//! last byte. `text` is the text of the file between `start` and `end`; it is `null` if that is longer than
//! 1000 bytes. Bytes that are not UTF-8 are read as Latin-1.
//!
//! `version` goes up when a reader of the old structure would fail. New keys may be added without that.

use super::SeverityCounts;
use crate::diagnostic::{Diagnostic, DiagnosticLabel};
use crate::presentation::safe_json::write_json_pretty;
use crate::presentation::safe_text;
use crate::source::Source;
use serde::Serialize;
use std::io::{self, Write};

const LONGEST_TEXT: usize = 1000;

/// Writes all findings as a JSON document, indented and with a line end.
///
/// # Errors
/// Returns the errors of the writer.
pub fn render_json(out: &mut dyn Write, diagnostics: &[Diagnostic]) -> io::Result<()> {
    write_json_pretty(&mut *out, &FindingsJson::from_findings(diagnostics))?;
    writeln!(out)
}

/// All findings of a run as a JSON document or a part of one; every output that has findings has them in this
/// form.
#[derive(Debug, Serialize)]
pub struct FindingsJson<'a> {
    version: u32,
    diagnostics: Vec<FindingJson<'a>>,
    counts: SeverityCountsJson,
}

impl<'a> FindingsJson<'a> {
    /// Takes the findings of a run, as the policy left them.
    pub fn from_findings(diagnostics: &'a [Diagnostic]) -> Self {
        Self {
            version: 1,
            diagnostics: diagnostics.iter().map(to_finding_json).collect(),
            counts: SeverityCounts::from_findings(diagnostics).into(),
        }
    }
}

/// A report that is a JSON object, with the findings of its run under one more key.
#[derive(Serialize)]
struct ReportWithFindings<'a, R> {
    #[serde(flatten)]
    report: &'a R,
    findings: FindingsJson<'a>,
}

/// Returns a report as a JSON document, with the findings of its run under the key `findings`. The text is
/// indented and has a line end.
pub(in crate::report) fn report_to_json(report: &impl Serialize, findings: &[Diagnostic]) -> String {
    let findings = FindingsJson::from_findings(findings);
    crate::report::to_json_text(&ReportWithFindings { report, findings })
}

/// What is known of a file that could not be analysed.
#[derive(Serialize)]
struct RefusedFile<'a> {
    version: u32,
    file: &'a str,
}

/// Returns the JSON document of an analysis that findings have stopped: version, name of the file and the
/// findings. It has none of the keys that tell results.
pub fn refusal_to_json(file: &str, findings: &[Diagnostic]) -> String {
    report_to_json(&RefusedFile { version: 1, file }, findings)
}

#[derive(Debug, Serialize)]
struct FindingJson<'a> {
    code: &'static str,
    severity: String,
    allowed: bool,
    step: Option<usize>,
    message: &'a str,
    help: Option<&'a str>,
    labels: Vec<FindingLabelJson<'a>>,
}

#[derive(Debug, Serialize)]
struct FindingLabelJson<'a> {
    file: &'a str,
    start: SourcePositionJson,
    end: SourcePositionJson,
    message: &'a str,
    text: Option<String>,
}

#[derive(Debug, Serialize)]
struct SourcePositionJson {
    line: usize,
    column: usize,
    offset: u32,
}

#[derive(Debug, Serialize)]
struct SeverityCountsJson {
    errors: usize,
    warnings: usize,
    notes: usize,
    allowed: usize,
}

impl From<SeverityCounts> for SeverityCountsJson {
    fn from(SeverityCounts { errors, warnings, notes, allowed }: SeverityCounts) -> Self {
        Self { errors, warnings, notes, allowed }
    }
}

fn to_finding_json(found: &Diagnostic) -> FindingJson<'_> {
    FindingJson {
        code: found.code.id(),
        severity: found.severity.to_string(),
        allowed: found.is_allowed,
        step: found.step,
        message: &found.message,
        help: found.help.as_deref(),
        labels: found.labels.iter().map(to_label_json).collect(),
    }
}

fn to_label_json(label: &DiagnosticLabel) -> FindingLabelJson<'_> {
    let bytes = label.source.slice(label.span);
    let text =
        (bytes.len() <= LONGEST_TEXT).then(|| safe_text::decode_characters(bytes).map(|(c, _)| c).collect());
    FindingLabelJson {
        file: label.source.name(),
        start: to_position_json(&label.source, label.span.start),
        end: to_position_json(&label.source, label.span.end),
        message: &label.message,
        text,
    }
}

fn to_position_json(source: &Source, offset: u32) -> SourcePositionJson {
    let (line, column) = source.line_column(offset);
    SourcePositionJson { line, column, offset }
}

//! This module writes the results of a batch as one JSON document.

use super::{BatchRecord, batch_results::ResultsHead};
use crate::diagnostic::Diagnostic;
use crate::report::render::json::FindingsJson;
use crate::report::to_json_text;
use serde::Serialize;

/// The JSON document of `batch`. `version` goes up when a reader of the old structure would fail. New keys may
/// be added without that.
#[derive(Serialize)]
struct BatchDocument<'a> {
    version: u32,
    /// The first line of the results; `null` if the batch was refused before it began.
    batch: Option<&'a ResultsHead>,
    /// How many of the files an earlier run had finished.
    done_before: usize,
    /// The other lines of the results. Each counts its findings by code.
    files: Vec<BatchRecord>,
    /// The findings about the batch itself.
    findings: FindingsJson<'a>,
}

/// Returns the results of a batch as one JSON document, indented and with a line end: what the results file
/// has, and the findings about the batch itself. `before` is the number of files that an earlier run had
/// finished. `times` tells whether seconds are included.
pub fn batch_to_json(
    head: Option<&ResultsHead>,
    records: &[BatchRecord],
    before: usize,
    times: bool,
    findings: &[Diagnostic],
) -> String {
    let of_file =
        |record: &BatchRecord| BatchRecord { seconds: record.seconds.filter(|_| times), ..record.clone() };
    let document = BatchDocument {
        version: 1,
        batch: head,
        done_before: before,
        files: records.iter().map(of_file).collect(),
        findings: FindingsJson::from_findings(findings),
    };
    to_json_text(&document)
}

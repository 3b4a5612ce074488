//! This module writes and reads results in JSON Lines: a head, then a line for every file, sorted by name.
//!
//! ```json
//! {"clsmith_batch":1,"version":"0.1.0","batch":"9f86…","files":2000,"shard":{"part":"2/8","files":250}}
//! {"input":"programs/a.cls","output":"a.cls","recipe":"slow.yaml","outcome":"corrected","sha256":{…},…}
//! ```
//!
//! `clsmith_batch` changes when readers have to change. New keys may be added without that. `batch`
//! identifies the batch, and its shards have it in common. The results of a whole batch have no `shard`. A
//! line is a [`BatchRecord`].

use super::{BatchRecord, Shard};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::fingerprint::{Digest, VERSION};
use crate::presentation::safe_json::to_json_line;
use crate::source::{Source, Span};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// The version of the format.
const FORMAT: u32 = 1;

/// The first line of results.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ResultsHead {
    /// The version of the format: 1.
    pub clsmith_batch: u32,
    /// The version of clsmith that ran the batch.
    pub version: String,
    /// The id of the batch.
    pub batch: Digest,
    /// The number of files in the whole batch.
    pub files: usize,
    /// The part of the batch to which these results belong.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub shard: Option<ResultsShard>,
}

/// A part of a batch.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct ResultsShard {
    /// Which part.
    #[serde(with = "as_text")]
    pub part: Shard,
    /// The number of files in it.
    pub files: usize,
}

impl ResultsHead {
    /// Makes the head of a batch's results. `shard` and the number of its files are given if it is a part.
    pub fn new(batch: Digest, files: usize, shard: Option<(Shard, usize)>) -> Self {
        let shard = shard.map(|(part, files)| ResultsShard { part, files });
        Self { clsmith_batch: FORMAT, version: VERSION.to_owned(), batch, files, shard }
    }
}

/// The head and the records that were read from a file.
#[derive(Debug)]
pub struct BatchResults {
    /// The file.
    pub source: Arc<Source>,
    /// Its first line.
    pub head: ResultsHead,
    /// The others.
    pub records: Vec<BatchRecord>,
}

/// Returns the text of results. `records` are sorted. `times` tells whether their seconds are included, which
/// differ from run to run.
pub fn results_to_bytes(head: &ResultsHead, records: &[BatchRecord], times: bool) -> Vec<u8> {
    let mut text = Vec::new();
    push_json_line(&mut text, head);
    for record in records {
        match times {
            true => push_json_line(&mut text, record),
            false => push_json_line(&mut text, &BatchRecord { seconds: None, ..record.clone() }),
        }
    }
    text
}

fn push_json_line(text: &mut Vec<u8>, line: &impl Serialize) {
    // Into memory, and without maps: nothing here can fail.
    if let Ok(line) = to_json_line(line) {
        text.extend_from_slice(&line);
    }
}

/// Reads results from a file.
///
/// # Errors
/// Returns [`codes::BAD_RESULTS`] at the first line that is not valid.
pub fn read_results(source: &Arc<Source>) -> Result<BatchResults, Failure> {
    let mut lines = (1..).map_while(|line| source.line_span(line)).filter(|span| !span.is_empty());
    let first = lines.next().unwrap_or_default();
    let head: ResultsHead =
        parse_line(source, first, "the first line of results says which batch they are of")?;
    if head.clsmith_batch != FORMAT {
        let message = format!("{} has results of a format that this clsmith does not know", source.name());
        return Err(Diagnostic::new(codes::BAD_RESULTS, message).with_label(source, first, "not 1").into());
    }
    let records: Result<Vec<BatchRecord>, _> =
        lines.map(|span| parse_line(source, span, "a line of results is about a file")).collect();
    Ok(BatchResults { source: Arc::clone(source), head, records: records? })
}

fn parse_line<T: for<'de> Deserialize<'de>>(
    source: &Arc<Source>,
    span: Span,
    what: &str,
) -> Result<T, Failure> {
    let read = serde_json::from_slice(source.slice(span)).map_err(|error| {
        // The place is in the label. serde counts lines within the line, which would mislead.
        let why = error.to_string();
        let why = why.split(" at line ").next().unwrap_or_default();
        let message = format!("{} is no results file of a batch: {what}", source.name());
        Diagnostic::new(codes::BAD_RESULTS, message).with_label(source, span, why)
    })?;
    Ok(read)
}

mod as_text {
    use super::Shard;
    use serde::{Deserialize, Deserializer, Serializer, de};

    pub(super) fn serialize<S: Serializer>(shard: &Shard, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(shard)
    }

    pub(super) fn deserialize<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Shard, D::Error> {
        String::deserialize(deserializer)?.parse().map_err(de::Error::custom)
    }
}

//! This module finds the results that earlier runs of the hook left beside an export. They are outdated when
//! the export cannot be posted any more.

use clsmith::source::read_file_bytes;
use serde::Deserialize;
use std::path::{Path, PathBuf};

/// The fields of a line of the log that are needed here.
#[derive(Deserialize)]
struct LoggedRun {
    command: String,
    input: LoggedPath,
    post: Option<LoggedResults>,
}

#[derive(Deserialize)]
struct LoggedPath {
    path: String,
}

#[derive(Deserialize)]
struct LoggedResults {
    left: Vec<String>,
}

/// Returns the files that the last run with results put beside this export, according to the log. Returns
/// none if the log cannot be read.
pub(super) fn list_logged_results(log: &Path, export: &str) -> Vec<PathBuf> {
    let bytes = read_file_bytes(log).unwrap_or_default();
    let lines = bytes.split(|byte| *byte == b'\n').rev();
    let runs = lines.filter_map(|line| serde_json::from_slice::<LoggedRun>(line).ok());
    let mut of_export = runs.filter(|run| run.command == "hook" && run.input.path == export);
    let left = of_export.find_map(|run| run.post.map(|post| post.left).filter(|left| !left.is_empty()));
    left.into_iter().flatten().map(PathBuf::from).collect()
}

//! What earlier runs of the hook left beside an export, when the export is posted no more.

use crate::cli::command_outputs::report_unwritable;
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::source::read_file_bytes;
use serde::Deserialize;
use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};

/// What of a line of the log counts here.
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

/// The files that the last run for this export put beside it, as the log says. A log that cannot be read names none.
pub(super) fn list_logged_results(log: &Path, export: &str) -> Vec<PathBuf> {
    let bytes = read_file_bytes(log).unwrap_or_default();
    let lines = bytes.split(|byte| *byte == b'\n').rev();
    let runs = lines.filter_map(|line| serde_json::from_slice::<LoggedRun>(line).ok());
    let mut of_export = runs.filter(|run| run.command == "hook" && run.input.path == export);
    let left = of_export.find_map(|run| run.post.map(|post| post.left).filter(|left| !left.is_empty()));
    left.into_iter().flatten().map(PathBuf::from).collect()
}

/// Renames a result of an earlier export to `NAME.outdated`. Says so, or why it cannot be renamed; `None` where there is
/// none.
pub(super) fn set_aside(result: &Path) -> Option<Diagnostic> {
    // A link is not followed: it is not a file that the hook has written.
    if !fs::symlink_metadata(result).is_ok_and(|there| there.is_file()) {
        return None;
    }
    let mut name = OsString::from(result.file_name()?);
    name.push(".outdated");
    let aside = result.with_file_name(name);
    if let Err(error) = fs::rename(result, &aside) {
        return Some(report_unwritable(&aside, &error));
    }
    let message =
        format!("{} is of an earlier export and was renamed to {}", result.display(), aside.display());
    Some(Diagnostic::new(codes::OLDER_RESULT, message))
}

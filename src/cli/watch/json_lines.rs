//! This module writes the JSON of a watch: a line for each program as it is done, and for findings about
//! what surrounds the programs.

use crate::cli::command_outputs::report_unwritable;
use crate::cli::output_args::JsonArgs;
use crate::cli::unattended::run_to_json_line;
use clsmith::diagnostic::Diagnostic;
use serde::Serialize;
use std::fs::File;
use std::io::{self, Write};
use std::path::PathBuf;

/// Where the lines go. A watch has no end at which a file could appear whole, so each line is written in one
/// call, and lines of earlier runs are removed.
pub(super) enum JsonLines {
    /// Nowhere.
    Unwanted,
    /// To standard output.
    Standard,
    /// To a file.
    File(PathBuf, File),
}

/// Why a line is not written.
pub(super) enum LostLine {
    /// The reader of standard output went away.
    NobodyReads(io::Error),
    /// The file cannot be written.
    Unwritable(Diagnostic),
}

impl JsonLines {
    /// Begins the lines that `--json` asks for.
    ///
    /// # Errors
    /// Returns a finding if the file cannot be written.
    pub(super) fn begin_lines(json: &JsonArgs) -> Result<Self, Diagnostic> {
        match json.path() {
            None => Ok(Self::Unwanted),
            Some(_) if json.is_standard() => Ok(Self::Standard),
            Some(path) => {
                let file = File::create(path).map_err(|error| report_unwritable(path, &error))?;
                Ok(Self::File(path.to_path_buf(), file))
            }
        }
    }

    /// Adds a line: the line of the log, if it is about a program, and all findings.
    ///
    /// # Errors
    /// Returns why the line is not written.
    pub(super) fn add_line(
        &mut self,
        run: Option<&impl Serialize>,
        findings: &[Diagnostic],
    ) -> Result<(), LostLine> {
        match self {
            Self::Unwanted => Ok(()),
            Self::Standard => {
                let mut out = io::stdout().lock();
                let line = run_to_json_line(run, findings);
                let written = line.and_then(|line| out.write_all(&line).and_then(|()| out.flush()));
                written.map_err(LostLine::NobodyReads)
            }
            Self::File(path, file) => {
                let written = run_to_json_line(run, findings).and_then(|line| file.write_all(&line));
                written.map_err(|error| LostLine::Unwritable(report_unwritable(path, &error)))
            }
        }
    }
}

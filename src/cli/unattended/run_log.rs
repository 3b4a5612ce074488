//! This module writes the log, with a complete line of JSON for each run.

use super::unattended_correction::{LoggedRecipe, UnattendedCorrection, UnattendedOutcome};
use crate::cli::command_outputs::report_unwritable;
use clsmith::diagnostic::{Diagnostic, Failure, codes};
use clsmith::fingerprint::{Digest, VERSION};
use clsmith::output_files::is_same_file;
use clsmith::report::changes::StepChanges;
use clsmith::report::render::json::FindingsJson;
use clsmith::report::render::line;
use clsmith::report::safe_json::{to_json_line, write_json_pretty};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};

/// The number of errors that a line repeats. All of them are counted.
const ERRORS: usize = 5;

/// A line of the log. `version` goes up when a reader of the old structure would fail. New keys may be added
/// without that.
#[derive(Debug, Serialize)]
pub(crate) struct LogLine<'r, More> {
    /// Version of the structure: 1.
    version: u32,
    /// When the run began, UTC.
    time: &'r str,
    /// `hook` or `watch`.
    command: &'r str,
    /// Version of clsmith.
    clsmith: &'static str,
    /// The program as it was read.
    input: &'r LoggedInput,
    /// What happened to it.
    outcome: UnattendedOutcome,
    /// The recipe; `null` if none was read.
    recipe: Option<&'r LoggedRecipe>,
    /// What each step changed.
    steps: &'r [StepChanges],
    /// How many findings of each code there were, those allowed by hand included.
    findings: BTreeMap<&'static str, usize>,
    /// How many of them were allowed by hand, by code.
    allowed: BTreeMap<&'static str, usize>,
    /// The first errors, each as one line of text.
    errors: Vec<String>,
    /// The program that was passed on; `null` if there was none.
    output: Option<&'r LoggedOutput>,
    /// The fields that only this command logs.
    #[serde(flatten)]
    more: More,
    /// The duration of the whole run, s.
    seconds: f64,
}

/// The program as it was read. A name that is not UTF-8 has `\u{fffd}` for bytes that cannot be written.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct LoggedInput {
    pub path: String,
    /// The digest; `null` if the program could not be read.
    pub sha256: Option<Digest>,
}

/// The program that was passed on.
#[derive(Debug, Clone, Serialize)]
pub(crate) struct LoggedOutput {
    /// Where it stays; `null` if it was only for the post.
    pub path: Option<String>,
    pub sha256: Digest,
}

impl<'r, More> LogLine<'r, More> {
    /// Makes the line of a program. `time` is the moment at which its run began, and `seconds` how long it took.
    pub(crate) fn from_correction(
        command: &'r str,
        (time, seconds): (&'r str, f64),
        input: &'r LoggedInput,
        correction: &'r UnattendedCorrection,
        output: Option<&'r LoggedOutput>,
        more: More,
    ) -> Self {
        Self {
            version: 1,
            time,
            command,
            clsmith: VERSION,
            input,
            outcome: correction.outcome,
            recipe: correction.recipe.as_ref(),
            steps: &correction.steps,
            findings: count_by_code(correction.findings.iter()),
            allowed: count_by_code(correction.findings.iter().filter(|found| found.is_allowed)),
            errors: list_errors(&correction.findings, &input.path),
            output,
            more,
            seconds,
        }
    }
}

/// Returns the current time in UTC, as RFC 3339 with milliseconds: `2026-03-01T06:30:00.250Z`.
pub(crate) fn utc_now() -> String {
    // The time is cut and not rounded, so that a time in a log is never in the future.
    format!("{:.3}", jiff::Timestamp::now())
}

/// What `--json` gives of a run: the line of the log, and the findings in whole.
#[derive(Serialize)]
struct RunDocument<'r, Line> {
    /// Version of the structure: 1. It goes up when a reader of the old structure would fail.
    version: u32,
    /// The line of the log; `null` for findings that belong to no run on a program.
    run: Option<&'r Line>,
    /// The findings of the run.
    findings: FindingsJson<'r>,
}

impl<'r, Line: Serialize> RunDocument<'r, Line> {
    fn new(run: Option<&'r Line>, findings: &'r [Diagnostic]) -> Self {
        Self { version: 1, run, findings: FindingsJson::from_findings(findings) }
    }
}

/// Returns the JSON document of a run, indented and with a line end. It is empty if that fails, which it only
/// does for a map whose keys are no text.
pub(crate) fn run_to_json(run: Option<&impl Serialize>, findings: &[Diagnostic]) -> String {
    let mut text = Vec::new();
    let written = write_json_pretty(&mut text, &RunDocument::new(run, findings));
    debug_assert!(written.is_ok(), "{written:?}");
    String::from_utf8(text).unwrap_or_default()
}

/// Returns the same on one line, for an output with a line for each run.
///
/// # Errors
/// Returns an error for a map whose keys are no text.
pub(crate) fn run_to_json_line(run: Option<&impl Serialize>, findings: &[Diagnostic]) -> io::Result<Vec<u8>> {
    to_json_line(&RunDocument::new(run, findings))
}

fn count_by_code<'f>(findings: impl Iterator<Item = &'f Diagnostic>) -> BTreeMap<&'static str, usize> {
    let mut counts = BTreeMap::new();
    for found in findings {
        *counts.entry(found.code.id()).or_default() += 1;
    }
    counts
}

/// Returns errors as `part.cls:12:13: CL0003: ...`, one on each line.
fn list_errors(findings: &[Diagnostic], file: &str) -> Vec<String> {
    let errors = findings.iter().filter(|found| found.is_error()).take(ERRORS);
    errors
        .filter_map(|found| {
            let mut text = Vec::new();
            line::render_lines(&mut text, std::slice::from_ref(found), Some(file)).ok()?;
            Some(String::from_utf8_lossy(&text).trim_end().to_owned())
        })
        .collect()
}

/// Ends a line that a full disk has cut, so that it does not damage the next one. The end of pipes and
/// devices cannot be read.
fn end_cut_line(file: &mut File) -> io::Result<()> {
    if !file.metadata()?.is_file() || file.seek(SeekFrom::End(0))? == 0 {
        return Ok(());
    }
    let mut last = [0];
    file.seek(SeekFrom::End(-1))?;
    file.read_exact(&mut last)?;
    if last == *b"\n" { Ok(()) } else { file.write_all(b"\n") }
}

/// A log that lines are added to.
pub(crate) struct RunLog {
    path: PathBuf,
    file: File,
}

impl RunLog {
    /// Opens a log. This comes first, so that nothing is done that could not be logged.
    ///
    /// # Errors
    /// Returns a finding if the log is one of `inputs`, or cannot be opened.
    pub(crate) fn open<'p>(
        path: &Path,
        inputs: impl IntoIterator<Item = &'p PathBuf>,
    ) -> Result<Self, Failure> {
        if let Some(input) = inputs.into_iter().find(|input| is_same_file(input, path)) {
            let message =
                format!("the log {} would be written into the input {}", path.display(), input.display());
            return Err(Diagnostic::new(codes::OUTPUT_IS_INPUT, message).into());
        }
        let file = File::options().read(true).append(true).create(true).open(path);
        let file = file.and_then(|mut file| end_cut_line(&mut file).map(|()| file));
        let file = file.map_err(|error| report_unwritable(path, &error))?;
        Ok(Self { path: path.to_path_buf(), file })
    }

    /// Returns a second handle of the same log, for the handler of Ctrl-C, which may have to write the last
    /// line. Returns `None` if the system refuses it.
    pub(crate) fn try_clone(&self) -> Option<Self> {
        Some(Self { path: self.path.clone(), file: self.file.try_clone().ok()? })
    }

    /// Returns the path of the log.
    pub(crate) fn path(&self) -> &Path {
        &self.path
    }

    /// Adds a line. It is written at the end of the file in one call, so that lines of several runs do not
    /// mix.
    ///
    /// # Errors
    /// Returns a finding if the line cannot be written.
    pub(crate) fn add_line(&mut self, record: &impl Serialize) -> Result<(), Diagnostic> {
        let written = to_json_line(record).and_then(|line| self.file.write_all(&line));
        written.map_err(|error| report_unwritable(&self.path, &error))
    }
}

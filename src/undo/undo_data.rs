//! This module reads a report and restores the original.

use super::UndoPatch;
use super::run_report::{CorrectedFile, FORMAT, FORMAT_VERSION, FileIdentity};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::fingerprint::{Digest, FileFingerprint, RecipeFingerprint};
use crate::source::{Source, Span};
use serde::Deserialize;
use serde_json::Value;
use std::sync::Arc;

/// The data of a run that undo needs.
///
/// ```
/// use clsmith::fingerprint::RecipeFingerprint;
/// use clsmith::parse::parse;
/// use clsmith::report::changes::RecipeChanges;
/// use clsmith::setup::Setup;
/// use clsmith::source::Source;
/// use clsmith::transform::{Recipe, run_recipe};
/// use clsmith::undo::{RunReport, UndoData};
///
/// let text = Source::new("recipe.yaml", b"version: 1\nsteps:\n  - scale_feed: { factor: 0.5 }\n".to_vec())?;
/// let recipe = Recipe::load(&text)?;
/// let print = RecipeFingerprint::read_files(&[text], &recipe, &Setup::default())?;
/// let part = Source::new("part.cls", b"FEDRAT/MMPM,1200.\nGOTO/0,0,0\n".to_vec())?;
/// let before = parse(&part, None).program;
/// let after = run_recipe(&recipe, &Setup::default(), before.clone())?.program;
///
/// let changes = RecipeChanges::from_programs(&before, &after, &recipe.step_names(), Some(recipe.units));
/// let mut report = Vec::new();
/// RunReport::from_program(&after, None, &print, recipe.provenance, &changes).write_json(&mut report)?;
///
/// let report = Source::new("out.json", report)?;
/// let corrected = Source::new("out.cls", after.to_bytes())?;
/// let original = UndoData::read_report(&report)?.restore_original(&corrected, &report)?;
/// assert_eq!(original.bytes, part.bytes());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct UndoData {
    /// The file as it was read.
    pub input: FileIdentity,
    /// The file as it was written.
    pub output: CorrectedFile,
    /// The old bytes that restore the original.
    pub undo: UndoPatch,
    /// The recipe and the files on which it depends, the recipe first.
    pub recipe_files: Vec<FileFingerprint>,
}

/// The part of a run's report that undo needs. A run that refused its program has no output.
#[derive(Deserialize)]
struct UndoDataText {
    input: FileIdentity,
    output: Option<CorrectedFile>,
    undo: UndoPatch,
    recipe: Option<RecipeFingerprint>,
}

/// An original that was restored.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct RestoredOriginal {
    /// Its bytes.
    pub bytes: Vec<u8>,
    /// Its digest, which is the one in the report.
    pub sha256: Digest,
    /// The number of places that differ.
    pub places: usize,
}

/// The keys that every version of the report has, and those that identify other files of clsmith. `version`
/// is a text in some of them.
#[derive(Deserialize)]
struct RunReportHead {
    format: Option<Value>,
    version: Option<Value>,
    clsmith_batch: Option<Value>,
    command: Option<Value>,
}

impl UndoData {
    /// Reads the report of a run.
    ///
    /// # Errors
    /// Returns [`codes::NO_RUN_REPORT`] for any other file, and [`codes::NEWER_RUN_REPORT`] for the report of
    /// a newer clsmith.
    pub fn read_report(report: &Arc<Source>) -> Result<Self, Failure> {
        let bytes = report.bytes();
        // Only the first value is read, because results of batches and logs have one on each line.
        let head = RunReportHead::deserialize(&mut serde_json::Deserializer::from_slice(bytes))
            .map_err(|error| report_unreadable(report, &error))?;
        if head.format.as_ref().and_then(Value::as_str) != Some(FORMAT) {
            let message = if head.clsmith_batch.is_some() {
                "these are the results of a batch, which are no run report; undo reads what `apply --json` writes"
            } else if head.command.is_some() {
                "this is a log, which is no run report; undo reads what `apply --json` writes"
            } else {
                "this is JSON, but not the report of a run of `clsmith apply`"
            };
            return Err(report_no_run_report(report, 0, message));
        }
        match head.version {
            Some(version) if version.as_u64() == Some(u64::from(FORMAT_VERSION)) => {}
            Some(newer) => {
                let message =
                    format!("the report has version {newer}; this clsmith reads version {FORMAT_VERSION}");
                let found = Diagnostic::new(codes::NEWER_RUN_REPORT, message);
                return Err(found.with_label(report, Span::new(0, 0), "").into());
            }
            None => return Err(report_no_run_report(report, 0, "the report does not state its version")),
        }
        let UndoDataText { input, output, undo, recipe } =
            serde_json::from_slice(bytes).map_err(|error| report_unreadable(report, &error))?;
        let Some(output) = output else {
            let message = "the run refused the program and wrote none, so there is nothing to undo";
            return Err(report_no_run_report(report, 0, message));
        };
        let recipe_files = recipe.map(|recipe| recipe.files).unwrap_or_default();
        Ok(Self { input, output, undo, recipe_files })
    }

    /// Restores the original of a corrected file.
    ///
    /// # Errors
    /// Returns [`codes::OTHER_FILE`] at the first difference if the file is not byte for byte the one that
    /// the run wrote, and [`codes::BAD_UNDO`] if the result is not the original.
    pub fn restore_original(
        &self,
        corrected: &Arc<Source>,
        report: &Arc<Source>,
    ) -> Result<RestoredOriginal, Failure> {
        let found = Digest::from_bytes(corrected.bytes());
        if found != self.output.sha256 {
            return Err(self.explain_other_file(corrected, found));
        }
        let bytes = self.undo.restore_bytes(corrected.bytes());
        let bytes =
            bytes.filter(|bytes| Digest::from_bytes(bytes) == self.input.sha256).ok_or_else(|| {
                let message = "the old bytes in the report do not restore the file that it names";
                let found = Diagnostic::new(codes::BAD_UNDO, message);
                found.with_label(report, Span::new(0, 0), "changed since the run wrote it")
            })?;
        Ok(RestoredOriginal { bytes, sha256: self.input.sha256, places: self.undo.count_places() })
    }

    /// Explains why a file is not the one that the run wrote.
    fn explain_other_file(&self, file: &Arc<Source>, digest: Digest) -> Failure {
        if digest == self.input.sha256 {
            let message = "this is the original already, as it was before the run";
            let help = "There is nothing to undo. Give the corrected file.";
            return Diagnostic::new(codes::OTHER_FILE, message).with_help(help).into();
        }
        if let Some(ends) = self.detect_line_ends(file.bytes()) {
            let message =
                format!("only the line ends differ from the file that the run wrote: here they are {ends}");
            let help = "An editor, a version control system or a transfer in text mode has changed them. Give the file that clsmith wrote.";
            return Diagnostic::new(codes::OTHER_FILE, message).with_help(help).into();
        }
        let at = self.output.crc32.find_first_difference(file.bytes());
        let line = |byte: usize| file.line_column(Span::new(byte, byte).start).0;
        let (bytes, wrote) = (file.bytes().len(), self.output.bytes);
        let (message, label) = if at.start == bytes && bytes < wrote {
            (format!("the file ends after {bytes} bytes; the run wrote {wrote}"), "here it ends")
        } else {
            let (from, to) = (line(at.start), line(at.end.saturating_sub(1).max(at.start)));
            let size = if bytes == wrote {
                String::new()
            } else {
                format!(", and it has {bytes} bytes, not {wrote}")
            };
            (
                format!(
                    "the file is not the one that the run wrote: it differs between line {from} and {to}{size}"
                ),
                "from about here",
            )
        };
        let line_end = file.line_span(line(at.start)).map_or(at.start, |line| line.end as usize);
        let span = Span::new(at.start, line_end.max(at.start));
        Diagnostic::new(codes::OTHER_FILE, message).with_label(file, span, label).into()
    }

    /// Returns the kind of line ends, if nothing else differs.
    fn detect_line_ends(&self, bytes: &[u8]) -> Option<&'static str> {
        let mut lf = Vec::with_capacity(bytes.len());
        let mut before = 0;
        for &byte in bytes {
            if byte == b'\n' && before == b'\r' {
                lf.pop();
            }
            lf.push(byte);
            before = byte;
        }
        let crlf: Vec<u8> = lf
            .iter()
            .flat_map(|byte| if *byte == b'\n' { &b"\r\n"[..] } else { std::slice::from_ref(byte) })
            .copied()
            .collect();
        let ours = |bytes: &[u8]| Digest::from_bytes(bytes) == self.output.sha256;
        if ours(&crlf) {
            return Some("LF");
        }
        ours(&lf).then_some("CRLF")
    }
}

fn report_unreadable(report: &Arc<Source>, error: &serde_json::Error) -> Failure {
    let head = report.bytes().trim_ascii_start();
    if head.first() == Some(&b'<') {
        let message = "this is a page for people; undo reads what `apply --json` writes";
        return report_no_run_report(report, 0, message);
    }
    let line = report.line_span(error.line().max(1)).unwrap_or_default();
    let at = (line.start as usize + error.column().saturating_sub(1)).min(report.bytes().len());
    let message = match error.classify() {
        serde_json::error::Category::Eof => "the report is incomplete: it ends in the middle".to_owned(),
        serde_json::error::Category::Data => format!("the report of a run lacks what undo needs: {error}"),
        _ => format!("this is no JSON: {error}"),
    };
    report_no_run_report(report, at, message)
}

fn report_no_run_report(report: &Arc<Source>, at: usize, message: impl Into<String>) -> Failure {
    Diagnostic::new(codes::NO_RUN_REPORT, message).with_label(report, Span::new(at, at), "").into()
}

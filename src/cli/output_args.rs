//! This module holds `-o` and `--json`, which mean the same in every command.

use super::command_outputs::{CommandOutputs, refuse_overwritten_input};
use super::input_files::STANDARD;
use super::output_endings::{OutputContent, find_wrong_ending};
use super::stop::Stop;
use clap::Args;
use clsmith::diagnostic::Diagnostic;
use std::fs::File;
use std::io::{self, Read};
use std::path::{Path, PathBuf};

/// Where a text for people goes.
#[derive(Debug, Clone, Default, Args)]
pub(super) struct TextOutputArgs {
    /// Where to write; standard output if it is not given
    #[arg(short, long, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl TextOutputArgs {
    /// Returns the file, or `-`.
    pub(super) fn path(&self) -> &Path {
        self.output.as_deref().unwrap_or(Path::new(STANDARD))
    }

    /// Returns whether the text goes to standard output.
    pub(super) fn is_standard(&self) -> bool {
        self.path() == Path::new(STANDARD)
    }

    /// Returns what is wrong with the ending of the file, if there is anything.
    pub(super) fn find_wrong_ending(&self) -> Option<String> {
        find_wrong_ending([("-o", self.output.as_deref(), OutputContent::Text)])
    }

    /// Writes the text, with a line end.
    ///
    /// # Errors
    /// Returns a finding if the text would overwrite one of the inputs, an error for a wrong ending of the file, and
    /// the errors of writing.
    pub(super) fn write_text(&self, text: &str, inputs: &[&Path]) -> Result<(), Stop> {
        self.find_wrong_ending().map_or(Ok(()), |wrong| Err(Stop::Usage(wrong)))?;
        refuse_overwritten_input([self.path()].into_iter(), inputs)?;
        CommandOutputs::default().for_inputs(inputs.iter().copied()).write_output(self.path(), |out| {
            out.write_all(text.as_bytes())?;
            if text.is_empty() || text.ends_with('\n') { Ok(()) } else { out.write_all(b"\n") }
        })
    }
}

/// How the documents of analyses begin. No recipe or setup that is written as JSON begins so.
const DOCUMENTS: &[&str] = &["{\n  \"version\": 1,\n  \"batch\":", "{\n  \"version\": 1,\n  \"file\":"];

/// The analysis for other programs.
#[derive(Debug, Clone, Default, Args)]
pub(super) struct JsonArgs {
    /// The analysis as JSON, to FILE (`--json=FILE`, or `--json FILE.json`) or else to standard output
    #[arg(
        long,
        value_name = "FILE",
        num_args = 0..=1,
        require_equals = true,
        default_missing_value = STANDARD,
        help_heading = "Outputs"
    )]
    json: Option<PathBuf>,
}

impl JsonArgs {
    /// Returns the file, or `-`, if JSON is wanted.
    pub(super) fn path(&self) -> Option<&Path> {
        self.json.as_deref()
    }

    /// Returns the file, if JSON goes to one.
    pub(super) fn file(&self) -> Option<&Path> {
        self.path().filter(|path| *path != Path::new(STANDARD))
    }

    /// Returns whether JSON is wanted.
    pub(super) fn is_wanted(&self) -> bool {
        self.json.is_some()
    }

    /// Returns whether JSON goes to standard output.
    pub(super) fn is_standard(&self) -> bool {
        self.path() == Some(Path::new(STANDARD))
    }

    /// Returns whether the file can be written while it is not known which files the inputs name: it does not
    /// exist, or is the document of an earlier run.
    pub(super) fn is_surely_no_input(&self) -> bool {
        let Some(path) = self.file() else { return true };
        let mut begin = Vec::new();
        match File::open(path).and_then(|file| file.take(64).read_to_end(&mut begin)) {
            Ok(_) => DOCUMENTS.iter().any(|document| begin.starts_with(document.as_bytes())),
            Err(error) => error.kind() == io::ErrorKind::NotFound,
        }
    }

    /// Returns what is wrong with the ending of the file, if there is anything.
    pub(super) fn find_wrong_ending(&self) -> Option<String> {
        find_wrong_ending([("--json", self.path(), OutputContent::Json)])
    }

    /// Checks, before the work, whether the file may be written.
    ///
    /// # Errors
    /// Returns a finding if the file is one of the inputs, and an error for a wrong ending.
    pub(super) fn check_file(&self, inputs: &[&Path]) -> Result<(), Stop> {
        refuse_overwritten_input(self.path().into_iter(), inputs)?;
        self.find_wrong_ending().map_or(Ok(()), |wrong| Err(Stop::Usage(wrong)))
    }

    /// Writes a document about the findings that stopped a command, so that they are not in the text alone.
    /// Returns why the command stopped: that, or that the document cannot be written.
    pub(super) fn write_stopped(
        &self,
        inputs: &[&Path],
        stop: Stop,
        document: impl FnOnce(&[Diagnostic]) -> String,
    ) -> Stop {
        let Stop::Found { findings, file } = stop else { return stop };
        match self.write_document(inputs, || document(&findings)) {
            Ok(()) => Stop::Found { findings, file },
            Err(Stop::Found { findings: unwritten, .. }) => {
                let is_new = |found: &Diagnostic| findings.iter().all(|other| other.message != found.message);
                let unwritten: Vec<_> = unwritten.into_iter().filter(is_new).collect();
                Stop::Found { findings: [findings, unwritten].concat(), file }
            }
            Err(stop) => stop,
        }
    }

    /// Writes a document if JSON is wanted.
    ///
    /// # Errors
    /// Returns a finding if the document would overwrite one of the inputs, an error for a wrong ending of
    /// the file, and the errors of writing.
    pub(super) fn write_document(
        &self,
        inputs: &[&Path],
        document: impl FnOnce() -> String,
    ) -> Result<(), Stop> {
        let Some(path) = self.path() else { return Ok(()) };
        self.check_file(inputs)?;
        let text = document();
        CommandOutputs::default().for_inputs(inputs.iter().copied()).write_output(path, |out| {
            out.write_all(text.as_bytes())?;
            if text.ends_with('\n') { Ok(()) } else { out.write_all(b"\n") }
        })
    }
}

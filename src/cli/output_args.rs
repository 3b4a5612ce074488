//! This module holds `-o` and `--json`, which mean the same in every command.

use super::command_outputs::{CommandOutputs, refuse_overwritten_input};
use super::input_files::STANDARD;
use super::output_endings::{OutputContent, find_wrong_ending};
use super::stop::Stop;
use clap::Args;
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

    /// Writes the text, with a line end.
    ///
    /// # Errors
    /// Returns a finding if the text would overwrite one of the inputs, and the errors of writing.
    pub(super) fn write_text(&self, text: &str, inputs: &[&Path]) -> Result<(), Stop> {
        refuse_overwritten_input([self.path()].into_iter(), inputs)?;
        CommandOutputs::default().for_inputs(inputs.iter().copied()).write_output(self.path(), |out| {
            out.write_all(text.as_bytes())?;
            if text.is_empty() || text.ends_with('\n') { Ok(()) } else { out.write_all(b"\n") }
        })
    }
}

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

    /// Returns whether JSON is wanted.
    pub(super) fn is_wanted(&self) -> bool {
        self.json.is_some()
    }

    /// Returns whether JSON goes to standard output.
    pub(super) fn is_standard(&self) -> bool {
        self.path() == Some(Path::new(STANDARD))
    }

    /// Returns what is wrong with the ending of the file, if there is anything.
    pub(super) fn find_wrong_ending(&self) -> Option<String> {
        find_wrong_ending([("--json", self.path(), OutputContent::Json)])
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
        refuse_overwritten_input([path].into_iter(), inputs)?;
        self.find_wrong_ending().map_or(Ok(()), |wrong| Err(Stop::Usage(wrong)))?;
        let text = document();
        CommandOutputs::default().for_inputs(inputs.iter().copied()).write_output(path, |out| {
            out.write_all(text.as_bytes())?;
            if text.ends_with('\n') { Ok(()) } else { out.write_all(b"\n") }
        })
    }
}

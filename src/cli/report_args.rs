//! This module writes `--report` and `--summary`: what changed, as a page and as Markdown.

use super::command_outputs::CommandOutputs;
use super::output_endings::{OutputContent, find_wrong_ending};
use crate::cli::stop::Stop;
use clap::Args;
use clsmith::report::comparison::{Comparison, to_markdown};
use clsmith::report::html;
use std::path::{Path, PathBuf};

/// Reports for people.
#[derive(Debug, Args)]
pub(super) struct ReportArgs {
    /// What changed as an HTML page: tables, charts, the path in 3D. It simulates the program before and
    /// after if the setup has stock and tools
    #[arg(long, value_name = "FILE")]
    report: Option<PathBuf>,
    /// What changed as Markdown, for merge requests. It simulates like --report
    #[arg(long, value_name = "FILE")]
    summary: Option<PathBuf>,
}

impl ReportArgs {
    /// Returns whether a report is requested.
    pub(super) fn is_wanted(&self) -> bool {
        self.named_outputs().next().is_some()
    }

    /// Returns the options that are given, with their files.
    pub(super) fn named_outputs(&self) -> impl Iterator<Item = (&'static str, &Path)> {
        let both = [("--report", &self.report), ("--summary", &self.summary)];
        both.into_iter().filter_map(|(name, path)| Some((name, path.as_deref()?)))
    }

    /// Returns what is wrong with the ending of a file, if there is anything.
    pub(super) fn find_wrong_ending(&self) -> Option<String> {
        find_wrong_ending([
            ("--report", self.report.as_deref(), OutputContent::Page),
            ("--summary", self.summary.as_deref(), OutputContent::Markdown),
        ])
    }

    /// Returns the files.
    pub(super) fn output_paths(&self) -> impl Iterator<Item = &Path> {
        self.named_outputs().map(|(_, path)| path)
    }

    /// Writes the requested reports.
    pub(super) fn write_reports(
        &self,
        comparison: &Comparison<'_>,
        outputs: &CommandOutputs,
    ) -> Result<(), Stop> {
        if let Some(path) = &self.report {
            outputs.write_output(path, |out| html::write_page(comparison, out))?;
        }
        if let Some(path) = &self.summary {
            let text = to_markdown(comparison);
            return outputs.write_output(path, |out| out.write_all(text.as_bytes()));
        }
        Ok(())
    }
}

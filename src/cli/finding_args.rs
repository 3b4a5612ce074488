//! This module holds the options of findings, and shows findings.

use super::choice_parser::ChoiceParser;
use super::terminal::{self, ColorMode};
use clap::builder::StringValueParser;
use clap::{Args, ValueEnum};
use clsmith::diagnostic::{CATALOGUE, Diagnostic};
use clsmith::report::finding_policy::{FindingPolicy, FindingPolicyError};
use clsmith::report::render::{human, json, line, sarif};
use std::io::{self, Write};

/// The format of findings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum FindingFormat {
    /// With the lines of the program, for people
    Human,
    /// `file:line:column: CODE: message`, for editors.
    Line,
    /// JSON.
    Json,
    /// SARIF 2.1.0, for code hosts.
    Sarif,
}

#[derive(Debug, Args)]
#[command(next_help_heading = "Findings")]
pub(super) struct FindingArgs {
    /// Treat a code as an error; `warnings` treats all of them so. It may be given several times
    #[arg(long, value_name = "CODE", value_delimiter = ',', hide_possible_values = true,
        value_parser = ChoiceParser::new(StringValueParser::new(), || [&["warnings"], &*list_codes()].concat()))]
    deny: Vec<String>,
    /// Let a code pass: it stops nothing, and is counted as allowed by hand. May be given several times
    #[arg(long, value_name = "CODE", value_delimiter = ',', hide_possible_values = true,
        value_parser = ChoiceParser::new(StringValueParser::new(), list_codes))]
    allow: Vec<String>,
    /// Show notes, too
    #[arg(long)]
    notes: bool,
    /// The format of the findings
    #[arg(long, value_enum, default_value = "human", value_name = "FORM")]
    pub format: FindingFormat,
    /// How many findings of one step and code are shown to people where there are more than three, the worst
    /// first; 0 shows all. The others are counted, with their lines
    #[arg(long, default_value_t = 1, value_name = "N")]
    max_per_code: usize,
    /// When to use colours
    #[arg(long, value_enum, default_value = "auto", value_name = "WHEN")]
    pub color: ColorMode,
}

/// Returns all codes, for completions.
pub(super) fn list_codes() -> Vec<&'static str> {
    CATALOGUE.iter().flat_map(|rows| rows.iter()).map(|code| code.id()).collect()
}

impl FindingArgs {
    /// Returns the policy of the options.
    pub(super) fn build_policy(&self) -> Result<FindingPolicy, FindingPolicyError> {
        FindingPolicy::from_code_lists(
            self.deny.iter().map(String::as_str),
            self.allow.iter().map(String::as_str),
            self.notes,
        )
    }

    /// Writes findings in the requested format. `file` is the file of the run, if there is only one.
    pub(super) fn write_findings(
        &self,
        out: &mut dyn Write,
        is_terminal: bool,
        findings: &[Diagnostic],
        file: Option<&str>,
    ) -> io::Result<()> {
        match self.format {
            FindingFormat::Human => {
                let options = human::HumanRenderOptions::default()
                    .with_color(self.color.is_wanted(is_terminal))
                    .with_unicode(terminal::has_unicode())
                    .with_width(terminal::width_columns(is_terminal))
                    .with_per_code(self.max_per_code);
                human::render_human(out, findings, file, &options)
            }
            FindingFormat::Line => line::render_lines(out, findings, file),
            FindingFormat::Json => json::render_json(out, findings),
            FindingFormat::Sarif => sarif::render_sarif(out, findings, file),
        }
    }
}

//! Options of findings, and showing them.

use super::terminal::{self, Color};
use clap::{Args, ValueEnum};
use clsmith::diagnostic::Diagnostic;
use clsmith::report::policy::Policy;
use clsmith::report::render::{human, json, line, sarif};
use std::io::{self, Write};

/// Form of findings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// With the lines they are about, for people.
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
pub struct FindingArgs {
    /// Treat a code as an error; `warnings` for all of them. May be given several times
    #[arg(long, value_name = "CODE", value_delimiter = ',')]
    deny: Vec<String>,
    /// Drop a code: it is not shown and does not stop anything. May be given several times
    #[arg(long, value_name = "CODE", value_delimiter = ',')]
    allow: Vec<String>,
    /// Show notes, too
    #[arg(long)]
    notes: bool,
    /// Form of the findings
    #[arg(long, value_enum, default_value = "human", value_name = "FORM")]
    pub format: Format,
    /// How many findings of one code are shown to people; 0 shows all
    #[arg(long, default_value_t = 10, value_name = "N")]
    max_per_code: usize,
    /// Colours in what people read
    #[arg(long, value_enum, default_value = "auto", value_name = "WHEN")]
    pub color: Color,
}

impl FindingArgs {
    /// The policy that the options ask for.
    pub fn policy(&self) -> Result<Policy, String> {
        Policy::parse(self.deny.iter().map(String::as_str), self.allow.iter().map(String::as_str), self.notes)
    }

    /// Writes findings in the form asked for. `file` is the run's one file, if it has one.
    pub fn show(
        &self,
        out: &mut dyn Write,
        is_terminal: bool,
        findings: &[Diagnostic],
        file: Option<&str>,
    ) -> io::Result<()> {
        match self.format {
            Format::Human => {
                let options = human::HumanOptions {
                    color: self.color.wanted(is_terminal),
                    unicode: terminal::unicode(),
                    width: terminal::width(),
                    per_code: self.max_per_code,
                    ..human::HumanOptions::default()
                };
                human::render(out, findings, file, &options)
            }
            Format::Line => line::render(out, findings, file),
            Format::Json => json::render(out, findings),
            Format::Sarif => sarif::render(out, findings, file),
        }
    }
}

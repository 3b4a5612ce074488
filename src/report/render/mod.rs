//! This module writes findings as text, with one file for each format.

mod excerpt;
pub mod finding_groups;
pub mod human;
pub mod json;
pub mod line;
pub mod sarif;

use crate::diagnostic::{Diagnostic, Severity};
use std::fmt;

/// The number of findings of each severity.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct SeverityCounts {
    /// Findings that prevent writing.
    pub errors: usize,
    /// Findings that should be examined.
    pub warnings: usize,
    /// Findings that are only shown on request (`--notes`).
    pub notes: usize,
    /// Findings of any severity that `--allow` named; they are in no other count.
    pub allowed: usize,
}

impl SeverityCounts {
    /// Counts findings.
    pub(crate) fn from_findings(diagnostics: &[Diagnostic]) -> Self {
        let stands =
            |severity: Severity| move |found: &&Diagnostic| !found.is_allowed && found.severity == severity;
        let count = |severity| diagnostics.iter().filter(stands(severity)).count();
        Self {
            errors: count(Severity::Error),
            warnings: count(Severity::Warning),
            notes: count(Severity::Note),
            allowed: diagnostics.iter().filter(|found| found.is_allowed).count(),
        }
    }
}

impl fmt::Display for SeverityCounts {
    /// Writes "2 errors, 1 warning", or "no problems found" if there are none.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let all = [(self.errors, "error"), (self.warnings, "warning"), (self.notes, "note")];
        let mut separator = "";
        for (count, name) in all.into_iter().filter(|(count, _)| *count > 0) {
            write!(f, "{separator}{count} {name}{}", if count == 1 { "" } else { "s" })?;
            separator = ", ";
        }
        if separator.is_empty() { f.write_str("no problems found") } else { Ok(()) }
    }
}

/// Returns how many findings there are, and which codes were allowed by hand: `1 error, 2 warnings; allowed
/// by hand: 8 x CL0510`. Every output for people uses this wording.
pub fn describe_counts(diagnostics: &[Diagnostic]) -> String {
    let counts = SeverityCounts::from_findings(diagnostics);
    match finding_groups::describe_allowed(diagnostics) {
        Some(allowed) => format!("{counts}; allowed by hand: {allowed}"),
        None => counts.to_string(),
    }
}

/// The file name of findings without a place if the run has no file.
const NO_FILE: &str = "clsmith";

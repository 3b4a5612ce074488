//! This module says in one sentence what a comparison means: whether its program can go to the machine.

use super::Comparison;
use crate::diagnostic::{Diagnostic, Severity};
use crate::report::render::{SeverityCounts, describe_counts};
use crate::report::table::ColumnUnit;
use crate::report::text_format::{format_count, format_counted};
use crate::transform::PROVENANCE;

/// What to do with a program.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum VerdictLevel {
    /// It has errors.
    Stop,
    /// It has warnings, or was not simulated.
    Look,
    /// Nothing speaks against it.
    Go,
}

/// A verdict on a program. Every output for people begins with it.
#[derive(Debug, Clone)]
pub struct Verdict<'a> {
    /// What to do.
    pub level: VerdictLevel,
    /// The verdict as one sentence.
    pub sentence: String,
    /// What it rests on, in sentences.
    pub details: String,
    /// The finding that decided, if one did.
    pub finding: Option<&'a Diagnostic>,
}

impl Comparison<'_> {
    /// Returns the verdict on the current program.
    pub fn verdict(&self) -> Verdict<'_> {
        let findings = self.subject.findings;
        let first = |severity| findings.iter().find(|found| !found.is_allowed && found.severity == severity);
        let counts = SeverityCounts::from_findings(findings);
        let (level, sentence, finding) = if let Some(found) = first(Severity::Error) {
            (VerdictLevel::Stop, self.forbid(found, counts.errors), Some(found))
        } else if let Some(found) = first(Severity::Warning) {
            let warnings = format_counted(counts.warnings, "warning", "warnings");
            let sentence = format!("Look at {warnings} before you post: {}", end_sentence(&found.message));
            (VerdictLevel::Look, sentence, Some(found))
        } else if self.runs.after.is_none() {
            let sentence = "No fault was found, but nothing was simulated on the stock.".to_owned();
            (VerdictLevel::Look, sentence, None)
        } else {
            (VerdictLevel::Go, "Ready to post: the simulation on the stock found no fault.".to_owned(), None)
        };
        Verdict { level, sentence, details: self.describe_basis(), finding }
    }

    fn forbid(&self, found: &Diagnostic, errors: usize) -> String {
        let more = match errors {
            0 | 1 => String::new(),
            _ => format!(
                " There {} more.",
                match errors - 1 {
                    1 => "is 1 error".to_owned(),
                    more => format!("are {more} errors"),
                }
            ),
        };
        let written = if self.subject.recipe.is_some() { " No program was written." } else { "" };
        format!("Do not post: {}{more}{written}", end_sentence(&found.message))
    }

    /// Returns how many findings there are, what no chip exceeds, and what was changed.
    fn describe_basis(&self) -> String {
        let mut said = vec![format!("{}.", capitalize(&describe_counts(self.subject.findings)))];
        if let Some(bound) = self.whole.after.and_then(|figures| figures.chip_thickness_bound_mm) {
            said.push(format!(
                "No chip is thicker than {}.",
                self.units().tell_fixed(ColumnUnit::Length, bound.value, 4)
            ));
        }
        said.extend(self.describe_changes());
        said.extend(self.differences.as_ref().map(|differences| capitalize(&differences.describe())));
        said.join(" ")
    }

    /// Returns how many statements were changed and how many were not; `None` without a program before.
    pub(in crate::report) fn describe_changes(&self) -> Option<String> {
        let changes = self.changes.as_ref()?;
        if changes.is_empty() {
            return Some("Nothing was changed.".to_owned());
        }
        let sum = |comments: bool| -> usize {
            let steps = changes.steps.iter().filter(|step| (step.name == PROVENANCE) == comments);
            let maps = steps.flat_map(|step| [&step.edited, &step.inserted, &step.deleted]);
            maps.map(|map| map.values().sum::<usize>()).sum()
        };
        let about = match sum(true) {
            0 => String::new(),
            said => format!("{} about the run, ", format_counted(said, "comment", "comments")),
        };
        let changed = format_counted(sum(false), "statement", "statements");
        Some(format!("{changed} changed, {about}{} untouched.", format_count(changes.untouched as u64)))
    }
}

fn end_sentence(text: &str) -> String {
    if text.ends_with(['.', '!', '?']) { text.to_owned() } else { format!("{text}.") }
}

fn capitalize(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or_else(String::new, |first| first.to_uppercase().chain(letters).collect())
}

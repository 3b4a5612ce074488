//! This module groups findings that are alike: those with one code and severity, of one step, about one file.
//!
//! Every output for people shows groups, so that hundreds of similar findings become one entry: the worst
//! one, the number of the others, and their lines. Outputs for programs ([`json`](super::json),
//! [`sarif`](super::sarif), [`line`](super::line)) have every finding. The totals are the same in both.

use crate::diagnostic::{Diagnostic, DiagnosticCode, Severity};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The largest size of a group of which all findings are shown.
pub const SMALL_GROUP: usize = 3;

/// The largest number of lines that are listed of the findings that are not shown.
const MOST_LINES: usize = 8;

/// Findings with the same code, severity, step and file. A group has at least one finding.
#[derive(Debug, Clone)]
pub struct FindingGroup<'a> {
    first: &'a Diagnostic,
    others: Vec<&'a Diagnostic>,
}

/// What findings of a group have in common: code, severity, whether allowed, step and file.
type GroupKey<'a> = (DiagnosticCode, Severity, bool, Option<usize>, Option<&'a str>);

/// Groups findings that are alike. The groups are in the order of their first findings.
pub fn group_findings(findings: &[Diagnostic]) -> Vec<FindingGroup<'_>> {
    let mut groups: Vec<FindingGroup<'_>> = Vec::new();
    let mut numbers: BTreeMap<GroupKey<'_>, usize> = BTreeMap::new();
    for found in findings {
        let file = found.labels.first().map(|label| label.source.name());
        let key = (found.code, found.severity, found.is_allowed, found.step, file);
        let number = *numbers.entry(key).or_insert(groups.len());
        match groups.get_mut(number) {
            Some(group) => group.others.push(found),
            None => groups.push(FindingGroup { first: found, others: Vec::new() }),
        }
    }
    groups
}

impl<'a> FindingGroup<'a> {
    /// Returns how many findings there are.
    pub fn count(&self) -> usize {
        self.others.len() + 1
    }

    /// Returns the worst finding: the first one with the largest magnitude, or the first one where they are
    /// alike.
    pub fn worst(&self) -> &'a Diagnostic {
        let worse = |worst: &'a Diagnostic, found: &&'a Diagnostic| {
            if found.magnitude > worst.magnitude { *found } else { worst }
        };
        self.others.iter().fold(self.first, worse)
    }

    /// Returns all findings in the order in which they were found.
    pub fn findings(&self) -> impl Iterator<Item = &'a Diagnostic> + '_ {
        std::iter::once(self.first).chain(self.others.iter().copied())
    }

    /// Returns the findings to show: all of a small group or where `most` is 0, else `most` of them, the
    /// worst first.
    pub fn shown(&self, most: usize) -> Vec<&'a Diagnostic> {
        if most == 0 || self.count() <= most.max(SMALL_GROUP) {
            return self.findings().collect();
        }
        let mut worst_first: Vec<&Diagnostic> = self.findings().collect();
        let magnitude = |found: &Diagnostic| found.magnitude.unwrap_or(f64::NEG_INFINITY);
        // The sort is stable, so findings that are equally bad stay in the order of the file.
        worst_first.sort_by(|a, b| magnitude(b).total_cmp(&magnitude(a)));
        worst_first.truncate(most);
        worst_first
    }

    /// Returns a text about the findings that [`FindingGroup::shown`] leaves out: their number, code, step
    /// and first lines. Returns `None` if it leaves out none.
    pub fn describe_hidden(&self, most: usize) -> Option<String> {
        let shown = self.shown(most);
        if shown.len() == self.count() {
            return None;
        }
        let hidden = self.findings().filter(|found| !shown.iter().any(|one| std::ptr::eq(*one, *found)));
        let lines: Vec<Option<usize>> = hidden.map(find_line).collect();
        let mut text = format!("{} more of {}", lines.len(), self.worst().code);
        if let Some(step) = self.worst().step {
            let _ = write!(text, " from step {step}");
        }
        let mut known: Vec<usize> = lines.iter().copied().flatten().collect();
        known.dedup();
        let separator = |index: usize| {
            if index == 0 { if known.len() == 1 { ", on line " } else { ", on lines " } } else { ", " }
        };
        for (index, line) in known.iter().take(MOST_LINES).enumerate() {
            let _ = write!(text, "{}{line}", separator(index));
        }
        if known.len() > MOST_LINES {
            text.push_str(", ...");
        }
        Some(text)
    }
}

fn find_line(found: &Diagnostic) -> Option<usize> {
    let label = found.labels.first()?;
    Some(label.source.line_column(label.span.start).0)
}

/// Returns how many findings of each code are allowed by hand: `8 x CL0510, 1 x CL0102`. Returns `None` if
/// none is allowed.
pub fn describe_allowed(findings: &[Diagnostic]) -> Option<String> {
    let mut counts: BTreeMap<DiagnosticCode, usize> = BTreeMap::new();
    for found in findings.iter().filter(|found| found.is_allowed) {
        *counts.entry(found.code).or_default() += 1;
    }
    let counted = counts.into_iter().map(|(code, count)| format!("{count} x {code}"));
    let all: Vec<String> = counted.collect();
    (!all.is_empty()).then(|| all.join(", "))
}

//! This module records what happened to a file.

use super::PortablePath;
use super::batch_plan::{PlannedFile, PreparedRecipe};
use crate::diagnostic::{Diagnostic, Severity};
use crate::fingerprint::{Digest, VERSION};
use crate::program::{Program, StatementChange};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// How the processing of a file ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FileOutcome {
    /// Its output was written and differs from the input.
    Corrected,
    /// Its output was written and equals the input byte for byte.
    Unchanged,
    /// There was an error, and nothing was written.
    Failed,
    /// It was not processed, because another file failed and the batch stops then.
    NotRun,
}

impl FileOutcome {
    /// Returns whether the output exists.
    pub fn is_written(self) -> bool {
        matches!(self, Self::Corrected | Self::Unchanged)
    }
}

/// The digests of what was read and written.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileDigests {
    /// The digest of the CL file. It is `None` if the file was not read.
    pub input: Option<Digest>,
    /// The digest of the recipe's text.
    pub recipe: Digest,
    /// The digest of all other files that the recipe depends on: setup, material, models and stock.
    pub setup: Digest,
    /// The digest of the output. It is `None` if none was written.
    pub output: Option<Digest>,
}

/// The number of statements that the recipe changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct StatementChangeCounts {
    /// Statements with a new text.
    pub edited: usize,
    /// Statements that were inserted.
    pub inserted: usize,
    /// Statements of the file that were deleted.
    pub deleted: usize,
}

impl StatementChangeCounts {
    /// Counts the statements that differ from the source.
    pub(crate) fn count_changes(program: &Program) -> Self {
        let mut changed = Self::default();
        for statement in program.statements() {
            match statement.change() {
                StatementChange::Untouched => {}
                StatementChange::Edited(_) => changed.edited += 1,
                StatementChange::Inserted(_) => changed.inserted += 1,
                // A statement that one step inserted and a later one deleted was never in the file.
                StatementChange::Deleted(_) if statement.origin().is_empty() => {}
                StatementChange::Deleted(_) => changed.deleted += 1,
            }
        }
        changed
    }
}

/// The number of findings.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct BatchFindingCounts {
    /// Errors.
    pub errors: usize,
    /// Warnings.
    pub warnings: usize,
    /// Notes; zero unless they were asked for.
    pub notes: usize,
    /// Findings of any severity that were allowed by hand; they are in no other count.
    #[serde(default)]
    pub allowed: usize,
}

/// The findings with the same code and severity.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct BatchFinding {
    /// The code: `CL0003`.
    pub code: String,
    /// `error`, `warning` or `note`.
    pub severity: String,
    /// Whether they were allowed by hand, so that they stopped nothing.
    #[serde(default)]
    pub allowed: bool,
    /// How many there are.
    pub count: usize,
    /// The message of the first one.
    pub first: String,
    /// The line of the first one, counted from 1. It is `None` if the finding is about the whole file, or
    /// about a line of another file.
    pub line: Option<usize>,
}

/// What happened to a file. Except for `seconds`, nothing in it depends on the machine, the threads or the
/// order of files.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct BatchRecord {
    /// The CL file, as the batch names it.
    pub input: PortablePath,
    /// The output, below the output folder.
    pub output: PortablePath,
    /// The recipe, as the batch names it.
    pub recipe: PortablePath,
    /// How it ended.
    pub outcome: FileOutcome,
    /// Digests.
    pub sha256: FileDigests,
    /// The version of clsmith that processed it.
    pub version: String,
    /// The number of changed statements.
    pub changed: StatementChangeCounts,
    /// The number of findings.
    pub counts: BatchFindingCounts,
    /// The findings by code.
    pub findings: Vec<BatchFinding>,
    /// The duration in seconds. It is only in journals, and in results on request.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f64>,
}

impl BatchRecord {
    /// Makes the record of a file before it is processed, with the outcome that it keeps if nothing else
    /// happens.
    pub(super) fn new(file: &PlannedFile, work: &PreparedRecipe, outcome: FileOutcome) -> Self {
        Self {
            input: file.input.clone(),
            output: file.output_name.clone(),
            recipe: work.name.clone(),
            outcome,
            sha256: FileDigests {
                input: None,
                recipe: work.recipe_digest(),
                setup: work.setup_digest(),
                output: None,
            },
            version: VERSION.to_owned(),
            changed: StatementChangeCounts::default(),
            counts: BatchFindingCounts::default(),
            findings: Vec::new(),
            seconds: None,
        }
    }

    /// Returns the key that identifies the record in its batch and defines the order of records.
    pub(crate) fn sort_key(&self) -> (&PortablePath, &PortablePath) {
        (&self.input, &self.output)
    }

    /// Counts the findings, as the policy has left them.
    pub(super) fn count_findings(&mut self, findings: &[Diagnostic], source_name: &str) {
        let mut by_code: BTreeMap<(&str, Severity, bool), BatchFinding> = BTreeMap::new();
        for found in findings {
            match found.severity {
                _ if found.is_allowed => self.counts.allowed += 1,
                Severity::Error => self.counts.errors += 1,
                Severity::Warning => self.counts.warnings += 1,
                Severity::Note => self.counts.notes += 1,
            }
            let label = found.labels.first().filter(|label| label.source.name() == source_name);
            let first = || BatchFinding {
                code: found.code.id().to_owned(),
                severity: found.severity.to_string(),
                allowed: found.is_allowed,
                count: 0,
                first: found.message.clone(),
                line: label.map(|label| label.source.line_column(label.span.start).0),
            };
            by_code.entry((found.code.id(), found.severity, found.is_allowed)).or_insert_with(first).count +=
                1;
        }
        self.findings = by_code.into_values().collect();
    }
}

//! What became of a file.

use super::PortablePath;
use super::batch_plan::{PlannedFile, PreparedRecipe};
use crate::diagnostic::{Diagnostic, Severity};
use crate::fingerprint::{Digest, VERSION};
use crate::program::{Program, StatementChange};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// How a file ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum FileOutcome {
    /// Its output is written and differs from the input.
    Corrected,
    /// Its output is written and is the input, byte for byte.
    Unchanged,
    /// An error stands; nothing was written.
    Failed,
    /// Nobody began it, because another one failed and the batch was to stop then.
    NotRun,
}

impl FileOutcome {
    /// Whether the output is there.
    pub fn is_written(self) -> bool {
        matches!(self, Self::Corrected | Self::Unchanged)
    }
}

/// Digests of what went in and what came out.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileDigests {
    /// Of the CL file; `None` if it was not read.
    pub input: Option<Digest>,
    /// Of the recipe's text.
    pub recipe: Digest,
    /// Of all other files that the recipe depends on: setup, material, models, stock.
    pub setup: Digest,
    /// Of the output; `None` if none was written.
    pub output: Option<Digest>,
}

/// How many statements the recipe changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct StatementChangeCounts {
    /// Statements with a new text.
    pub edited: usize,
    /// Statements put in.
    pub inserted: usize,
    /// Statements of the file taken out.
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
                // One step put it in, a later one took it out: the file never had it.
                StatementChange::Deleted(_) if statement.origin().is_empty() => {}
                StatementChange::Deleted(_) => changed.deleted += 1,
            }
        }
        changed
    }
}

/// How many findings there were.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
pub struct BatchFindingCounts {
    /// Errors.
    pub errors: usize,
    /// Warnings.
    pub warnings: usize,
    /// Notes; none unless they were asked for.
    pub notes: usize,
    /// Findings of any severity that were allowed by hand; they are in no other count.
    #[serde(default)]
    pub allowed: usize,
}

/// Findings of one code and severity.
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
    /// The message of the first.
    pub first: String,
    /// The line it is about, from 1; `None` if it is about the whole file, or about a line of another one.
    pub line: Option<usize>,
}

/// What became of a file. Nothing in it depends on the machine, the threads or the order of files, but `seconds`.
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
    /// The clsmith that did it.
    pub version: String,
    /// What the recipe changed.
    pub changed: StatementChangeCounts,
    /// How many findings there were.
    pub counts: BatchFindingCounts,
    /// Findings by code.
    pub findings: Vec<BatchFinding>,
    /// How long it took; only in journals, and in results on request.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seconds: Option<f64>,
}

impl BatchRecord {
    /// A file of which nothing is known yet but how it ends if nothing more is learnt.
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

    /// What identifies the record in its batch, and orders it.
    pub(crate) fn sort_key(&self) -> (&PortablePath, &PortablePath) {
        (&self.input, &self.output)
    }

    /// Takes the findings down, as the policy left them.
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

//! This module holds what differs between two files that are compared.

use crate::program::Program;
use crate::report::diff::{ProgramDiff, StatementAlignment, summarize_diff};

/// The differences between two files, by meaning, and the statements that belong together.
#[derive(Debug)]
pub struct FileDifferences {
    /// The differences, as `clsmith diff` tells them.
    pub diff: ProgramDiff,
    pub(in crate::report) alignment: StatementAlignment,
}

impl FileDifferences {
    pub(super) fn new(other: &Program, program: &Program) -> Self {
        let (diff, alignment) = ProgramDiff::align_programs(other, program);
        Self { diff, alignment }
    }

    /// Returns the differences in sentences.
    pub(super) fn describe(&self) -> String {
        let lines = summarize_diff(&self.diff);
        lines.lines().map(|line| format!("{line}.")).collect::<Vec<_>>().join(" ")
    }
}

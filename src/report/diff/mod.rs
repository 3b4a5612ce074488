//! This module finds what differs between two programs, by meaning.
//!
//! Statements are aligned, and every pair is classified: the same bytes, the same meaning in other words, a
//! moved point, a changed feed. The motions show whether the tool follows the same path ([`PathComparison`]),
//! so two dialects can be compared. The JSON ([`to_json`]) is [`ProgramDiff`] itself, with `"version": 1`.
//! `version` goes up when a reader of the old structure would fail. New keys may be added without that.

mod alignment;
mod alignment_keys;
mod diff_collector;
mod difference_kind;
mod path_comparison;
mod text;

pub(in crate::report) use alignment::{AlignmentRun, StatementAlignment};
pub use difference_kind::DifferenceKind;
pub use path_comparison::PathComparison;
pub use text::{summarize_diff, to_text};

use super::render::json::report_to_json;
use super::stats::{DialectName, MotionTotals, ReportedRange, ResolvedLengthUnit};
use crate::diagnostic::Diagnostic;
use crate::program::Program;
use crate::program::RecordKind;
use serde::Serialize;
use std::collections::BTreeMap;

/// The largest number of changes of one [`DifferenceKind`] that are listed. All of them are counted.
pub const MOST_LISTED: usize = 500;

/// The differences between two programs.
///
/// ```
/// use clsmith::parse::parse;
/// use clsmith::report::diff::ProgramDiff;
/// use clsmith::source::Source;
///
/// let read = |text: &str| -> Result<_, clsmith::source::SourceTooLarge> {
///     Ok(parse(&Source::new("part.cls", text.as_bytes().to_vec())?, None).program)
/// };
/// let (before, layout) = (read("GOTO/1.0,2.0,3.0\n")?, read("GOTO/1,2,3.000\n")?);
/// let diff = ProgramDiff::from_programs(&before, &layout);
/// assert!(!diff.identical && diff.same_meaning);
/// let diff = ProgramDiff::from_programs(&before, &read("GOTO/1.0,2.0,3.5\n")?);
/// assert_eq!(diff.largest_move, Some(0.5));
/// # Ok::<(), clsmith::source::SourceTooLarge>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ProgramDiff {
    /// Version of the JSON structure: 1.
    pub version: u32,
    /// The first program.
    pub a: DiffSide,
    /// The second program.
    pub b: DiffSide,
    /// Whether the files are equal byte for byte.
    pub identical: bool,
    /// Whether a post-processor would see no difference, because only layout and comments differ.
    pub same_meaning: bool,
    /// The comparison of the paths.
    pub geometry: PathComparison,
    /// The numbers of statements by kind of difference.
    pub counts: DiffCounts,
    /// The largest distance by which a point moved, in the second file's unit; `null` if no point moved.
    pub largest_move: Option<f64>,
    /// The lowest and the highest change of feeds in percent; `null` if none changed or their units cannot be
    /// compared.
    pub feed_change: Option<ReportedRange>,
    /// The operations with differences, in order.
    pub operations: Vec<OperationDiff>,
    /// Differences in order, at most [`MOST_LISTED`] of each kind.
    pub changes: Vec<StatementDifference>,
    /// Differences that are counted but not listed.
    pub not_listed: usize,
}

/// One of the two programs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct DiffSide {
    /// The file's name.
    pub file: String,
    /// The dialect.
    pub dialect: DialectName,
    /// The unit of its lengths.
    pub units: ResolvedLengthUnit,
    /// Lengths and times; rapids have no time.
    pub totals: MotionTotals,
}

/// The numbers of statements by kind of difference.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct DiffCounts {
    /// Statements of the same bytes.
    pub same: usize,
    /// Statements that are written differently, but have the same meaning: blanks, zeros, order of words.
    pub layout: usize,
    /// Comments, empty lines and text for people: changed, added or removed.
    pub text: usize,
    /// Points that moved.
    pub moved: usize,
    /// Axes that turned while the point stayed.
    pub turned: usize,
    /// Feeds that changed, those of cycles too.
    pub feeds: usize,
    /// Other records that changed, by kind.
    pub changed: BTreeMap<RecordKind, usize>,
    /// Records only in the second program, by kind.
    pub added: BTreeMap<RecordKind, usize>,
    /// Records only in the first program, by kind.
    pub removed: BTreeMap<RecordKind, usize>,
}

/// An operation with differences.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct OperationDiff {
    /// The name in the second program, or in the first if it was removed. It is empty before the first
    /// operation.
    pub name: String,
    /// How many statements differ, and how.
    pub counts: DiffCounts,
}

/// A statement that differs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StatementDifference {
    /// The kind of the difference.
    pub what: DifferenceKind,
    /// The kind of the statement.
    pub kind: RecordKind,
    /// Index in `operations`.
    pub operation: usize,
    /// The line in the first file; `null` if it has none.
    pub line_a: Option<usize>,
    /// The line in the second file; `null` if it has none.
    pub line_b: Option<usize>,
    /// The text in the first file without line end. Bytes that are not UTF-8 are read as Latin-1.
    pub old: Option<String>,
    /// The text in the second file.
    pub new: Option<String>,
    /// For a moved point, the distance in the second file's unit; for a feed, the change in percent.
    pub by: Option<f64>,
}

impl ProgramDiff {
    /// Compares two programs in their current state.
    pub fn from_programs(a: &Program, b: &Program) -> Self {
        diff_collector::collect_diff(a, b).0
    }

    /// Compares two programs, and returns which statements belong together, too.
    pub(in crate::report) fn align_programs(a: &Program, b: &Program) -> (Self, StatementAlignment) {
        diff_collector::collect_diff(a, b)
    }

    /// Returns whether the programs are equal byte for byte.
    pub fn is_empty(&self) -> bool {
        self.identical
    }
}

impl DiffCounts {
    /// Returns whether no difference matters to a post-processor.
    pub fn has_same_meaning(&self) -> bool {
        let maps = [&self.changed, &self.added, &self.removed];
        self.moved == 0 && self.turned == 0 && self.feeds == 0 && maps.iter().all(|map| map.is_empty())
    }

    /// Returns whether there is no difference at all.
    pub fn is_empty(&self) -> bool {
        self.has_same_meaning() && self.layout == 0 && self.text == 0
    }
}

/// Returns the differences as a JSON document, indented and with a line end. `findings` are those of both
/// programs, after the policy; they are written under the key `findings`.
pub fn to_json(diff: &ProgramDiff, findings: &[Diagnostic]) -> String {
    report_to_json(diff, findings)
}

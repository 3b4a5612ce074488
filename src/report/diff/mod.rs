//! What differs between two programs, by meaning.
//!
//! Statements are aligned (`align`) and every pair is told apart: the same bytes, the same said differently, a point moved,
//! a feed changed. Whether the tool takes the same way is found from the motions ([`PathComparison`]), so two dialects can be
//! compared. The JSON ([`to_json`]) is [`ProgramDiff`] as it stands, with `"version": 1`; `version` changes when a reader of the
//! structure would have to, new keys may be added without.

mod alignment;
mod alignment_keys;
mod diff_collector;
mod difference_kind;
mod path_comparison;
mod text;

pub use difference_kind::DifferenceKind;
pub use path_comparison::PathComparison;
pub use text::{summarize_diff, to_text};

use super::stats::{DialectName, MotionTotals, ReportedRange, ResolvedLengthUnit};
use crate::program::Program;
use crate::program::RecordKind;
use serde::Serialize;
use std::collections::BTreeMap;

/// Changes of one [`DifferenceKind`] that are listed; all are counted.
pub const MOST_LISTED: usize = 500;

/// What differs between two programs.
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
    /// Whether the files are byte for byte the same.
    pub identical: bool,
    /// Whether a post-processor would see no difference: nothing but layout and comments differs.
    pub same_meaning: bool,
    /// The paths, compared.
    pub geometry: PathComparison,
    /// How many statements differ, and how.
    pub counts: DiffCounts,
    /// Largest distance that a point moved, in the second file's unit; `null` when none did.
    pub largest_move: Option<f64>,
    /// Change of feeds in percent, lowest and highest; `null` when none changed or their units cannot be compared.
    pub feed_change: Option<ReportedRange>,
    /// The operations in which something differs, in order.
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

/// How many statements differ, and how.
#[derive(Debug, Clone, PartialEq, Eq, Default, Serialize)]
pub struct DiffCounts {
    /// Statements of the same bytes.
    pub same: usize,
    /// Written differently, the same meaning: blanks, zeros, order of words.
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

/// An operation in which something differs.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct OperationDiff {
    /// Name in the second program, or in the first for one that was removed; empty before the first operation.
    pub name: String,
    /// How many statements differ, and how.
    pub counts: DiffCounts,
}

/// A statement that differs.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StatementDifference {
    /// How.
    pub what: DifferenceKind,
    /// What the statement is about.
    pub kind: RecordKind,
    /// Index in `operations`.
    pub operation: usize,
    /// Line in the first file; `null` where it has none.
    pub line_a: Option<usize>,
    /// Line in the second file; `null` where it has none.
    pub line_b: Option<usize>,
    /// Text in the first file, without line end; bytes that are no UTF-8 are read as Latin-1.
    pub old: Option<String>,
    /// Text in the second file.
    pub new: Option<String>,
    /// Of a moved point the distance in the second file's unit, of a feed the change in percent.
    pub by: Option<f64>,
}

impl ProgramDiff {
    /// Compares two programs as they stand.
    pub fn from_programs(a: &Program, b: &Program) -> Self {
        diff_collector::collect_diff(a, b)
    }

    /// Whether nothing differs, byte for byte.
    pub fn is_empty(&self) -> bool {
        self.identical
    }
}

impl DiffCounts {
    /// Whether nothing differs that a post-processor could see.
    pub fn has_same_meaning(&self) -> bool {
        let maps = [&self.changed, &self.added, &self.removed];
        self.moved == 0 && self.turned == 0 && self.feeds == 0 && maps.iter().all(|map| map.is_empty())
    }

    /// Whether nothing differs at all.
    pub fn is_empty(&self) -> bool {
        self.has_same_meaning() && self.layout == 0 && self.text == 0
    }
}

/// The differences as one JSON document, indented and with a line end.
pub fn to_json(diff: &ProgramDiff) -> String {
    super::to_json_text(diff)
}

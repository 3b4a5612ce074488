//! This module measures a program: lengths, times, tools and operations.
//!
//! It takes a single pass over the motions. The JSON ([`to_json`]) is [`ProgramStats`] with
//! `"version": 1`, and the findings of the run. `version` goes up when a reader of the old structure would fail. New keys may be added
//! without that. Lengths are in `units.unit`. Feeds are in that unit per minute, except in `feeds`, where
//! they are as programmed. Times are in seconds. An unknown value is `null` and never guessed.

mod bounding_box;
mod conversion;
mod feed_rows;
mod machine_time_parts;
mod stats_collector;
mod stats_columns;
mod stats_json;
mod text;
mod totals;

pub use bounding_box::MotionBoundingBox;
pub use feed_rows::FeedRow;
pub use machine_time_parts::MachineTimeParts;
pub(in crate::report) use stats_columns::totals_columns;
pub use text::to_text;
pub(crate) use totals::MotionLengthAndTime;
pub use totals::{MotionTotals, UntimedMotions};

use super::render::json::report_to_json;
use crate::diagnostic::Diagnostic;
use crate::program::{Dialect, LengthUnit, MotionClass, Program};
use crate::setup::Setup;
use serde::Serialize;

/// The statistics of a program.
///
/// ```
/// use clsmith::parse::parse;
/// use clsmith::report::stats::{ProgramStats, to_text};
/// use clsmith::setup::Setup;
/// use clsmith::source::Source;
///
/// let part = b"FROM/0,0,0\nFEDRAT/MMPM,600.\nGOTO/100,0,0\nGOTO/100,50,0\n";
/// let program = parse(&Source::new("part.cls", part.to_vec())?, None).program;
/// let stats = ProgramStats::from_program(&program, &Setup::default());
/// assert_eq!(stats.totals.feed_length, 150.0);
/// assert!(to_text(&stats).contains("150"));
/// # Ok::<(), clsmith::source::SourceTooLarge>(())
/// ```
#[derive(Debug, Clone, PartialEq, Serialize)]
#[non_exhaustive]
pub struct ProgramStats {
    /// Version of the JSON structure: 1.
    pub version: u32,
    /// The file's name.
    pub file: String,
    /// The number of bytes of the program in its current state.
    pub bytes: u64,
    /// The number of lines.
    pub lines: u64,
    /// The dialect.
    pub dialect: DialectName,
    /// The unit of all lengths here, and how it is known.
    pub units: ResolvedLengthUnit,
    /// The unit of the file, if lengths are shown in another one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub file_units: Option<ResolvedLengthUnit>,
    /// The number of statements, including comments and empty lines.
    pub statements: usize,
    /// The number of statements that could not be read.
    pub unreadable: usize,
    /// Lengths and times of the whole program.
    pub totals: MotionTotals,
    /// The time of the whole program on the machine by its parts; `null` if its axes and what corners cost are not known.
    pub machine_time: Option<MachineTimeParts>,
    /// Motions of each class that occurs.
    pub classes: Vec<ClassStats>,
    /// Lengths and times of each programmed feed; see [`FeedRow`].
    pub feeds: Vec<FeedRow>,
    /// Slowest and fastest feed, in the file's unit per minute.
    pub feed: Option<ReportedRange>,
    /// Slowest and fastest spindle at feed, in rev/min. A lathe's constant surface speed makes the slowest one at the
    /// largest radius and the fastest at the smallest, up to MAXRPM. It is infinite (`null` in JSON) where the tool meets
    /// the axis and no MAXRPM holds.
    pub spindle_rpm: Option<ReportedRange>,
    /// Whether the spindle keeps a surface speed somewhere, so that its speed changes within motions.
    pub spindle_keeps_surface_speed: bool,
    /// Paths by shape.
    pub paths: PathShapeCounts,
    /// The box of the motions at feed, in the program's coordinates.
    pub box_of_feed: Option<MotionBoundingBox>,
    /// Box of all motions, in the program's coordinates.
    pub box_of_all: Option<MotionBoundingBox>,
    /// The frames in which motions are programmed.
    pub frames: Vec<FrameStats>,
    /// The tools that move.
    pub tools: Vec<ToolStats>,
    /// The operations in order.
    pub operations: Vec<OperationStats>,
}

/// A dialect by name and title.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct DialectName {
    /// The name on the command line.
    pub name: &'static str,
    /// The name for people.
    pub title: &'static str,
}

impl From<Dialect> for DialectName {
    fn from(dialect: Dialect) -> Self {
        Self { name: dialect.name(), title: dialect.display_name() }
    }
}

/// A unit of length and how it is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct ResolvedLengthUnit {
    /// The unit.
    pub unit: LengthUnit,
    /// How it is known.
    pub from: LengthUnitOrigin,
}

/// How the unit of a file is known.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum LengthUnitOrigin {
    /// A UNITS record states it.
    File,
    /// The caller (a recipe or an option) gave it.
    Caller,
    /// There is no record, but every feed unit in the file belongs to this unit (`IPM`, `MMPM`).
    Feeds,
    /// Nothing states it, and millimetres are assumed.
    Assumed,
    /// It is not the unit of the file, but the one in which the caller wants lengths.
    Shown,
}

/// The motions of one class.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ClassStats {
    /// The class.
    pub class: MotionClass,
    /// Lengths and times.
    pub totals: MotionTotals,
}

/// A closed interval.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ReportedRange {
    /// Lowest.
    pub min: f64,
    /// Highest.
    pub max: f64,
}

impl ReportedRange {
    pub(crate) fn include_value(range: &mut Option<Self>, value: f64) {
        let range = range.get_or_insert(Self { min: value, max: value });
        range.min = range.min.min(value);
        range.max = range.max.max(value);
    }
}

/// Motions by the shape of their path.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct PathShapeCounts {
    /// Straight.
    pub lines: usize,
    /// Arcs in a plane.
    pub arcs: usize,
    /// Arcs that rise along their axis.
    pub helices: usize,
    /// Splines.
    pub splines: usize,
    /// Holes of drilling cycles. Their moves count as lines.
    pub holes: usize,
}

/// A frame.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct FrameStats {
    /// The line of the statement that sets it first; `null` if a step inserted that statement.
    pub line: Option<usize>,
    /// Origin, in the file's unit.
    pub origin: [f64; 3],
    /// Its z axis.
    pub z_axis: [f64; 3],
    /// Motions in it.
    pub motions: usize,
}

/// A tool, as far as the file describes it.
#[derive(Debug, Clone, PartialEq)]
pub struct ToolStats {
    /// Number.
    pub number: Option<u32>,
    /// Name.
    pub name: Option<String>,
    /// Diameter.
    pub diameter: Option<f64>,
    /// Radius of the nose of a lathe tool, which has no diameter.
    pub nose_radius: Option<f64>,
    /// Corner radius.
    pub corner_radius: Option<f64>,
    /// Length below the holder.
    pub length: Option<f64>,
    /// Length of the flutes.
    pub flute_length: Option<f64>,
    /// Taper of the flank in degrees.
    pub taper_degrees: Option<f64>,
    /// Angle of the tip in degrees.
    pub tip_degrees: Option<f64>,
    /// Lengths and times.
    pub totals: MotionTotals,
}

/// An operation.
#[derive(Debug, Clone, PartialEq)]
pub struct OperationStats {
    /// The name. It is empty if the file has none.
    pub name: String,
    /// The index in `tools` of the first tool that moves in it.
    pub tool: Option<usize>,
    /// Lengths and times.
    pub totals: MotionTotals,
    /// Slowest and fastest feed, in the file's unit per minute.
    pub feed: Option<ReportedRange>,
}

impl ProgramStats {
    /// Measures a program in its current state. Rapids get a time if the machine's rapid feed is known.
    pub fn from_program(program: &Program, setup: &Setup) -> Self {
        Self::with_assumed_unit(program, setup, None)
    }

    /// Does the same as [`ProgramStats::from_program`]. `units` is the unit of lengths if the file does not
    /// state it.
    pub fn with_assumed_unit(program: &Program, setup: &Setup, units: Option<LengthUnit>) -> Self {
        stats_collector::collect_stats(program, setup, ResolvedLengthUnit::from_program(program, units))
    }
}

impl ResolvedLengthUnit {
    /// Returns the unit of a program: the unit that it states, else the caller's, else the unit of its feeds,
    /// else millimetres.
    pub fn from_program(program: &Program, caller: Option<LengthUnit>) -> Self {
        if let Some(unit) = program.stated_length_unit() {
            return Self { unit, from: LengthUnitOrigin::File };
        }
        if let Some(unit) = caller {
            return Self { unit, from: LengthUnitOrigin::Caller };
        }
        match program.feed_length_unit() {
            Some(unit) => Self { unit, from: LengthUnitOrigin::Feeds },
            None => Self { unit: LengthUnit::Mm, from: LengthUnitOrigin::Assumed },
        }
    }
}

/// Returns the statistics as a JSON document, indented and with a line end. `findings` are those of the run,
/// after the policy; they are written under the key `findings`.
pub fn to_json(stats: &ProgramStats, findings: &[Diagnostic]) -> String {
    report_to_json(stats, findings)
}

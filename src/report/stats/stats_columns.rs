//! This module defines the columns of statistics: name, unit, value and printing. Values are in the file's
//! unit, and the keys of the JSON do not name the unit.

use super::{FeedRow, MotionBoundingBox, MotionTotals, OperationStats, ReportedRange, ToolStats};
use crate::presentation::safe_text::to_safe_line;
use crate::report::table::{Column, ColumnUnit, TableValue};
use crate::report::text_format::format_short;

/// Sums and what they are sums of.
pub(super) struct NamedTotals<'a> {
    pub name: String,
    pub totals: &'a MotionTotals,
}

/// An operation and the tools of the program.
pub(super) struct NamedOperation<'a> {
    pub operation: &'a OperationStats,
    pub tools: &'a [ToolStats],
}

/// A box and the motions that it is around.
pub(super) struct NamedBox {
    pub name: &'static str,
    pub bounds: MotionBoundingBox,
}

impl AsRef<MotionTotals> for MotionTotals {
    fn as_ref(&self) -> &MotionTotals {
        self
    }
}

impl AsRef<MotionTotals> for NamedTotals<'_> {
    fn as_ref(&self) -> &MotionTotals {
        self.totals
    }
}

impl AsRef<MotionTotals> for NamedOperation<'_> {
    fn as_ref(&self) -> &MotionTotals {
        &self.operation.totals
    }
}

impl AsRef<MotionTotals> for ToolStats {
    fn as_ref(&self) -> &MotionTotals {
        &self.totals
    }
}

/// Returns the sums as columns, in the order of the JSON.
pub(in crate::report) fn totals_columns<R: AsRef<MotionTotals>>() -> [Column<R>; 7] {
    use ColumnUnit as Unit;
    [
        Column::new("motions", Unit::None, |row: &R| row.as_ref().motions.into()),
        Column::new("feed_length", Unit::Length, |row: &R| row.as_ref().feed_length.into())
            .titled("at feed")
            .old_json_key("feed_length")
            .decimals(1),
        Column::new("rapid_length", Unit::Length, |row: &R| row.as_ref().rapid_length.into())
            .titled("at rapid")
            .old_json_key("rapid_length")
            .decimals(1),
        Column::new("feed_time", Unit::Duration, |row: &R| TableValue::Duration {
            seconds: row.as_ref().feed_seconds,
            // A time that leaves out motions is a lower bound.
            is_lower_bound: row.as_ref().unknown_time.motions > 0,
        })
        .titled("time")
        .worded_as("time at feed, without acceleration", 1)
        .old_json_key("feed_seconds"),
        Column::new("accelerated_time", Unit::Duration, |row: &R| {
            let totals = row.as_ref();
            let is_lower_bound = totals.unknown_time.motions > 0;
            let time = |seconds| TableValue::Duration { seconds, is_lower_bound };
            totals.accelerated_seconds.map_or(TableValue::Missing, time)
        })
        .titled("time")
        .worded_as("time at feed, with acceleration", 1)
        .old_json_key("accelerated_seconds"),
        Column::new("rapid_time", Unit::Duration, |row: &R| TableValue::duration(row.as_ref().rapid_seconds))
            .titled("time")
            .old_json_key("rapid_seconds"),
        Column::new("standing_time", Unit::Duration, |row: &R| {
            TableValue::duration(row.as_ref().standing_seconds)
        })
        .titled("standing")
        .old_json_key("standing_seconds")
        .worded_as("time for tool changes, spindle starts and dwells", 1),
    ]
}

/// Returns the column of the names of sums.
pub(super) fn name_column<'a>() -> Column<NamedTotals<'a>> {
    Column::new("class", ColumnUnit::None, |row: &NamedTotals<'a>| TableValue::text(&row.name)).left_aligned()
}

/// Returns the columns of an operation besides its sums, in the order of the JSON.
pub(super) fn operation_columns<'a>() -> [Column<NamedOperation<'a>>; 3] {
    [
        Column::new("name", ColumnUnit::None, |row: &NamedOperation<'a>| {
            TableValue::text(&row.operation.name)
        })
        .titled("operation")
        .left_aligned(),
        Column::new("tool", ColumnUnit::None, |row: &NamedOperation<'a>| {
            let tool = row.operation.tool.and_then(|tool| row.tools.get(tool));
            let name = tool.map(format_tool).unwrap_or_default();
            TableValue::Reference { index: row.operation.tool, name: name.into() }
        })
        .left_aligned(),
        Column::new("feed", ColumnUnit::FeedPerMinute, |row: &NamedOperation<'a>| {
            let range = row.operation.feed;
            range.map_or(TableValue::Missing, |ReportedRange { min, max }| TableValue::Range([min, max]))
        })
        .old_json_key("feed"),
    ]
}

/// Returns the columns of a tool besides its sums, in the order of the JSON.
pub(super) fn tool_columns() -> [Column<ToolStats>; 10] {
    use ColumnUnit as Unit;
    [
        Column::new("tool", Unit::None, |tool: &ToolStats| TableValue::Text(format_tool(tool).into()))
            .left_aligned()
            .only_in_csv(),
        Column::new("number", Unit::None, |tool: &ToolStats| {
            tool.number.map_or(TableValue::Missing, |number| TableValue::Count(number as usize))
        })
        .only_in_json(),
        Column::new("name", Unit::None, |tool: &ToolStats| {
            tool.name.as_deref().map_or(TableValue::Missing, TableValue::text)
        })
        .only_in_json(),
        Column::new("diameter", Unit::Length, |tool: &ToolStats| tool.diameter.into())
            .old_json_key("diameter"),
        Column::new("nose_radius", Unit::Length, |tool: &ToolStats| tool.nose_radius.into())
            .titled("nose radius")
            .old_json_key("nose_radius"),
        Column::new("corner_radius", Unit::Length, |tool: &ToolStats| tool.corner_radius.into())
            .titled("corner")
            .old_json_key("corner_radius"),
        Column::new("length", Unit::Length, |tool: &ToolStats| tool.length.into()).old_json_key("length"),
        Column::new("flute_length", Unit::Length, |tool: &ToolStats| tool.flute_length.into())
            .titled("flute length")
            .old_json_key("flute_length"),
        Column::new("taper", Unit::Angle, |tool: &ToolStats| tool.taper_degrees.into())
            .old_json_key("taper_degrees"),
        Column::new("tip", Unit::Angle, |tool: &ToolStats| tool.tip_degrees.into())
            .old_json_key("tip_degrees"),
    ]
}

/// Returns the columns of programmed feeds, in the order of the JSON. A feed stands in the unit that its
/// record names, so it is never converted.
pub(super) fn feed_columns() -> [Column<FeedRow>; 7] {
    use ColumnUnit as Unit;
    [
        Column::new("programmed_feed", Unit::None, |row: &FeedRow| {
            let [min, max] = [row.min, row.max].map(format_short);
            let range = if min == max { min } else { format!("{min} .. {max}") };
            TableValue::Text(format!("{range} {}", row.unit.unwrap_or("(no unit)")).into())
        })
        .titled("programmed feed")
        .left_aligned()
        .only_in_csv(),
        Column::new("unit", Unit::None, |row: &FeedRow| {
            row.unit.map_or(TableValue::Missing, TableValue::text)
        }),
        Column::new("min", Unit::None, |row: &FeedRow| row.min.into()),
        Column::new("max", Unit::None, |row: &FeedRow| row.max.into()),
        Column::new("motions", Unit::None, |row: &FeedRow| row.motions.into()),
        Column::new("length", Unit::Length, |row: &FeedRow| row.length.into())
            .old_json_key("length")
            .decimals(1),
        Column::new("time", Unit::Duration, |row: &FeedRow| TableValue::duration(row.seconds))
            .missing("?")
            .old_json_key("seconds"),
    ]
}

/// Returns the columns of boxes.
pub(super) fn box_columns() -> [Column<NamedBox>; 4] {
    let unit = ColumnUnit::Length;
    [
        Column::new("box", ColumnUnit::None, |named: &NamedBox| TableValue::text(named.name))
            .titled("")
            .left_aligned(),
        Column::new("x", unit, |named: &NamedBox| named.range(0)),
        Column::new("y", unit, |named: &NamedBox| named.range(1)),
        Column::new("z", unit, |named: &NamedBox| named.range(2)),
    ]
}

impl NamedBox {
    fn range(&self, axis: usize) -> TableValue<'static> {
        let ends = self.bounds.min.get(axis).zip(self.bounds.max.get(axis));
        ends.map_or(TableValue::Missing, |(low, high)| TableValue::Range([*low, *high]))
    }
}

/// Returns a tool as people call it: number and name.
fn format_tool(tool: &ToolStats) -> String {
    let number = tool.number.map(|number| number.to_string());
    let name = tool.name.as_deref().map(to_safe_line);
    match (number, name) {
        (Some(number), Some(name)) => format!("{number} {name}"),
        (one, other) => one.or(other).unwrap_or_else(|| "-".to_owned()),
    }
}

//! This module writes statistics as text for people.

use super::stats_columns::{
    NamedBox, NamedOperation, NamedTotals, box_columns, feed_columns, name_column, operation_columns,
    tool_columns, totals_columns,
};
use super::{FeedRow, LengthUnitOrigin, ProgramStats, ReportedRange};
use crate::presentation::safe_text::to_safe_line;
use crate::report::table::{DisplayUnits, PrintedTable, TableLooks, pick_columns};
use crate::report::text_format::{format_count, format_counted, format_short, unit_name};
use std::fmt::Write;

/// The number of rows of a table that are shown. The JSON has all of them.
const MOST_ROWS: usize = 24;

/// Returns the statistics as tables.
pub fn to_text(stats: &ProgramStats) -> String {
    let unit = unit_name(stats.units.unit);
    let mut out = String::new();
    let _ = writeln!(out, "{}: {}", to_safe_line(&stats.file), stats.dialect.title);
    let _ = writeln!(
        out,
        "  {}, {}, {}{}",
        format_counted(stats.bytes as usize, "byte", "bytes"),
        format_counted(stats.lines as usize, "line", "lines"),
        format_counted(stats.statements, "statement", "statements"),
        match stats.unreadable {
            0 => String::new(),
            some => format!(" ({} unreadable)", format_count(some as u64)),
        }
    );
    let _ = writeln!(
        out,
        "  lengths in {unit} ({}), feeds in {unit}/min, times at feed {}",
        match stats.file_units {
            None => describe_unit_origin(stats.units.from).to_owned(),
            Some(file) => {
                let origin = describe_unit_origin(file.from);
                format!("as asked for; those of the file are in {}, {origin}", file.unit)
            }
        },
        match stats.totals.accelerated_seconds {
            Some(_) if stats.machine_time.is_some() => "on the machine",
            Some(_) => "with the machine's acceleration",
            None => "without acceleration",
        },
    );
    append_path_shapes(&mut out, stats);
    if let Some(time) = stats.machine_time {
        let _ = writeln!(out, "  {}", time.to_sentence());
    }
    append_classes(&mut out, stats);
    append_operations(&mut out, stats);
    append_tools(&mut out, stats);
    append_feeds(&mut out, stats);
    append_bounding_boxes(&mut out, stats);
    out
}

fn describe_unit_origin(from: LengthUnitOrigin) -> &'static str {
    match from {
        LengthUnitOrigin::File => "stated in the file",
        LengthUnitOrigin::Caller => "as given; the file does not state it",
        LengthUnitOrigin::Feeds => "from the unit of its feeds; the file does not state it",
        LengthUnitOrigin::Assumed => "assumed; the file does not state it",
        LengthUnitOrigin::Shown => "as asked for",
    }
}

fn append_path_shapes(out: &mut String, stats: &ProgramStats) {
    let paths = stats.paths;
    let all = [
        (paths.lines, "line", "lines"),
        (paths.arcs, "arc", "arcs"),
        (paths.helices, "helix", "helices"),
        (paths.splines, "spline", "splines"),
        (paths.holes, "hole", "holes"),
        (stats.frames.len(), "frame", "frames"),
    ];
    let found: Vec<String> = all
        .iter()
        .filter(|(number, ..)| *number > 0)
        .map(|(n, one, many)| format_counted(*n, one, many))
        .collect();
    let found = if found.is_empty() { "no motions".to_owned() } else { found.join(", ") };
    let _ = writeln!(out, "  {found}");
    if let Some(rpm) = stats.spindle_rpm {
        let range = match rpm.max.is_finite() {
            true => format!("{} rev/min", format_range(Some(rpm))),
            // The tool meets the axis, where a surface speed has no end.
            false => format!("from {} rev/min up, with no MAXRPM at the axis", format_short(rpm.min)),
        };
        let kept = if stats.spindle_keeps_surface_speed { " (constant surface speed)" } else { "" };
        let _ = writeln!(out, "  spindle {range}{kept}");
    }
}

/// Returns the keys of the sums in tables, in this order. Only one time at feed is shown: the one with the
/// machine's acceleration if it is known, else the one without.
fn totals_keys(stats: &ProgramStats) -> Vec<&'static str> {
    let mut keys = vec!["motions", "feed_length", time_key(stats), "rapid_length", "rapid_time"];
    if stats.totals.standing_seconds.is_some_and(|seconds| seconds > 0.0) {
        keys.push("standing_time");
    }
    keys
}

fn time_key(stats: &ProgramStats) -> &'static str {
    if stats.totals.accelerated_seconds.is_some() { "accelerated_time" } else { "feed_time" }
}

/// Returns the style of the tables. A line above them gives the units.
fn table_looks(stats: &ProgramStats) -> TableLooks {
    TableLooks::plain(DisplayUnits::unconverted(stats.units.unit)).without_units_in_heads()
}

fn append_classes(out: &mut String, stats: &ProgramStats) {
    if stats.totals.motions == 0 {
        return;
    }
    let mut rows: Vec<NamedTotals<'_>> = stats
        .classes
        .iter()
        .map(|class| NamedTotals { name: class.class.to_string(), totals: &class.totals })
        .collect();
    rows.push(NamedTotals { name: "total".to_owned(), totals: &stats.totals });
    let mut columns = vec![name_column()];
    columns.extend(pick_columns(&totals_columns(), &totals_keys(stats)));
    let _ = write!(out, "\n{}", PrintedTable::from_rows(&columns, &rows, table_looks(stats)).to_text());
    let unknown = stats.totals.unknown_time;
    let reasons = [
        (unknown.no_feed, "no feed is programmed"),
        (unknown.no_spindle_speed, "a feed per revolution has no speed in rev/min"),
        (unknown.zero_feed, "the feed is 0"),
    ];
    for (number, reason) in reasons.into_iter().filter(|(number, _)| *number > 0) {
        let _ = writeln!(
            out,
            "  {} without a time: {reason}",
            format_counted(number, "motion is", "motions are")
        );
    }
}

fn append_operations(out: &mut String, stats: &ProgramStats) {
    if stats.operations.len() < 2 && stats.operations.iter().all(|operation| operation.name.is_empty()) {
        return;
    }
    let [name, tool, feed] = operation_columns();
    let mut columns = vec![name, tool];
    columns.extend(pick_columns(&totals_columns(), &totals_keys(stats)));
    columns.push(feed);
    let named = |operation| NamedOperation { operation, tools: &stats.tools };
    let rows: Vec<NamedOperation<'_>> = stats.operations.iter().map(named).collect();
    let table = PrintedTable::from_rows(&columns, &rows, table_looks(stats)).keep_rows(MOST_ROWS);
    let _ = write!(out, "\n{}", table.to_text());
}

fn append_tools(out: &mut String, stats: &ProgramStats) {
    if stats.tools.is_empty() {
        return;
    }
    let mut shape = vec!["tool", "diameter", "corner_radius", "length", "flute_length"];
    if stats.tools.iter().any(|tool| tool.nose_radius.is_some()) {
        shape.insert(2, "nose_radius");
    }
    let mut columns = pick_columns(&tool_columns(), &shape);
    columns.extend(pick_columns(&totals_columns(), &["motions", "feed_length", time_key(stats)]));
    let table = PrintedTable::from_rows(&columns, &stats.tools, table_looks(stats)).keep_rows(MOST_ROWS);
    let _ = write!(out, "\n{}", table.to_text());
}

fn append_feeds(out: &mut String, stats: &ProgramStats) {
    if stats.feeds.is_empty() {
        return;
    }
    let mut shown: Vec<&FeedRow> = stats.feeds.iter().collect();
    if shown.len() > MOST_ROWS {
        // The feeds with the longest paths matter most. They stay in the order of the table.
        let mut lengths: Vec<f64> = shown.iter().map(|row| row.length).collect();
        lengths.sort_by(|a, b| b.total_cmp(a));
        let least = lengths.get(MOST_ROWS - 1).copied().unwrap_or(0.0);
        shown.retain(|row| row.length >= least);
        shown.truncate(MOST_ROWS);
    }
    let columns = pick_columns(&feed_columns(), &["programmed_feed", "motions", "length", "time"]);
    let left_out = stats.feeds.len() - shown.len();
    let table = PrintedTable::from_rows(&columns, shown, table_looks(stats)).leave_out(left_out);
    let _ = write!(out, "\n{}", table.to_text());
}

fn format_range(range: Option<ReportedRange>) -> String {
    match range {
        None => "-".to_owned(),
        Some(ReportedRange { min, max }) if format_short(min) == format_short(max) => format_short(min),
        Some(ReportedRange { min, max }) => format!("{} .. {}", format_short(min), format_short(max)),
    }
}

fn append_bounding_boxes(out: &mut String, stats: &ProgramStats) {
    let boxes = [("box at feed", stats.box_of_feed), ("box of all", stats.box_of_all)];
    let known = boxes.into_iter().filter_map(|(name, bounds)| bounds.map(|bounds| NamedBox { name, bounds }));
    let rows: Vec<NamedBox> = known.collect();
    let table = PrintedTable::from_rows(&box_columns(), &rows, table_looks(stats));
    if !table.is_empty() {
        let _ = write!(out, "\n{}", table.to_text());
    }
}

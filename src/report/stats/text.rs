//! Statistics as text for people.

use super::{
    FeedRow, LengthUnitOrigin, MotionBoundingBox, MotionTotals, ProgramStats, ReportedRange, ToolStats,
};
use crate::presentation::safe_text::to_safe_line;
use crate::report::text_format::{
    format_count, format_counted, format_duration, format_fixed, format_short, format_table, unit_name,
};
use std::fmt::Write;

/// Rows of a table that are shown; the JSON has all.
const MOST_ROWS: usize = 24;

/// The statistics as tables.
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
        "  lengths in {unit} ({}), feeds in {unit}/min",
        describe_unit_origin(stats.units.from)
    );
    append_path_shapes(&mut out, stats);
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
        LengthUnitOrigin::Caller => "as told; the file does not say",
        LengthUnitOrigin::Feeds => "from the unit of its feeds; the file does not say",
        LengthUnitOrigin::Assumed => "assumed; the file does not say",
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
        let _ = writeln!(out, "  spindle {} rev/min", format_range(Some(rpm)));
    }
}

fn head_cells(first: &str, rest: &[&str]) -> Vec<String> {
    std::iter::once(first).chain(rest.iter().copied()).map(str::to_owned).collect()
}

const SUMS: [&str; 5] = ["motions", "at feed", "time", "at rapid", "time"];

fn totals_cells(totals: &MotionTotals) -> [String; 5] {
    // A time that leaves motions out is a lower bound, and says so.
    let more = if totals.unknown_time.motions > 0 { "> " } else { "" };
    [
        format_count(totals.motions as u64),
        format_fixed(totals.feed_length, 1),
        format!("{more}{}", format_duration(totals.feed_seconds)),
        format_fixed(totals.rapid_length, 1),
        totals.rapid_seconds.map_or_else(|| "-".to_owned(), format_duration),
    ]
}

fn named_totals_cells(name: &str, totals: &MotionTotals) -> Vec<String> {
    std::iter::once(name.to_owned()).chain(totals_cells(totals)).collect()
}

fn append_classes(out: &mut String, stats: &ProgramStats) {
    if stats.totals.motions == 0 {
        return;
    }
    let mut rows = vec![head_cells("class", &SUMS)];
    rows.extend(
        stats.classes.iter().map(|class| named_totals_cells(&class.class.to_string(), &class.totals)),
    );
    rows.push(named_totals_cells("total", &stats.totals));
    let _ = write!(out, "\n{}", format_table(&rows));
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

fn append_hidden_row_count(out: &mut String, rows: usize) {
    if let Some(left) = rows.checked_sub(MOST_ROWS).filter(|left| *left > 0) {
        let _ = writeln!(out, "  and {} more", format_count(left as u64));
    }
}

fn append_operations(out: &mut String, stats: &ProgramStats) {
    if stats.operations.len() < 2 && stats.operations.iter().all(|operation| operation.name.is_empty()) {
        return;
    }
    let mut rows =
        vec![head_cells("operation", &["tool", "motions", "at feed", "time", "at rapid", "time", "feed"])];
    for operation in stats.operations.iter().take(MOST_ROWS) {
        let tool = operation.tool.and_then(|tool| stats.tools.get(tool));
        let mut cells = vec![to_safe_line(&operation.name), tool.map(format_tool).unwrap_or_default()];
        cells.extend(totals_cells(&operation.totals));
        cells.push(format_range(operation.feed));
        rows.push(cells);
    }
    let _ = write!(out, "\n{}", format_table(&rows));
    append_hidden_row_count(out, stats.operations.len());
}

fn format_tool(tool: &ToolStats) -> String {
    let number = tool.number.map(|number| number.to_string());
    let name = tool.name.as_deref().map(to_safe_line);
    match (number, name) {
        (Some(number), Some(name)) => format!("{number} {name}"),
        (one, other) => one.or(other).unwrap_or_else(|| "-".to_owned()),
    }
}

fn append_tools(out: &mut String, stats: &ProgramStats) {
    if stats.tools.is_empty() {
        return;
    }
    let rest = ["diameter", "corner", "length", "flutes", "motions", "at feed", "time"];
    let mut rows = vec![head_cells("tool", &rest)];
    for tool in stats.tools.iter().take(MOST_ROWS) {
        let shape = [tool.diameter, tool.corner_radius, tool.length, tool.flute_length];
        let mut cells = vec![format_tool(tool)];
        cells.extend(shape.map(|value| value.map_or_else(|| "-".to_owned(), format_short)));
        cells.extend(totals_cells(&tool.totals).into_iter().take(3));
        rows.push(cells);
    }
    let _ = write!(out, "\n{}", format_table(&rows));
    append_hidden_row_count(out, stats.tools.len());
}

fn append_feeds(out: &mut String, stats: &ProgramStats) {
    if stats.feeds.is_empty() {
        return;
    }
    let mut shown: Vec<&FeedRow> = stats.feeds.iter().collect();
    if shown.len() > MOST_ROWS {
        // The longest feeds are those that matter; they stay in the order of the table.
        let mut lengths: Vec<f64> = shown.iter().map(|row| row.length).collect();
        lengths.sort_by(|a, b| b.total_cmp(a));
        let least = lengths.get(MOST_ROWS - 1).copied().unwrap_or(0.0);
        shown.retain(|row| row.length >= least);
        shown.truncate(MOST_ROWS);
    }
    let mut rows = vec![head_cells("programmed feed", &["motions", "length", "time"])];
    for row in shown {
        let unit = row.unit.unwrap_or("(no unit)");
        rows.push(vec![
            format!("{} {unit}", format_range(Some(ReportedRange { min: row.min, max: row.max }))),
            format_count(row.motions as u64),
            format_fixed(row.length, 1),
            row.seconds.map_or_else(|| "?".to_owned(), format_duration),
        ]);
    }
    let _ = write!(out, "\n{}", format_table(&rows));
    append_hidden_row_count(out, stats.feeds.len());
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
    let mut rows = vec![head_cells("", &["x", "y", "z"])];
    for (name, bounds) in boxes {
        let Some(MotionBoundingBox { min, max }) = bounds else { continue };
        let sides = min
            .iter()
            .zip(max)
            .map(|(low, high)| format!("{} .. {}", format_short(*low), format_short(high)));
        rows.push(std::iter::once(name.to_owned()).chain(sides).collect());
    }
    if rows.len() > 1 {
        let _ = write!(out, "\n{}", format_table(&rows));
    }
}

//! Statistics as text for people.

use super::{Bounds, FeedRow, Range, Stats, ToolStats, Totals, UnitsFrom};
use crate::report::render::text::one_line;
use crate::report::table::{count, counted, duration, fixed, short, table, unit_name};
use std::fmt::Write;

/// Rows of a table that are shown; the JSON has all.
const MOST_ROWS: usize = 24;

/// The statistics as tables.
pub fn to_text(stats: &Stats) -> String {
    let unit = unit_name(stats.units.unit);
    let mut out = String::new();
    let _ = writeln!(out, "{}: {}", one_line(&stats.file), stats.dialect.title);
    let _ = writeln!(
        out,
        "  {}, {}, {}{}",
        counted(stats.bytes as usize, "byte", "bytes"),
        counted(stats.lines as usize, "line", "lines"),
        counted(stats.statements, "statement", "statements"),
        match stats.unreadable {
            0 => String::new(),
            some => format!(" ({} unreadable)", count(some as u64)),
        }
    );
    let _ = writeln!(out, "  lengths in {unit} ({}), feeds in {unit}/min", known(stats.units.from));
    paths(&mut out, stats);
    classes(&mut out, stats);
    operations(&mut out, stats);
    tools(&mut out, stats);
    feeds(&mut out, stats);
    boxes(&mut out, stats);
    out
}

fn known(from: UnitsFrom) -> &'static str {
    match from {
        UnitsFrom::File => "stated in the file",
        UnitsFrom::Caller => "as told; the file does not say",
        UnitsFrom::Feeds => "from the unit of its feeds; the file does not say",
        UnitsFrom::Assumed => "assumed; the file does not say",
    }
}

fn paths(out: &mut String, stats: &Stats) {
    let paths = stats.paths;
    let all = [
        (paths.lines, "line", "lines"),
        (paths.arcs, "arc", "arcs"),
        (paths.helices, "helix", "helices"),
        (paths.splines, "spline", "splines"),
        (paths.holes, "hole", "holes"),
        (stats.frames.len(), "frame", "frames"),
    ];
    let found: Vec<String> =
        all.iter().filter(|(number, ..)| *number > 0).map(|(n, one, many)| counted(*n, one, many)).collect();
    let found = if found.is_empty() { "no motions".to_owned() } else { found.join(", ") };
    let _ = writeln!(out, "  {found}");
    if let Some(rpm) = stats.spindle_rpm {
        let _ = writeln!(out, "  spindle {} rev/min", range(Some(rpm)));
    }
}

fn head(first: &str, rest: &[&str]) -> Vec<String> {
    std::iter::once(first).chain(rest.iter().copied()).map(str::to_owned).collect()
}

const SUMS: [&str; 5] = ["motions", "at feed", "time", "at rapid", "time"];

fn sums(totals: &Totals) -> [String; 5] {
    // A time that leaves motions out is a lower bound, and says so.
    let more = if totals.unknown_time.motions > 0 { "> " } else { "" };
    [
        count(totals.motions as u64),
        fixed(totals.feed_length, 1),
        format!("{more}{}", duration(totals.feed_seconds)),
        fixed(totals.rapid_length, 1),
        totals.rapid_seconds.map_or_else(|| "-".to_owned(), duration),
    ]
}

fn row(name: &str, totals: &Totals) -> Vec<String> {
    std::iter::once(name.to_owned()).chain(sums(totals)).collect()
}

fn classes(out: &mut String, stats: &Stats) {
    if stats.totals.motions == 0 {
        return;
    }
    let mut rows = vec![head("class", &SUMS)];
    rows.extend(stats.classes.iter().map(|class| row(&class.class.to_string(), &class.totals)));
    rows.push(row("total", &stats.totals));
    let _ = write!(out, "\n{}", table(&rows));
    let unknown = stats.totals.unknown_time;
    let reasons = [
        (unknown.no_feed, "no feed is programmed"),
        (unknown.no_spindle_speed, "a feed per revolution has no speed in rev/min"),
        (unknown.zero_feed, "the feed is 0"),
    ];
    for (number, reason) in reasons.into_iter().filter(|(number, _)| *number > 0) {
        let _ = writeln!(out, "  {} without a time: {reason}", counted(number, "motion is", "motions are"));
    }
}

fn more(out: &mut String, rows: usize) {
    if let Some(left) = rows.checked_sub(MOST_ROWS).filter(|left| *left > 0) {
        let _ = writeln!(out, "  and {} more", count(left as u64));
    }
}

fn operations(out: &mut String, stats: &Stats) {
    if stats.operations.len() < 2 && stats.operations.iter().all(|operation| operation.name.is_empty()) {
        return;
    }
    let mut rows =
        vec![head("operation", &["tool", "motions", "at feed", "time", "at rapid", "time", "feed"])];
    for operation in stats.operations.iter().take(MOST_ROWS) {
        let tool = operation.tool.and_then(|tool| stats.tools.get(tool));
        let mut cells = vec![one_line(&operation.name), tool.map(tool_name).unwrap_or_default()];
        cells.extend(sums(&operation.totals));
        cells.push(range(operation.feed));
        rows.push(cells);
    }
    let _ = write!(out, "\n{}", table(&rows));
    more(out, stats.operations.len());
}

fn tool_name(tool: &ToolStats) -> String {
    let number = tool.number.map(|number| number.to_string());
    let name = tool.name.as_deref().map(one_line);
    match (number, name) {
        (Some(number), Some(name)) => format!("{number} {name}"),
        (one, other) => one.or(other).unwrap_or_else(|| "-".to_owned()),
    }
}

fn tools(out: &mut String, stats: &Stats) {
    if stats.tools.is_empty() {
        return;
    }
    let rest = ["diameter", "corner", "length", "flutes", "motions", "at feed", "time"];
    let mut rows = vec![head("tool", &rest)];
    for tool in stats.tools.iter().take(MOST_ROWS) {
        let shape = [tool.diameter, tool.corner_radius, tool.length, tool.flute_length];
        let mut cells = vec![tool_name(tool)];
        cells.extend(shape.map(|value| value.map_or_else(|| "-".to_owned(), short)));
        cells.extend(sums(&tool.totals).into_iter().take(3));
        rows.push(cells);
    }
    let _ = write!(out, "\n{}", table(&rows));
    more(out, stats.tools.len());
}

fn feeds(out: &mut String, stats: &Stats) {
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
    let mut rows = vec![head("programmed feed", &["motions", "length", "time"])];
    for row in shown {
        let unit = row.unit.unwrap_or("(no unit)");
        rows.push(vec![
            format!("{} {unit}", range(Some(Range { min: row.min, max: row.max }))),
            count(row.motions as u64),
            fixed(row.length, 1),
            row.seconds.map_or_else(|| "?".to_owned(), duration),
        ]);
    }
    let _ = write!(out, "\n{}", table(&rows));
    more(out, stats.feeds.len());
}

fn range(range: Option<Range>) -> String {
    match range {
        None => "-".to_owned(),
        Some(Range { min, max }) if short(min) == short(max) => short(min),
        Some(Range { min, max }) => format!("{} .. {}", short(min), short(max)),
    }
}

fn boxes(out: &mut String, stats: &Stats) {
    let boxes = [("box at feed", stats.box_of_feed), ("box of all", stats.box_of_all)];
    let mut rows = vec![head("", &["x", "y", "z"])];
    for (name, bounds) in boxes {
        let Some(Bounds { min, max }) = bounds else { continue };
        let sides = min.iter().zip(max).map(|(low, high)| format!("{} .. {}", short(*low), short(high)));
        rows.push(std::iter::once(name.to_owned()).chain(sides).collect());
    }
    if rows.len() > 1 {
        let _ = write!(out, "\n{}", table(&rows));
    }
}

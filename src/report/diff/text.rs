//! This module writes differences as text for people.

use super::{DiffCounts, DifferenceKind, ProgramDiff, StatementDifference};
use crate::presentation::safe_text::to_safe_line;
use crate::program::RecordKind;
use crate::report::text_format::{format_counted, format_duration, format_length, format_short, unit_name};
use std::collections::BTreeMap;
use std::fmt::Write;

/// Returns the differences: a summary, then the differences of each operation, at most `most` statements of
/// each.
pub fn to_text(diff: &ProgramDiff, most: usize) -> String {
    let mut out = format!("{} -> {}\n", to_safe_line(&diff.a.file), to_safe_line(&diff.b.file));
    if diff.a.dialect != diff.b.dialect {
        let _ = writeln!(out, "{} -> {}", diff.a.dialect.title, diff.b.dialect.title);
    }
    out.push_str(&summarize_diff(diff));
    let mut changes = diff.changes.iter().peekable();
    for (index, operation) in diff.operations.iter().enumerate() {
        let name = match operation.name.as_str() {
            "" => "(no operation)".to_owned(),
            name => to_safe_line(name),
        };
        let _ = writeln!(out, "\n{name}: {}", describe_counts(&operation.counts, None).join(", "));
        let mut shown = 0;
        while let Some(change) = changes.next_if(|change| change.operation == index) {
            if shown < most {
                append_difference(&mut out, change, unit_name(diff.b.units.unit));
            }
            shown += 1;
        }
        let all = count_differences(&operation.counts);
        if most > 0 && all > shown.min(most) {
            let _ = writeln!(out, "  and {} more", all - shown.min(most));
        }
    }
    out
}

/// Returns the differences in a few lines.
pub fn summarize_diff(diff: &ProgramDiff) -> String {
    if diff.is_empty() {
        return "the same, byte for byte\n".to_owned();
    }
    let mut out = String::from(if diff.geometry.same { "same geometry: yes" } else { "same geometry: no" });
    if let Some(parts) = diff.geometry.parts_at {
        let line =
            |line: Option<usize>| line.map_or_else(|| "the end".to_owned(), |line| format!("line {line}"));
        let _ = write!(out, " (the paths separate at {} -> {})", line(parts.0), line(parts.1));
    }
    out.push('\n');
    let _ = writeln!(out, "{}", describe_counts(&diff.counts, Some(diff)).join(", "));
    let (a, b) = (&diff.a, &diff.b);
    let time = |totals: &crate::report::stats::MotionTotals| {
        let more = if totals.unknown_time.motions > 0 { "> " } else { "" };
        format!("{more}{}", format_duration(totals.feed_seconds))
    };
    let _ = writeln!(
        out,
        "path length {} -> {}, time at feed {} -> {}",
        format_length(a.totals.length(), a.units.unit),
        format_length(b.totals.length(), b.units.unit),
        time(&a.totals),
        time(&b.totals)
    );
    out
}

fn describe_counts(counts: &DiffCounts, diff: Option<&ProgramDiff>) -> Vec<String> {
    let mut out = Vec::new();
    let mut say = |number: usize, one: &str, many: &str, more: String| {
        if number > 0 {
            out.push(format!("{}{more}", format_counted(number, one, many)));
        }
    };
    let feeds = diff.and_then(|diff| diff.feed_change);
    let feeds =
        feeds.map(|range| format!(" ({} .. {})", format_percent(range.min), format_percent(range.max)));
    let moved = diff.and_then(|diff| Some((diff.largest_move?, diff.b.units.unit)));
    let moved = moved.map(|(by, unit)| format!(" (at most {} {})", format_distance(by), unit_name(unit)));
    say(counts.feeds, "feed changed", "feeds changed", feeds.unwrap_or_default());
    say(counts.moved, "point moved", "points moved", moved.unwrap_or_default());
    say(counts.turned, "axis turned", "axes turned", String::new());
    for (map, verb) in [(&counts.added, "added"), (&counts.removed, "removed"), (&counts.changed, "changed")]
    {
        append_kind_phrases(&mut out, map, verb);
    }
    let mut say = |number: usize, one: &str, many: &str| {
        if number > 0 {
            out.push(format_counted(number, one, many));
        }
    };
    say(counts.text, "comment differs", "comments differ");
    say(counts.layout, "statement written differently", "statements written differently");
    if out.is_empty() {
        out.push("no statement differs".to_owned());
    }
    out
}

fn append_kind_phrases(out: &mut Vec<String>, map: &BTreeMap<RecordKind, usize>, verb: &str) {
    for (kind, number) in map {
        out.push(format!("{} {verb}", format_counted(*number, kind.display_name(1), kind.display_name(2))));
    }
}

fn count_differences(counts: &DiffCounts) -> usize {
    let maps = [&counts.added, &counts.removed, &counts.changed];
    let kinds: usize = maps.iter().flat_map(|map| map.values()).sum();
    counts.feeds + counts.moved + counts.turned + counts.text + counts.layout + kinds
}

fn format_percent(value: f64) -> String {
    format!("{value:+.1} %")
}

/// Formats a distance. Small ones keep the digits that distinguish them from zero.
fn format_distance(value: f64) -> String {
    if value < 0.001 { format!("{value:.6}") } else { format_short(value) }
}

fn append_difference(out: &mut String, change: &StatementDifference, unit: &str) {
    let line = |line: Option<usize>| line.map_or_else(|| "-".to_owned(), |line| line.to_string());
    let what = match (change.what, change.by) {
        (DifferenceKind::Layout, _) => "written differently".to_owned(),
        (DifferenceKind::Text, _) => "comment".to_owned(),
        (DifferenceKind::Moved, Some(by)) => format!("moved by {} {unit}", format_distance(by)),
        (DifferenceKind::Moved, None) => "moved".to_owned(),
        (DifferenceKind::Turned, _) => "axis turned".to_owned(),
        (DifferenceKind::Feed, Some(by)) => format!("feed {}", format_percent(by)),
        (DifferenceKind::Feed, None) => "feed".to_owned(),
        (DifferenceKind::Changed, _) => "changed".to_owned(),
        (DifferenceKind::Added, _) => "added".to_owned(),
        (DifferenceKind::Removed, _) => "removed".to_owned(),
    };
    let _ = writeln!(out, "  line {} -> {}: {what}", line(change.line_a), line(change.line_b));
    for (sign, text) in [('-', &change.old), ('+', &change.new)] {
        let Some(text) = text else { continue };
        for line in text.lines() {
            let _ = writeln!(out, "    {sign} {}", to_visible_line(line));
        }
    }
}

/// Returns a line with visible blanks, because blanks may be the only difference.
fn to_visible_line(line: &str) -> String {
    line.chars().map(|c| crate::presentation::safe_text::to_visible_character(c, true)).collect()
}

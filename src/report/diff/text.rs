//! Differences as text for people.

use super::{Counts, Diff, Difference, What};
use crate::report::kind::Kind;
use crate::report::render::text::one_line;
use crate::report::table::{counted, duration, length, short, unit_name};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The differences: the summary, then for each operation what differs, at most `most` statements of it.
pub fn to_text(diff: &Diff, most: usize) -> String {
    let mut out = format!("{} -> {}\n", one_line(&diff.a.file), one_line(&diff.b.file));
    if diff.a.dialect != diff.b.dialect {
        let _ = writeln!(out, "{} -> {}", diff.a.dialect.title, diff.b.dialect.title);
    }
    out.push_str(&summary(diff));
    let mut changes = diff.changes.iter().peekable();
    for (index, operation) in diff.operations.iter().enumerate() {
        let name = match operation.name.as_str() {
            "" => "(no operation)".to_owned(),
            name => one_line(name),
        };
        let _ = writeln!(out, "\n{name}: {}", phrases(&operation.counts, None).join(", "));
        let mut shown = 0;
        while let Some(change) = changes.next_if(|change| change.operation == index) {
            if shown < most {
                push(&mut out, change, unit_name(diff.b.units.unit));
            }
            shown += 1;
        }
        let all = total(&operation.counts);
        if most > 0 && all > shown.min(most) {
            let _ = writeln!(out, "  and {} more", all - shown.min(most));
        }
    }
    out
}

/// The differences in a few lines.
pub fn summary(diff: &Diff) -> String {
    if diff.is_empty() {
        return "the same, byte for byte\n".to_owned();
    }
    let mut out = String::from(if diff.geometry.same { "same geometry: yes" } else { "same geometry: no" });
    if let Some(parts) = diff.geometry.parts_at {
        let line =
            |line: Option<usize>| line.map_or_else(|| "the end".to_owned(), |line| format!("line {line}"));
        let _ = write!(out, " (the paths part at {} -> {})", line(parts.0), line(parts.1));
    }
    out.push('\n');
    let _ = writeln!(out, "{}", phrases(&diff.counts, Some(diff)).join(", "));
    let (a, b) = (&diff.a, &diff.b);
    let time = |totals: &crate::report::stats::Totals| {
        let more = if totals.unknown_time.motions > 0 { "> " } else { "" };
        format!("{more}{}", duration(totals.feed_seconds))
    };
    let _ = writeln!(
        out,
        "path length {} -> {}, time at feed {} -> {}",
        length(a.totals.length(), a.units.unit),
        length(b.totals.length(), b.units.unit),
        time(&a.totals),
        time(&b.totals)
    );
    out
}

fn phrases(counts: &Counts, diff: Option<&Diff>) -> Vec<String> {
    let mut out = Vec::new();
    let mut say = |number: usize, one: &str, many: &str, more: String| {
        if number > 0 {
            out.push(format!("{}{more}", counted(number, one, many)));
        }
    };
    let feeds = diff.and_then(|diff| diff.feed_change);
    let feeds = feeds.map(|range| format!(" ({} .. {})", percent(range.min), percent(range.max)));
    let moved = diff.and_then(|diff| Some((diff.largest_move?, diff.b.units.unit)));
    let moved = moved.map(|(by, unit)| format!(" (at most {} {})", distance(by), unit_name(unit)));
    say(counts.feeds, "feed changed", "feeds changed", feeds.unwrap_or_default());
    say(counts.moved, "point moved", "points moved", moved.unwrap_or_default());
    say(counts.turned, "axis turned", "axes turned", String::new());
    for (map, verb) in [(&counts.added, "added"), (&counts.removed, "removed"), (&counts.changed, "changed")]
    {
        kinds(&mut out, map, verb);
    }
    let mut say = |number: usize, one: &str, many: &str| {
        if number > 0 {
            out.push(counted(number, one, many));
        }
    };
    say(counts.text, "comment differs", "comments differ");
    say(counts.layout, "statement written differently", "statements written differently");
    if out.is_empty() {
        out.push("no statement differs".to_owned());
    }
    out
}

fn kinds(out: &mut Vec<String>, map: &BTreeMap<Kind, usize>, verb: &str) {
    for (kind, number) in map {
        out.push(format!("{} {verb}", counted(*number, kind.name(1), kind.name(2))));
    }
}

fn total(counts: &Counts) -> usize {
    let maps = [&counts.added, &counts.removed, &counts.changed];
    let kinds: usize = maps.iter().flat_map(|map| map.values()).sum();
    counts.feeds + counts.moved + counts.turned + counts.text + counts.layout + kinds
}

fn percent(value: f64) -> String {
    format!("{value:+.1} %")
}

/// Small moves keep the digits that tell them from none.
fn distance(value: f64) -> String {
    if value < 0.001 { format!("{value:.6}") } else { short(value) }
}

fn push(out: &mut String, change: &Difference, unit: &str) {
    let line = |line: Option<usize>| line.map_or_else(|| "-".to_owned(), |line| line.to_string());
    let what = match (change.what, change.by) {
        (What::Layout, _) => "written differently".to_owned(),
        (What::Text, _) => "comment".to_owned(),
        (What::Moved, Some(by)) => format!("moved by {} {unit}", distance(by)),
        (What::Moved, None) => "moved".to_owned(),
        (What::Turned, _) => "axis turned".to_owned(),
        (What::Feed, Some(by)) => format!("feed {}", percent(by)),
        (What::Feed, None) => "feed".to_owned(),
        (What::Changed, _) => "changed".to_owned(),
        (What::Added, _) => "added".to_owned(),
        (What::Removed, _) => "removed".to_owned(),
    };
    let _ = writeln!(out, "  line {} -> {}: {what}", line(change.line_a), line(change.line_b));
    for (sign, text) in [('-', &change.old), ('+', &change.new)] {
        let Some(text) = text else { continue };
        for line in text.lines() {
            let _ = writeln!(out, "    {sign} {}", visible(line));
        }
    }
}

/// One line as it stands, blanks kept, since blanks may be all that differs.
fn visible(line: &str) -> String {
    line.chars().map(|c| crate::report::render::text::visible(c, true)).collect()
}

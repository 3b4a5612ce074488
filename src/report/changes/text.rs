//! The changes of a recipe as text for people.

use super::{RecipeChanges, StepChanges};
use crate::presentation::safe_text::to_safe_line;
use crate::program::RecordKind;
use crate::report::stats::MotionTotals;
use crate::report::text_format::{format_counted, format_duration, format_fixed, format_table, unit_name};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The changes: a line for each step, and the program before and after.
pub fn to_text(changes: &RecipeChanges) -> String {
    let mut out = format!("{}\n", to_safe_line(&changes.file));
    out.push_str(&steps_to_text(&changes.steps));
    let _ = writeln!(out, "  {} untouched", format_counted(changes.untouched, "statement", "statements"));
    let _ = write!(out, "\n{}", format_totals(changes));
    out
}

/// A line for each step.
pub fn steps_to_text(steps: &[StepChanges]) -> String {
    let mut out = String::new();
    for (index, step) in steps.iter().enumerate() {
        let mut phrases = Vec::new();
        for (map, verb) in
            [(&step.edited, "edited"), (&step.inserted, "inserted"), (&step.deleted, "deleted")]
        {
            phrases.extend(format_kind_counts(map, verb));
        }
        let phrases = if phrases.is_empty() { "no change".to_owned() } else { phrases.join(", ") };
        let _ = writeln!(out, "  {}. {}: {phrases}", index + 1, to_safe_line(&step.name));
    }
    out
}

fn format_kind_counts(map: &BTreeMap<RecordKind, usize>, verb: &str) -> Vec<String> {
    map.iter()
        .map(|(kind, number)| {
            format!("{} {verb}", format_counted(*number, kind.display_name(1), kind.display_name(2)))
        })
        .collect()
}

fn format_totals(changes: &RecipeChanges) -> String {
    let unit = unit_name(changes.units.unit);
    let (before, after) = (&changes.before, &changes.after);
    let time = |totals: &MotionTotals| {
        let more = if totals.unknown_time.motions > 0 { "> " } else { "" };
        format!("{more}{}", format_duration(totals.feed_seconds))
    };
    let row = |name: &str, old: String, new: String, from: f64, to: f64| {
        let change = (to / from - 1.0) * 100.0;
        let change = if change.is_finite() && old != new { format!("{change:+.1} %") } else { String::new() };
        vec![name.to_owned(), old, new, change]
    };
    let length =
        |name: &str, from: f64, to: f64| row(name, format_fixed(from, 1), format_fixed(to, 1), from, to);
    format_table(&[
        ["", "before", "after", "change"].map(str::to_owned).into(),
        length(&format!("at feed, {unit}"), before.feed_length, after.feed_length),
        length(&format!("at rapid, {unit}"), before.rapid_length, after.rapid_length),
        row("time at feed", time(before), time(after), before.feed_seconds, after.feed_seconds),
    ])
}

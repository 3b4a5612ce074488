//! The changes of a recipe as text for people.

use super::{Changes, StepChanges};
use crate::report::kind::Kind;
use crate::report::render::text::one_line;
use crate::report::stats::Totals;
use crate::report::table::{counted, duration, fixed, table, unit_name};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The changes: a line for each step, and the program before and after.
pub fn to_text(changes: &Changes) -> String {
    let mut out = format!("{}\n", one_line(&changes.file));
    out.push_str(&steps_to_text(&changes.steps));
    let _ = writeln!(out, "  {} untouched", counted(changes.untouched, "statement", "statements"));
    let _ = write!(out, "\n{}", totals(changes));
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
            phrases.extend(kinds(map, verb));
        }
        let phrases = if phrases.is_empty() { "no change".to_owned() } else { phrases.join(", ") };
        let _ = writeln!(out, "  {}. {}: {phrases}", index + 1, one_line(&step.name));
    }
    out
}

fn kinds(map: &BTreeMap<Kind, usize>, verb: &str) -> Vec<String> {
    map.iter()
        .map(|(kind, number)| format!("{} {verb}", counted(*number, kind.name(1), kind.name(2))))
        .collect()
}

fn totals(changes: &Changes) -> String {
    let unit = unit_name(changes.units.unit);
    let (before, after) = (&changes.before, &changes.after);
    let time = |totals: &Totals| {
        let more = if totals.unknown_time.motions > 0 { "> " } else { "" };
        format!("{more}{}", duration(totals.feed_seconds))
    };
    let row = |name: &str, old: String, new: String, from: f64, to: f64| {
        let change = (to / from - 1.0) * 100.0;
        let change = if change.is_finite() && old != new { format!("{change:+.1} %") } else { String::new() };
        vec![name.to_owned(), old, new, change]
    };
    let length = |name: &str, from: f64, to: f64| row(name, fixed(from, 1), fixed(to, 1), from, to);
    table(&[
        ["", "before", "after", "change"].map(str::to_owned).into(),
        length(&format!("at feed, {unit}"), before.feed_length, after.feed_length),
        length(&format!("at rapid, {unit}"), before.rapid_length, after.rapid_length),
        row("time at feed", time(before), time(after), before.feed_seconds, after.feed_seconds),
    ])
}

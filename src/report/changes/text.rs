//! This module writes the changes of a recipe as text for people.

use super::{RecipeChanges, StepChanges};
use crate::presentation::safe_text::to_safe_line;
use crate::program::RecordKind;
use crate::report::stats::totals_columns;
use crate::report::table::{DisplayUnits, TableLooks, compare_figures, pick_columns};
use crate::report::text_format::format_counted;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Returns the changes as text: a line for each step, the number of untouched statements, and a table of
/// lengths and times before and after.
pub fn to_text(changes: &RecipeChanges) -> String {
    let mut out = format!("{}\n", to_safe_line(&changes.file));
    out.push_str(&steps_to_text(&changes.steps));
    let _ = writeln!(out, "  {} untouched", format_counted(changes.untouched, "statement", "statements"));
    let _ = write!(out, "\n{}", format_totals(changes));
    out
}

/// Returns a line for each step: how many statements of each kind it edited, inserted and deleted.
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
    let time = if changes.after.accelerated_seconds.is_some() { "accelerated_time" } else { "feed_time" };
    let mut keys = vec!["feed_length", "rapid_length", time];
    // On the machine everything has its time; without it, rapids have one and standing has none.
    if changes.after.standing_seconds.is_some() {
        keys.extend(["rapid_time", "standing_time"]);
    }
    let columns = pick_columns(&totals_columns(), &keys);
    let looks = TableLooks::plain(DisplayUnits::unconverted(changes.units.unit));
    compare_figures(&columns, Some(&changes.before), Some(&changes.after), looks).to_text()
}

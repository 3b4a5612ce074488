//! This module summarizes a batch for people.

use super::{BatchRecord, FileOutcome};
use crate::report::table::{Column, ColumnUnit, DisplayUnits, PrintedTable, TableLooks, TableValue};
use crate::report::text_format::{format_count, format_counted, format_duration};
use std::collections::BTreeMap;
use std::fmt::Write;

/// The largest number of failed files that are listed.
const MOST_LISTED: usize = 20;

/// Returns the summary: the number of files by outcome and recipe, the findings by code, and the files that
/// failed. An earlier run has processed `before` of them. `seconds` is the duration of this run, if it is
/// known.
pub fn summary_to_text(records: &[BatchRecord], before: usize, seconds: Option<f64>) -> String {
    let mut text = format_counted(records.len(), "file", "files");
    if let Some(seconds) = seconds {
        let _ = write!(text, " in {}", format_duration(seconds));
    }
    if before > 0 {
        let _ = write!(text, ", {} done before", format_count(before as u64));
    }
    text.push_str("\n\n");
    let looks = TableLooks::plain(DisplayUnits::MM);
    let recipes = PrintedTable::from_rows(&recipe_columns(), &recipe_rows(records), looks);
    text.push_str(&recipes.to_text());
    let found = PrintedTable::from_rows(&finding_columns(), &finding_rows(records), looks);
    if !found.is_empty() {
        let _ = write!(text, "\n{}", found.to_text());
    }
    let failed: Vec<&BatchRecord> =
        records.iter().filter(|record| record.outcome == FileOutcome::Failed).collect();
    if !failed.is_empty() {
        text.push_str(
            "\nFailed, and not written (what an earlier run wrote of them is NAME.outdated now):\n",
        );
    }
    for record in failed.iter().take(MOST_LISTED) {
        let error = record.findings.iter().find(|found| found.severity == "error");
        let why = error.map_or(String::new(), |found| {
            let line = found.line.map_or(String::new(), |line| format!("line {line}: "));
            format!("{} {line}{}", found.code, found.first)
        });
        let _ = writeln!(text, "  {}: {}", record.input, why.replace(char::is_control, "?"));
    }
    if failed.len() > MOST_LISTED {
        let _ = writeln!(text, "  and {} more", format_count((failed.len() - MOST_LISTED) as u64));
    }
    text
}

/// The files of one recipe, or of all recipes.
struct RecipeRow<'a> {
    name: String,
    records: Vec<&'a BatchRecord>,
}

impl RecipeRow<'_> {
    fn count_outcome(&self, outcome: FileOutcome) -> TableValue<'static> {
        self.records.iter().filter(|record| record.outcome == outcome).count().into()
    }

    fn sum(&self, of: fn(&BatchRecord) -> usize) -> TableValue<'static> {
        self.records.iter().map(|record| of(record)).sum::<usize>().into()
    }
}

fn recipe_columns<'a>() -> [Column<RecipeRow<'a>>; 8] {
    type Row<'a> = RecipeRow<'a>;
    let unit = ColumnUnit::None;
    [
        Column::new("recipe", unit, |row: &Row<'a>| TableValue::text(&row.name)),
        Column::new("files", unit, |row: &Row<'a>| row.records.len().into()),
        Column::new("corrected", unit, |row: &Row<'a>| row.count_outcome(FileOutcome::Corrected)),
        Column::new("unchanged", unit, |row: &Row<'a>| row.count_outcome(FileOutcome::Unchanged)),
        Column::new("failed", unit, |row: &Row<'a>| row.count_outcome(FileOutcome::Failed)),
        Column::new("not_run", unit, |row: &Row<'a>| row.count_outcome(FileOutcome::NotRun))
            .titled("not run"),
        Column::new("statements_changed", unit, |row: &Row<'a>| {
            row.sum(|record| record.changed.edited + record.changed.inserted + record.changed.deleted)
        })
        .titled("statements changed"),
        Column::new("warnings", unit, |row: &Row<'a>| row.sum(|record| record.counts.warnings)),
    ]
}

fn recipe_rows(records: &[BatchRecord]) -> Vec<RecipeRow<'_>> {
    let mut by_recipe: BTreeMap<String, Vec<&BatchRecord>> = BTreeMap::new();
    for record in records {
        by_recipe.entry(record.recipe.to_string()).or_default().push(record);
    }
    let mut rows: Vec<RecipeRow<'_>> =
        by_recipe.into_iter().map(|(name, records)| RecipeRow { name, records }).collect();
    if rows.len() > 1 {
        rows.push(RecipeRow { name: "all".to_owned(), records: records.iter().collect() });
    }
    rows
}

/// A code, how often it was found, in how many files, and where first.
struct FindingRow<'a> {
    code: &'a str,
    severity: &'a str,
    times: usize,
    files: usize,
    first: String,
}

fn finding_columns<'a>() -> [Column<FindingRow<'a>>; 4] {
    type Row<'a> = FindingRow<'a>;
    let unit = ColumnUnit::None;
    [
        Column::new("finding", unit, |row: &Row<'a>| {
            TableValue::Text(format!("{} {}", row.code, row.severity).into())
        }),
        Column::new("times", unit, |row: &Row<'a>| row.times.into()),
        Column::new("files", unit, |row: &Row<'a>| row.files.into()),
        Column::new("first_in", unit, |row: &Row<'a>| TableValue::text(&row.first)).titled("first in"),
    ]
}

fn finding_rows(records: &[BatchRecord]) -> Vec<FindingRow<'_>> {
    let mut by_code: BTreeMap<(&str, &str), FindingRow<'_>> = BTreeMap::new();
    for record in records {
        for found in &record.findings {
            let (code, severity) = (found.code.as_str(), found.severity.as_str());
            let row = by_code.entry((code, severity)).or_insert_with(|| {
                let line = found.line.map_or(String::new(), |line| format!(":{line}"));
                FindingRow { code, severity, times: 0, files: 0, first: format!("{}{line}", record.input) }
            });
            row.times += found.count;
            row.files += 1;
        }
    }
    by_code.into_values().collect()
}

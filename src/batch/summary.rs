//! A batch for people.

use super::{BatchRecord, FileOutcome};
use crate::report::text_format::{format_count, format_counted, format_duration, format_table};
use std::collections::BTreeMap;
use std::fmt::Write;

/// Files that failed are listed up to here.
const LISTED: usize = 20;

/// The summary: how many files ended how, by recipe; findings by code; files that failed. `before` of them were done by
/// an earlier run; `seconds` is how long this one took, if anybody knows.
pub fn summary_to_text(records: &[BatchRecord], before: usize, seconds: Option<f64>) -> String {
    let mut text = format_counted(records.len(), "file", "files");
    if let Some(seconds) = seconds {
        let _ = write!(text, " in {}", format_duration(seconds));
    }
    if before > 0 {
        let _ = write!(text, ", {} done before", format_count(before as u64));
    }
    text.push_str("\n\n");
    text.push_str(&format_table(&recipe_rows(records)));
    let found = finding_rows(records);
    if found.len() > 1 {
        text.push('\n');
        text.push_str(&format_table(&found));
    }
    let failed: Vec<&BatchRecord> =
        records.iter().filter(|record| record.outcome == FileOutcome::Failed).collect();
    if !failed.is_empty() {
        text.push_str("\nFailed, and not written (what an earlier run wrote of them stays):\n");
    }
    for record in failed.iter().take(LISTED) {
        let error = record.findings.iter().find(|found| found.severity == "error");
        let why = error.map_or(String::new(), |found| {
            let line = found.line.map_or(String::new(), |line| format!("line {line}: "));
            format!("{} {line}{}", found.code, found.first)
        });
        let _ = writeln!(text, "  {}: {}", record.input, why.replace(char::is_control, "?"));
    }
    if failed.len() > LISTED {
        let _ = writeln!(text, "  and {} more", format_count((failed.len() - LISTED) as u64));
    }
    text
}

fn recipe_rows(records: &[BatchRecord]) -> Vec<Vec<String>> {
    let mut by_recipe: BTreeMap<String, Vec<&BatchRecord>> = BTreeMap::new();
    for record in records {
        by_recipe.entry(record.recipe.to_string()).or_default().push(record);
    }
    let head =
        ["recipe", "files", "corrected", "unchanged", "failed", "not run", "statements changed", "warnings"];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    let row = |name: String, records: &[&BatchRecord]| {
        let ended = |outcome| records.iter().filter(|record| record.outcome == outcome).count();
        let sum = |of: fn(&BatchRecord) -> usize| records.iter().map(|record| of(record)).sum::<usize>();
        let numbers = [
            records.len(),
            ended(FileOutcome::Corrected),
            ended(FileOutcome::Unchanged),
            ended(FileOutcome::Failed),
            ended(FileOutcome::NotRun),
            sum(|record| record.changed.edited + record.changed.inserted + record.changed.deleted),
            sum(|record| record.counts.warnings),
        ];
        [name].into_iter().chain(numbers.map(|number| format_count(number as u64))).collect::<Vec<_>>()
    };
    if by_recipe.len() > 1 {
        let all: Vec<&BatchRecord> = records.iter().collect();
        rows.extend(by_recipe.into_iter().map(|(name, records)| row(name, &records)));
        rows.push(row("all".to_owned(), &all));
    } else {
        rows.extend(by_recipe.into_iter().map(|(name, records)| row(name, &records)));
    }
    rows
}

/// Codes, how often, in how many files, and where first.
fn finding_rows(records: &[BatchRecord]) -> Vec<Vec<String>> {
    let mut by_code: BTreeMap<(&str, &str), (usize, usize, String)> = BTreeMap::new();
    for record in records {
        for found in &record.findings {
            let line = found.line.map_or(String::new(), |line| format!(":{line}"));
            let entry = by_code.entry((&found.code, &found.severity)).or_insert((0, 0, String::new()));
            entry.0 += found.count;
            entry.1 += 1;
            if entry.2.is_empty() {
                entry.2 = format!("{}{line}", record.input);
            }
        }
    }
    let mut rows = vec![["finding", "times", "files", "first in"].map(str::to_owned).to_vec()];
    rows.extend(by_code.into_iter().map(|((code, severity), (times, files, first))| {
        vec![format!("{code} {severity}"), format_count(times as u64), format_count(files as u64), first]
    }));
    rows
}

//! A batch for people.

use super::{Outcome, Record};
use crate::report::table::{count, counted, duration, table};
use std::collections::BTreeMap;
use std::fmt::Write;

/// Files that failed are listed up to here.
const LISTED: usize = 20;

/// The summary: how many files ended how, by recipe; findings by code; files that failed. `before` of them were done by
/// an earlier run; `seconds` is how long this one took, if anybody knows.
pub fn to_text(records: &[Record], before: usize, seconds: Option<f64>) -> String {
    let mut text = counted(records.len(), "file", "files");
    if let Some(seconds) = seconds {
        let _ = write!(text, " in {}", duration(seconds));
    }
    if before > 0 {
        let _ = write!(text, ", {} done before", count(before as u64));
    }
    text.push_str("\n\n");
    text.push_str(&table(&recipes(records)));
    let found = findings(records);
    if found.len() > 1 {
        text.push('\n');
        text.push_str(&table(&found));
    }
    let failed: Vec<&Record> = records.iter().filter(|record| record.outcome == Outcome::Failed).collect();
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
        let _ = writeln!(text, "  and {} more", count((failed.len() - LISTED) as u64));
    }
    text
}

fn recipes(records: &[Record]) -> Vec<Vec<String>> {
    let mut by_recipe: BTreeMap<String, Vec<&Record>> = BTreeMap::new();
    for record in records {
        by_recipe.entry(record.recipe.to_string()).or_default().push(record);
    }
    let head =
        ["recipe", "files", "corrected", "unchanged", "failed", "not run", "statements changed", "warnings"];
    let mut rows = vec![head.map(str::to_owned).to_vec()];
    let row = |name: String, records: &[&Record]| {
        let ended = |outcome| records.iter().filter(|record| record.outcome == outcome).count();
        let sum = |of: fn(&Record) -> usize| records.iter().map(|record| of(record)).sum::<usize>();
        let numbers = [
            records.len(),
            ended(Outcome::Corrected),
            ended(Outcome::Unchanged),
            ended(Outcome::Failed),
            ended(Outcome::NotRun),
            sum(|record| record.changed.edited + record.changed.inserted + record.changed.deleted),
            sum(|record| record.counts.warnings),
        ];
        [name].into_iter().chain(numbers.map(|number| count(number as u64))).collect::<Vec<_>>()
    };
    if by_recipe.len() > 1 {
        let all: Vec<&Record> = records.iter().collect();
        rows.extend(by_recipe.into_iter().map(|(name, records)| row(name, &records)));
        rows.push(row("all".to_owned(), &all));
    } else {
        rows.extend(by_recipe.into_iter().map(|(name, records)| row(name, &records)));
    }
    rows
}

/// Codes, how often, in how many files, and where first.
fn findings(records: &[Record]) -> Vec<Vec<String>> {
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
        vec![format!("{code} {severity}"), count(times as u64), count(files as u64), first]
    }));
    rows
}

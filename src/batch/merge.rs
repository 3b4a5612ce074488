//! This module merges the results of shards.

use super::batch_results::{BatchResults, ResultsHead};
use super::{BatchRecord, FileOutcome, PortablePath, Shard};
use crate::diagnostic::{Diagnostic, DiagnosticCode, Failure, codes};
use std::collections::BTreeMap;

/// Returns the results of the whole batch. They are the same bytes as if one machine had processed
/// everything.
///
/// # Errors
/// Returns findings about parts of another batch or another split, and about parts or files that are repeated
/// or missing.
pub fn merge_results(parts: Vec<BatchResults>) -> Result<(ResultsHead, Vec<BatchRecord>), Failure> {
    let Some(first) = parts.first() else {
        return Err(report_missing("there are no results to merge".into()).into());
    };
    let mut wrong = Vec::new();
    for other in parts.iter().skip(1) {
        let differs = if other.head.batch != first.head.batch {
            "another batch: other files, recipes, options or version"
        } else if shard_count(other) != shard_count(first) {
            "another split of the batch"
        } else {
            continue;
        };
        let message = format!("{} is of {differs} than {}", other.source.name(), first.source.name());
        wrong.push(report_at_head(other, codes::NOT_ONE_BATCH, message, "differs"));
    }
    if !wrong.is_empty() {
        return Err(wrong.into());
    }
    let twice = find_repeated_shards(&parts);
    let each_once = twice.is_empty();
    wrong.extend(twice);
    wrong.extend(find_missing_shards(&parts, shard_count(first)));
    wrong.extend(parts.iter().filter_map(check_record_count));
    // A repeated part repeats all its files, so a single finding about the part is enough.
    if each_once {
        wrong.extend(find_repeated_files(&parts));
    }
    wrong.extend(find_files_not_run(&parts));
    let head = ResultsHead { shard: None, ..first.head.clone() };
    let mut records: Vec<BatchRecord> = parts.into_iter().flat_map(|part| part.records).collect();
    records.sort_by(|a, b| a.sort_key().cmp(&b.sort_key()));
    if wrong.is_empty() && records.len() != head.files {
        wrong.push(report_missing(format!(
            "the batch has {} files, the parts {}",
            head.files,
            records.len()
        )));
    }
    if wrong.is_empty() { Ok((head, records)) } else { Err(wrong.into()) }
}

fn shard_count(results: &BatchResults) -> u32 {
    results.head.shard.as_ref().map_or(1, |shard| shard.part.count())
}

fn shard_index(results: &BatchResults) -> u32 {
    results.head.shard.as_ref().map_or(1, |shard| shard.part.index())
}

fn report_at_head(results: &BatchResults, code: DiagnosticCode, message: String, label: &str) -> Diagnostic {
    let head = results.source.line_span(1).unwrap_or_default();
    Diagnostic::new(code, message).with_label(&results.source, head, label)
}

fn report_missing(message: String) -> Diagnostic {
    Diagnostic::new(codes::RESULTS_MISSING, message)
}

fn find_repeated_shards(parts: &[BatchResults]) -> Vec<Diagnostic> {
    let mut seen: BTreeMap<u32, &BatchResults> = BTreeMap::new();
    let mut wrong = Vec::new();
    for part in parts {
        if let Some(other) = seen.insert(shard_index(part), part) {
            let message = format!(
                "{} and {} are both of shard {}/{}",
                other.source.name(),
                part.source.name(),
                shard_index(part),
                shard_count(part)
            );
            wrong.push(report_at_head(part, codes::NOT_ONE_BATCH, message, "repeated here"));
        }
    }
    wrong
}

fn find_missing_shards(parts: &[BatchResults], count: u32) -> Option<Diagnostic> {
    let there: Vec<u32> = parts.iter().map(shard_index).collect();
    let gone =
        (1..=count).filter(|index| !there.contains(index)).filter_map(|index| Shard::new(index, count));
    let gone: Vec<String> = gone.map(|shard| shard.to_string()).collect();
    let shown = gone.iter().take(10).map(String::as_str).collect::<Vec<_>>().join(", ");
    let more = if gone.len() > 10 { format!(" and {} more", gone.len() - 10) } else { String::new() };
    (!gone.is_empty()).then(|| report_missing(format!("results are missing of shard {shown}{more}")))
}

fn check_record_count(part: &BatchResults) -> Option<Diagnostic> {
    let files = part.head.shard.as_ref().map_or(part.head.files, |shard| shard.files);
    let message = || format!("{} has {} of {files} files", part.source.name(), part.records.len());
    (files != part.records.len())
        .then(|| report_at_head(part, codes::RESULTS_MISSING, message(), "the head announces more"))
}

fn find_repeated_files(parts: &[BatchResults]) -> Vec<Diagnostic> {
    let mut seen: BTreeMap<(&PortablePath, &PortablePath), &BatchResults> = BTreeMap::new();
    let mut wrong = Vec::new();
    for (part, record) in parts.iter().flat_map(|part| part.records.iter().map(move |record| (part, record)))
    {
        if let Some(other) = seen.insert(record.sort_key(), part) {
            let (other, here) = (other.source.name(), part.source.name());
            let message = format!("{} is in {here} and in {other}", record.input);
            wrong.push(Diagnostic::new(codes::NOT_ONE_BATCH, message));
        }
    }
    wrong
}

fn find_files_not_run(parts: &[BatchResults]) -> Vec<Diagnostic> {
    let all = parts.iter().flat_map(|part| part.records.iter().map(move |record| (part, record)));
    all.filter(|(_, record)| record.outcome == FileOutcome::NotRun)
        .map(|(part, record)| {
            report_missing(format!("{} was not run; {} says so", record.input, part.source.name()))
                .with_help("The batch was to stop at the first failure. Run the shard again with --resume.")
        })
        .collect()
}

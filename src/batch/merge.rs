//! Results of shards put together.

use super::results::{Head, Results};
use super::{Name, Outcome, Record, Shard};
use crate::diagnostic::{Code, Diagnostic, codes};
use std::collections::BTreeMap;

/// The results of the whole batch: the same bytes as if one machine had done all of it.
///
/// # Errors
/// Parts of another batch or of another split, parts or files that are there twice, parts or files that are missing.
pub fn merge(parts: Vec<Results>) -> Result<(Head, Vec<Record>), Vec<Diagnostic>> {
    let Some(first) = parts.first() else {
        return Err(vec![missing("there are no results to merge".into())]);
    };
    let mut wrong = Vec::new();
    for other in parts.iter().skip(1) {
        let differs = if other.head.batch != first.head.batch {
            "another batch: other files, recipes, options or version"
        } else if count(other) != count(first) {
            "another split of the batch"
        } else {
            continue;
        };
        let message = format!("{} is of {differs} than {}", other.source.name(), first.source.name());
        wrong.push(at(other, codes::NOT_ONE_BATCH, message, "differs"));
    }
    if !wrong.is_empty() {
        return Err(wrong);
    }
    let twice = twice(&parts);
    let each_once = twice.is_empty();
    wrong.extend(twice);
    wrong.extend(missing_shards(&parts, count(first)));
    wrong.extend(parts.iter().filter_map(short));
    // A part that is there twice has every file twice; one finding says it.
    if each_once {
        wrong.extend(same_files(&parts));
    }
    wrong.extend(not_run(&parts));
    let head = Head { shard: None, ..first.head.clone() };
    let mut records: Vec<Record> = parts.into_iter().flat_map(|part| part.records).collect();
    records.sort_by(|a, b| a.key().cmp(&b.key()));
    if wrong.is_empty() && records.len() != head.files {
        wrong.push(missing(format!("the batch has {} files, the parts {}", head.files, records.len())));
    }
    if wrong.is_empty() { Ok((head, records)) } else { Err(wrong) }
}

fn count(results: &Results) -> u32 {
    results.head.shard.as_ref().map_or(1, |shard| shard.part.count())
}

fn index(results: &Results) -> u32 {
    results.head.shard.as_ref().map_or(1, |shard| shard.part.index())
}

fn at(results: &Results, code: Code, message: String, label: &str) -> Diagnostic {
    let head = results.source.line(1).unwrap_or_default();
    Diagnostic::new(code, message).label(&results.source, head, label)
}

fn missing(message: String) -> Diagnostic {
    Diagnostic::new(codes::RESULTS_MISSING, message)
}

fn twice(parts: &[Results]) -> Vec<Diagnostic> {
    let mut seen: BTreeMap<u32, &Results> = BTreeMap::new();
    let mut wrong = Vec::new();
    for part in parts {
        if let Some(other) = seen.insert(index(part), part) {
            let message = format!(
                "{} and {} are both of shard {}/{}",
                other.source.name(),
                part.source.name(),
                index(part),
                count(part)
            );
            wrong.push(at(part, codes::NOT_ONE_BATCH, message, "there already"));
        }
    }
    wrong
}

fn missing_shards(parts: &[Results], count: u32) -> Option<Diagnostic> {
    let there: Vec<u32> = parts.iter().map(index).collect();
    let gone =
        (1..=count).filter(|index| !there.contains(index)).filter_map(|index| Shard::new(index, count));
    let gone: Vec<String> = gone.map(|shard| shard.to_string()).collect();
    let shown = gone.iter().take(10).map(String::as_str).collect::<Vec<_>>().join(", ");
    let more = if gone.len() > 10 { format!(" and {} more", gone.len() - 10) } else { String::new() };
    (!gone.is_empty()).then(|| missing(format!("results are missing of shard {shown}{more}")))
}

fn short(part: &Results) -> Option<Diagnostic> {
    let files = part.head.shard.as_ref().map_or(part.head.files, |shard| shard.files);
    let message = || format!("{} has {} of {files} files", part.source.name(), part.records.len());
    (files != part.records.len()).then(|| at(part, codes::RESULTS_MISSING, message(), "more were promised"))
}

fn same_files(parts: &[Results]) -> Vec<Diagnostic> {
    let mut seen: BTreeMap<(&Name, &Name), &Results> = BTreeMap::new();
    let mut wrong = Vec::new();
    for (part, record) in parts.iter().flat_map(|part| part.records.iter().map(move |record| (part, record)))
    {
        if let Some(other) = seen.insert(record.key(), part) {
            let (other, here) = (other.source.name(), part.source.name());
            let message = format!("{} is in {here} and in {other}", record.input);
            wrong.push(Diagnostic::new(codes::NOT_ONE_BATCH, message));
        }
    }
    wrong
}

fn not_run(parts: &[Results]) -> Vec<Diagnostic> {
    let all = parts.iter().flat_map(|part| part.records.iter().map(move |record| (part, record)));
    all.filter(|(_, record)| record.outcome == Outcome::NotRun)
        .map(|(part, record)| {
            missing(format!("{} was not run; {} says so", record.input, part.source.name()))
                .help("The batch was to stop at the first failure. Run the shard again with --resume.")
        })
        .collect()
}

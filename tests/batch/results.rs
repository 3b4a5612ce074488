//! Results read, and those of shards put together.

use crate::support;
use clsmith::batch::batch_results::{BatchResults, ResultsHead, read_results, results_to_bytes};
use clsmith::batch::merge::merge_results;
use clsmith::batch::{
    BatchFindingCounts, BatchRecord, FileDigests, FileOutcome, PortablePath, Shard, StatementChangeCounts,
};
use clsmith::diagnostic::{DiagnosticCode, codes};
use clsmith::fingerprint::Digest;
use clsmith::source::Source;
use std::path::Path;

fn record(name: &str) -> BatchRecord {
    BatchRecord {
        input: PortablePath::from_path(Path::new(name)),
        output: PortablePath::from_path(Path::new(name)),
        recipe: PortablePath::from_path(Path::new("r.yaml")),
        outcome: FileOutcome::Corrected,
        sha256: FileDigests {
            input: Some(Digest::from_bytes(name.as_bytes())),
            recipe: Digest::from_bytes(b"r"),
            setup: Digest::from_bytes(b""),
            output: Some(Digest::from_bytes(b"out")),
        },
        version: "0.1.0".to_owned(),
        changed: StatementChangeCounts { edited: 1, inserted: 2, deleted: 3 },
        counts: BatchFindingCounts::default(),
        findings: Vec::new(),
        seconds: None,
    }
}

/// Shard `index` of `count` of a batch of files named by numbers, changed by `edit`.
fn part(
    index: u32,
    count: u32,
    files: usize,
    edit: impl Fn(&mut ResultsHead, &mut Vec<BatchRecord>),
) -> BatchResults {
    let shard = Shard::new(index, count).unwrap();
    let mut records: Vec<BatchRecord> = (0..files)
        .filter(|&file| shard.contains(file))
        .map(|file| record(&format!("{file:03}.cls")))
        .collect();
    let mut head = ResultsHead::new(Digest::from_bytes(b"batch"), files, Some((shard, records.len())));
    edit(&mut head, &mut records);
    let name = format!("results-{}.jsonl", shard.file_name_part());
    read_results(&Source::new(name, results_to_bytes(&head, &records, false)).unwrap()).unwrap()
}

fn same(_: &mut ResultsHead, _: &mut Vec<BatchRecord>) {}

#[test]
fn parts_make_the_whole() {
    for (count, files) in [(1, 5), (3, 10), (4, 2), (2, 0)] {
        // In any order.
        let parts = (1..=count).rev().map(|index| part(index, count, files, same)).collect();
        let (head, records) = merge_results(parts).unwrap();
        let all: Vec<BatchRecord> = (0..files).map(|file| record(&format!("{file:03}.cls"))).collect();
        let whole = ResultsHead::new(Digest::from_bytes(b"batch"), files, None);
        assert_eq!(results_to_bytes(&head, &records, true), results_to_bytes(&whole, &all, false));
    }
}

#[track_caller]
fn refused(parts: Vec<BatchResults>, code: DiagnosticCode, words: &str) {
    let found = merge_results(parts).unwrap_err();
    assert!(
        found.findings().iter().any(|found| found.code == code && found.message.contains(words)),
        "{found:?}"
    );
}

#[test]
fn what_is_no_whole_batch_is_refused() {
    let three = |edit: &dyn Fn(&mut ResultsHead, &mut Vec<BatchRecord>)| {
        vec![part(1, 3, 10, same), part(2, 3, 10, edit), part(3, 3, 10, same)]
    };
    refused(Vec::new(), codes::RESULTS_MISSING, "no results");
    refused(vec![part(1, 3, 10, same)], codes::RESULTS_MISSING, "shard 2/3, 3/3");
    refused(vec![part(1, 50, 100, same)], codes::RESULTS_MISSING, "and 39 more");
    refused(
        vec![part(1, 2, 4, same), part(2, 2, 4, same), part(2, 2, 4, same)],
        codes::NOT_ONE_BATCH,
        "both of shard 2/2",
    );
    refused(
        three(&|head, _| head.batch = Digest::from_bytes(b"other")),
        codes::NOT_ONE_BATCH,
        "another batch",
    );
    refused(vec![part(1, 2, 4, same), part(2, 3, 4, same)], codes::NOT_ONE_BATCH, "another split");
    refused(three(&|_, records| drop(records.pop())), codes::RESULTS_MISSING, "has 2 of 3 files");
    refused(three(&|_, records| records[0] = record("000.cls")), codes::NOT_ONE_BATCH, "000.cls is in");
    refused(
        three(&|_, records| records[0].outcome = FileOutcome::NotRun),
        codes::RESULTS_MISSING,
        "was not run",
    );
    let short = |head: &mut ResultsHead, records: &mut Vec<BatchRecord>| {
        records.pop();
        head.shard.as_mut().unwrap().files -= 1;
    };
    refused(three(&short), codes::RESULTS_MISSING, "the batch has 10 files, the parts 9");
}

#[test]
fn what_is_no_result_is_underlined() {
    let good =
        results_to_bytes(&ResultsHead::new(Digest::from_bytes(b"batch"), 1, None), &[record("a.cls")], false);
    let good = String::from_utf8(good).unwrap();
    assert_eq!(read_results(&support::text(&good)).unwrap().records, [record("a.cls")]);
    for (bad, line) in [
        (String::new(), 1),
        ("GOTO/1,2,3\n".to_owned(), 1),
        (good.replace("\"clsmith_batch\":1", "\"clsmith_batch\":2"), 1),
        (good.lines().nth(1).unwrap().to_owned(), 1),
        (good[..good.len() - 20].to_owned(), 2),
        (good.replace("corrected", "perfect"), 2),
    ] {
        let failure = read_results(&support::text(&bad)).unwrap_err();
        let found = &failure.findings()[0];
        assert_eq!(found.code, codes::BAD_RESULTS, "{bad}");
        let label = &found.labels[0];
        assert_eq!(label.source.line_column(label.span.start).0, line, "{bad}");
    }
}

#[test]
fn seconds_are_there_only_on_request() {
    let slow = BatchRecord { seconds: Some(1.5), ..record("a.cls") };
    let head = ResultsHead::new(Digest::from_bytes(b"batch"), 1, None);
    let text =
        |times| String::from_utf8(results_to_bytes(&head, std::slice::from_ref(&slow), times)).unwrap();
    assert!(text(true).contains("\"seconds\":1.5"));
    assert!(!text(false).contains("seconds"));
}

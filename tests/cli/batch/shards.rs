//! `--shard` and `clsmith merge`.

use super::{batch, clsmith, shop, stderr, stdout, tree, write};
use std::fs;
use std::path::Path;

fn merge(folder: &Path, args: &[&str]) -> assert_cmd::assert::Assert {
    clsmith(folder).arg("merge").args(args).assert()
}

#[test]
fn three_shards_and_a_merge_are_one_run() {
    let shop = shop(20);
    write(shop.path(), "programs/bad.cls", "GOTO/x\n");
    batch(shop.path(), "whole", &[]).code(1);
    let whole = tree(&shop.path().join("whole"));
    let parts = ["parts/results-1-of-3.jsonl", "parts/results-2-of-3.jsonl", "parts/results-3-of-3.jsonl"];
    let mut codes = Vec::new();
    for shard in ["3/3", "1/3", "2/3"] {
        let done = batch(shop.path(), "parts", &["--shard", shard]);
        codes.push(done.get_output().status.code());
    }
    codes.sort();
    assert_eq!(codes, [Some(0), Some(0), Some(1)], "the one with the bad file");
    let done = merge(shop.path(), &[&parts[..], &["-o", "parts/results.jsonl"]].concat()).code(1);
    assert!(stdout(&done).contains("programs/bad.cls: CL0"), "{}", stdout(&done));
    for part in parts {
        fs::remove_file(shop.path().join(part)).unwrap();
    }
    assert_eq!(tree(&shop.path().join("parts")), whole);
}

#[test]
fn shards_in_folders_of_their_own_merge_too_and_to_standard_output() {
    let shop = shop(5);
    batch(shop.path(), "whole", &[]).success();
    for shard in 1..=2 {
        batch(shop.path(), &format!("out{shard}"), &["--shard", &format!("{shard}/2")]).success();
    }
    let done =
        merge(shop.path(), &["out1/results-1-of-2.jsonl", "out2/results-2-of-2.jsonl", "-o", "-"]).success();
    assert_eq!(done.get_output().stdout, fs::read(shop.path().join("whole/results.jsonl")).unwrap());
    assert!(stderr(&done).contains("5 files"));
}

#[test]
fn more_shards_than_files_are_fine() {
    let shop = shop(2);
    batch(shop.path(), "whole", &[]).success();
    for shard in 1..=4 {
        batch(shop.path(), "parts", &["--shard", &format!("{shard}/4")]).success();
    }
    let parts: Vec<String> = (1..=4).map(|shard| format!("parts/results-{shard}-of-4.jsonl")).collect();
    let parts: Vec<&str> = parts.iter().map(String::as_str).collect();
    merge(shop.path(), &[&parts[..], &["-o", "all.jsonl", "-q"]].concat()).success();
    let read = |name: &str| fs::read(shop.path().join(name)).unwrap();
    assert_eq!(read("all.jsonl"), read("whole/results.jsonl"));
}

#[test]
fn what_is_missing_or_foreign_is_found_and_nothing_is_written() {
    let shop = shop(6);
    for shard in ["1/2", "2/2"] {
        batch(shop.path(), "parts", &["--shard", shard]).success();
    }
    let (one, two) = ("parts/results-1-of-2.jsonl", "parts/results-2-of-2.jsonl");
    let refused = |args: &[&str], code: &str| {
        let done = merge(shop.path(), &[args, &["-o", "all.jsonl"]].concat()).code(1);
        assert!(stderr(&done).contains(code), "{}", stderr(&done));
        assert!(!shop.path().join("all.jsonl").exists());
    };
    refused(&[one], "CL0429");
    refused(&[one, two, two], "CL0428");
    refused(&[one, "r.yaml"], "CL0427");
    refused(&[one, "nowhere.jsonl"], "CL0401");
    merge(shop.path(), &[one, two, "-o", two]).code(1);
    write(shop.path(), "r.yaml", "version: 1\nsteps: []\n");
    batch(shop.path(), "parts", &["--shard", "2/2"]).success();
    refused(&[one, two], "CL0428");
}

#[test]
fn shards_read_each_others_journals() {
    let shop = shop(6);
    batch(shop.path(), "done", &["--shard", "1/2"]).success();
    let whole = batch(shop.path(), "done", &["--resume"]).success();
    assert!(stdout(&whole).contains("3 done before"), "{}", stdout(&whole));
    let third = batch(shop.path(), "done", &["--resume", "--shard", "3/3"]).success();
    assert!(stdout(&third).contains("2 done before"), "{}", stdout(&third));
}

#[test]
fn shards_that_are_given_one_name_for_results_write_each_its_own() {
    let shop = shop(6);
    let records = |name: &str| {
        let text = fs::read_to_string(shop.path().join(name)).unwrap();
        text.lines().skip(1).count()
    };
    for shard in ["1/2", "2/2"] {
        batch(shop.path(), "parts", &["--results", "all.jsonl", "--shard", shard]).success();
    }
    batch(shop.path(), "whole", &[]).success();
    assert_eq!(records("all-1-of-2.jsonl") + records("all-2-of-2.jsonl"), records("whole/results.jsonl"));
    assert!(!shop.path().join("all.jsonl").exists());
}

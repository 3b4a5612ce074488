//! `--resume`: what is skipped, and what is not.

use super::{batch, clsmith, everything, part, shop, stdout, tree, write};
use std::fs;
use std::path::Path;

/// How many files a run found done.
fn done_before(folder: &Path, more: &[&str]) -> usize {
    let run = batch(folder, "done", &[&["--resume"], more].concat());
    let text = stdout(&run);
    let first = text.lines().next().unwrap();
    let words: Vec<&str> = first.split_whitespace().collect();
    words.iter().position(|word| *word == "done").map_or(0, |at| words[at - 1].parse().unwrap())
}

#[test]
fn only_what_is_new_or_changed_is_done_again() {
    let shop = shop(6);
    let path = shop.path();
    assert_eq!(done_before(path, &[]), 0, "nothing is there yet");
    let first = tree(&path.join("done"));
    assert_eq!(done_before(path, &[]), 6);
    assert_eq!(tree(&path.join("done")), first);
    // A new time stamp is no change, another content is.
    let one = "programs/p003.cls";
    write(path, one, &part(3));
    assert_eq!(done_before(path, &[]), 6);
    write(path, one, &part(4));
    assert_eq!(done_before(path, &[]), 5);
    write(path, one, &part(3));
    assert_eq!(done_before(path, &[]), 5);
    assert_eq!(tree(&path.join("done")), first);
    // An output that somebody touched or took away is made again.
    fs::write(path.join("done/p003.cls"), "mine").unwrap();
    fs::remove_file(path.join("done/p006.cls")).unwrap();
    assert_eq!(done_before(path, &[]), 4);
    assert_eq!(tree(&path.join("done")), first);
    // Another recipe, other options, and a setup file count.
    assert_eq!(done_before(path, &["--deny", "warnings"]), 0);
    assert_eq!(done_before(path, &[]), 0);
    write(path, "r.yaml", &format!("# a comment\n{}", super::RECIPE));
    assert_eq!(done_before(path, &[]), 0);
    write(path, "s.yaml", "machine: { max_feed: 8000 }\n");
    assert_eq!(done_before(path, &["--setup", "s.yaml"]), 0);
    assert_eq!(done_before(path, &["--setup", "s.yaml"]), 6);
    write(path, "s.yaml", "machine: { max_feed: 9000 }\n");
    assert_eq!(done_before(path, &["--setup", "s.yaml"]), 0);
    // Without --resume everything is.
    let again = batch(path, "done", &[]).success();
    assert!(!stdout(&again).contains("done before"));
}

#[test]
fn what_failed_is_tried_again() {
    let shop = shop(3);
    write(shop.path(), "programs/bad.cls", "GOTO/x\n");
    batch(shop.path(), "done", &[]).code(1);
    let first = tree(&shop.path().join("done"));
    assert_eq!(done_before(shop.path(), &[]), 3);
    assert_eq!(tree(&shop.path().join("done")), first);
    write(shop.path(), "programs/bad.cls", "GOTO/1.0,1.0,1.0\n");
    assert_eq!(done_before(shop.path(), &[]), 3);
    assert!(shop.path().join("done/bad.cls").exists());
}

#[test]
fn a_torn_journal_costs_only_what_is_torn() {
    let shop = shop(5);
    batch(shop.path(), "done", &[]).success();
    let first = tree(&shop.path().join("done"));
    let journal = shop.path().join("done/.clsmith-batch.journal");
    let whole = fs::read(&journal).unwrap();
    let lines: Vec<usize> = (0..whole.len()).filter(|&at| whole[at] == b'\n').collect();
    assert_eq!(lines.len(), 6, "a head and five files");
    for (cut, left) in [
        (whole.len() - 1, 5), // only the line end is missing
        (whole.len() - 2, 4),
        (lines[3] + 10, 3),
        (lines[0] / 2, 0),
        (0, 0),
    ] {
        fs::write(&journal, &whole[..cut]).unwrap();
        assert_eq!(done_before(shop.path(), &[]), left, "cut at {cut}");
        assert_eq!(tree(&shop.path().join("done")), first);
        assert_eq!(done_before(shop.path(), &[]), 5, "and the journal is whole again");
    }
    // Garbage in the middle, too.
    let mut garbage = whole.clone();
    garbage.splice(lines[1] + 5..lines[1] + 9, [0, 255, b'\n', b'{']);
    fs::write(&journal, garbage).unwrap();
    assert_eq!(done_before(shop.path(), &[]), 4);
    assert_eq!(tree(&shop.path().join("done")), first);
}

#[test]
fn only_ones_own_left_over_files_are_swept() {
    let shop = shop(3);
    fs::create_dir_all(shop.path().join("done/a")).unwrap();
    let ours = ["done/.clsmith-batch-Ab12Cd.tmp", "done/a/.clsmith-batch-2-of-3-x.tmp"];
    let others = ["done/.clsmith-Ab12Cd.tmp", "done/notes.tmp", "done/.clsmith-batch-notes.txt"];
    ours.iter().chain(&others).for_each(|name| fs::write(shop.path().join(name), "half").unwrap());
    batch(shop.path(), "done", &["--shard", "1/3"]).success();
    assert!(ours.iter().all(|name| shop.path().join(name).exists()), "another shard may be writing");
    batch(shop.path(), "done", &["--shard", "2/3"]).success();
    assert!(!shop.path().join(ours[1]).exists());
    batch(shop.path(), "done", &[]).success();
    let left = everything(&shop.path().join("done"));
    assert!(left.keys().all(|name| !ours.contains(&format!("done/{}", name.display()).as_str())), "{left:?}");
    assert!(others.iter().all(|name| shop.path().join(name).exists()));
}

#[test]
fn old_results_do_not_outlive_a_new_run() {
    let shop = shop(2);
    batch(shop.path(), "done", &[]).success();
    fs::write(shop.path().join("done/results.jsonl"), "old").unwrap();
    // A journal that cannot be written ends the run before its files.
    fs::remove_file(shop.path().join("done/.clsmith-batch.journal")).unwrap();
    fs::create_dir(shop.path().join("done/.clsmith-batch.journal")).unwrap();
    let run = clsmith(shop.path())
        .args(["batch", "--recipe", "r.yaml", "--output", "done", "programs/**/*.cls"])
        .assert()
        .code(1);
    assert!(super::stderr(&run).contains("CL0402"), "{}", super::stderr(&run));
    assert!(!shop.path().join("done/results.jsonl").exists());
}

#[test]
fn an_older_output_beside_a_refused_program_is_set_aside() {
    let shop = shop(2);
    batch(shop.path(), "done", &[]).code(0);
    let done = shop.path().join("done");
    let before = std::fs::read(done.join("a/p001.cls")).unwrap();
    write(shop.path(), "programs/a/p001.cls", "GOTO/x\n");
    for more in [&[][..], &["--resume"], &["--resume"]] {
        batch(shop.path(), "done", more).code(1);
        assert!(!done.join("a/p001.cls").exists(), "it would look like the result of this program");
        assert_eq!(std::fs::read(done.join("a/p001.cls.outdated")).unwrap(), before);
    }
    write(shop.path(), "programs/a/p001.cls", &super::part(1));
    batch(shop.path(), "done", &["--resume"]).code(0);
    assert_eq!(std::fs::read(done.join("a/p001.cls")).unwrap(), before);
    write(shop.path(), "programs/a/p001.cls", "GOTO/x\n");
    batch(shop.path(), "done", &["--resume"]).code(1);
    let results = std::fs::read_to_string(done.join("results.jsonl")).unwrap();
    assert_eq!(results.matches("CL0443").count(), 1, "{results}");
    assert!(results.contains("a/p001.cls is of an earlier run"), "{results}");
}

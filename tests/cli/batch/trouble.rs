//! Two at once, and files that do not hold still.

use super::{ALL, batch, clsmith, long_part, shop, stderr, tree, write};
use std::fs::{self, File};
use std::io::Write;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

#[test]
fn the_second_of_two_batches_is_refused() {
    let shop = shop(3);
    (0..8).for_each(|number| write(shop.path(), &format!("programs/long{number}.cls"), &long_part(20_000)));
    let mut first = std::process::Command::new(env!("CARGO_BIN_EXE_clsmith"))
        .current_dir(shop.path())
        .args(["batch", "--recipe", "r.yaml", "--jobs", "1", "-q", "--out", "done", ALL])
        .spawn()
        .unwrap();
    let lock = shop.path().join("done/.clsmith-batch.lock");
    let wait = Instant::now();
    while !File::open(&lock).is_ok_and(|file| file.try_lock_shared().is_err()) {
        assert!(wait.elapsed() < Duration::from_secs(20), "the first never began");
        std::thread::sleep(Duration::from_millis(1));
    }
    let second = batch(shop.path(), "done", &["--resume"]).code(1);
    assert!(stderr(&second).contains("CL0423"), "{}", stderr(&second));
    assert!(first.wait().unwrap().success(), "the first is not disturbed");
    assert_eq!(tree(&shop.path().join("done")).len(), 12);
    batch(shop.path(), "done", &["--resume"]).success();
}

#[test]
fn shards_share_a_folder_with_their_like_only() {
    let shop = shop(4);
    let done = shop.path().join("done");
    batch(shop.path(), "done", &["--shard", "1/2"]).success();
    let open = |name: &str| File::options().read(true).write(true).open(done.join(name)).unwrap();
    let refused = |more: &[&str]| {
        let run = batch(shop.path(), "done", more).code(1);
        assert!(stderr(&run).contains("CL0423"), "{}", stderr(&run));
    };
    // As if shard 1 of 2 were running.
    let whole = open(".clsmith-batch.lock");
    whole.lock_shared().unwrap();
    let first = open(".clsmith-batch-1-of-2.lock");
    first.lock().unwrap();
    refused(&[]);
    refused(&["--shard", "1/2"]);
    batch(shop.path(), "done", &["--shard", "2/2"]).success();
    // Of another batch, though the folder is the same.
    refused(&["--shard", "2/2", "--deny", "warnings"]);
    drop((first, whole));
    batch(shop.path(), "done", &["--shard", "2/2", "--deny", "warnings"]).success();
    let whole = open(".clsmith-batch.lock");
    whole.lock().unwrap();
    refused(&["--shard", "1/2"]);
}

#[test]
fn a_file_that_is_changed_while_it_is_read_is_an_error() {
    let shop = shop(2);
    write(shop.path(), "programs/export.cls", &long_part(20_000));
    let export = shop.path().join("programs/export.cls");
    let ended = AtomicBool::new(false);
    let run = std::thread::scope(|scope| {
        scope.spawn(|| {
            let mut file = File::options().append(true).open(&export).unwrap();
            while !ended.load(Ordering::Relaxed) {
                file.write_all(b"GOTO/1.0,1.0,1.0\n").unwrap();
                std::thread::sleep(Duration::from_millis(2));
            }
        });
        let run = batch(shop.path(), "done", &["--format", "line"]);
        ended.store(true, Ordering::Relaxed);
        run
    });
    let run = run.code(1);
    assert!(stderr(&run).contains("CL0424: programs/export.cls was changed"), "{}", stderr(&run));
    assert!(!shop.path().join("done/export.cls").exists());
    assert!(shop.path().join("done/a/p001.cls").exists(), "the others are done");
    // Also when size and time stay what they were.
    let text = fs::read_to_string(&export).unwrap();
    let time = fs::metadata(&export).unwrap().modified().unwrap();
    let ended = AtomicBool::new(false);
    let run = std::thread::scope(|scope| {
        scope.spawn(|| {
            let file = File::options().write(true).open(&export).unwrap();
            for round in 0.. {
                if ended.load(Ordering::Relaxed) {
                    break;
                }
                fs::write(
                    &export,
                    text.replace("FEDRAT/MMPM,100", &format!("FEDRAT/MMPM,{:03}", 100 + round % 900)),
                )
                .unwrap();
                file.set_modified(time).unwrap();
            }
        });
        let run = batch(shop.path(), "done", &["--format", "line"]);
        ended.store(true, Ordering::Relaxed);
        run
    });
    assert!(stderr(&run.code(1)).contains("CL0424"));
}

#[test]
fn a_setup_that_is_changed_meanwhile_is_told() {
    let shop = shop(2);
    write(shop.path(), "r.yaml", &format!("setup_file: s.yaml\n{}", super::RECIPE));
    write(shop.path(), "s.yaml", "machine: { max_feed: 8000 }\n");
    (0..4).for_each(|number| write(shop.path(), &format!("programs/long{number}.cls"), &long_part(20_000)));
    let mut run = clsmith(shop.path());
    run.args(["batch", "--recipe", "r.yaml", "--jobs", "1", "--out", "done", ALL, "-q"]);
    let journal = shop.path().join("done/.clsmith-batch.journal");
    let done = std::thread::scope(|scope| {
        scope.spawn(|| {
            let wait = Instant::now();
            while !journal.exists() && wait.elapsed() < Duration::from_secs(20) {
                std::thread::sleep(Duration::from_millis(1));
            }
            write(shop.path(), "s.yaml", "machine: { max_feed: 9000 }\n");
        });
        run.assert()
    });
    assert!(stderr(&done.code(1)).contains("s.yaml was changed while the batch ran"));
}

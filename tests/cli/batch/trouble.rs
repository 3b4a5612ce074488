//! Two at once, and files that do not hold still.

use super::{ALL, batch, clsmith, long_part, shop, stderr, tree, write};
use crate::support::{try_until_met, wait_for};
use std::fs::{self, File};
use std::io::Write;
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Duration;

#[test]
fn the_second_of_two_batches_is_refused() {
    try_until_met(|size| {
        let shop = shop(3);
        (0..4).for_each(|number| {
            write(shop.path(), &format!("programs/long{number}.cls"), &long_part(8_000 * size))
        });
        let mut first = std::process::Command::new(env!("CARGO_BIN_EXE_clsmith"))
            .current_dir(shop.path())
            .args(["batch", "--recipe", "r.yaml", "--threads", "1", "-q", "--output", "done", ALL])
            .spawn()
            .unwrap();
        let lock = shop.path().join("done/.clsmith-batch.lock");
        let is_held = || File::open(&lock).is_ok_and(|file| file.try_lock_shared().is_err());
        wait_for("the first batch", || is_held() || first.try_wait().unwrap().is_some());
        let second = batch(shop.path(), "done", &["--resume"]);
        let refused = second.get_output().status.code() == Some(1);
        if refused {
            assert!(stderr(&second).contains("CL0423"), "{}", stderr(&second));
        } else {
            assert!(first.try_wait().unwrap().is_some(), "both ran");
        }
        assert!(first.wait().unwrap().success(), "the first is not disturbed");
        assert_eq!(tree(&shop.path().join("done")).len(), 8);
        batch(shop.path(), "done", &["--resume"]).success();
        refused
    });
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

/// Runs batches while somebody else does something to a file again and again, until one of them notices: on a busy machine
/// nothing may happen between two looks.
fn while_it_is_changed(change: impl Fn(&Path, usize) + Sync, look: impl Fn(&Path)) {
    let shop = shop(2);
    write(shop.path(), "programs/export.cls", &long_part(5_000));
    let export = shop.path().join("programs/export.cls");
    /// Ends the changes also when a check fails, which would wait for them otherwise.
    struct EndOnDrop<'e>(&'e AtomicBool);
    impl Drop for EndOnDrop<'_> {
        fn drop(&mut self) {
            self.0.store(true, Ordering::Relaxed);
        }
    }
    let ended = AtomicBool::new(false);
    let noticed = std::thread::scope(|scope| {
        let _end = EndOnDrop(&ended);
        scope.spawn(|| {
            (0..).take_while(|_| !ended.load(Ordering::Relaxed)).for_each(|round| change(&export, round))
        });
        (0..30).any(|_| {
            let run = batch(shop.path(), "done", &["--format", "line"]);
            let noticed = stderr(&run).contains("CL0424: programs/export.cls was changed");
            assert_eq!(run.get_output().status.code(), Some(i32::from(noticed)), "{}", stderr(&run));
            assert!(shop.path().join("done/a/p001.cls").exists(), "the others are done");
            if !noticed {
                look(&shop.path().join("done/export.cls"));
                fs::remove_file(shop.path().join("done/export.cls")).unwrap();
            }
            assert!(!shop.path().join("done/export.cls").exists());
            noticed
        })
    });
    assert!(noticed);
}

#[test]
fn a_file_that_grows_while_it_is_read_is_an_error() {
    let grow = |export: &Path, _| {
        File::options().append(true).open(export).unwrap().write_all(b"GOTO/1.0,1.0,1.0\n").unwrap();
        std::thread::sleep(Duration::from_millis(2));
    };
    while_it_is_changed(grow, |done| assert!(fs::read(done).unwrap().ends_with(b"\n")));
}

#[test]
fn a_file_that_is_changed_in_place_is_an_error_though_size_and_time_stay() {
    // Every third line, from front to end.
    let change = |export: &Path, round: usize| {
        let time = fs::metadata(export).unwrap().modified().unwrap();
        let mut text = fs::read(export).unwrap();
        let digit = b'0' + (round % 10) as u8;
        text.iter_mut().filter(|byte| byte.is_ascii_digit()).step_by(3).for_each(|byte| *byte = digit);
        let mut file = File::options().write(true).open(export).unwrap();
        file.write_all(&text).unwrap();
        file.set_modified(time).unwrap();
    };
    while_it_is_changed(change, |_| ());
}

#[test]
fn a_setup_that_is_changed_meanwhile_is_told() {
    try_until_met(|size| {
        let shop = shop(2);
        write(shop.path(), "r.yaml", &format!("setup_file: s.yaml\n{}", super::RECIPE));
        write(shop.path(), "s.yaml", "machine: { max_feed: 8000 }\n");
        (0..4).for_each(|number| {
            write(shop.path(), &format!("programs/long{number}.cls"), &long_part(3_000 * size))
        });
        let mut run = clsmith(shop.path());
        run.args(["batch", "--recipe", "r.yaml", "--threads", "1", "--output", "done", ALL, "-q"]);
        let journal = shop.path().join("done/.clsmith-batch.journal");
        let done = std::thread::scope(|scope| {
            scope.spawn(|| {
                wait_for("the batch", || journal.exists());
                write(shop.path(), "s.yaml", "machine: { max_feed: 9000 }\n");
            });
            run.assert()
        });
        // It succeeds where it was done before the setup was changed.
        let told = done.get_output().status.code() == Some(1);
        assert_eq!(
            told,
            stderr(&done).contains("s.yaml was changed while the batch ran"),
            "{}",
            stderr(&done)
        );
        told
    });
}

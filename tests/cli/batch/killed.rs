//! A batch that is killed at any moment goes on to the same result.

use super::{ALL, batch, everything, long_part, shop, tree, write};
use crate::support::{self, try_until_met, wait_for};
use proptest::test_runner::RngSeed;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, SystemTime};

fn start(folder: &Path, out: &str) -> Child {
    Command::new(env!("CARGO_BIN_EXE_clsmith"))
        .current_dir(folder)
        .args([
            "batch",
            "--recipe",
            "r.yaml",
            "--resume",
            "--threads",
            "2",
            "--memory",
            "64M",
            "-q",
            "--output",
            out,
            ALL,
        ])
        .stdout(Stdio::null())
        .stderr(Stdio::null())
        .spawn()
        .unwrap()
}

/// Numbers from 0 to 1: other ones in every run, but under `CI`.
fn random() -> (u64, impl FnMut() -> f64) {
    let seed = match support::property(1).rng_seed {
        RngSeed::Fixed(seed) => seed,
        RngSeed::Random => {
            SystemTime::now().duration_since(SystemTime::UNIX_EPOCH).unwrap().as_nanos() as u64
        }
    };
    let mut state = seed;
    let next = move || {
        // Marsaglia's xorshift.
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1u64 << 53) as f64
    };
    (seed, next)
}

/// How many files a journal says are done.
fn journalled(out: &Path) -> usize {
    let text = std::fs::read(out.join(".clsmith-batch.journal")).unwrap_or_default();
    text.iter().filter(|&&byte| byte == b'\n').count().saturating_sub(1)
}

#[test]
fn twenty_kills_change_nothing() {
    let shop = shop(30);
    (0..6).for_each(|number| write(shop.path(), &format!("programs/long{number}.cls"), &long_part(600)));
    write(shop.path(), "programs/bad.cls", "GOTO/x\n");
    assert_eq!(start(shop.path(), "whole").wait().unwrap().code(), Some(1));
    let whole = tree(&shop.path().join("whole"));
    assert_eq!(whole.len(), 37);
    let (seed, mut random) = random();
    let mut killed = 0;
    // Killed four times over, then left in peace; five times, or more often where a busy machine lets most runs end before they are killed.
    for round in 0.. {
        if round >= 5 && killed >= 10 {
            break;
        }
        assert!(round < 40, "{killed} were still running, seed {seed}");
        let out = format!("killed{round}");
        let folder = shop.path().join(&out);
        for _ in 0..4 {
            // At any number of files done, and a little later: moments by the clock would miss a run that has little left.
            let done = journalled(&folder);
            let until = done + (random() * (37 - done) as f64) as usize;
            let mut run = start(shop.path(), &out);
            while journalled(&folder) < until && run.try_wait().unwrap().is_none() {
                std::thread::sleep(Duration::from_millis(1));
            }
            std::thread::sleep(Duration::from_millis(8).mul_f64(random()));
            killed += usize::from(run.try_wait().unwrap().is_none());
            run.kill().unwrap();
            run.wait().unwrap();
            // A run killed in its first moments has made no folder yet.
            if !folder.exists() {
                continue;
            }
            // Whatever is there under its own name is whole. A temporary file may stay behind; the run below takes it away.
            let is_temporary = |name: &Path| name.extension().is_some_and(|end| end == "tmp");
            for (name, bytes) in tree(&folder).into_iter().filter(|(name, _)| !is_temporary(name)) {
                assert!(whole[&name] == bytes, "{} after seed {seed}", name.display());
            }
        }
        batch(shop.path(), &out, &["--resume"]).code(1);
        let left = everything(&folder);
        assert!(
            left.keys().all(|name| !name.to_string_lossy().ends_with(".tmp")),
            "seed {seed}: {:?}",
            left.keys()
        );
        assert!(tree(&folder) == whole, "seed {seed}");
    }
}

#[cfg(unix)]
#[test]
fn ctrl_c_ends_it_gently() {
    try_until_met(|size| {
        let shop = shop(3);
        (0..30 * size)
            .for_each(|number| write(shop.path(), &format!("programs/long{number}.cls"), &long_part(2000)));
        let mut run = start(shop.path(), "done");
        let done = shop.path().join("done");
        wait_for("two files that are done", || journalled(&done) >= 2);
        Command::new("kill").args(["-INT", &run.id().to_string()]).status().unwrap();
        let code = run.wait().unwrap().code();
        if code == Some(0) {
            // It was done before.
            return false;
        }
        assert_eq!(code, Some(130));
        let left = everything(&done);
        assert!(left.keys().all(|name| !name.to_string_lossy().ends_with(".tmp")), "{:?}", left.keys());
        assert!(!done.join("results.jsonl").exists());
        let resumed = batch(shop.path(), "done", &["--resume"]).success();
        assert!(super::stdout(&resumed).contains("done before"));
        true
    });
}

//! Load: 2,000 programs of mixed sizes and one of 500 MB, within a stated memory.

use super::{ALL, RECIPE, lines, write};
use crate::support::wait_with_peak;
use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;

/// The budget that is stated, in bytes.
const MEMORY: u64 = 5_000_000_000;
/// What the process may take beside the files: itself, its threads, what the allocator keeps.
const BESIDE: u64 = 100_000_000;

fn points(path: &Path, bytes: usize) {
    let mut out = BufWriter::new(File::create(path).unwrap());
    write!(
        out,
        "TOOL PATH/LOAD,TOOL,T1\nTLDATA/MILL,10.0000,0.0000,75.0000,0.0000,0.0000\nFEDRAT/MMPM,1200.0000\n"
    )
    .unwrap();
    let mut written = 100;
    for index in 0.. {
        if written >= bytes {
            break;
        }
        let (x, y, z) = (index % 997, index % 991, index % 13);
        let line = match index % 1000 {
            999 => format!("FEDRAT/MMPM,{}.0000\n", 400 + index % 700),
            _ => format!("GOTO/{x}.1250,{y}.2500,-{z}.5000,0.0000000,0.0000000,1.0000000\n"),
        };
        written += line.len();
        out.write_all(line.as_bytes()).unwrap();
    }
    out.write_all(b"END-OF-PATH\n").unwrap();
    out.flush().unwrap();
}

/// Runs a batch; its peak memory and seconds.
fn run(folder: &Path, out: &str, more: &[&str]) -> (u64, f64) {
    let began = Instant::now();
    let memory = MEMORY.to_string();
    let run = Command::new(env!("CARGO_BIN_EXE_clsmith"))
        .current_dir(folder)
        .args(["batch", "--recipe", "r.yaml", "-q", "--memory", &memory, "--out", out])
        .args(more)
        .arg(ALL)
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    let (status, most) = wait_with_peak(run);
    assert!(status.success());
    (most, began.elapsed().as_secs_f64())
}

fn load(recipe: &str) {
    let shop = tempfile::tempdir().unwrap();
    write(shop.path(), "r.yaml", recipe);
    for number in 0..2000_usize {
        let folder = shop.path().join("programs").join((number % 20).to_string());
        fs::create_dir_all(&folder).unwrap();
        // From 1 kB to 1 MB, most of them small: 200 MB together.
        let bytes = 1000 + 1_000_000 * (number * 7919 % 2000).pow(3) / 2000_usize.pow(3) / 2;
        points(&folder.join(format!("p{number}.cls")), bytes);
    }
    points(&shop.path().join("programs/large.cls"), 500_000_000);
    for (out, more) in [("done", &["--jobs", "4"][..]), ("again", &["--jobs", "1"]), ("done", &["--resume"])]
    {
        let (most, seconds) = run(shop.path(), out, more);
        let (rate, most_mb) = (2001.0 / seconds, most as f64 / 1e6);
        println!("{out} {more:?}: {seconds:.1} s, {rate:.0} files/s, peak memory {most_mb:.0} MB");
        assert!(most < MEMORY + BESIDE, "{most} bytes");
    }
    let results = |out: &str| fs::read(shop.path().join(out).join("results.jsonl")).unwrap();
    assert!(results("done") == results("again"));
    assert_eq!(lines(&shop.path().join("done/results.jsonl")).len(), 2001);
}

#[test]
#[ignore = "soak: 2,000 files and one of 500 MB; minutes, and release"]
fn soak_two_thousand_files_and_a_large_one() {
    load(RECIPE);
}

/// The most that a recipe can do to memory: every statement gets a new text.
#[test]
#[ignore = "soak: 2,000 files and one of 500 MB; minutes, and release"]
fn soak_every_statement_changed() {
    load("version: 1\nsteps:\n  - move_origin: { translate: [1, 2, 3] }\n");
}

//! A batch under load: 2,000 programs of 1 kB to 0.5 MB and one of 500 MB, within a stated memory: `cargo bench --bench batch`.
//!
//! Prints seconds, files a second and peak memory, for a recipe that edits feeds and for one that gives every statement a new text, with
//! four jobs, with one, and resumed. Ends with a failure where a run takes more memory than it was given, or where the results differ.
//! `CLSMITH_BENCH_MB` sets the size of the large file (500) and, in proportion, the number of the others. It needs a gigabyte of disk.

// A benchmark that cannot make its files has nothing to measure.
#![allow(clippy::expect_used)]

mod support;

use std::fs::{self, File};
use std::io::{BufWriter, Write};
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;
use support::wait_with_peak;

/// The budget that is stated, in bytes.
const MEMORY: u64 = 5_000_000_000;
/// What the process may take beside the files: itself, its threads, what the allocator keeps.
const BESIDE: u64 = 100_000_000;

/// What the recipes change: feeds alone, or the text of every statement, which is the most that a recipe can do to memory.
const RECIPES: [(&str, &str); 2] = [
    ("feeds halved", "version: 1\nsteps:\n  - scale_feed: { factor: 0.5 }\n"),
    ("every point moved", "version: 1\nsteps:\n  - move_origin: { translate: [1, 2, 3] }\n"),
];

fn main() {
    let megabytes: usize =
        std::env::var("CLSMITH_BENCH_MB").ok().and_then(|text| text.parse().ok()).unwrap_or(500);
    let folder = tempfile::tempdir().expect("a folder");
    let count = write_programs(folder.path(), megabytes).expect("the programs");
    for (name, recipe) in RECIPES {
        fs::write(folder.path().join("recipe.yaml"), recipe).expect("a recipe");
        println!("{count} files, {name}");
        for (out, more) in
            [("done", &["--threads", "4"][..]), ("again", &["--threads", "1"]), ("done", &["--resume"])]
        {
            let (most, seconds) = run(folder.path(), out, more);
            let rate = count as f64 / seconds;
            let more = more.join(" ");
            println!(
                "  {more:<9} {seconds:7.1} s {rate:6.0} files/s, peak memory {:.0} MB",
                most as f64 / 1e6
            );
            assert!(most < MEMORY + BESIDE, "{most} bytes are more than what was stated");
        }
        let results = |out: &str| fs::read(folder.path().join(out).join("results.jsonl")).expect("results");
        assert!(results("done") == results("again"), "the results hang on the number of jobs");
        assert_eq!(results("done").split(|byte| *byte == b'\n').count(), count + 1);
        for out in ["done", "again"] {
            fs::remove_dir_all(folder.path().join(out)).expect("outputs to remove");
        }
    }
}

/// Writes the programs; how many.
fn write_programs(folder: &Path, megabytes: usize) -> std::io::Result<usize> {
    let small = 4 * megabytes;
    for number in 0..small {
        let below = folder.join("programs").join((number % 20).to_string());
        fs::create_dir_all(&below)?;
        // Most of them are small: 250 MB together where there are 2,000.
        let bytes = 1000 + 1_000_000 * (number * 7919 % small).pow(3) / small.pow(3) / 2;
        write_points(&below.join(format!("p{number}.cls")), bytes)?;
    }
    write_points(&folder.join("programs/large.cls"), megabytes * 1_000_000)?;
    Ok(small + 1)
}

fn write_points(path: &Path, bytes: usize) -> std::io::Result<()> {
    let mut out = BufWriter::new(File::create(path)?);
    write!(
        out,
        "TOOL PATH/LOAD,TOOL,T1\nTLDATA/MILL,10.0000,0.0000,75.0000,0.0000,0.0000\nFEDRAT/MMPM,1200.0000\n"
    )?;
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
        out.write_all(line.as_bytes())?;
    }
    out.write_all(b"END-OF-PATH\n")?;
    out.flush()
}

/// Runs a batch; its peak memory and seconds.
fn run(folder: &Path, out: &str, more: &[&str]) -> (u64, f64) {
    let began = Instant::now();
    let memory = MEMORY.to_string();
    let run = Command::new(env!("CARGO_BIN_EXE_clsmith"))
        .current_dir(folder)
        .args(["batch", "--recipe", "recipe.yaml", "-q", "--memory", &memory, "--output", out])
        .args(more)
        .arg("programs/**/*.cls")
        .stderr(Stdio::null())
        .spawn()
        .expect("the command");
    let (status, most) = wait_with_peak(run);
    assert!(status.success(), "{status}");
    (most, began.elapsed().as_secs_f64())
}

//! Reading and writing a large file, beside the least that any reader must do: split lines and parse floats.
//!
//! `cargo bench --bench pipeline` prints times, throughput, ratios and peak memory. `CLSMITH_BENCH_MB` sets the size (100).
//! Each stage runs in a process of its own, so that peak memory is that of the stage.

// A benchmark that cannot make its file has nothing to measure.
#![allow(clippy::expect_used)]

use clsmith::parse::parse;
use clsmith::source::Source;
#[path = "support/mixes.rs"]
mod mixes;

use mixes::Mix;
use std::hint::black_box;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

const RUNS: usize = 5;

fn main() {
    // Cargo passes `--bench`; a stage is named by the environment.
    match std::env::var("CLSMITH_BENCH_STAGE") {
        Ok(stage) => run_stage(&stage),
        Err(_) => compare(),
    }
}

fn compare() {
    let megabytes: usize =
        std::env::var("CLSMITH_BENCH_MB").ok().and_then(|text| text.parse().ok()).unwrap_or(100);
    let folder = std::env::temp_dir().join(format!("clsmith-bench-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for the benchmark");
    for mix in [Mix::Gotos, Mix::Nx, Mix::Catia] {
        for size in [megabytes / 10, megabytes].into_iter().filter(|size| *size > 0) {
            let path = folder.join(mix.file_name());
            std::fs::write(&path, mix.write_program(size * 1_000_000)).expect("the benchmark's file");
            println!("{size} MB, {}", mix.name());
            compare_stages(&path, size as f64);
        }
    }
    std::fs::remove_dir_all(&folder).expect("the benchmark's folder");
}

/// Runs each stage on a file of so many megabytes, and prints what it took.
fn compare_stages(path: &Path, size: f64) {
    let mut bare = 0.0;
    for stage in ["bare", "parse", "apply"] {
        let output = Command::new(std::env::current_exe().expect("this benchmark"))
            .env("CLSMITH_BENCH_STAGE", stage)
            .env("CLSMITH_BENCH_FILE", path)
            .output()
            .expect("a stage");
        let text = String::from_utf8_lossy(&output.stdout).into_owned();
        let mut words = text.split_whitespace().filter_map(|word| word.parse::<f64>().ok());
        let (seconds, memory) = (words.next().unwrap_or(f64::NAN), words.next().unwrap_or(f64::NAN));
        if stage == "bare" {
            bare = seconds;
        }
        println!(
            "  {stage:<6} {:8.1} ms  {:6.0} MB/s  {:5.2} x bare  peak {:5.2} x file",
            seconds * 1e3,
            size / seconds,
            seconds / bare,
            memory / (size * 1e6)
        );
    }
}

/// Runs one stage a few times; prints the best time and the peak memory of the process.
fn run_stage(stage: &str) {
    let path = std::env::var("CLSMITH_BENCH_FILE").expect("CLSMITH_BENCH_FILE");
    let path = Path::new(&path);
    let best = (0..RUNS).map(|_| measure(stage, path)).min().unwrap_or_default();
    println!("{} {}", best.as_secs_f64(), peak_bytes());
}

fn measure(stage: &str, path: &Path) -> Duration {
    match stage {
        "bare" => {
            let bytes = std::fs::read(path).expect("the file");
            let start = Instant::now();
            black_box(bare(&bytes));
            start.elapsed()
        }
        "parse" => {
            let source =
                Source::new("part.cls", std::fs::read(path).expect("the file")).expect("below 4 GiB");
            let start = Instant::now();
            black_box(parse(&source, None).program.statements().len());
            start.elapsed()
        }
        _ => {
            // What `clsmith apply` does with an empty recipe, from opening the file to the renamed output on the disk.
            let start = Instant::now();
            let source =
                Source::new("part.cls", std::fs::read(path).expect("the file")).expect("below 4 GiB");
            let parsed = parse(&source, None);
            clsmith::output_files::write_atomically(&path.with_extension("out"), |out| {
                parsed.program.byte_chunks().try_for_each(|piece| out.write_all(piece))
            })
            .expect("the output");
            start.elapsed()
        }
    }
}

/// Lines split at LF, what is behind the slash split at commas, floats by std: the least any reader of CL text does.
fn bare(bytes: &[u8]) -> f64 {
    let text = std::str::from_utf8(bytes).expect("ASCII");
    let mut sum = 0.0;
    for line in text.split('\n') {
        let fields = line.split_once('/').map_or(line, |(_, fields)| fields);
        sum += fields.split(',').filter_map(|number| number.trim_ascii().parse::<f64>().ok()).sum::<f64>();
    }
    sum
}

/// Peak resident memory, where the system tells it; 0 elsewhere.
fn peak_bytes() -> u64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:")).unwrap_or_default();
    line.split_whitespace().next().and_then(|kilobytes| kilobytes.parse::<u64>().ok()).unwrap_or_default()
        * 1024
}

//! Whether time grows with the size of a program and no faster, and whether one wrong coordinate costs nothing:
//! `cargo bench --bench growth`.
//!
//! Prints seconds of the processor for programs of one, two and four times a size, and fails where four times the size takes more
//! than seven times as long. `CLSMITH_BENCH_POINTS` sets the points of the largest statement (160,000); the largest program
//! has a fifth as many operations.

// A benchmark that cannot make its files has nothing to measure.
#![allow(clippy::expect_used)]

mod support;

use std::fmt::Write as _;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;
use support::wait_with_peak;

/// Four times the size may take so many times as long: 4 is linear, 16 is quadratic, and the machine is shared.
const MOST_GROWTH: f64 = 7.0;

/// What a program with one wrong coordinate may take, in bytes.
const MOST_MEMORY: u64 = 500_000_000;

const STOCK: &str = "{ stock: { block: { from: [-35, -25, -15], to: [35, 25, 0] } }, tools: [ { match: {}, teeth: 3 } ], \
    machine: { max_feed: 3000, rapid_feed: 15000 } }";

fn main() {
    let points: usize =
        std::env::var("CLSMITH_BENCH_POINTS").ok().and_then(|text| text.parse().ok()).unwrap_or(160_000);
    let folder = tempfile::tempdir().expect("a folder");
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).expect("a file");
    write("move.yaml", "version: 1\nsteps:\n  - move_origin: { translate: [1, 2, 3] }\n");
    let optimize =
        "version: 1\nsetup: SETUP\nsteps:\n  - optimize_feed: { target: 0.08 }\n".replace("SETUP", STOCK);
    write("optimize.yaml", &optimize);
    let sizes = [points / 4, points / 2, points];
    measure_growth("one statement of N points, moved", folder.path(), "move.yaml", sizes, one_statement);
    let sizes = sizes.map(|points| points / 5);
    measure_growth("N operations, feeds optimized", folder.path(), "optimize.yaml", sizes, operations);
    measure_growth(
        "N operations with a tool each, moved",
        folder.path(),
        "move.yaml",
        sizes,
        operations_with_tools,
    );
    // The first operation cuts, the second has lost its decimal point.
    let lost = operations(1).replace("GOTO/20.0000,0.0000,", "GOTO/20.0000,100000000.0000,");
    write("part.cls", &(operations(1) + &lost));
    let (seconds, peak) = apply(folder.path(), "optimize.yaml");
    println!(
        "a coordinate of 100 km, feeds optimized: {seconds:.2} s, peak memory {:.0} MB",
        peak as f64 / 1e6
    );
    assert!(peak < MOST_MEMORY, "{peak} bytes for one wrong coordinate");
}

fn measure_growth(name: &str, folder: &Path, recipe: &str, sizes: [usize; 3], program: fn(usize) -> String) {
    let mut seconds = Vec::new();
    for size in sizes {
        fs::write(folder.join("part.cls"), program(size)).expect("a program");
        let (taken, peak) = apply(folder, recipe);
        println!("{name}: N = {size:>7}: {taken:6.2} s, peak memory {:.0} MB", peak as f64 / 1e6);
        seconds.push(taken);
    }
    let [first, .., last] = seconds.as_slice() else { return };
    assert!(
        last / first < MOST_GROWTH,
        "{name}: four times the size takes {:.1} times as long",
        last / first
    );
}

/// Applies a recipe; seconds by the clock, and the peak of memory in bytes.
fn apply(folder: &Path, recipe: &str) -> (f64, u64) {
    let begun = Instant::now();
    let mut command = Command::new(env!("CARGO_BIN_EXE_clsmith"));
    command.current_dir(folder).args([
        "apply",
        "-q",
        recipe,
        "part.cls",
        "-o",
        "out.cls",
        "--summary",
        "out.md",
    ]);
    command.stdout(Stdio::null()).stderr(Stdio::null());
    let (status, peak) = wait_with_peak(command.spawn().expect("the command"));
    assert!(status.success(), "apply {recipe}: {status}");
    (begun.elapsed().as_secs_f64(), peak)
}

/// A statement of many points, a line each.
fn one_statement(points: usize) -> String {
    let mut text = "TOOL PATH/LONG,TOOL,EM6\nLOAD/TOOL,1\nFEDRAT/MMPM,500.0000\nGOTO/".to_owned();
    for index in 0..points {
        let end = if index + 1 < points { ", $" } else { "" };
        let _ = writeln!(text, "{:.4},{:.4},1.0000{end}", index as f64 * 0.01, (index % 7) as f64);
    }
    text + "END-OF-PATH\n"
}

/// Operations that each have a tool of their own.
fn operations_with_tools(count: usize) -> String {
    let mut text = String::new();
    for index in 0..count {
        let _ = write!(
            text,
            "TOOL PATH/OPERATION{index},TOOL,EM{index}\nTLDATA/MILL,12.0000,0.0000,75.0000,0.0000,0.0000\nLOAD/TOOL,{index}\n\
             FEDRAT/MMPM,700.0000\nGOTO/-45.0000,0.0000,1.0000\nGOTO/20.0000,0.0000,1.0000\nEND-OF-PATH\n"
        );
    }
    text
}

/// Operations that each go through the stock once.
fn operations(count: usize) -> String {
    let mut text = String::new();
    for index in 0..count {
        let z = -3.0 - 9.0 * index as f64 / count as f64;
        let _ = write!(
            text,
            "TOOL PATH/OPERATION{index},TOOL,EM12\nTLDATA/MILL,12.0000,0.0000,75.0000,0.0000,0.0000\nLOAD/TOOL,3\n\
             SPINDL/RPM,3200,CLW\nRAPID\nGOTO/-45.0000,0.0000,30.0000\nFEDRAT/MMPM,700.0000\nGOTO/-45.0000,0.0000,{z:.4}\n\
             GOTO/20.0000,0.0000,{z:.4}\nRAPID\nGOTO/20.0000,0.0000,30.0000\nEND-OF-PATH\n"
        );
    }
    text
}

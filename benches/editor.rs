//! An edit of a long program in an editor: how soon `clsmith lsp` answers after it, how soon its findings follow, and the peak of
//! memory by the size of the file.
//!
//! `cargo bench --bench editor` prints them for a million lines; `CLSMITH_BENCH_LINES` sets another number.

// A benchmark that gets no answer has nothing to measure.
#![allow(clippy::expect_used, clippy::unwrap_used, clippy::panic, clippy::indexing_slicing)]

#[path = "../tests/editor/client.rs"]
#[allow(dead_code)]
mod client;

use client::Client;
use serde_json::Value;
use std::time::Instant;

const URI: &str = "file:///programs/long.cls";

fn main() {
    let lines: u32 =
        std::env::var("CLSMITH_BENCH_LINES").ok().and_then(|text| text.parse().ok()).unwrap_or(1_000_000);
    let mut text = String::from("UNITS/MM\nLOAD/TOOL,1\nSPINDL/RPM,5000,CLW\nFEDRAT/MMPM,1200\n");
    for point in 0..lines {
        // A pass of 1000 points along a wave, with the digits of real programs: 32 bytes a line.
        let (x, y) = (f64::from(point % 1000) * 0.3217, 100.0 + f64::from(point / 1000) * 0.05);
        text.push_str(&format!("GOTO/{x:.4},{y:.4},{:.4}\n", -12.0 + (x * 0.1).sin()));
    }
    let mut client = Client::initialized(&[], Value::Null);
    let begun = Instant::now();
    client.open(URI, "apt", &text);
    println!(
        "{lines} lines, {:.1} MB: opened and checked in {:.2} s",
        text.len() as f64 / 1e6,
        begun.elapsed().as_secs_f64()
    );
    let mut worst = 0.0_f64;
    for version in 2..22 {
        let line = lines / 2 + version as u32;
        let begun = Instant::now();
        client.change(URI, version, &[([line, 5, line, 6], "7")]);
        assert!(client.hover(URI, lines - 7).contains("1200 MMPM"));
        worst = worst.max(begun.elapsed().as_secs_f64());
    }
    println!("  an edit and a question behind it, slowest of 20: {:.0} ms", worst * 1e3);
    let begun = Instant::now();
    client.findings(URI, 21);
    println!(
        "  findings after the last edit: {:.2} s, with the pause of 0.15 s",
        begun.elapsed().as_secs_f64()
    );
    if let Some(peak) = client.peak_memory_bytes() {
        println!("  peak of memory: {:.0} MB, {:.1} times the file", peak / 1e6, peak / text.len() as f64);
    }
    client.end();
}

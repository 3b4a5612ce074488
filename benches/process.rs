//! The whole command on programs as CAM systems write them: `check`, and `apply` of two steps whose output must be, byte for
//! byte, that of a bare rewriter that knows nothing but the columns of its numbers.
//!
//! `cargo bench --bench process` prints, for each, megabytes a second by the clock and by the processor, and the peak of
//! memory by the size of the file. `CLSMITH_BENCH_MB` sets the size (10), `RAYON_NUM_THREADS` how many threads.

// A benchmark that cannot make its files has nothing to measure.
#![allow(clippy::expect_used)]

#[path = "support/mixes.rs"]
mod mixes;
mod support;

use mixes::Mix;
use std::fs;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::Instant;
use support::wait_with_peak;

const RUNS: u32 = 7;

/// A step, and the bare rewriter of a line: how it changes the number of an index, if it does.
type BareRewriter = fn(line: &Line<'_>, index: usize, value: f64) -> Option<f64>;

fn main() {
    let megabytes: usize =
        std::env::var("CLSMITH_BENCH_MB").ok().and_then(|text| text.parse().ok()).unwrap_or(10);
    let folder = tempfile::tempdir().expect("a folder");
    let folder = folder.path();
    let recipe = |step: &str| format!("version: 1\nunits: mm\nsteps: [{step}]\n");
    fs::write(folder.join("empty.yaml"), recipe("")).expect("a recipe");
    fs::write(folder.join("scale.yaml"), recipe("{ scale_feed: { factor: 0.5 } }")).expect("a recipe");
    fs::write(folder.join("move.yaml"), recipe("{ move_origin: { translate: [10, -20, 5.5] } }"))
        .expect("a recipe");
    for mix in [Mix::Gotos, Mix::Nx, Mix::Catia] {
        let program = mix.write_program(megabytes * 1_000_000);
        fs::write(folder.join(mix.file_name()), &program).expect("the benchmark's file");
        println!("{megabytes} MB, {}", mix.name());
        measure(folder, &["check", mix.file_name()], &program);
        measure(folder, &["apply", "-q", "empty.yaml", mix.file_name(), "-o", "out.cls"], &program);
        let steps: [(&str, BareRewriter); 2] = [("scale.yaml", halve_feed), ("move.yaml", move_point)];
        for (name, rewrite) in steps {
            let begun = Instant::now();
            let expected = rewrite_program(&program, rewrite);
            let bare = begun.elapsed();
            measure(folder, &["apply", "-q", name, mix.file_name(), "-o", "out.cls"], &program);
            println!("    the bare rewriter, in memory: {:.0} ms", bare.as_secs_f64() * 1e3);
            compare(&fs::read_to_string(folder.join("out.cls")).expect("the output"), &expected);
        }
    }
}

/// Runs a command a few times; prints its best time by the clock, its mean by the processor, and its peak of memory.
fn measure(folder: &Path, arguments: &[&str], program: &str) {
    let (mut best, mut most) = (f64::INFINITY, 0);
    let before = children_seconds();
    for _ in 0..RUNS {
        let begun = Instant::now();
        let mut command = Command::new(env!("CARGO_BIN_EXE_clsmith"));
        command.current_dir(folder).args(arguments).stdout(Stdio::null()).stderr(Stdio::null());
        let (status, peak) = wait_with_peak(command.spawn().expect("the command"));
        assert!(status.success(), "{arguments:?}: {status}");
        best = best.min(begun.elapsed().as_secs_f64());
        most = peak.max(most);
    }
    let processor = (children_seconds() - before) / f64::from(RUNS);
    let size = program.len() as f64 / 1e6;
    println!(
        "  {:<16} {:6.0} ms  {:5.0} MB/s by the clock  {:5.0} by the processor  peak {:5.2} x file",
        arguments.iter().filter(|word| !word.starts_with('-')).take(2).copied().collect::<Vec<_>>().join(" "),
        best * 1e3,
        size / best,
        size / processor,
        most as f64 / program.len() as f64
    );
}

/// Seconds of the processor that ended children took, in hundredths as Linux counts them; 0 elsewhere.
fn children_seconds() -> f64 {
    let stat = fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields = stat.rsplit(") ").next().unwrap_or_default().split(' ');
    let ticks: Vec<f64> = fields.skip(13).take(2).filter_map(|ticks| ticks.parse().ok()).collect();
    ticks.iter().sum::<f64>() / 100.0
}

fn compare(actual: &str, expected: &str) {
    let differs = || actual.lines().zip(expected.lines()).find(|(actual, expected)| actual != expected);
    assert!(actual == expected, "the output is not the bare rewriter's: {:?}", differs());
}

/// A line, and the word of the statement that it belongs to.
struct Line<'t> {
    word: &'t str,
    /// How many numbers of the statement stand in lines before.
    before: usize,
    /// Whether the arc of the statement is longer than half a circle, which adds a number.
    beyond_half: bool,
}

fn halve_feed(line: &Line<'_>, _index: usize, value: f64) -> Option<f64> {
    (line.word == "FEDRAT").then_some(value * 0.5)
}

fn move_point(line: &Line<'_>, index: usize, value: f64) -> Option<f64> {
    let shift = [10.0, -20.0, 5.5];
    let at = line.before + index;
    let component = match line.word {
        "GOTO" | "CIRCLE" => at,
        // Centre, radius, perhaps the 2 of `2,INTOF`, centre and end.
        "TLON" => match at {
            0..3 => at,
            _ => (at.checked_sub(if line.beyond_half { 5 } else { 4 })?) % 3,
        },
        _ => return None,
    };
    shift.get(component).map(|shift| value + shift)
}

/// Prints the numbers that a step changes where they stood, with their decimals; all else is copied.
fn rewrite_program(program: &str, rewrite: BareRewriter) -> String {
    let mut out = String::with_capacity(program.len() + program.len() / 8);
    let mut line = Line { word: "", before: 0, beyond_half: false };
    let mut open = false;
    for text in program.split_inclusive('\n') {
        if !open {
            let word = text.split(['/', ',', ' ', '\n']).next().unwrap_or_default();
            line = Line { word, before: 0, beyond_half: false };
        }
        line.beyond_half |= text.contains("INTOF");
        line.before += rewrite_line(text, &line, rewrite, &mut out);
        open = text.ends_with("$\n");
    }
    out
}

/// Rewrites one line, and returns how many numbers it has.
fn rewrite_line(text: &str, line: &Line<'_>, rewrite: BareRewriter, out: &mut String) -> usize {
    let (mut copied, mut index, mut start) = (0, 0, 0);
    for field in text.split_inclusive(['/', ',', ')', '(']) {
        let inner = field.trim_end_matches(['/', ',', ')', '(', '\n', '$']);
        let number = inner.trim_start();
        if number.starts_with(|first: char| first.is_ascii_digit() || first == '-')
            && let Ok(value) = number.parse::<f64>()
        {
            if let Some(new) = rewrite(line, index, value) {
                let decimals = number.split_once('.').map_or(0, |(_, decimals)| decimals.len());
                let zero = format!("-{:.decimals$}", 0.0);
                let printed = format!("{new:.decimals$}");
                let printed = if printed == zero { &printed[1..] } else { &printed };
                out.push_str(&text[copied..start]);
                let width = if inner.len() > number.len() { inner.len() } else { 0 };
                out.push_str(&format!("{printed:>width$}"));
                copied = start + inner.len();
            }
            index += 1;
        }
        start += field.len();
    }
    out.push_str(&text[copied..]);
    index
}

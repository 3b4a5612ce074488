//! How many moves a second the simulation does: `cargo bench --bench simulate`.
//!
//! A block of 100 x 100 x 25, a cutter of 10 mm, moves of 0.5 mm in a zigzag 1 mm apart, depth sinusoidal from 2 to 8 mm, chip
//! thickness computed. Single thread, by time of the processor, so that what else runs does not count, and once more with the details that
//! forces need; then all threads, by the clock. `CLSMITH_BENCH_CELLS=0.25` limits the cells.
//!
//! Then what the largest removal rate of a motion costs, which must not depend on how the motion is split: the time of a run that tells
//! where along its pieces it removes how much, by that of one that does not. Both run in turns, single thread, by time of the processor.

// A benchmark that cannot make its cutter has nothing to measure.
#![allow(clippy::expect_used, clippy::indexing_slicing)]

use clsmith::cutter::{CutterModel, Meridian, Teeth};
use clsmith::engagement::{PathPiece, Simulation};
use clsmith::program::geometry::Pose;
use clsmith::stock::{DexelGrid, Dexels};
use nalgebra::{Point3, Vector3};
use std::hint::black_box;
use std::time::Instant;

/// The best of so many runs counts.
const RUNS: u32 = 2;

fn block(cell: f64) -> Dexels {
    let layout = DexelGrid::covering_box([0.0, 0.0, -25.0], [100.0, 100.0, 0.0], cell);
    let mut stock = Dexels::with_empty_columns(layout);
    for row in 0..layout.rows {
        for column in 0..layout.columns {
            stock.set_column(column, row, &[[0.0, 25.0]]);
        }
    }
    stock
}

/// 82 passes of 200 moves with a step-over between them.
fn zigzag(lean: f64) -> Vec<PathPiece> {
    let depth = |x: f64, y: f64| -5.0 - 3.0 * (x / 8.0 + y / 5.0).sin();
    let mut points = Vec::new();
    for pass in 0..82 {
        let y = 9.5 + f64::from(pass);
        for step in 0..=200 {
            let x = 0.5 * f64::from(if pass % 2 == 0 { step } else { 200 - step });
            points.push(Point3::new(x, y, depth(x, y)));
        }
    }
    let axis = |point: &Point3<f64>| {
        let (a, b) = (lean * (point.x / 11.0).sin(), lean * (point.y / 13.0).cos());
        Vector3::new(a.sin(), b.sin(), 1.0).normalize()
    };
    let place = |point: &Point3<f64>| Pose {
        point: *point,
        axis: if lean > 0.0 { axis(point) } else { Vector3::z() },
    };
    points
        .windows(2)
        .map(|pair| PathPiece { from: place(&pair[0]), to: place(&pair[1]), cutter: 0 })
        .collect()
}

/// The same passes as one straight motion each, with the step-overs between them.
fn long_passes() -> Vec<PathPiece> {
    let place = |x: f64, y: f64| Pose { point: Point3::new(x, y, -5.0), axis: Vector3::z() };
    let mut points = Vec::new();
    for pass in 0..82 {
        let y = 9.5 + f64::from(pass);
        let ends = if pass % 2 == 0 { [0.0, 100.0] } else { [100.0, 0.0] };
        points.extend(ends.map(|x| place(x, y)));
    }
    points.windows(2).map(|pair| PathPiece { from: pair[0], to: pair[1], cutter: 0 }).collect()
}

/// The time of a run that finds largest removal rates, by that of one that does not. Both run in turns; the best of each counts.
fn peak_cost(cutter: &CutterModel, pieces: &[PathPiece], cell: f64) -> f64 {
    let mut best = [f64::INFINITY; 2];
    for _ in 0..2 * RUNS {
        for (best, window) in best.iter_mut().zip([None, Some((8.0 * cell).max(0.5))]) {
            let mut simulation = Simulation::new(block(cell), false).with_removal_window_mm(window);
            let (start, used) = (Instant::now(), processor_seconds());
            let mut removed = 0.0_f64;
            for batch in pieces.chunks(1024) {
                let found = simulation.sweep_pieces(batch, std::slice::from_ref(cutter));
                removed += found.iter().map(|found| found.removed_mm3).sum::<f64>();
            }
            black_box(removed);
            let used = processor_seconds().zip(used).map(|(now, before)| now - before);
            *best = best.min(used.unwrap_or_else(|| start.elapsed().as_secs_f64()));
        }
    }
    best[1] / best[0].max(0.01)
}

/// Seconds of the processor that this process has used (Linux), else none.
fn processor_seconds() -> Option<f64> {
    let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
    let after_name = stat.rsplit(')').next()?;
    let mut fields = after_name.split_whitespace().skip(11);
    let ticks: f64 = fields.next()?.parse::<f64>().ok()? + fields.next()?.parse::<f64>().ok()?;
    Some(ticks / 100.0)
}

/// Moves per second; the best of some runs.
fn rate(cutter: &CutterModel, pieces: &[PathPiece], cell: f64, detail: bool, by_processor: bool) -> f64 {
    let mut best = 0.0_f64;
    for _ in 0..RUNS {
        let mut simulation = Simulation::new(block(cell), detail);
        let teeth = Teeth::evenly_spaced(4, 0.0).expect("four teeth");
        let (start, used) = (Instant::now(), processor_seconds());
        let mut largest = 0.0_f64;
        for batch in pieces.chunks(1024) {
            for found in simulation.sweep_pieces(batch, std::slice::from_ref(cutter)) {
                largest = largest.max(found.max_advance_ratio() * 1000.0 / 5000.0 / teeth.count() as f64);
            }
        }
        black_box(largest);
        let used = processor_seconds().zip(used).map(|(now, before)| now - before);
        let seconds = used.filter(|_| by_processor).unwrap_or_else(|| start.elapsed().as_secs_f64());
        best = best.max(pieces.len() as f64 / seconds.max(1e-9));
    }
    best
}

fn main() {
    let cells: Vec<f64> = std::env::var("CLSMITH_BENCH_CELLS")
        .ok()
        .map(|cells| cells.split(',').filter_map(|cell| cell.parse().ok()).collect())
        .unwrap_or_else(|| vec![0.25, 0.1]);
    let cutter = |corner: f64| CutterModel {
        profile: Meridian::new(10.0, corner, 0.0, 0.0, 40.0).expect("a cutter"),
        collars: Vec::new(),
        teeth: None,
    };
    let single = rayon::ThreadPoolBuilder::new().num_threads(1).build().expect("a thread");
    println!(
        "{:<18}{:>6}{:>16}{:>16}{:>16}",
        "cutter", "cell", "1 thread /s", "for forces /s", "all threads /s"
    );
    let cutters = [("flat", 0.0), ("ball", 5.0), ("bull R1", 1.0)];
    let leans = [("", 0.0), ("five-axis ", 0.2)];
    for (kind, lean, (name, corner)) in
        leans.into_iter().flat_map(|(kind, lean)| cutters.map(|cutter| (kind, lean, cutter)))
    {
        let pieces = zigzag(lean);
        for cell in &cells {
            let cutter = cutter(corner);
            let [one, forces] =
                [false, true].map(|detail| single.install(|| rate(&cutter, &pieces, *cell, detail, true)));
            let all = rate(&cutter, &pieces, *cell, false, false);
            println!("{:<18}{cell:>6}{one:>16.0}{forces:>16.0}{all:>16.0}", format!("{kind}{name}"));
        }
    }

    println!(
        "\n{:<18}{:>6}{:>26}{:>26}",
        "largest removal", "cell", "moves of 0.5 mm, ratio", "of 100 mm, ratio"
    );
    for (kind, lean, (name, corner)) in
        leans.into_iter().flat_map(|(kind, lean)| cutters.map(|cutter| (kind, lean, cutter)))
    {
        // The long passes are upright.
        let (short, long) = (zigzag(lean), long_passes());
        for cell in &cells {
            let cutter = cutter(corner);
            let ratio = single.install(|| peak_cost(&cutter, &short, *cell));
            let of_long = match lean > 0.0 {
                true => String::new(),
                false => format!("{:.2}", single.install(|| peak_cost(&cutter, &long, *cell))),
            };
            println!("{:<18}{cell:>6}{ratio:>26.2}{of_long:>26}", format!("{kind}{name}"));
        }
    }
}

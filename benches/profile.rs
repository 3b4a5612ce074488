//! The tip path of a ball over a profile of a million points: seconds of the processor.
//!
//! `cargo bench --bench profile`; `CLSMITH_BENCH_POINTS` sets the number of points (1,000,000).

// A benchmark that cannot make its profile has nothing to measure.
#![allow(clippy::expect_used)]

use clsmith::internals::surface::profile::{
    Chain, ChordSide, Point, compensate_profile, find_unreachable_parts, fit_chords, recover_profile,
};
use std::hint::black_box;

const RUNS: usize = 5;

/// What a case makes of the profile and its tip path: a number of pieces or places.
type Work = fn(&Chain, &Chain) -> usize;

fn main() {
    let points: usize =
        std::env::var("CLSMITH_BENCH_POINTS").ok().and_then(|text| text.parse().ok()).unwrap_or(1_000_000);
    let work: [(&str, Work); 5] = [
        ("compensate", |profile, _| compensate_profile(profile, 5.0).expect("a radius").pieces().len()),
        ("recover", |_, tip| recover_profile(tip, 5.0).expect("a radius").pieces().len()),
        ("unreachable", |profile, _| find_unreachable_parts(profile, 5.0, 0.01).expect("a radius").len()),
        ("chords 0.01", |_, tip| {
            fit_chords(tip, 0.01, false, ChordSide::Both).expect("a tolerance").pieces().len()
        }),
        ("arcs 0.01", |_, tip| {
            fit_chords(tip, 0.01, true, ChordSide::Both).expect("a tolerance").pieces().len()
        }),
    ];
    let shapes =
        [("gentle hills", hills(points)), ("waves", waves(points)), ("steps that overhang", saw(points))];
    for (shape, profile) in shapes {
        println!("{points} points, {shape}");
        let tip = compensate_profile(&profile, 5.0).expect("a radius");
        for (name, work) in &work {
            let mut best = f64::INFINITY;
            let mut count = 0;
            for _ in 0..RUNS {
                let start = processor_seconds();
                count = black_box(work(black_box(&profile), black_box(&tip)));
                best = best.min(processor_seconds() - start);
            }
            println!("  {name:<12} {best:7.2} s of the processor, {count} pieces");
        }
    }
}

/// Hollows wider than the ball: nearly every point counts.
fn hills(points: usize) -> Chain {
    let at = |index: usize| {
        let u = 1000.0 * index as f64 / points as f64;
        Point::new(u, 20.0 * (u * 0.02).sin())
    };
    Chain::from_points(&(0..points).map(at).collect::<Vec<_>>()).expect("a profile")
}

/// Waves of a millimetre to a metre: hollows both wider and tighter than the ball.
fn waves(points: usize) -> Chain {
    let at = |index: usize| {
        let u = 1000.0 * index as f64 / points as f64;
        Point::new(u, 20.0 * (u * 0.02).sin() + 2.0 * (u * 0.31).sin() + 0.2 * (u * 3.1).sin())
    };
    Chain::from_points(&(0..points).map(at).collect::<Vec<_>>()).expect("a profile")
}

/// Every fourth piece goes back, so that the profile overhangs everywhere.
fn saw(points: usize) -> Chain {
    let at = |index: usize| {
        let u = 1000.0 * (index as f64 - if index % 4 == 3 { 1.5 } else { 0.0 }) / points as f64;
        Point::new(u, 20.0 * (u * 0.02).sin() + 0.001 * (index % 4) as f64)
    };
    Chain::from_points(&(0..points).map(at).collect::<Vec<_>>()).expect("a profile")
}

/// Processor time of this process in seconds where the system tells it, else time by the clock.
fn processor_seconds() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/schedstat").unwrap_or_default();
    match stat.split_whitespace().next().and_then(|nanoseconds| nanoseconds.parse::<f64>().ok()) {
        Some(nanoseconds) => nanoseconds * 1e-9,
        None => std::time::SystemTime::now()
            .duration_since(std::time::UNIX_EPOCH)
            .map_or(0.0, |since| since.as_secs_f64()),
    }
}

//! How many poses a second get the values of all axes, and how many motions a second a time: `cargo bench --bench machine`.
//!
//! A million poses on a table-table machine with two turns of C between its limits, the tool swinging through the pole and
//! winding around it; then five million motions of a chain with corners. Single thread, by time of the processor, so that
//! what else runs does not count. Poles and flips are constructed, counted and compared.

// A benchmark that cannot make its machine has nothing to measure.
#![allow(clippy::expect_used)]

use clsmith::machine::{
    AxisKind, AxisMount, BranchChoice, FeedMotion, KinematicChain, MachineAxis, time_feed_motions,
};
use clsmith::nalgebra::{Point3, Unit, Vector3};
use std::hint::black_box;
use std::time::Instant;

/// Seconds of the processor that this process has used (Linux), else by the clock.
fn seconds(start: Instant) -> f64 {
    let used = || {
        let stat = std::fs::read_to_string("/proc/self/stat").ok()?;
        let mut fields = stat.rsplit(')').next()?.split_whitespace().skip(11);
        let ticks: f64 = fields.next()?.parse::<f64>().ok()? + fields.next()?.parse::<f64>().ok()?;
        Some(ticks / 100.0)
    };
    used().unwrap_or_else(|| start.elapsed().as_secs_f64())
}

fn machine() -> KinematicChain {
    let axis = |name: &str, mount, kind, direction: [f64; 3], point: [f64; 3], limits| MachineAxis {
        name: name.to_owned(),
        mount,
        kind,
        direction: Unit::new_normalize(Vector3::from(direction)),
        point: Point3::from(point),
        limits: Some(limits),
        max_speed: 10000.0,
        rapid: 20000.0,
        acceleration: 3000.0,
        jerk: None,
    };
    use AxisKind::{Linear, Rotary};
    use AxisMount::{Head, Table};
    let axes = vec![
        axis("C", Table, Rotary, [0.0, 0.0, 1.0], [11.0, -13.0, 0.0], [-360.0, 360.0]),
        axis("A", Table, Rotary, [1.0, 0.0, 0.0], [0.0, -2.0, -52.0], [-100.0, 100.0]),
        axis("X", Head, Linear, [1.0, 0.0, 0.0], [0.0; 3], [-700.0, 700.0]),
        axis("Y", Head, Linear, [0.0, 1.0, 0.0], [0.0; 3], [-700.0, 700.0]),
        axis("Z", Head, Linear, [0.0, 0.0, 1.0], [0.0; 3], [-700.0, 700.0]),
    ];
    KinematicChain::new(axes, Vector3::z_axis()).expect("a machine")
}

/// Sweeps of 100 or 101 poses through the pole: between two poses, or on one.
fn sweep(pose: usize, steps: usize) -> (Point3<f64>, Vector3<f64>) {
    let (sweep, step) = (pose / steps, pose % steps);
    let share = 2.0 * step as f64 / (steps - 1) as f64 - 1.0;
    let tilt = if sweep.is_multiple_of(2) { share } else { -share } * 0.5;
    (Point3::new(sweep as f64 * 0.001, 10.0 * tilt, 0.0), Vector3::new(0.0, tilt.sin(), tilt.cos()))
}

/// Windings about the pole.
fn winding(pose: usize) -> (Point3<f64>, Vector3<f64>) {
    let angle = pose as f64 * 0.01;
    let axis = Vector3::new(0.5 * angle.cos(), 0.5 * angle.sin(), 1.0).normalize();
    (Point3::new(40.0 * angle.cos(), 40.0 * angle.sin(), 5.0), axis)
}

fn main() {
    let chain = machine();
    for (name, count, pose) in [
        ("sweeps through the pole on a pose", 1_010_000, (|pose| sweep(pose, 101)) as fn(usize) -> _),
        ("sweeps through the pole between poses", 1_000_000, |pose| sweep(pose, 100)),
        ("windings", 250_000, winding),
        ("windings", 500_000, winding),
        ("windings", 1_000_000, winding),
    ] {
        let poses: Vec<(Point3<f64>, Vector3<f64>)> = (0..count).map(pose).collect();
        let start = Instant::now();
        let before = seconds(start);
        let chosen = BranchChoice::choose_values(&chain, poses.iter().copied());
        let taken = seconds(start) - before;
        let chosen: Vec<_> = chosen.into_iter().flatten().collect();
        assert_eq!(chosen.len(), count, "all poses are reached");
        let poles = chosen.iter().filter(|pose| pose.is_pole).count();
        let flips = chosen.windows(2).filter(|pair| matches!(pair, [a, b] if a.side * b.side < 0)).count();
        let step = |a: f64, b: f64| (a - b).abs() > 180.0;
        let rewinds = chosen
            .windows(2)
            .filter(|pair| matches!(pair, [a, b] if step(a.joints.rotaries[0], b.joints.rotaries[0])))
            .count();
        let start = Instant::now();
        let before = seconds(start);
        let mut worst = 0.0_f64;
        for (pose, (tip, axis)) in chosen.iter().zip(&poses) {
            let (back, turned) = chain.locate_tool(&pose.joints);
            worst = worst.max((back - tip).norm()).max((turned - axis).norm());
        }
        let checked = seconds(start) - before;
        assert!(worst < 1e-9, "{worst:e}");
        println!(
            "{name}: {count} poses in {taken:.2} s ({:.2} M/s), forward check {checked:.2} s (worst {worst:.1e}), \
             {poles} poles, {flips} flips, {rewinds} rewinds",
            count as f64 / taken / 1e6
        );
        match name {
            "sweeps through the pole on a pose" => assert_eq!((poles, flips), (10_000, 0)),
            "sweeps through the pole between poses" => assert_eq!((poles, flips), (0, 10_000)),
            _ => {}
        }
    }
    for count in [1_250_000, 2_500_000, 5_000_000] {
        let motions: Vec<FeedMotion> = (0..count)
            .map(|number| {
                let angle = f64::from(number) * 0.01;
                let tangent = Vector3::new(angle.cos(), angle.sin(), 0.0);
                FeedMotion {
                    length: 0.5,
                    speed: 30.0 + 10.0 * f64::from(number / 100 % 3),
                    tangents: [tangent; 2],
                    acceleration: Some(2500.0),
                    jerk: None,
                    is_from_rest: number % 1000 == 0,
                }
            })
            .collect();
        let start = Instant::now();
        let before = seconds(start);
        let mut sum = 0.0;
        black_box(time_feed_motions(&motions, 0.0087, |_, time| sum += time));
        let taken = seconds(start) - before;
        println!(
            "{count} motions timed in {taken:.2} s ({:.1} M/s), {sum:.0} s of machining",
            f64::from(count) / taken / 1e6
        );
    }
}

//! A long program with a known number of poles and flips.

use super::{axis, chain, linears};
use crate::support::within_seconds;
use clsmith::machine::{AxisKind, AxisMount, BranchChoice};
use nalgebra::{Point3, Vector3};

/// Poses along a tilt that swings through z: every sweep passes the pole once. With an odd number of steps for a sweep
/// the pole is a pose, else it lies between two.
fn sweeps(count: usize, steps: usize) -> impl Iterator<Item = (Point3<f64>, Vector3<f64>)> {
    (0..count).flat_map(move |sweep| {
        (0..steps).map(move |step| {
            let share = 2.0 * step as f64 / (steps - 1) as f64 - 1.0;
            let tilt = if sweep % 2 == 0 { share } else { -share } * 0.5;
            let axis = Vector3::new(0.0, tilt.sin(), tilt.cos());
            (Point3::new(sweep as f64 * 0.01, 10.0 * tilt, 0.0), axis)
        })
    })
}

#[test]
fn all_poles_and_flips_are_found() {
    let mut axes = vec![
        axis("C", AxisMount::Table, AxisKind::Rotary, [0.0, 0.0, 1.0], [0.0; 3]),
        axis("A", AxisMount::Table, AxisKind::Rotary, [1.0, 0.0, 0.0], [0.0, 0.0, -50.0]),
    ];
    axes[0].limits = Some([-360.0, 360.0]);
    axes[1].limits = Some([-100.0, 100.0]);
    let machine = chain(axes.into_iter().chain(linears()).collect());
    for (steps, poles, flips) in [(101, 1000, 0), (100, 0, 1000)] {
        let chosen = within_seconds(20.0, || BranchChoice::choose_values(&machine, sweeps(1000, steps)));
        assert_eq!(chosen.len(), 1000 * steps);
        let chosen: Vec<_> = chosen.into_iter().map(Option::unwrap).collect();
        assert_eq!(chosen.iter().filter(|pose| pose.is_pole).count(), poles);
        // The shortest way goes through z with A alone, and C stands still.
        assert!(chosen.iter().all(|pose| pose.joints.rotaries[0].abs() < 1e-9));
        let crossings = chosen.windows(2).filter(|pair| pair[0].side * pair[1].side < 0).count();
        assert_eq!(crossings, flips);
        let mut worst = 0.0_f64;
        for (pose, (tip, wanted)) in chosen.iter().zip(sweeps(1000, steps)) {
            let (back, turned) = machine.locate_tool(&pose.joints);
            worst = worst.max((back - tip).norm()).max((turned - wanted).norm());
        }
        assert!(worst < 1e-9, "{worst:e}");
    }
}

#[test]
fn an_axis_that_cannot_go_below_zero_turns_instead() {
    let mut axes = vec![
        axis("C", AxisMount::Table, AxisKind::Rotary, [0.0, 0.0, 1.0], [0.0; 3]),
        axis("A", AxisMount::Table, AxisKind::Rotary, [1.0, 0.0, 0.0], [0.0, 0.0, -50.0]),
    ];
    axes[0].limits = Some([-360.0, 360.0]);
    axes[1].limits = Some([0.0, 100.0]);
    let machine = chain(axes.into_iter().chain(linears()).collect());
    let chosen = BranchChoice::choose_values(&machine, sweeps(500, 100));
    let first: Vec<f64> = chosen.iter().map(|pose| pose.unwrap().joints.rotaries[0]).collect();
    // Half a turn of C on the spot at every passage of the pole.
    let turns = first.windows(2).filter(|pair| ((pair[1] - pair[0]).abs() - 180.0).abs() < 1e-6).count();
    assert_eq!(turns, 500);
}

#[test]
fn what_cannot_be_reached_is_told_and_passed_over() {
    let machine = chain(
        [axis("B", AxisMount::Head, AxisKind::Rotary, [0.0, 1.0, 0.0], [0.0; 3])]
            .into_iter()
            .chain(linears())
            .collect(),
    );
    let tilted = |x: f64, y: f64| (Point3::origin(), Vector3::new(x, y, 1.0).normalize());
    let poses = [tilted(0.0, 0.1), tilted(0.1, 0.0), tilted(0.2, 0.3), tilted(0.3, 0.0), tilted(0.0, -0.2)];
    let reached: Vec<bool> =
        BranchChoice::choose_values(&machine, poses).iter().map(Option::is_some).collect();
    assert_eq!(reached, [false, true, false, true, false]);
}

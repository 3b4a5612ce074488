//! Closed forms of common machines, and sags by hand.

use super::{axis, chain, linears};
use clsmith::machine::{AxisKind, AxisMount, BranchChoice, JointMotion, JointValues, KinematicChain};
use nalgebra::{Point3, Vector3};

fn two(first: (&str, AxisMount, [f64; 3]), second: (&str, AxisMount, [f64; 3])) -> KinematicChain {
    let rotary = |(name, mount, direction): (&str, AxisMount, [f64; 3])| {
        axis(name, mount, AxisKind::Rotary, direction, [0.0; 3])
    };
    chain([rotary(first), rotary(second)].into_iter().chain(linears()).collect())
}

/// The tool axis at both values.
fn tool(chain: &KinematicChain, first: f64, second: f64) -> Vector3<f64> {
    chain.locate_tool(&JointValues { rotaries: [first, second], linears: [0.0; 3] }).1
}

#[test]
fn tool_axes_of_common_machines() {
    let (x, y, z) = ([1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]);
    let table_table = two(("C", AxisMount::Table, z), ("A", AxisMount::Table, x));
    let table_head = two(("C", AxisMount::Table, z), ("B", AxisMount::Head, y));
    let head_head = two(("C", AxisMount::Head, z), ("A", AxisMount::Head, x));
    for (first, second) in [(30.0_f64, 20.0_f64), (-100.0, 75.0), (170.0, -40.0)] {
        let ((s1, c1), (s2, c2)) = (first.to_radians().sin_cos(), second.to_radians().sin_cos());
        let cases = [
            (&table_table, Vector3::new(s1 * s2, c1 * s2, c2)),
            (&table_head, Vector3::new(s2 * c1, -s2 * s1, c2)),
            (&head_head, Vector3::new(s1 * s2, -c1 * s2, c2)),
        ];
        for (chain, wanted) in cases {
            assert!((tool(chain, first, second) - wanted).norm() < 1e-15);
            let found = chain.solve_rotaries(&wanted);
            let is_here =
                |values: [f64; 2]| (values[0] - first).abs() < 1e-12 && (values[1] - second).abs() < 1e-12;
            let other = |values: [f64; 2]| (values[1] + second).abs() < 1e-12;
            assert!(found.iter().any(|solution| is_here(solution.values)), "{found:?}");
            assert!(found.iter().any(|solution| other(solution.values)), "{found:?}");
        }
    }
}

#[test]
fn a_nutating_head_lies_at_half_a_turn() {
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let z = [0.0, 0.0, 1.0];
    let chain = two(("C", AxisMount::Table, z), ("B", AxisMount::Head, [0.0, half, half]));
    assert!((tool(&chain, 0.0, 180.0) - Vector3::y()).norm() < 1e-15);
    // The tilt at B is cos t = (1 + cos B) / 2.
    for b in [10.0_f64, 75.0, 130.0] {
        let tilt = ((1.0 + b.to_radians().cos()) / 2.0).acos();
        assert!((tool(&chain, 33.0, b).angle(&Vector3::z()) - tilt).abs() < 1e-12);
    }
    // What points down is out of reach, what lies flat is just reached, whatever its last decimal.
    assert!(chain.solve_rotaries(&Vector3::new(0.1, 0.0, -0.5).normalize()).is_empty());
    assert_eq!(chain.solve_rotaries(&Vector3::new(1.0, 0.0, -1e-7).normalize()).len(), 2);
}

#[test]
fn a_radial_tool_of_a_lathe_turns_with_the_spindle() {
    let mut axes = linears().to_vec();
    axes.insert(0, axis("C", AxisMount::Table, AxisKind::Rotary, [0.0, 0.0, 1.0], [0.0; 3]));
    let lathe = KinematicChain::new(axes, Vector3::x_axis()).unwrap();
    let (sine, cosine) = 40f64.to_radians().sin_cos();
    let found = lathe.solve_rotaries(&Vector3::new(cosine, sine, 0.0));
    assert_eq!(found.len(), 1);
    // The spindle turns the workpiece back to where the tool stands.
    assert!((found[0].values[0] + 40.0).abs() < 1e-12);
    let tip = Point3::new(30.0 * cosine - 5.0 * sine, 30.0 * sine + 5.0 * cosine, -12.0);
    let linears = lathe.solve_linears(found[0].values, &tip).unwrap();
    assert!((Vector3::from(linears) - Vector3::new(30.0, 5.0, -12.0)).norm() < 1e-12);
    assert!(lathe.solve_rotaries(&Vector3::new(cosine, sine, 0.3).normalize()).is_empty());
}

#[test]
fn the_sag_of_a_small_turn_is_r_a2_by_8() {
    let chain = two(("C", AxisMount::Table, [0.0, 0.0, 1.0]), ("B", AxisMount::Table, [0.0, 1.0, 0.0]));
    for (radius, turn) in [(40.0_f64, 2.0_f64), (120.0, 5.0), (7.5, 0.5)] {
        let at = |c: f64| {
            let angle = c.to_radians();
            // The tip stands still in the machine while C turns, so it makes an arc about C in the workpiece.
            let tip = Point3::new(radius * angle.cos(), -radius * angle.sin(), 0.0);
            let linears = chain.solve_linears([c, 30.0], &tip).unwrap();
            (JointValues { rotaries: [c, 30.0], linears }, tip)
        };
        let ((from, start), (to, end)) = (at(0.0), at(turn));
        let motion = JointMotion { chain: &chain, from, to, tips: [start, end] };
        let exact = radius * (1.0 - (turn.to_radians() / 2.0).cos());
        let small = radius * turn.to_radians().powi(2) / 8.0;
        assert!((motion.tip_sag_mm() - exact).abs() < 1e-9 * exact.max(1.0), "{}", motion.tip_sag_mm());
        assert!((motion.tip_sag_mm() / small - 1.0).abs() < 1e-3);
    }
}

/// A program that winds about z at 30 degrees, `turns` times.
fn winding(turns: usize) -> Vec<(Point3<f64>, Vector3<f64>)> {
    let tilt = 30f64.to_radians();
    (0..=turns * 36)
        .map(|step| {
            let angle = (step as f64 * 10.0 + 5.0).to_radians();
            let axis = Vector3::new(tilt.sin() * angle.cos(), tilt.sin() * angle.sin(), tilt.cos());
            (Point3::new(20.0 * angle.cos(), 20.0 * angle.sin(), 0.0), axis)
        })
        .collect()
}

#[test]
fn turns_are_used_up_before_the_axis_goes_back() {
    let limited = |limits: Option<[f64; 2]>| {
        let mut axes = vec![
            axis("C", AxisMount::Table, AxisKind::Rotary, [0.0, 0.0, 1.0], [0.0; 3]),
            axis("A", AxisMount::Table, AxisKind::Rotary, [1.0, 0.0, 0.0], [0.0; 3]),
        ];
        axes[0].limits = limits;
        axes[1].limits = Some([-120.0, 0.0]);
        chain(axes.into_iter().chain(linears()).collect())
    };
    let count_rewinds = |limits: Option<[f64; 2]>, turns: usize| {
        let machine = limited(limits);
        let values = BranchChoice::choose_values(&machine, winding(turns));
        let first: Vec<f64> = values.iter().map(|value| value.unwrap().joints.rotaries[0]).collect();
        if let Some([low, high]) = limits {
            // Limits have a slack of 1e-9.
            assert!(first.iter().all(|value| *value > low - 2e-9 && *value < high + 2e-9));
        }
        first.windows(2).filter(|pair| (pair[1] - pair[0]).abs() > 180.0).count()
    };
    // Ten turns on an axis without end need no rewind. With two turns between its limits, the shortest way goes back by one
    // turn less a step whenever the limit is near: by two turns it would be a step longer.
    assert_eq!(count_rewinds(None, 10), 0);
    assert_eq!(count_rewinds(Some([-3600.0, 3600.0]), 10), 0);
    let rewinds = count_rewinds(Some([-360.0, 360.0]), 10);
    assert!((8..=9).contains(&rewinds), "{rewinds}");
}

#[test]
fn the_best_way_is_no_longer_than_any_other() {
    // All ways through a short program, by brute force.
    let mut axes = vec![
        axis("C", AxisMount::Table, AxisKind::Rotary, [0.2, 0.1, 1.0], [0.0; 3]),
        axis("B", AxisMount::Head, AxisKind::Rotary, [0.1, 1.0, -0.3], [0.0, 0.0, 150.0]),
    ];
    axes[0].limits = Some([-200.0, 400.0]);
    axes[1].limits = Some([-100.0, 100.0]);
    let machine = chain(axes.into_iter().chain(linears()).collect());
    let poses: Vec<_> = winding(2).into_iter().step_by(11).collect();
    let options: Vec<Vec<[f64; 2]>> = poses
        .iter()
        .map(|(_, wanted)| {
            let mut all = Vec::new();
            for solution in machine.solve_rotaries(wanted).iter() {
                for (first, second) in
                    (-3..=3).flat_map(|a| (-3..=3).map(move |b| (f64::from(a), f64::from(b))))
                {
                    let values = [solution.values[0] + 360.0 * first, solution.values[1] + 360.0 * second];
                    let allows =
                        |(axis, value): (&clsmith::machine::MachineAxis, f64)| axis.allows_value(value);
                    if machine.rotary_axes().zip(values).all(allows) {
                        all.push(values);
                    }
                }
            }
            all
        })
        .collect();
    let step = |from: &[f64; 2], to: &[f64; 2]| (to[0] - from[0]).abs() + (to[1] - from[1]).abs();
    let mut ways: Vec<(f64, [f64; 2])> = vec![(0.0, [0.0; 2])];
    for options in &options {
        assert!(options.len() >= 2, "a choice");
        ways = ways
            .iter()
            .flat_map(|(way, at)| options.iter().map(move |to| (way + step(at, to), *to)))
            .collect();
    }
    let shortest = ways.iter().map(|(way, _)| *way).fold(f64::INFINITY, f64::min);
    let (mut way, mut at) = (0.0, [0.0; 2]);
    for chosen in BranchChoice::choose_values(&machine, poses) {
        let to = chosen.unwrap().joints.rotaries;
        way += step(&at, &to);
        at = to;
    }
    assert!((way - shortest).abs() < 1e-9, "{way} and not {shortest}");
}

//! Random machines: what the inverse finds, the forward chain confirms.

use super::{axis, chain, linears};
use crate::support::property;
use clsmith::machine::{AxisKind, AxisMount, JointValues, KinematicChain, MachineAxis};
use nalgebra::Vector3;
use proptest::prelude::*;

fn direction() -> impl Strategy<Value = [f64; 3]> {
    [-1.0..1.0_f64, -1.0..1.0, -1.0..1.0].prop_filter("too short", |v| Vector3::from(*v).norm() > 0.1)
}

fn rotary(name: &'static str) -> impl Strategy<Value = MachineAxis> {
    (direction(), [-300.0..300.0, -300.0..300.0, -300.0..300.0], any::<bool>()).prop_map(
        move |(direction, point, table)| {
            let mount = if table { AxisMount::Table } else { AxisMount::Head };
            axis(name, mount, AxisKind::Rotary, direction, point)
        },
    )
}

/// Machines with two rotary axes in general position, linear axes at any place of the chain.
fn machine() -> impl Strategy<Value = KinematicChain> {
    (rotary("P"), rotary("Q"), [0..4_usize, 0..4, 0..4], [any::<bool>(), any::<bool>(), any::<bool>()])
        .prop_filter_map("the axes are nearly parallel", |(first, second, places, tables)| {
            let mut axes = vec![first, second];
            for ((mut linear, place), table) in linears().into_iter().zip(places).zip(tables) {
                linear.mount = if table { AxisMount::Table } else { AxisMount::Head };
                axes.insert(place.min(axes.len()), linear);
            }
            // The table's axes come first.
            axes.sort_by_key(|axis| axis.mount == AxisMount::Head);
            let chain = KinematicChain::new(axes, Vector3::z_axis()).ok()?;
            let rotaries: Vec<_> = chain.rotary_axes().map(|axis| axis.direction).collect();
            let apart = rotaries[0].cross(&rotaries[1]).norm().min(rotaries[1].cross(&Vector3::z()).norm());
            (apart > 0.02).then_some(chain)
        })
}

fn joints() -> impl Strategy<Value = JointValues> {
    let angle = || prop_oneof![-180.0..180.0_f64, -1e-3..1e-3];
    let travel = || -500.0..500.0_f64;
    ([angle(), angle()], [travel(), travel(), travel()])
        .prop_map(|(rotaries, linears)| JointValues { rotaries, linears })
}

proptest! {
    #![proptest_config(property(2000))]

    #[test]
    fn the_inverse_of_any_pose_leads_back(chain in machine(), joints in joints()) {
        let (tip, axis) = chain.locate_tool(&joints);
        let solutions = chain.solve_rotaries(&axis);
        prop_assert!(!solutions.is_empty(), "{axis} is reached by {joints:?}");
        for solution in solutions.iter() {
            // Where the linear axes lie in one plane no values are found, and none are right.
            let Some(linears) = chain.solve_linears(solution.values, &tip) else { continue };
            let size = linears.iter().fold(1000.0_f64, |size, value| size.max(value.abs()));
            let found = JointValues { rotaries: solution.values, linears };
            let (back, turned) = chain.locate_tool(&found);
            let own_error = if solution.is_pole { 2e-8 } else { 1e-9 };
            prop_assert!((turned - axis).norm() < own_error, "{:e}", (turned - axis).norm());
            prop_assert!((back - tip).norm() < 1e-9 * size, "{:e} of {size}", (back - tip).norm());
        }
        // One of them is where it came from, but at the pole and where both branches meet.
        let near = |value: f64, wanted: f64| {
            let turns = (value - wanted) / 360.0;
            (turns - turns.round()).abs() * 360.0
        };
        let nearest = solutions.iter().map(|solution| {
            near(solution.values[0], joints.rotaries[0]).max(near(solution.values[1], joints.rotaries[1]))
        }).fold(f64::INFINITY, f64::min);
        let is_pole = solutions.iter().any(|solution| solution.is_pole);
        prop_assert!(is_pole || nearest < 1e-3, "{nearest} away");
    }

    #[test]
    fn directions_beyond_the_cone_have_no_solution(chain in machine(), wanted in direction()) {
        let wanted = Vector3::from(wanted).normalize();
        let rotaries: Vec<_> = chain.rotary_axes().map(|axis| axis.direction.into_inner()).collect();
        // The tool turns about the second axis in a cone, and that about the first: the angles to it are an interval.
        let between = rotaries[0].angle(&rotaries[1]);
        let own = rotaries[1].angle(&Vector3::z());
        let [least, most] = [(between - own).abs(), (between + own).min(2.0 * std::f64::consts::PI - between - own)];
        let angle = rotaries[0].angle(&wanted);
        prop_assume!((angle - least).abs() > 1e-5 && (angle - most).abs() > 1e-5);
        prop_assert_eq!(!chain.solve_rotaries(&wanted).is_empty(), angle > least && angle < most);
    }
}

#[test]
fn the_pole_keeps_its_digits() {
    // Directions that come within a hundred-thousandth of a degree of the pole, where cosines have lost theirs.
    let axes = [
        axis("C", AxisMount::Table, AxisKind::Rotary, [0.0, 0.0, 1.0], [3.0, -4.0, 0.0]),
        axis("A", AxisMount::Table, AxisKind::Rotary, [1.0, 0.0, 0.0], [0.0, 20.0, -50.0]),
    ];
    let chain = chain(axes.into_iter().chain(linears()).collect());
    for exponent in 0..50 {
        let tilt = 10f64.powf(-0.15 * f64::from(exponent));
        for turn in [0.0_f64, 1.0, 2.5, 4.0] {
            let wanted = Vector3::new(tilt.sin() * turn.cos(), tilt.sin() * turn.sin(), tilt.cos());
            let solutions = chain.solve_rotaries(&wanted);
            assert_eq!(solutions.len(), 2, "{tilt:e}");
            for solution in solutions.iter() {
                let joints = JointValues { rotaries: solution.values, linears: [0.0; 3] };
                let (_, back) = chain.locate_tool(&joints);
                assert!((back - wanted).norm() < 1e-15 * 20.0, "{:e} at {tilt:e}", (back - wanted).norm());
                assert!((solution.values[1].abs().to_radians() - tilt).abs() < 1e-14 + 1e-12 * tilt);
            }
        }
    }
}

//! The cases of `../shared/cases/machine`: joint values, poles, sags and limits of feed from an independent
//! computation, which finds rotary values by a numeric search.

use super::chain_of;
use super::neutral::{read_json, to_setup};
use crate::support::require_shared_folder;
use clsmith::machine::{AxisInterpolation, JointMotion, KinematicChain, ProgramPose, solve_program_poses};
use clsmith::program::LengthUnit;
use nalgebra::{Point3, Vector3};
use serde_json::Value;
use std::path::Path;

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap_or_else(|| panic!("{value} is no number"))
}

fn vector(value: &Value) -> Vector3<f64> {
    Vector3::new(number(&value[0]), number(&value[1]), number(&value[2]))
}

#[track_caller]
fn assert_close(found: f64, wanted: f64, tolerance: f64, what: &str) {
    assert!((found - wanted).abs() <= tolerance, "{what}: {found} instead of {wanted}");
}

#[test]
fn agree_with_an_independent_computation() {
    let Some(folder) = require_shared_folder("cases/machine") else { return };
    let mut cases = 0;
    for entry in std::fs::read_dir(&folder).unwrap().flatten() {
        let name = entry.file_name().to_string_lossy().into_owned();
        let Some(name) = name.strip_suffix(".expected.json").filter(|name| *name != "time") else { continue };
        let expected = read_json(&entry.path());
        let file = expected["machine_file"].as_str().map(str::to_owned);
        let machine = read_json(&folder.join(file.unwrap_or_else(|| format!("{name}.machine.json"))));
        let chain = chain_of(&to_setup(&machine, ""));
        let poses = solve_case(&folder, name, &chain);
        compare_poses(name, &expected, &chain, &poses);
        compare_moves(name, &expected, &chain, &poses);
        compare_directions(name, &expected, &chain);
        cases += 1;
    }
    assert!(cases >= 11, "{cases} cases were found");
}

fn solve_case(folder: &Path, name: &str, chain: &KinematicChain) -> Vec<(u64, ProgramPose)> {
    let program = crate::support::program(std::fs::read(folder.join(format!("{name}.cls"))).unwrap());
    let poses = solve_program_poses(&program, chain, LengthUnit::Mm);
    let line = |pose: &ProgramPose| {
        let span = program.statement(pose.statement).origin();
        u64::from(program.source().line_column(span.start).0 as u32)
    };
    poses.into_iter().map(|pose| (line(&pose), pose)).collect()
}

fn compare_poses(name: &str, expected: &Value, chain: &KinematicChain, poses: &[(u64, ProgramPose)]) {
    let wanted = expected["poses"].as_array().unwrap();
    assert_eq!(wanted.len(), poses.len(), "{name}");
    let (mut way, mut before) = (0.0, [0.0; 2]);
    for (wanted, (line, pose)) in wanted.iter().zip(poses) {
        let what = format!("{name}, line {line}");
        assert_eq!(wanted["line"].as_u64(), Some(*line), "{what}");
        let chosen = pose.chosen.unwrap_or_else(|| panic!("{what} cannot be reached"));
        let values = chain.order_values(&chosen.joints.linears, &chosen.joints.rotaries);
        for (axis, value) in chain.axes().iter().zip(&values) {
            assert_close(
                *value,
                number(&wanted["joints"][&axis.name]),
                1e-6,
                &format!("{what}, {}", axis.name),
            );
        }
        let (tip, axis) = chain.locate_tool(&chosen.joints);
        assert_close((tip - pose.tip).norm(), 0.0, 1e-9, &format!("{what}, tip"));
        assert_close((axis - pose.axis).norm(), 0.0, 1e-9, &format!("{what}, axis"));
        let outside = chain.find_axes_outside(&chosen.joints);
        let outside: Vec<&str> = outside.iter().map(|place| chain.axes()[*place].name.as_str()).collect();
        let wanted_outside: Vec<&str> =
            wanted["outside"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
        assert_eq!(outside, wanted_outside, "{what}");
        assert_eq!(chosen.is_pole, wanted["pole"].as_bool().unwrap_or(false), "{what}");
        if let Some(angle) = wanted["pole_deg"].as_f64() {
            assert_close(chain.pole_angle_deg(&pose.axis).unwrap(), angle, 1e-7, &what);
        }
        if chain.rotary_axes().count() == 2 && !chosen.is_pole {
            compare_alternative(&what, wanted, chain, pose);
        }
        for (value, last) in chosen.joints.rotaries.iter().zip(before) {
            way += (value - last).abs();
        }
        before = chosen.joints.rotaries;
    }
    assert_close(way, number(&expected["rotary_way_deg"]), 1e-5, name);
}

/// The other branch, limits not looked at.
fn compare_alternative(what: &str, wanted: &Value, chain: &KinematicChain, pose: &ProgramPose) {
    let chosen = pose.chosen.unwrap();
    let solutions = chain.solve_rotaries(&pose.axis);
    let other = solutions.iter().find(|solution| solution.side != chosen.side).unwrap();
    let linears = chain.solve_linears(other.values, &pose.tip).unwrap();
    let values = chain.order_values(&linears, &other.values);
    for (axis, value) in chain.axes().iter().zip(values) {
        let wanted = number(&wanted["alternative"][&axis.name]);
        let turns = if axis.value_unit() == "deg" { 360.0 * ((value - wanted) / 360.0).round() } else { 0.0 };
        assert_close(value - turns, wanted, 1e-6, &format!("{what}, other {}", axis.name));
    }
}

fn compare_moves(name: &str, expected: &Value, chain: &KinematicChain, poses: &[(u64, ProgramPose)]) {
    let pose_at = |line: &Value| poses.iter().find(|(at, _)| Some(*at) == line.as_u64()).unwrap().1;
    for wanted in expected["moves"].as_array().unwrap() {
        let (from, to) = (pose_at(&wanted["from_line"]), pose_at(&wanted["line"]));
        let what = format!("{name}, to line {}", wanted["line"]);
        let motion = to.motion_from(&from, chain).unwrap();
        assert_close(motion.tip_length_mm(), number(&wanted["length_mm"]), 1e-6, &what);
        let sag = number(&wanted["sag_mm"]);
        assert_close(motion.tip_sag_mm(), sag, (0.01 * sag).max(1e-6), &what);
        if wanted["mid_tip_no_tcp"].is_array() {
            let middle = Point3::from(vector(&wanted["mid_tip_no_tcp"]));
            assert_close((motion.joint_linear_tip(0.5) - middle).norm(), 0.0, 1e-6, &what);
        }
        let rewinds = motion.rotary_steps().iter().any(|step| step.abs() > 180.0);
        assert_eq!(Some(rewinds), wanted["rewind"].as_bool(), "{what}");
        let flips = chain.has_pole() && from.chosen.unwrap().side * to.chosen.unwrap().side < 0;
        assert_eq!(Some(flips), wanted["flip"].as_bool(), "{what}");
        if let Some(rapid) = wanted["rapid_s"].as_f64() {
            assert_close(motion.rapid_s(), rapid, 1e-3 * rapid, &what);
        }
        compare_demand(&what, wanted, &motion);
    }
}

fn compare_demand(what: &str, wanted: &Value, motion: &JointMotion<'_>) {
    let ways = [("tcp", AxisInterpolation::TipControlled), ("joint_linear", AxisInterpolation::JointLinear)];
    for (key, interpolation) in ways {
        let Some(least) = wanted[key]["least_s"].as_f64() else { continue };
        let demand = motion.axis_demand(interpolation);
        assert_close(demand.least_s, least, 1e-3 * least, &format!("{what}, {key}"));
        let axis = demand.axis.map(|place| motion.chain.axes()[place].name.as_str());
        assert_eq!(axis, wanted[key]["axis"].as_str(), "{what}, {key}");
    }
}

fn compare_directions(name: &str, expected: &Value, chain: &KinematicChain) {
    for wanted in expected["directions"].as_array().into_iter().flatten() {
        let what = format!("{name}, axis {}", wanted["axis"]);
        let solutions = chain.solve_rotaries(&vector(&wanted["axis"]).normalize());
        let all = wanted["solutions"].as_array().unwrap();
        assert_eq!(solutions.len(), all.len(), "{what}");
        for one in all {
            let fits = |solution: &&clsmith::machine::RotarySolution| {
                chain.rotary_axes().zip(solution.values).all(|(axis, value)| {
                    // A value that the case leaves out is free.
                    one[&axis.name].as_f64().is_none_or(|wanted| {
                        let turns = (value - wanted) / 360.0;
                        (turns - turns.round()).abs() * 360.0 < 1e-6
                    })
                })
            };
            assert!(solutions.iter().any(|solution| fits(&solution)), "{what}: {solutions:?}");
        }
    }
}

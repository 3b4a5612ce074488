//! `linearize`, and `clamp_feed` by the axes of a machine.

use super::try_apply;
use crate::support::program;
use clsmith::diagnostic::codes;
use clsmith::machine::{JointMotion, solve_program_poses};
use clsmith::program::LengthUnit;
use clsmith::setup::Setup;
use clsmith::source::Source;

const MACHINE: &str = "  machine:
    table:
      - { name: C, kind: rotary, direction: [0, 0, 1], point: [0, 0, 0], max_speed: 1800, rapid: 9000, acceleration: 800 }
      - { name: B, kind: rotary, direction: [0, 1, 0], point: [0, 0, 77.5], max_speed: 3600, rapid: 9000, acceleration: 400 }
    head:
      - { name: X, kind: linear, direction: [1, 0, 0], max_speed: 20000, rapid: 26000, acceleration: 4000 }
      - { name: Y, kind: linear, direction: [0, 1, 0], max_speed: 20000, rapid: 26000, acceleration: 4000 }
      - { name: Z, kind: linear, direction: [0, 0, 1], max_speed: 17000, rapid: 20000, acceleration: 3500 }
";

fn recipe(step: &str) -> String {
    format!("version: 1\nsetup:\n{MACHINE}steps:\n  - {step}\n")
}

/// A point at a tilt and a turn, in degrees.
fn goto(tip: [f64; 3], tilt: f64, turn: f64) -> String {
    let ((st, ct), (sr, cr)) = (tilt.to_radians().sin_cos(), turn.to_radians().sin_cos());
    format!("GOTO/{:.4},{:.4},{:.4},{:.7},{:.7},{:.7}\n", tip[0], tip[1], tip[2], st * cr, st * sr, ct)
}

fn part() -> String {
    let points = [
        goto([40.0, 0.0, 10.0], 30.0, 0.0),
        goto([35.0, 15.0, 10.0], 35.0, 20.0),
        goto([25.0, 30.0, 8.0], 45.0, 45.0),
        goto([25.0, 31.0, 8.0], 45.0, 45.0),
    ];
    format!(
        "TOOL PATH/A,TOOL,T1\nTLDATA/MILL,10.0000,0.0000,60.0000,0.0000,0.0000\nRAPID\n{}FEDRAT/MMPM,900.0000\n{}END-OF-PATH\n",
        points[0],
        points[1..].concat()
    )
}

/// The largest distance of the tip from its line on the motions at feed.
fn largest_sag(text: &str) -> f64 {
    let setup =
        format!("machine:\n{}", MACHINE.lines().skip(1).map(|line| format!("{line}\n")).collect::<String>());
    let setup = Setup::load(&Source::new("m.yaml", setup.into_bytes()).unwrap()).unwrap();
    let chain = setup.machine.chain.unwrap();
    let poses = solve_program_poses(&program(text), &chain, LengthUnit::Mm);
    let motions = poses.windows(2).filter_map(|pair| pair[1].motion_from(&pair[0], &chain));
    motions.map(|motion: JointMotion<'_>| motion.tip_sag_mm()).fold(0.0, f64::max)
}

#[test]
fn points_are_put_in_until_the_tip_stays_near_its_line() {
    let before = part();
    assert!(largest_sag(&before) > 0.5);
    let step = recipe("linearize: { tolerance: 0.01 }");
    let (after, findings) = try_apply(&step, &before).unwrap();
    assert!(findings.is_empty(), "{findings:?}");
    assert!(largest_sag(&after) <= 0.01, "{}", largest_sag(&after));
    // All old records are there, byte for byte and in their order; what is new are points.
    let mut old = before.lines().peekable();
    let mut added = 0;
    for line in after.lines() {
        if old.next_if(|kept| *kept == line).is_none() {
            assert!(line.starts_with("GOTO/"), "{line}");
            added += 1;
        }
    }
    assert!(old.next().is_none() && added > 8, "{added}");
    // New points lie on the old lines, with the feed that was in force.
    let (old, new) = (program(&before), program(&after));
    let length = |program: &clsmith::Program| program.motions().map(|motion| motion.length()).sum::<f64>();
    assert!((length(&old) - length(&new)).abs() < 1e-3);
    assert!(new.motions().all(|motion| motion.feed.is_none_or(|feed| feed.value == 900.0)));
    // A second run finds nothing, and a coarser tolerance puts in fewer.
    assert_eq!(try_apply(&step, &after).unwrap().0, after);
    let coarse = try_apply(&recipe("linearize: { tolerance: 0.1 }"), &before).unwrap().0;
    assert!(coarse.lines().count() < after.lines().count() && largest_sag(&coarse) <= 0.1);
}

#[test]
fn what_cannot_be_mended_by_points_is_left_and_told() {
    // A feed that is the time of the whole motion.
    let timed = part().replace("FEDRAT/MMPM,900.0000", "FEDRAT/INVERS,12.0000");
    let (after, findings) = try_apply(&recipe("linearize: { tolerance: 0.01 }"), &timed).unwrap();
    assert_eq!(after, timed);
    assert_eq!(findings.len(), 2, "{findings:?}");
    assert!(findings[0].message.contains("time of the whole motion"), "{}", findings[0].message);
    // A machine whose axes nobody knows.
    let found = try_apply("version: 1\nsteps:\n  - linearize: { tolerance: 0.01 }\n", part()).unwrap_err();
    assert_eq!(found[0].code, codes::MACHINE_WITHOUT_AXES);
}

#[test]
fn feeds_are_clamped_to_what_axes_follow() {
    // C turns by 10 degrees on a millimetre, far from the pole: 1800 deg/min allow 180 mm/min.
    let text = format!(
        "TOOL PATH/A,TOOL,T1\nRAPID\n{}FEDRAT/MMPM,500.0000\n{}{}END-OF-PATH\n",
        goto([0.0; 3], 40.0, 0.0),
        goto([1.0, 0.0, 0.0], 40.0, 10.0),
        goto([30.0, 0.0, 0.0], 40.0, 11.0)
    );
    let (after, findings) = try_apply(&recipe("clamp_feed: { axes: true }"), &text).unwrap();
    assert!(findings.is_empty(), "{findings:?}");
    let feeds: Vec<f64> = program(&after)
        .motions()
        .filter(|motion| !motion.rapid)
        .map(|motion| motion.feed.unwrap().value)
        .collect();
    assert!(feeds[0] <= 180.0 && feeds[0] > 179.9, "{feeds:?}");
    assert_eq!(feeds[1], 500.0);
    assert_eq!(try_apply(&recipe("clamp_feed: { axes: true }"), &after).unwrap().0, after);
    // A lowest feed counts before the axes, and so does a highest one.
    let (after, _) = try_apply(&recipe("clamp_feed: { axes: true, min: 250, max: 400 }"), &text).unwrap();
    assert!(after.contains("FEDRAT/MMPM,250") && after.contains("FEDRAT/MMPM,400"), "{after}");
    let found = try_apply("version: 1\nsteps:\n  - clamp_feed: { axes: true }\n", &text).unwrap_err();
    assert_eq!(found[0].code, codes::MACHINE_WITHOUT_AXES);
}

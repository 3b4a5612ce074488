//! `unwind`: rewinds in the air.

use super::move_origin::{diff, shown};
use super::try_apply;
use crate::support::{program, snapshots};
use clsmith::diagnostic::codes;
use clsmith::machine::{
    AxisInterpolation, FaultSearch, KinematicChain, MotionFaultKind, solve_program_poses,
};
use clsmith::program::LengthUnit;
use clsmith::setup::Setup;
use clsmith::source::Source;
use std::sync::Arc;

const MACHINE: &str = "  machine:
    max_feed: 5000
    table:
      - { name: C, kind: rotary, direction: [0, 0, 1], point: [0, 0, 0], limits: [-270, 270], max_speed: 1800, rapid: 9000, acceleration: 800 }
      - { name: B, kind: rotary, direction: [0, 1, 0], point: [0, 0, 77.5], max_speed: 3600, rapid: 9000, acceleration: 400 }
    head:
      - { name: X, kind: linear, direction: [1, 0, 0], max_speed: 20000, rapid: 26000, acceleration: 4000 }
      - { name: Y, kind: linear, direction: [0, 1, 0], max_speed: 20000, rapid: 26000, acceleration: 4000 }
      - { name: Z, kind: linear, direction: [0, 0, 1], max_speed: 17000, rapid: 20000, acceleration: 3500 }
";

/// The head turns about z instead of the table, with the tool tilted by the head, too.
const HEAD: &str = "  machine:
    max_feed: 5000
    head:
      - { name: X, kind: linear, direction: [1, 0, 0], max_speed: 20000, rapid: 26000, acceleration: 4000 }
      - { name: Y, kind: linear, direction: [0, 1, 0], max_speed: 20000, rapid: 26000, acceleration: 4000 }
      - { name: Z, kind: linear, direction: [0, 0, 1], max_speed: 17000, rapid: 20000, acceleration: 3500 }
      - { name: C, kind: rotary, direction: [0, 0, 1], point: [0, 0, 220], limits: [-270, 270], max_speed: 1800, rapid: 9000, acceleration: 800 }
      - { name: B, kind: rotary, direction: [0, 1, 0], point: [0, 0, 220], max_speed: 3600, rapid: 9000, acceleration: 400 }
";

const STOCK: &str = "  stock: { cylinder: { diameter: 60, from: [0, 0, -30], to: [0, 0, 0] } }
  tools: [ { match: {}, diameter: 10, corner_radius: 5, flute_length: 40, teeth: 4 } ]
";

fn recipe(machine: &str, step: &str) -> String {
    format!("version: 1\nsetup:\n{STOCK}{machine}steps:\n  - {step}\n")
}

/// A ball that winds around on top of the cylinder, tilted outwards.
fn winding(turns: f64) -> String {
    let goto = |angle: f64, height: f64| {
        let ((sine, cosine), (st, ct)) = (angle.to_radians().sin_cos(), 20f64.to_radians().sin_cos());
        format!(
            "GOTO/{:.5},{:.5},{:.5},{:.7},{:.7},{:.7}\n",
            20.0 * cosine,
            20.0 * sine,
            height,
            st * cosine,
            st * sine,
            ct
        )
    };
    let mut text = format!(
        "TOOL PATH/A,TOOL,T1\nTLDATA/MILL,10.0000,5.0000,80.0000,0.0000,0.0000\nMSYS/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000\nSPINDL/RPM,6000,CLW\nRAPID\n{}FEDRAT/MMPM,800.0000\n",
        goto(0.0, 30.0)
    );
    for step in 0..=(turns * 36.0) as usize {
        let angle = 10.0 * step as f64;
        text += &goto(angle, -0.5 - 0.2 * angle / 360.0);
    }
    text + "RAPID\n" + &goto(turns * 360.0, 40.0) + "END-OF-PATH\n"
}

fn chain_of(machine: &str) -> Arc<KinematicChain> {
    let text: String =
        machine.lines().map(|line| format!("{}\n", line.strip_prefix("  ").unwrap())).collect();
    let setup = Setup::load(&Source::new("m.yaml", text.into_bytes()).unwrap()).unwrap();
    setup.machine.chain.unwrap()
}

/// The rewinds in cuts and at rapid.
fn rewinds(text: &str, chain: &KinematicChain) -> [usize; 2] {
    let search = FaultSearch { chain, interpolation: AxisInterpolation::TipControlled, tip_tolerance: 0.01 };
    let faults = search.find_faults(&program(text), LengthUnit::Mm);
    [true, false].map(|at_feed| {
        let is_one = |kind: &MotionFaultKind| matches!(kind, MotionFaultKind::Rewind { is_at_feed, .. } if *is_at_feed == at_feed);
        faults.iter().filter(|fault| is_one(&fault.kind)).count()
    })
}

#[test]
fn rewinds_leave_the_cut() {
    for (machine, tilt_sign) in [(MACHINE, -1.0), (HEAD, 1.0)] {
        let chain = chain_of(machine);
        // 1440 degrees in a range of 540: at least two rewinds.
        let before = winding(4.0);
        let [in_cut, _] = rewinds(&before, &chain);
        assert!(in_cut >= 2, "{in_cut}");
        let step = recipe(machine, "unwind: { retract: 60 }");
        let (after, findings) = try_apply(&step, &before).unwrap();
        let unexpected: Vec<_> = findings.iter().filter(|one| one.code == codes::NOT_CHANGED).collect();
        assert!(unexpected.is_empty(), "{unexpected:?}");
        assert_eq!(rewinds(&after, &chain), [0, 0], "{tilt_sign}");
        // All old lines are there in their order, and nothing else than ways of RAPID and GOTO is new.
        let mut old = before.lines().peekable();
        let mut added = 0;
        for line in after.lines() {
            if old.next_if(|kept| *kept == line).is_none() {
                assert!(line == "RAPID" || line.starts_with("GOTO/"), "{line}");
                added += 1;
            }
        }
        assert!(old.next().is_none());
        // Up and 24 points at rapid, and one back.
        assert_eq!(added, in_cut * (2 * 25 + 1));
        // Inside the limits everywhere, and by the whole turn in small steps.
        let poses = solve_program_poses(&program(&after), &chain, LengthUnit::Mm);
        let first: Vec<f64> = poses.iter().map(|pose| pose.chosen.unwrap().joints.rotaries[0]).collect();
        assert!(first.iter().all(|value| value.abs() <= 270.0 + 1e-6));
        assert!(first.windows(2).all(|pair| (pair[1] - pair[0]).abs() < 100.0));
        // The cut is what it was: the same motions at feed, but for the ways back to it.
        let feeds = |text: &str| {
            let feeds: Vec<f64> = program(text)
                .motions()
                .filter(|motion| !motion.rapid)
                .map(|motion| motion.length())
                .collect();
            feeds
        };
        let (old, new) = (feeds(&before), feeds(&after));
        assert_eq!(new.len(), old.len() + in_cut);
        assert!((new.iter().sum::<f64>() - old.iter().sum::<f64>() - 60.0 * in_cut as f64).abs() < 0.01);
        // A second run finds nothing to do.
        assert_eq!(try_apply(&step, &after).unwrap().0, after);
    }
}

#[test]
fn the_way_through_the_air_as_it_is_written() {
    let before = winding(2.0);
    let (after, findings) = try_apply(&recipe(MACHINE, "unwind: { retract: 60 }"), &before).unwrap();
    let told = format!("\n{}{}", diff(&before, &after), shown(&findings).join("\n"));
    snapshots("machine").bind(|| insta::assert_snapshot!("unwind", told));
}

#[test]
fn a_way_that_meets_the_stock_is_refused() {
    // With half a millimetre of retract the ball goes on cutting while the part turns below it.
    let found = try_apply(&recipe(MACHINE, "unwind: { retract: 0.2 }"), winding(4.0)).unwrap_err();
    assert_eq!(found[0].code, codes::STEP_FAILED);
    assert!(found[0].message.contains("on its way back in the air"), "{}", found[0].message);
    assert!(found[0].labels.iter().any(|label| label.source.name() != "recipe.yaml"), "{found:?}");
}

#[test]
fn what_it_needs_is_said() {
    let without = |part: &str| {
        let text = recipe(MACHINE, "unwind: { retract: 60 }").replace(part, "");
        try_apply(&text, winding(4.0)).unwrap_err()[0].code
    };
    assert_eq!(without(MACHINE), codes::MACHINE_WITHOUT_AXES);
    assert_eq!(without(STOCK), codes::STOCK_MISSING);
    // A program that winds no further than the limits needs neither stock nor change.
    let short = winding(1.0);
    let text = recipe(MACHINE, "unwind: { retract: 60 }").replace(STOCK, "");
    assert_eq!(try_apply(&text, &short).unwrap().0, short);
}

#[test]
fn ranges_without_a_common_value_are_told() {
    // 355 degrees of travel: no pose has two values of C.
    let narrow = MACHINE.replace("limits: [-270, 270]", "limits: [-175, 180]");
    let (after, findings) = try_apply(&recipe(&narrow, "unwind: { retract: 60 }"), winding(2.0)).unwrap();
    assert_eq!(after, winding(2.0));
    assert!(findings.iter().any(|one| one.message.contains("no value in common")), "{findings:?}");
}

//! What `check` says of a program on a machine.

use crate::support::program;
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::machine::find_machine_findings;
use clsmith::program::LengthUnit;
use clsmith::setup::Setup;
use clsmith::source::Source;

const MACHINE: &str = "\
machine:
  table:
    - { name: C, kind: rotary, direction: [0, 0, 1], point: [0, 0, 0], limits: [-360, 360], max_speed: 1800, rapid: 9000, acceleration: 800 }
    - { name: A, kind: rotary, direction: [1, 0, 0], point: [0, 0, -50], limits: [-100, 20], max_speed: 3600, rapid: 9000, acceleration: 800 }
  head:
    - { name: X, kind: linear, direction: [1, 0, 0], limits: [-200, 200], max_speed: 20000, rapid: 26000, acceleration: 4000 }
    - { name: Y, kind: linear, direction: [0, 1, 0], limits: [-200, 200], max_speed: 20000, rapid: 26000, acceleration: 4000 }
    - { name: Z, kind: linear, direction: [0, 0, 1], limits: [-200, 200], max_speed: 17000, rapid: 20000, acceleration: 3500 }
";

fn check(machine: &str, text: &str) -> Vec<(Diagnostic, usize)> {
    check_in(machine, text, LengthUnit::Mm)
}

fn check_in(machine: &str, text: &str, unit: LengthUnit) -> Vec<(Diagnostic, usize)> {
    let setup = Setup::load(&Source::new("m.yaml", machine.as_bytes().to_vec()).unwrap()).unwrap();
    let program = program(text);
    let found = find_machine_findings(&program, &setup.machine.fault_search().unwrap(), unit);
    let line = |finding: &Diagnostic| {
        finding.labels.first().map_or(0, |label| label.source.line_column(label.span.start).0)
    };
    found.into_iter().map(|finding| (finding.clone(), line(&finding))).collect()
}

fn list(found: &[(Diagnostic, usize)]) -> Vec<(&str, usize)> {
    found.iter().map(|(finding, line)| (finding.code.id(), *line)).collect()
}

fn goto(tip: [f64; 3], tilt: f64, turn: f64) -> String {
    let ((st, ct), (sr, cr)) = (tilt.to_radians().sin_cos(), turn.to_radians().sin_cos());
    format!("GOTO/{:.6},{:.6},{:.6},{:.9},{:.9},{:.9}\n", tip[0], tip[1], tip[2], st * cr, st * sr, ct)
}

#[test]
fn a_sound_program_has_none() {
    let text = format!(
        "MULTAX/ON\nFEDRAT/MMPM,500\n{}{}",
        goto([0.0; 3], 20.0, 0.0),
        goto([20.0, 0.0, 0.0], 22.0, 1.0)
    );
    assert_eq!(list(&check(MACHINE, &text)), []);
}

#[test]
fn limits_and_travel_are_told_with_value_and_limit() {
    let text = format!(
        "MULTAX/ON\nRAPID\n{}RAPID\n{}RAPID\n{}",
        goto([0.0; 3], 30.0, 0.0),
        goto([0.0; 3], 110.0, 0.0),
        goto([0.0, 0.0, 230.0], 0.0, 0.0)
    );
    let found = check(MACHINE, &text);
    let limit = found.iter().find(|(finding, _)| finding.code == codes::ROTARY_LIMIT_EXCEEDED).unwrap();
    assert_eq!(limit.1, 5);
    assert!(
        limit.0.message.starts_with("A would stand at -110.000 deg, 10.000 deg beyond its limit of -100 deg"),
        "{}",
        limit.0.message
    );
    let travel = found.iter().find(|(finding, _)| finding.code == codes::TRAVEL_EXCEEDED).unwrap();
    assert_eq!(travel.1, 7);
    assert!(
        travel.0.message.contains("Z would stand at 230.000 mm, 30.000 mm beyond"),
        "{}",
        travel.0.message
    );
    assert!(found.iter().all(|(finding, _)| finding.help.as_ref().is_some_and(|help| !help.is_empty())));
}

#[test]
fn an_axis_out_of_reach_is_an_error_with_its_line() {
    let four = MACHINE.lines().filter(|line| !line.contains("name: C")).collect::<Vec<_>>().join("\n");
    let text = format!(
        "MULTAX/ON\nFEDRAT/MMPM,500\n{}{}",
        goto([0.0; 3], 10.0, 90.0),
        goto([5.0, 0.0, 0.0], 10.0, 60.0)
    );
    let found = check(&four, &text);
    assert_eq!(list(&found), [("CL0701", 4)]);
    assert!(found[0].0.is_error());
}

#[test]
fn a_pole_that_is_passed_near_asks_too_much_of_c() {
    // Half a degree beside the pole, C turns by 60 degrees on one millimetre.
    let text = format!(
        "MULTAX/ON\nFEDRAT/MMPM,600\n{}{}",
        goto([0.0; 3], 0.5, 0.0),
        goto([1.0, 0.0, 0.0], 0.5, 60.0)
    );
    let found = check(MACHINE, &text);
    assert_eq!(list(&found), [("CL0704", 4)]);
    // 600 mm/min are 0.1 s for a millimetre: 600 deg/s.
    assert!(
        found[0].0.message.contains("0.500 deg from the pole, where C turns by"),
        "{}",
        found[0].0.message
    );
    assert!(
        found[0].0.message.contains("asks 36000 deg/min of it, and it makes 1800"),
        "{}",
        found[0].0.message
    );
}

#[test]
fn a_feed_that_an_axis_cannot_follow_is_told_with_the_largest_that_it_can() {
    // C turns by 10 degrees on a millimetre, far from the pole: 1800 deg/min allow 180 mm/min.
    let text = format!(
        "MULTAX/ON\nFEDRAT/MMPM,500\n{}{}",
        goto([0.0; 3], 40.0, 0.0),
        goto([1.0, 0.0, 0.0], 40.0, 10.0)
    );
    let found = check(MACHINE, &text);
    // Ten degrees are a wide step for the tool axis as well.
    assert_eq!(list(&found), [("CL0712", 4), ("CL0709", 4)]);
    assert!(
        found[1].0.message.contains("C cannot follow the feed of 500 mm/min, but at most 180.0"),
        "{}",
        found[1].0.message
    );
}

#[test]
fn without_control_the_tip_leaves_its_line_and_tolerance_says_from_when() {
    let text = format!(
        "MULTAX/ON\nFEDRAT/MMPM,100\n{}{}",
        goto([60.0, 0.0, 0.0], 30.0, 0.0),
        goto([59.5, 5.0, 0.0], 30.0, 5.0)
    );
    assert_eq!(list(&check(MACHINE, &text)), []);
    let free = MACHINE.replace("machine:\n", "machine:\n  tcp: false\n");
    let found = check(&free, &text);
    assert_eq!(list(&found), [("CL0708", 4)]);
    let sag = found[0].0.magnitude.unwrap();
    // r a2 / 8 with 60 mm and 5 degrees is 57 um.
    assert!((0.04..0.08).contains(&sag), "{sag}");
    let coarse = MACHINE.replace("machine:\n", "machine:\n  tcp: false\n  tip_tolerance: 0.1\n");
    assert_eq!(list(&check(&coarse, &text)), []);
}

#[test]
fn rewinds_in_the_cut_are_warnings_and_those_in_the_air_notes() {
    let winding = |between: &str| {
        let steps = (0..75).map(|step| {
            let turn = 10.0 * f64::from(step) + 95.0;
            let (sine, cosine) = turn.to_radians().sin_cos();
            let rapid = if step == 37 { between } else { "" };
            format!("{rapid}{}", goto([30.0 * cosine, 30.0 * sine, 0.0], 45.0, turn))
        });
        format!("MULTAX/ON\nFEDRAT/MMPM,500\n{}", steps.collect::<String>())
    };
    let one_sided = MACHINE.replace("limits: [-360, 360]", "limits: [-200, 200]");
    let codes_of = |text: &str| -> Vec<String> {
        check(&one_sided, text).iter().map(|(finding, _)| finding.code.id().to_owned()).collect()
    };
    assert!(codes_of(&winding("")).contains(&"CL0706".to_owned()));
    // 750 degrees on 400: one rewind at least; with a rapid in the middle it costs nothing more there.
    let in_air = codes_of(&winding("RAPID\n"));
    assert!(in_air.iter().any(|code| code.starts_with("CL070")), "{in_air:?}");
}

#[test]
fn every_motion_that_an_axis_cannot_follow_is_a_finding() {
    let steps: String = (0..301)
        .map(|step| goto([0.5 * f64::from(step), 0.0, 0.0], 40.0, f64::from(step % 2) * 20.0))
        .collect();
    let found = check(MACHINE, &format!("MULTAX/ON\nFEDRAT/MMPM,500\n{steps}"));
    // Outputs show the worst of a code and count the rest, so every one has to reach them.
    assert_eq!(found.iter().filter(|(finding, _)| finding.code == codes::AXIS_TOO_SLOW).count(), 300);
}

#[test]
fn a_program_in_inches_is_told_its_lengths_in_inches() {
    let text = format!("UNITS/INCHES\n{}", goto([0.0, 0.0, 10.0], 0.0, 0.0));
    let found = check_in(MACHINE, &text, LengthUnit::Inch);
    assert_eq!(list(&found), [("CL0703", 2)]);
    // 254 mm on a way of 200 mm.
    assert!(
        found[0].0.message.contains("Z would stand at 10.0000 in, 2.1260 in beyond its limit of 7.87402 in"),
        "{}",
        found[0].0.message
    );
    let fast = format!(
        "UNITS/INCHES\nMULTAX/ON\nFEDRAT/20,IPM\n{}{}",
        goto([0.0; 3], 40.0, 0.0),
        goto([1.0 / 25.4, 0.0, 0.0], 40.0, 10.0)
    );
    let found = check_in(MACHINE, &fast, LengthUnit::Inch);
    let told = found.iter().find(|(finding, _)| finding.code == codes::AXIS_TOO_SLOW).unwrap();
    // 180 mm/min.
    assert!(
        told.0.message.contains("the feed of 20.0 in/min, but at most 7.09 in/min"),
        "{}",
        told.0.message
    );
}

#[test]
fn with_control_of_the_tip_the_axis_may_leave_the_shortest_turn() {
    let step = |turn: f64| {
        let text = format!(
            "MULTAX/ON\nFEDRAT/MMPM,50\n{}{}",
            goto([0.0; 3], 40.0, 0.0),
            goto([20.0, 0.0, 0.0], 40.0, turn)
        );
        check(MACHINE, &text)
    };
    let found = step(10.0);
    assert_eq!(list(&found), [("CL0712", 4)]);
    // Half way, the cone is at 40 degrees, and the shortest turn where tan is tan 40 cos 5.
    let shortest = (40f64.to_radians().tan() * 5f64.to_radians().cos()).atan().to_degrees();
    let swing = 40.0 - shortest;
    let told = format!("takes the tool axis {swing:.3} deg").replace("takes", "take");
    assert!(found[0].0.message.contains(&told), "{} without {told}", found[0].0.message);
    // With the square of the step it falls below what is allowed.
    assert!(step(2.0).is_empty());
}

//! Feeds that the axes of a machine follow, and the time on it.

use crate::support::program;
use crate::transform::try_apply;
use clsmith::diagnostic::{Failure, codes};
use clsmith::machine::time_program;
use clsmith::program::LengthUnit;
use clsmith::setup::Setup;
use clsmith::source::Source;
use clsmith::transform::{Recipe, run_recipe};

const MACHINE: &str = "  machine:
    max_feed: 6000
    corner_constant: 0.0087
    table:
      - { name: C, kind: rotary, direction: [0, 0, 1], point: [0, 0, 0], max_speed: 1800, rapid: 9000, acceleration: 800 }
      - { name: B, kind: rotary, direction: [0, 1, 0], point: [0, 0, 77.5], max_speed: 3600, rapid: 9000, acceleration: 400 }
    head:
      - { name: X, kind: linear, direction: [1, 0, 0], max_speed: 20000, rapid: 26000, acceleration: 4000 }
      - { name: Y, kind: linear, direction: [0, 1, 0], max_speed: 20000, rapid: 26000, acceleration: 4000 }
      - { name: Z, kind: linear, direction: [0, 0, 1], max_speed: 17000, rapid: 20000, acceleration: 3500 }
  stock: { block: { from: [-30, -20, -10], to: [30, 20, 0] } }
  tools: [ { match: {}, diameter: 10, corner_radius: 5, flute_length: 40, teeth: 4 } ]
";

fn recipe(step: &str) -> String {
    format!("version: 1\nsetup:\n{MACHINE}steps:\n  - {step}\n")
}

/// At a tilt of 20 degrees; C turns by 10 degrees on the second millimetre, and on none of the others.
fn part() -> String {
    let goto = |x: f64, turn: f64| {
        let ((st, ct), (sr, cr)) = (20f64.to_radians().sin_cos(), turn.to_radians().sin_cos());
        format!("GOTO/{x:.4},0.0000,-1.0000,{:.7},{:.7},{:.7}\n", st * cr, st * sr, ct)
    };
    let points = [(-21.0, 0.0), (0.0, 0.0), (1.0, 10.0), (22.0, 10.0)];
    let text: String = points.iter().map(|(x, turn)| goto(*x, *turn)).collect();
    format!(
        "TOOL PATH/A,TOOL,T1\nTLDATA/MILL,10.0000,5.0000,80.0000,0.0000,0.0000\nSPINDL/RPM,6000,CLW\nRAPID\n{}FEDRAT/MMPM,800.0000\n{text}END-OF-PATH\n",
        goto(-35.0, 0.0)
    )
}

fn feeds(text: &str) -> Vec<f64> {
    program(text).motions().filter(|motion| !motion.rapid).map(|motion| motion.feed.unwrap().value).collect()
}

#[test]
fn no_feed_is_above_what_axes_follow() {
    // 1800 deg/min for 10 degrees on a millimetre: 180 mm/min.
    let (free, _) = try_apply(&recipe("optimize_feed: { target: 0.1 }"), part()).unwrap();
    assert!(feeds(&free)[2] > 500.0, "{:?}", feeds(&free));
    let step = recipe("optimize_feed: { target: 0.1, axes: true }");
    let (kept, _) = try_apply(&step, part()).unwrap();
    let (own, other) = (feeds(&kept), feeds(&free));
    assert!(own[2] <= 180.0 && own[2] >= 179.0, "{own:?}");
    assert_eq!((own[1], own[3]), (other[1], other[3]));
    assert_eq!(try_apply(&step, &kept).unwrap().0, kept);
    // A programmed feed that nothing else limits, in air, is lowered, too.
    let above = part().replace("-1.0000,", "30.0000,").replacen("30.0000,", "-1.0000,", 2);
    let (lowered, _) = try_apply(&step, above).unwrap();
    assert!(feeds(&lowered)[2] <= 180.0, "{:?}", feeds(&lowered));
    let without = recipe("optimize_feed: { target: 0.1, max_feed: 3000, axes: true }")
        .replace(MACHINE, &MACHINE[MACHINE.find("  stock").unwrap()..]);
    let found = try_apply(&without, part()).unwrap_err();
    assert!(found.iter().any(|one| one.code == codes::MACHINE_WITHOUT_AXES && one.is_error()), "{found:?}");
}

#[test]
fn the_report_begins_with_the_time_on_the_machine() {
    let text = recipe("optimize_feed: { target: 0.1, axes: true }");
    let source = Source::new("recipe.yaml", text.into_bytes()).unwrap();
    let recipe = Recipe::load(&source).map_err(Failure::into_findings).unwrap();
    let setup = recipe.merge_setups(Setup::default(), Setup::default());
    let outcome = run_recipe(&recipe, &setup, program(part())).map_err(Failure::into_findings).unwrap();
    let json = outcome.reports[0].to_json();
    let seconds = |program: &clsmith::Program| {
        time_program(program, LengthUnit::Mm, &setup.machine.dynamics().unwrap()).total()
    };
    let told = |key: &str| json[key].as_f64().unwrap();
    assert!((told("machine_seconds_before") - seconds(&program(part()))).abs() < 1e-9);
    assert!((told("machine_seconds_after") - seconds(&outcome.program)).abs() < 1e-9);
    let text = outcome.reports[0].to_text(clsmith::report::DisplayUnits::MM);
    let second = text.trim_start().lines().nth(1).unwrap();
    assert!(second.trim_start().starts_with("on the machine"), "{text}");
}

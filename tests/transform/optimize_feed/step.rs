//! The whole step on programs whose loads are known in closed form.

use crate::support;
use crate::transform::try_apply;
use clsmith::diagnostic::Diagnostic;
use clsmith::report::render::human::HumanRenderOptions;

/// A program of one operation with a flat cutter of 10 mm at 5000 rev/min.
pub fn program(body: &str) -> String {
    format!(
        "TOOL PATH/SLOT,TOOL,EM10\n\
         TLDATA/MILL,10.0000,0.0000,75.0000,0.0000,0.0000\n\
         MSYS/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000\n\
         LOAD/TOOL,1\n\
         SPINDL/RPM,5000,CLW\n\
         RAPID\n\
         GOTO/-10.0000,0.0000,-3.0000,0.0000000,0.0000000,1.0000000\n\
         {body}\
         RAPID\n\
         GOTO/0.0000,0.0000,50.0000\n\
         END-OF-PATH\n"
    )
}

/// One pass through 100 mm of a block, 3 mm deep.
const PASS: &str = "FEDRAT/MMPM,500.0000\nGOTO/110.0000,0.0000,-3.0000\n";

pub fn recipe(step: &str) -> String {
    format!(
        "version: 1\n\
         setup:\n\
         \x20 stock: {{ block: {{ from: [0, -30, -20], to: [100, 30, 0] }} }}\n\
         \x20 tools: [ {{ match: {{}}, teeth: 4, helix: 0, flute_length: 30 }} ]\n\
         \x20 material: {{ k_tc: 2000 }}\n\
         steps:\n\
         \x20 - optimize_feed: {{ {step} }}\n"
    )
}

pub fn corrected(step: &str, text: &str) -> String {
    let (text, findings) = try_apply(&recipe(step), text).unwrap_or_else(|found| panic!("{found:?}"));
    assert!(findings.iter().all(|found| !found.is_error()), "{findings:?}");
    text
}

/// Feeds that a text programs, in order.
pub fn feeds(text: &str) -> Vec<f64> {
    let feed = |line: &str| {
        line.strip_prefix("FEDRAT/").map(|rest| rest.split(',').nth(1).unwrap().parse().unwrap())
    };
    text.lines().filter_map(feed).collect()
}

fn stopped(recipe: &str, text: &str) -> Vec<Diagnostic> {
    try_apply(recipe, text).unwrap_err()
}

pub fn snapshot(name: &str, recipe: &str, text: &str) {
    let found = stopped(recipe, text);
    let mut out = Vec::new();
    clsmith::report::render::human::render_human(&mut out, &found, None, &HumanRenderOptions::default())
        .unwrap();
    support::snapshots("optimize_feed").bind(|| insta::assert_snapshot!(name, String::from_utf8_lossy(&out)));
}

#[test]
fn a_full_slot_runs_at_target_times_teeth_times_speed() {
    let done = corrected("target: 0.06, max_feed: 9000, cell: 0.25", &program(PASS));
    assert_eq!(feeds(&done), [0.06 * 4.0 * 5000.0]);
    assert_eq!(done.lines().count(), program(PASS).lines().count(), "no FEDRAT more than needed");
}

#[test]
fn a_second_run_changes_nothing() {
    let step = "target: 0.06, max_feed: 6000, air_feed: 6000, max_acceleration: 20000, cell: 0.25, \
                split: { above: 1, shortest: 0.5, at_most: 8 }";
    let once = corrected(step, &program(PASS));
    let twice = corrected(step, &once);
    assert!(feeds(&once).len() >= 2);
    assert_eq!(once, twice);
}

#[test]
fn other_criteria_in_closed_form() {
    let text = program(PASS);
    // 10 mm x 3 mm of ground; half a cell on either side may be hidden.
    let rate = feeds(&corrected("criterion: removal_rate, target: 30000, max_feed: 9000, cell: 0.25", &text));
    assert!((0.95 * 1000.0..=1000.0).contains(&rate[0]), "{rate:?}");
    // Power is k_tc times removal rate: 2000 N/mm2 x 30 mm2 x 1000 mm/min = 1 kW.
    let power = feeds(&corrected("criterion: power, target: 1, max_feed: 9000, cell: 0.25", &text));
    assert!((0.9 * 1000.0..=1000.0).contains(&power[0]), "{power:?}");
    let both = feeds(&corrected(
        "target: 0.06, limits: [ { criterion: power, target: 1 }, { criterion: force, target: 100000 } ], max_feed: 9000, cell: 0.25",
        &text,
    ));
    assert_eq!(both, power, "the lowest of several limits");
}

#[test]
fn limits_of_the_feed() {
    let text = program(PASS);
    assert_eq!(feeds(&corrected("target: 0.06, max_feed: 900, cell: 0.25", &text)), [900.0]);
    assert_eq!(feeds(&corrected("target: 0.06, max_feed: 9000, max_ratio: 1.5, cell: 0.25", &text)), [750.0]);
    assert_eq!(
        feeds(&corrected("target: 0.001, max_feed: 9000, min_ratio: 0.5, cell: 0.25", &text)),
        [250.0]
    );
    let (low, findings) =
        try_apply(&recipe("target: 0.001, min_feed: 100, max_feed: 9000, cell: 0.25"), &text).unwrap();
    assert_eq!(feeds(&low), [100.0]);
    assert!(findings.iter().any(|found| found.code.id() == "CL0515"), "{findings:?}");
}

#[test]
fn feeds_per_revolution_and_in_inches_keep_their_unit() {
    let per_turn = program("FEDRAT/MMPR,0.1000\nGOTO/110.0000,0.0000,-3.0000\n");
    let done = corrected("target: 0.06, max_feed: 9000, cell: 0.25, round_down_to: 0", &per_turn);
    assert_eq!(feeds(&done), [0.24]);
    let inches = program("FEDRAT/IPM,20.0000\nGOTO/4.0000,0.0000,-0.1000\n")
        .replace("MILL,10.0000,0.0000,75.0000", "MILL,0.4000,0.0000,3.0000");
    let recipe = recipe("target: 0.002, max_feed: 300, cell: 0.01")
        .replace("version: 1\n", "version: 1\nunits: inch\n")
        .replace("[0, -30, -20], to: [100, 30, 0]", "[0, -1, -1], to: [3.9, 1, 0]")
        .replace("flute_length: 30", "flute_length: 1.2");
    let (done, _) = try_apply(&recipe, &inches).unwrap_or_else(|found| panic!("{found:?}"));
    assert_eq!(feeds(&done), [40.0], "0.002 inch x 4 x 5000");
    // What misses its stock is told in the unit of the file.
    let elsewhere =
        recipe.replace("from: [0, -1, -1], to: [3.9, 1, 0]", "from: [0, 9, -1], to: [3.9, 10, 0]");
    let found = stopped(&elsewhere, &inches);
    let message = &found.last().unwrap().message;
    assert!(
        message.contains("(0.000, 9.000, -1.000)") && message.contains("(4.000, 0.000, -0.100)"),
        "{message}"
    );
}

#[test]
fn air_runs_fast_and_slows_down_in_time() {
    let body = "FEDRAT/MMPM,500.0000\nGOTO/-6.0000,0.0000,-3.0000\nGOTO/110.0000,0.0000,-3.0000\nGOTO/130.0000,0.0000,-3.0000\n";
    let done =
        corrected("target: 0.06, max_feed: 9000, air_feed: 6000, margin: 0.5, cell: 0.25", &program(body));
    assert_eq!(feeds(&done), [6000.0, 1200.0, 6000.0], "{done}");
    let slow = corrected(
        "target: 0.06, max_feed: 9000, air_feed: 6000, margin: 0.5, cell: 0.25, max_acceleration: 2000, min_change: 0",
        &program(body),
    );
    // F^2 = 1200^2 + 120 a L over the 4 mm before the cut. Behind it the machine speeds up as it can.
    let reach = |length: f64| (1200f64.powi(2) + 120.0 * 2000.0 * length).sqrt().floor();
    assert_eq!(feeds(&slow), [reach(4.0), 1200.0, 6000.0]);
}

#[test]
fn what_is_not_selected_keeps_its_bytes_and_its_feed() {
    let text = format!(
        "{}{}",
        program(PASS),
        program(PASS).replace("SLOT", "OTHER").replace(",0.0000,-3.0000", ",12.0000,-3.0000")
    );
    let done = corrected("target: 0.06, max_feed: 9000, cell: 0.25, where: { operations: [SLOT] }", &text);
    assert_eq!(feeds(&done), [1200.0, 500.0]);
    assert_eq!(done.replace("1200.0000", "500.0000"), text);
}

#[test]
fn the_programmed_feed_comes_back_after_the_blocks_it_may_touch() {
    let body = "PAINT/COLOR,31\nFEDRAT/MMPM,500.0000\nGOTO/110.0000,0.0000,-3.0000\nPAINT/COLOR,37\nGOTO/110.0000,0.0000,20.0000\n";
    let done = corrected("target: 0.06, max_feed: 9000, cell: 0.25", &program(body));
    assert_eq!(feeds(&done), [1200.0, 500.0], "{done}");
}

#[test]
fn long_blocks_are_split_where_the_load_changes_and_arcs_stay_arcs() {
    // A half circle about (50, -30) from below the block into it.
    let body = "RAPID\nGOTO/-10.0000,-60.0000,-3.0000\nFEDRAT/MMPM,500.0000\nGOTO/50.0000,-60.0000,-3.0000\n\
        CIRCLE/50.0000,-30.0000,-3.0000,0.0000000,0.0000000,1.0000000,30.0000,0.0600,0.5000,10.0000,0.0000\n\
        GOTO/50.0000,0.0000,-3.0000\nRAPID\nGOTO/50.0000,0.0000,50.0000\n";
    let done = corrected(
        "target: 0.06, max_feed: 6000, cell: 0.25, split: { above: 1, shortest: 2, at_most: 6 }",
        &program(body),
    );
    let circles = done.matches("CIRCLE/").count();
    assert!((2..=6).contains(&circles), "{done}");
    let arcs = support::clean_motions(&support::program(&done))
        .into_iter()
        .filter_map(|motion| match motion.path {
            clsmith::program::geometry::MotionPath::Arc(arc) => Some(arc),
            _ => None,
        })
        .collect::<Vec<_>>();
    let sweep: f64 = arcs.iter().map(|arc| arc.sweep).sum();
    assert!((sweep - std::f64::consts::PI).abs() < 1e-4);
    assert!(arcs.iter().all(|arc| (arc.radius - 30.0).abs() < 1e-4));
}

#[test]
fn plunges_and_ramps_are_touched_and_drilling_is_not() {
    let body = "FEDRAT/MMPM,500.0000\nGOTO/50.0000,0.0000,5.0000\nGOTO/50.0000,0.0000,-4.0000\n\
        CYCLE/DRILL,RAPTO,3.0000,FEDTO,-12.0000,MMPM,420.0000\nGOTO/20.0000,20.0000,0.0000\nCYCLE/OFF\n";
    let body = body.replace("CYCLE/DRILL", "RAPID\nGOTO/50.0000,0.0000,5.0000\nCYCLE/DRILL");
    let text = program(&body).replace("GOTO/-10.0000,0.0000,-3.0000", "GOTO/-10.0000,0.0000,5.0000");
    let done = corrected("target: 0.03, max_feed: 9000, cell: 0.25", &text);
    assert_eq!(
        feeds(&done).last(),
        Some(&600.0),
        "a flat end's plunge cuts the whole feed per tooth: {done}"
    );
    assert!(done.contains("MMPM,420.0000"));
}

#[test]
fn the_papers_window_looks_half_a_block_ahead() {
    let body = "FEDRAT/MMPM,500.0000\nGOTO/-25.0000,0.0000,-3.0000\nGOTO/-6.0000,0.0000,-3.0000\n\
        GOTO/50.0000,0.0000,-3.0000\nGOTO/110.0000,0.0000,-3.0000\n";
    let done = corrected(
        "target: 0.06, max_feed: 6000, air_feed: 6000, margin: 0, window: half_blocks, cell: 0.25",
        &program(body),
    );
    let found = feeds(&done);
    assert_eq!(found.first(), Some(&6000.0));
    assert!(found.contains(&1200.0), "{done}");
}

#[test]
fn the_papers_window_tells_which_targets_it_passes() {
    // The second half of the last block meets only the side of a slot that is there already.
    let body = "RAPID\nGOTO/-10.0000,0.0000,5.0000\nRAPID\nGOTO/120.0000,2.0000,5.0000\nRAPID\nGOTO/120.0000,2.0000,-3.0000\nFEDRAT/MMPM,500.0000\n\
        GOTO/40.0000,2.0000,-3.0000\nRAPID\nGOTO/40.0000,2.0000,5.0000\nRAPID\nGOTO/-10.0000,0.0000,5.0000\nRAPID\n\
        GOTO/-10.0000,0.0000,-3.0000\nFEDRAT/MMPM,500.0000\nGOTO/-6.0000,0.0000,-3.0000\n\
        GOTO/110.0000,0.0000,-3.0000\n";
    let step = "target: 0.06, max_feed: 6000, margin: 0, cell: 0.25";
    let (_, found) = try_apply(&recipe(&format!("{step}, window: half_blocks")), program(body)).unwrap();
    let passed: Vec<&Diagnostic> = found.iter().filter(|found| found.code.to_string() == "CL0534").collect();
    assert_eq!(passed.len(), 1, "{found:?}");
    // A share of 0.8 lets the block run at 1500 mm/min, at which a full slot has 0.075 mm, of which nearly all is proved.
    assert!(passed[0].message.contains("0.074"), "{}", passed[0].message);
    let (_, found) = try_apply(&recipe(step), program(body)).unwrap();
    assert!(found.iter().all(|found| found.code.to_string() != "CL0534"), "{found:?}");
}

#[test]
fn what_is_missing_is_asked_for_at_its_place() {
    let text = program(PASS);
    let step = "target: 0.06, max_feed: 9000, cell: 0.25";
    let good = recipe(step);
    snapshot(
        "no stock",
        &good.replace("  stock: { block: { from: [0, -30, -20], to: [100, 30, 0] } }\n", ""),
        &text,
    );
    snapshot("no teeth", &good.replace("teeth: 4, helix: 0, ", ""), &text);
    snapshot(
        "no material",
        &recipe("criterion: force, target: 100, max_feed: 9000").replace("  material: { k_tc: 2000 }\n", ""),
        &text,
    );
    snapshot("no highest feed", &recipe("target: 0.06"), &text);
    snapshot("no tool", &good, &text.replace("TLDATA/MILL,10.0000,0.0000,75.0000,0.0000,0.0000\n", ""));
    snapshot("no spindle speed", &good, &text.replace("SPINDL/RPM,5000,CLW\n", ""));
    snapshot("no feed", &good, &text.replace("FEDRAT/MMPM,500.0000\n", ""));
    snapshot("cell too coarse", &recipe("target: 0.06, max_feed: 9000, cell: 3"), &text);
    snapshot("too much", &recipe("target: 0.06, max_feed: 9000, cell: 0.001"), &text);
    snapshot(
        "stock elsewhere",
        &good.replace("[0, -30, -20], to: [100, 30, 0]", "[0, 70, -20], to: [100, 90, 0]"),
        &text,
    );
    snapshot("lowest above highest", &recipe("target: 0.06, min_feed: 700, max_feed: 600"), &text);
}

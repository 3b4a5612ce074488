//! Indexable cutters: what their middle leaves, and what they run into.

use super::{codes, machine, near, nx};
use clsmith::engagement::PillarContact;
use clsmith::simulation_run::DexelRunResult;

/// A face mill of 50 mm whose middle of 38 mm does not cut.
const MILL: &str = "50.0000,6.0000,80.0000,0.0000,0.0000";

fn setup(height: f64) -> String {
    format!(
        "stock: {{ block: {{ from: [-100, -60, -40], to: [200, 60, 0] }} }}\n\
         tools: [ {{ match: {{}}, teeth: 4, helix: 0, flute_length: 60, insert: {{ height: {height}, radius: 6 }} }} ]\n"
    )
}

/// What a program runs into, with inserts of a cutting height.
fn run(body: &str, height: f64) -> (Option<PillarContact>, f64, DexelRunResult) {
    let (cuts, ran) = machine(&nx(MILL, body), &setup(height), 0.5);
    let deepest = cuts.iter().filter_map(|cut| cut.pillar);
    let deepest = deepest.reduce(|one, other| if other.depth_mm() > one.depth_mm() { other } else { one });
    (deepest, cuts.iter().map(|cut| cut.removed_mm3).sum(), ran)
}

/// Down along x by a slope, and back.
fn there_and_back(slope: f64) -> String {
    format!(
        "GOTO/0.,0.,0.\nGOTO/100.,0.,{:.4}\nGOTO/0.,0.,{:.4}\nGOTO/100.,0.,{:.4}\n",
        -100.0 * slope,
        -200.0 * slope,
        -200.0 * slope
    )
}

#[test]
fn the_pillar_is_as_high_as_the_closed_forms_say() {
    for slope in [0.03, 0.06, 0.1] {
        // Straight on the middle descends over its width before the other side has passed.
        let straight = format!("GOTO/0.,0.,0.\nGOTO/100.,0.,{:.4}\n", -100.0 * slope);
        let least = 38.0 * slope;
        let tolerance = 4.0 * 0.5 * slope + 0.01;
        assert!(run(&straight, least + 0.02).0.is_none(), "{slope}");
        let found = run(&straight, 0.5).0.unwrap();
        near(found.height_mm, least, tolerance);
        near(found.depth_mm(), least - 0.5, tolerance);
        // Where it turns back, twice that; the ramp keeps the limit of the paper, and touches.
        assert!(run(&there_and_back(slope), 2.0 * least + 0.02).0.is_none(), "{slope}");
        let found = run(&there_and_back(slope), 1.5 * least).0.unwrap();
        near(found.height_mm, 2.0 * least, tolerance);
        assert!(found.height_mm <= 2.0 * least + 1e-3, "a column is never higher than the pillar");
    }
}

#[test]
fn a_pillar_has_a_place_and_is_a_finding() {
    let (found, _, ran) = run(&there_and_back(0.1), 5.0);
    let found = found.unwrap();
    // It stands at the side of the turn from which the cutter came, on the middle of the path.
    let [x, y, _] = found.place_mm;
    near(x, 100.0 - 19.0, 1.0);
    near(y, 0.0, 1.0);
    assert_eq!(codes(&ran), ["CL0540"]);
    let told = &ran.findings[0];
    assert!(told.message.contains("above the tip at 81."), "{}", told.message);
    assert!(told.message.contains("the inserts clear 5.00 mm"), "{}", told.message);
    assert!(found.volume_mm3 > 0.0);
    // Without inserts in the setup nothing of this is known.
    let solid = setup(5.0).replace(", insert: { height: 5, radius: 6 }", "");
    assert_eq!(codes(&machine(&nx(MILL, &there_and_back(0.1)), &solid, 0.5).1), [""; 0]);
}

#[test]
fn a_plunge_leaves_what_the_inserts_clear_and_level_cuts_take_it() {
    let pi = std::f64::consts::PI;
    // Straight down by less than an insert cuts: a ring, and a pillar in the middle of it.
    let mill = "50.0000,0.0000,80.0000,0.0000,0.0000";
    let plunge = "GOTO/0.,0.,0.\nGOTO/0.,0.,-3.\n";
    let (cuts, ran) = machine(&nx(mill, plunge), &setup(4.0), 0.5);
    near(cuts.iter().map(|cut| cut.removed_mm3).sum(), 3.0 * pi * (25.0 * 25.0 - 19.0 * 19.0), 30.0);
    assert_eq!(codes(&ran), [""; 0]);
    // The level cut away from there takes the pillar, too.
    let level = format!("{plunge}GOTO/80.,0.,-3.\n");
    let (cuts, ran) = machine(&nx(mill, &level), &setup(4.0), 0.5);
    near(cuts.iter().map(|cut| cut.removed_mm3).sum(), 3.0 * (pi * 25.0 * 25.0 + 80.0 * 50.0), 60.0);
    assert_eq!(codes(&ran), [""; 0]);
    // Deeper than an insert cuts, the body is pushed into it. What it meets stays.
    let (cuts, ran) = machine(&nx(mill, "GOTO/0.,0.,0.\nGOTO/0.,0.,-6.\n"), &setup(4.0), 0.5);
    assert_eq!(codes(&ran), ["CL0540"]);
    let met = cuts.iter().find_map(|cut| cut.pillar).unwrap();
    near(met.volume_mm3, 2.0 * pi * 19.0 * 19.0, 30.0);
    near(met.depth_mm(), 2.0, 1e-3);
}

/// What the ring of inserts leaves of a column, by stepping the cutter along its path: the lowest that the inserts reached; and
/// how deep the body gets into it.
fn stepped(points: &[[f64; 3]], [x, y]: [f64; 2], height: f64, [outer, inner]: [f64; 2]) -> (f64, f64) {
    let (mut top, mut deepest) = (0.0_f64, 0.0_f64);
    for pair in points.windows(2) {
        for step in 0..=1500 {
            let at = [0, 1, 2]
                .map(|axis| pair[0][axis] + (pair[1][axis] - pair[0][axis]) * f64::from(step) / 1500.0);
            let r = f64::hypot(at[0] - x, at[1] - y);
            if r >= outer {
                continue;
            }
            if r >= inner {
                top = top.min(at[2]);
            } else {
                deepest = deepest.max(top - at[2] - height);
            }
        }
    }
    (top, deepest)
}

#[test]
fn columns_are_those_of_a_ring_that_is_stepped_along() {
    // Up and down, in several directions, flat bottoms: every case of a column that is under the middle at an end.
    let points = [
        [0.0, 0.0, 0.0],
        [30.0, 0.0, -3.0],
        [30.0, 10.0, -3.0],
        [10.0, -15.0, -1.0],
        [60.0, -15.0, -6.0],
        [60.0, -15.0, -8.0],
        [45.0, 5.0, -8.0],
        [45.0, 5.0, -5.0],
        [70.0, 5.0, -4.0],
    ];
    let body: String = points.iter().map(|[x, y, z]| format!("GOTO/{x:.4},{y:.4},{z:.4}\n")).collect();
    let (cuts, ran) = machine(&nx("50.0000,0.0000,80.0000,0.0000,0.0000", &body), &setup(2.0), 0.5);
    let grid = *ran.left.grid();
    let mut deepest = 0.0_f64;
    for row in (0..grid.rows).step_by(5) {
        for column in (0..grid.columns).step_by(5) {
            let place = grid.column_center(column, row);
            // Where a rim just grazes a column, steps may miss it.
            let (one, pushed) = stepped(&points, place, 2.0, [24.95, 19.05]);
            let (other, _) = stepped(&points, place, 2.0, [25.05, 18.95]);
            let left = ran.left.column_spans(column, row)[0][1];
            let top = f64::from(left) + grid.base_mm;
            assert!(
                top >= one.min(other) - 0.02 && top <= one.max(other) + 0.02,
                "{place:?}: {top}, {one}, {other}"
            );
            deepest = deepest.max(pushed);
        }
    }
    let told = cuts.iter().filter_map(|cut| cut.pillar).map(|pillar| pillar.depth_mm()).fold(0.0, f64::max);
    assert!(told >= deepest - 0.02 && told <= deepest + 0.8, "{told} and {deepest}");
}

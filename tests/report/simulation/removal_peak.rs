//! The largest removal rate, against closed forms and however a path is divided.

use super::{SHOP, SLOT, simulate};
use clsmith::program::LengthUnit;
use clsmith::report::simulation::SimulationReport;

/// A share by which the largest rate of a path may differ between two ways to divide it: parts of the path begin
/// elsewhere, and within a part volume counts as even.
const DIVIDED: f64 = 0.03;

fn shop(stock: &str, diameter: f64, corner: f64) -> String {
    format!(
        "stock: {{ block: {stock} }}\ntools: [{{ match: {{}}, diameter: {diameter}, corner_radius: {corner}, flute_length: 20, teeth: 4 }}]\n"
    )
}

fn program(points: &[[f64; 3]], feed: f64, axis: &str) -> String {
    let point = |[x, y, z]: &[f64; 3]| format!("GOTO/{x:.4},{y:.4},{z:.4},{axis}\n");
    let (first, rest) = points.split_first().unwrap();
    let goto: String = rest.iter().map(point).collect();
    format!("LOAD/TOOL,3\nSPINDL/RPM,5000,CLW\nRAPID\n{}FEDRAT/MMPM,{feed:.1}\n{goto}", point(first))
}

const UP: &str = "0.0000000,0.0000000,1.0000000";

fn peak(found: &SimulationReport) -> f64 {
    found.totals.removal_rate_mm3_min.unwrap().value
}

fn near(found: f64, expected: f64, share: f64) {
    assert!((found / expected - 1.0).abs() <= share, "{found} instead of {expected}");
}

#[test]
fn a_long_motion_whose_end_cuts_has_the_rate_of_its_end() {
    let shop = shop("{ from: [90, 0, -20], to: [200, 40, 0] }", 10.0, 0.0);
    let text = program(&[[0.0, 20.0, -3.0], [100.0, 20.0, -3.0]], 1000.0, UP);
    let found = simulate(&text, &shop, LengthUnit::Mm).unwrap();
    // A full slot of 10 x 3 mm at 1000 mm/min.
    near(peak(&found), 30_000.0, 0.01);
    let row = found.motions.rows.last().unwrap();
    assert_eq!(row.peak_removal_rate_mm3_min, Some(peak(&found)));
    // 10 mm of slot and the cap of half a circle, over 100 mm.
    let area = 10.0 * 10.0 + std::f64::consts::PI * 25.0 / 2.0;
    near(row.removal_rate_mm3_min.unwrap(), area * 3.0 / 100.0 * 1000.0, 0.01);
}

#[test]
fn a_full_slot_removes_depth_times_width_times_feed() {
    let found = simulate(SLOT, SHOP, LengthUnit::Mm).unwrap();
    near(peak(&found), 10.0 * 2.0 * 800.0, 0.01);
    // Straight down into the full: the cutter's circle.
    let stock = "{ from: [0, 0, -30], to: [40, 40, 0] }";
    let text = program(&[[20.0, 20.0, 5.0], [20.0, 20.0, -10.0]], 200.0, UP);
    let found = simulate(&text, &shop(stock, 10.0, 0.0), LengthUnit::Mm).unwrap();
    near(peak(&found), std::f64::consts::PI * 25.0 * 200.0, 0.02);
    // A ball down to its middle in a slot: the cross section of half a circle.
    let text = program(&[[-10.0, 20.0, -5.0], [40.0, 20.0, -5.0]], 600.0, UP);
    let found = simulate(&text, &shop(stock, 10.0, 5.0), LengthUnit::Mm).unwrap();
    near(peak(&found), std::f64::consts::PI * 12.5 * 600.0, 0.02);
}

#[test]
fn a_tilted_axis_has_the_same_rate() {
    let stock = "{ from: [0, 0, -30], to: [40, 40, 0] }";
    let points = [[-10.0, 20.0, -3.0], [25.0, 20.0, -3.0], [25.0, 50.0, -3.0]];
    let rate = |axis: &str| {
        peak(&simulate(&program(&points, 1000.0, axis), &shop(stock, 10.0, 2.0), LengthUnit::Mm).unwrap())
    };
    // A full slot, without what the corner leaves at both sides.
    let slot = (10.0 * 3.0 - 2.0 * 2.0 * 2.0 * (1.0 - std::f64::consts::FRAC_PI_4)) * 1000.0;
    near(rate(UP), slot, 0.02);
    near(rate("0.0000000,0.0000500,1.0000000"), slot, 0.02);
}

#[test]
fn the_rate_does_not_depend_on_how_a_path_is_divided() {
    let stock = "{ from: [10, 0, -30], to: [60, 40, 0] }";
    let corners =
        [[0.0, 12.0, -2.0], [70.0, 20.0, -2.0], [70.0, 27.0, -3.0], [30.0, 24.0, -4.0], [30.0, 50.0, -4.0]];
    let mut seed = 7_u64;
    let mut random = move || {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (seed >> 11) as f64 / (1_u64 << 53) as f64
    };
    for corner in [0.0, 2.0, 5.0] {
        let shop = shop(stock, 10.0, corner);
        let whole = peak(&simulate(&program(&corners, 900.0, UP), &shop, LengthUnit::Mm).unwrap());
        for _ in 0..4 {
            let mut points = vec![corners[0]];
            for pair in corners.windows(2) {
                let mut shares: Vec<f64> = (0..(random() * 12.0) as usize).map(|_| random()).collect();
                shares.sort_by(f64::total_cmp);
                let between = |share: &f64| {
                    [0, 1, 2].map(|axis| pair[0][axis] + (pair[1][axis] - pair[0][axis]) * share)
                };
                points.extend(shares.iter().map(between));
                points.push(pair[1]);
            }
            let divided = simulate(&program(&points, 900.0, UP), &shop, LengthUnit::Mm).unwrap();
            near(peak(&divided), whole, DIVIDED);
        }
    }
}

#[test]
fn crashes_are_in_no_drawing_of_loads() {
    let text = SLOT.replace("FEDRAT/MMPM,800.0000\n", "RAPID\n");
    let found = simulate(&text, SHOP, LengthUnit::Mm).unwrap();
    assert!(found.faults.rapids_in_material > 0);
    let crash = found.motions.rows.iter().position(|row| row.is_crash && row.rapid).unwrap();
    let row = &found.motions.rows[crash];
    assert!(row.removal_rate_mm3_min.unwrap() > 0.0 && row.peak_removal_rate_mm3_min.is_none(), "{row:?}");
    let series = found.to_time_series("a");
    let thickest = series.moments.iter().filter(|moment| moment.feed_mm_min.is_none());
    assert!(
        thickest.clone().count() > 0
            && thickest.clone().all(|moment| moment.chip_thickness_mm.unwrap_or(0.0) == 0.0)
    );
}

/// The largest rates of a path with each of its lines in so many equal ones.
fn divided_peaks(corners: &[[f64; 3]], parts: &[usize], shop: &str) -> Vec<f64> {
    let rate = |parts: &usize| {
        let mut points = vec![corners[0]];
        for pair in corners.windows(2) {
            points.extend((1..=*parts).map(|part| {
                let share = part as f64 / *parts as f64;
                [0, 1, 2].map(|axis| pair[0][axis] + (pair[1][axis] - pair[0][axis]) * share)
            }));
        }
        peak(&simulate(&program(&points, 600.0, UP), shop, LengthUnit::Mm).unwrap())
    };
    parts.iter().map(rate).collect()
}

#[test]
fn a_descent_has_the_rate_of_its_front_and_its_bottom() {
    let stock = "{ from: [0, 0, -30], to: [80, 40, 0] }";
    let corners = [[10.0, 20.0, 1.0], [60.0, 20.0, -9.0], [10.0, 20.0, -9.0]];
    // The front of a flat end takes w d, and the bottom sinks over its whole disc: pi R^2 tan(a). The mean over the last
    // 2 mm counts, where the tip is 0.2 mm higher in the middle.
    let slope: f64 = 10.0 / 50.0;
    let level = 600.0 / slope.hypot(1.0);
    let flat = (10.0 * (9.0 - slope) + std::f64::consts::PI * 25.0 * slope) * level;
    for corner in [0.0, 2.0, 5.0] {
        let shop = shop(stock, 10.0, corner);
        let found = divided_peaks(&corners, &[1, 2, 7, 31], &shop);
        if corner == 0.0 {
            near(found[0], flat, 0.02);
        }
        found.iter().for_each(|rate| near(*rate, found[0], DIVIDED));
    }
}

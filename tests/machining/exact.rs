//! The fast model, filled by the dexels, against the path of every tooth.

use super::{SETUP, machine, nx};
use clsmith::cutter::{Meridian, Teeth};
use clsmith::engagement::{ToothMotion, ToothSampling, measure_exact_chips};
use clsmith::program::record::SpindleDirection;
use nalgebra::Point3;

/// A pass from (-8, y, z) to (12, y, z) over the block, climbing or falling by `rise`.
fn compare(corner: f64, y: f64, z: f64, rise: f64, teeth: &Teeth) {
    let tool = format!("10.0000,{corner:.4},75.0000,0.0000,0.0000");
    let body = format!("GOTO/-8.0000,{y:.4},{z:.4}\nGOTO/12.0000,{y:.4},{:.4}\n", z + rise);
    let (found, _) = machine(&nx(&tool, &body), SETUP, 0.05);
    let (feed, rpm) = (1000.0, 5000.0);
    let fast = found[1].chip_thickness_mm(teeth, feed, rpm);
    let bound = found[1].chip_thickness_bound_mm(teeth, feed, rpm);
    let profile = Meridian::new(10.0, corner, 0.0, 0.0, 40.0).unwrap();
    // The last millimetres are steady; the way before is known to be cut.
    let motion = ToothMotion {
        from: Point3::new(10.0, y, z + rise * 0.9),
        to: Point3::new(12.0, y, z + rise),
        feed_mm_min: feed,
        rpm,
        spindle: SpindleDirection::Clockwise,
    };
    let height = (-z).max(-(z + rise));
    let fineness = ToothSampling { looks: 60, points: 61, height_mm: height * 0.999, tolerance_mm: 1e-5 };
    let inside = |point: Point3<f64>| {
        point.x > 0.0 && point.y.abs() < 30.0 && point.z < 0.0 && {
            // What the way to the start of the motion has already taken.
            let (dx, dy) = (point.x - 10.0, point.y - y);
            let side = if dx < 0.0 { dy.abs() } else { dx.hypot(dy) };
            let tip = z + rise * 0.9;
            side > 5.0 || point.z < tip + profile.height_at_radius_mm(side)
        }
    };
    let exact = measure_exact_chips(&profile, teeth, &motion, fineness, inside).largest_mm;
    let what =
        format!("corner {corner}, y {y}, z {z}, rise {rise}: exact {exact}, fast {fast}, bound {bound}");
    assert!(exact <= bound * 1.01 + 1e-5, "{what}");
    assert!(exact >= 0.85 * fast, "{what}");
}

#[test]
fn fast_and_exact_agree() {
    let teeth = Teeth::evenly_spaced(2, 0.0).unwrap();
    compare(0.0, 0.0, -3.0, 0.0, &teeth);
    compare(0.0, 32.5, -3.0, 0.0, &teeth);
    compare(5.0, 0.0, -1.0, 0.0, &teeth);
    compare(1.0, 0.0, -0.5, 0.0, &teeth);
    let uneven = Teeth::unevenly_spaced(vec![2.8, 3.4], vec![0.0, 0.01], 0.0).unwrap();
    compare(0.0, 0.0, -3.0, 0.0, &uneven);
}

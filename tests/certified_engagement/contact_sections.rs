//! What of a cutter cuts at one moment: arcs at the side of the cutter, down to skimming cuts.

use super::loads::{Mill, block_at, certified, one_mill};
use clsmith::cutter::Teeth;
use std::f64::consts::FRAC_PI_2;

#[test]
fn skimming_cuts_are_found_at_the_side_of_the_cutter() {
    let teeth = Teeth::evenly_spaced(2, 0.5).unwrap();
    let mill = Mill { numbers: [10.0, 0.0, 0.0, 0.0, 30.0], teeth, left: 1.0 };
    for (width, side) in [(1e-4, 1.0), (1e-4, -1.0), (1e-3, 1.0), (0.01, -1.0), (0.5, 1.0), (4.0, -1.0)] {
        let along = |y: f64| block_at([-20.0, y, -3.0], [20.0, y, -3.0]);
        let made = one_mill(&mill, vec![along(0.0), along(side * width)]);
        let section = certified(&made).find_contact_section(1, 0.5).unwrap();
        // A strip of this width beside the path of before: cos of the angle from the side is 1 - width / R.
        let wanted = (1.0 - width / 5.0_f64).acos();
        assert!(!section.is_empty(), "{width}: nothing found");
        for row in &section.rows {
            let arcs: Vec<_> = row.arcs.iter().map(|[from, to]| [from * side, to * side]).collect();
            assert_eq!(arcs.len(), 1, "{width}: {arcs:?}");
            let (near, far) = (arcs[0][0].min(arcs[0][1]), arcs[0][0].max(arcs[0][1]));
            assert!(
                (far - FRAC_PI_2).abs() < 1e-3 && (far - near - wanted).abs() < 1e-3,
                "{width}: {near} {far}"
            );
        }
        let height: f64 = section
            .rows
            .iter()
            .map(|row| {
                let [low, high] = row.range.map(|at| row.element.point(at)[1]);
                high - low
            })
            .sum();
        assert!((height - 3.0).abs() < 0.01, "{width}: {height}");
    }
}

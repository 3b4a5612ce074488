//! What tilted tools engage: shares, contacts, material beside the flank, collars.

use super::tilted::{V, leaning, near, place, run};
use super::{block, cutter};
use clsmith::cutter::{Meridian, NonCuttingCylinder, NonCuttingKind};
use clsmith::engagement::PathPiece;

/// A long flat cutter at 60 degrees passes through a block: the slot's cross-section is a parallelogram.
#[test]
fn a_tilted_slot_has_the_volume_of_its_parallelogram() {
    let stock = || block([0.0, -30.0, -10.0], [20.0, 30.0, 0.0], 0.1);
    for tilt in [30.0f64, 60.0] {
        let axis = leaning(tilt, 90.0);
        for (d, r) in [(6.0, 0.0), (6.0, 3.0), (6.0, 1.0)] {
            // The tip is far below the block.
            let tip = -V::z() * 5.0 - axis * 20.0;
            let piece = |x: f64, y: f64| PathPiece {
                from: place([-10.0, tip.y, tip.z], axis),
                to: place([x, y + tip.y, tip.z], axis),
                cutter: 0,
            };
            let tool = cutter(d, r, 0.0, 0.0);
            let (_, found) = run(stock(), &tool, &[piece(30.0, 0.0)]);
            let wanted = 20.0 * 10.0 * d / tilt.to_radians().cos();
            near(found[0].removed_mm3, wanted, 2e-3 * wanted);
            near(found[0].max_advance_ratio(), 1.0, 1e-6);
            let front = found[0].bins.iter().filter(|bin| bin.is_engaged() && bin.radial > 0.999).count();
            assert!((58..=62).contains(&front), "the front half of the flank: {front}");
        }
    }
}

#[test]
fn a_lead_angle_shares_feed_between_flank_and_bottom() {
    // Feed along x; leaning forward lifts the heel, leaning back drives the bottom into the material.
    let flat = cutter(10.0, 0.0, 0.0, 0.0);
    for lead in [-10.0f64, 10.0] {
        let stock = block([0.0, -15.0, -10.0], [40.0, 15.0, 0.0], 0.1);
        let axis = leaning(lead.abs(), if lead > 0.0 { 0.0 } else { 180.0 });
        let piece = |from: f64, to: f64| PathPiece {
            from: place([from, 0.0, -4.0], axis),
            to: place([to, 0.0, -4.0], axis),
            cutter: 0,
        };
        let (_, found) = run(stock, &flat, &[piece(-20.0, 20.0), piece(20.0, 25.0)]);
        let angle = lead.abs().to_radians();
        let found = &found[1];
        near(found.across, angle.cos(), 1e-12);
        near(found.max_advance_ratio(), angle.cos(), 1e-3);
        let bottom: Vec<f64> = found
            .bins
            .iter()
            .filter(|bin| bin.is_engaged() && bin.radial < 0.1)
            .map(|bin| f64::from(bin.advance_ratio))
            .collect();
        for share in &bottom {
            near(*share, if lead < 0.0 { angle.sin() } else { 0.0 }, 1e-6);
        }
    }
}

/// Radial depth of a tilted flank: the classic share, in the plane across the axis.
#[test]
fn radial_depth_of_a_tilted_flank() {
    let cell = 0.1;
    let flat = cutter(10.0, 0.0, 0.0, 0.0);
    for depth in [0.5, 2.0, 4.0] {
        // The tool leans by 45 degrees over the block's edge along x, and takes off a strip of the slanting face.
        let axis = leaning(45.0, 90.0);
        let side = axis.cross(&V::x());
        let stock = || {
            let mut stock = block([0.0, -20.0, -20.0], [30.0, 20.0, 0.0], cell);
            let layout = *stock.grid();
            for row in 0..layout.rows {
                for column in 0..layout.columns {
                    let [_, y] = layout.column_center(column, row);
                    // Material where the distance along `side` (down and across) is above 0.
                    let top = (20.0 + y * side.y / -side.z).clamp(0.0, 20.0) as f32;
                    let none = top <= 0.0;
                    let solid = [[0.0, top]];
                    stock.set_column(column, row, if none { &[] } else { &solid });
                }
            }
            stock
        };
        let tip = side * (if side.z < 0.0 { depth - 5.0 } else { 5.0 - depth }) - axis * 20.0;
        let piece = |from: f64, to: f64| PathPiece {
            from: place([from, tip.y, tip.z], axis),
            to: place([to, tip.y, tip.z], axis),
            cutter: 0,
        };
        let (_, found) = run(stock(), &flat, &[piece(-10.0, 12.0), piece(12.0, 15.0)]);
        let classic =
            |depth: f64| if depth >= 5.0 { 1.0 } else { 2.0 * (depth / 10.0 * (1.0 - depth / 10.0)).sqrt() };
        let share = found[1].max_advance_ratio();
        assert!(
            (classic(depth - cell)..=classic(depth + cell)).contains(&share),
            "{depth}: {share}, {}",
            classic(depth)
        );
        let bound = found[1].bins.iter().map(|bin| f64::from(bin.advance_ratio_bound)).fold(0.0, f64::max);
        assert!(bound >= classic(depth) - 1e-6);
    }
}

#[test]
fn cut_ground_engages_nothing_and_grazes() {
    let axis = leaning(15.0, 60.0);
    let piece =
        |from: [f64; 3], to: [f64; 3]| PathPiece { from: place(from, axis), to: place(to, axis), cutter: 0 };
    let flat = cutter(8.0, 0.0, 0.0, 0.0);
    let (a, b) = ([-30.0, 0.0, -4.0], [30.0, 1.0, -4.0]);
    let above = |p: [f64; 3]| [p[0], p[1], 3.0];
    let (_, found) =
        run(super::tilted::cube(0.25), &flat, &[piece(a, b), piece(b, a), piece(above(b), above(a))]);
    assert!(found[0].has_removed_material() && !found[1].has_removed_material(), "{}", found[1].removed_mm3);
    assert!(found[1].graze > 0.1, "walls closer than a cell are known");
    assert!(!found[2].has_removed_material() && found[2].graze == 0.0);
}

#[test]
fn collars_in_material_are_told() {
    let mut tool = cutter(6.0, 3.0, 0.0, 0.0);
    tool.profile = Meridian::new(6.0, 3.0, 0.0, 0.0, 12.0).unwrap();
    tool.collars = vec![
        NonCuttingCylinder { kind: NonCuttingKind::Shank, radius_mm: 2.5, from_mm: 12.0, to_mm: 30.0 },
        NonCuttingCylinder { kind: NonCuttingKind::Holder, radius_mm: 10.0, from_mm: 30.0, to_mm: 60.0 },
    ];
    let axis = leaning(60.0, 0.0);
    let piece = |tip: [f64; 3]| PathPiece {
        from: place(tip, axis),
        to: place([tip[0], tip[1] + 1.0, tip[2]], axis),
        cutter: 0,
    };
    let (_, found) = run(super::tilted::cube(0.25), &tool, &[piece([14.0, 0.0, 0.0])]);
    assert_eq!(found[0].contact, None, "beside the block");
    // The shank's lower rim is at 12 up the axis: 6 above the tip, and 2.5 sin 60 lower at its lowest place.
    let (_, found) = run(super::tilted::cube(0.25), &tool, &[piece([-14.0, 0.0, -5.0])]);
    let (index, depth) = found[0].contact.unwrap();
    assert_eq!(index, 0);
    near(depth, 2.5 * 60f64.to_radians().sin() - 1.0, 0.15);
    let (_, found) = run(super::tilted::cube(0.25), &tool, &[piece([-14.0, 0.0, -2.0])]);
    assert_eq!(found[0].contact, None);
}

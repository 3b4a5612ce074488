//! How passes are joined, and where the tool goes in between.

use super::{along, of_class, options, over};
use crate::surface::solids::{cube, mesh, sphere, terrain};
use clsmith::internals::surface::drop_cutter::{DropCutter, DropCutterShape};
use clsmith::program::MotionClass;
use clsmith::surface_milling::{PassPattern, SurfaceMillingOptions, plane_offsets};
use clsmith::write::new_program::DraftMoveKind;

#[test]
fn planes_are_spread_evenly_and_reach_both_ends() {
    assert_eq!(plane_offsets(0.0, 10.0, 2.5).unwrap(), [0.0, 2.5, 5.0, 7.5, 10.0]);
    assert_eq!(plane_offsets(0.0, 10.0, 3.0).unwrap(), [0.0, 2.5, 5.0, 7.5, 10.0]);
    assert_eq!(plane_offsets(10.0, 0.0, 5.0).unwrap(), [10.0, 5.0, 0.0]);
    assert_eq!(plane_offsets(4.0, 4.0, 5.0).unwrap(), [4.0]);
    assert_eq!(plane_offsets(0.0, 0.3, 0.1).unwrap().len(), 4, "a rounding is no further plane");
    assert_eq!(plane_offsets(0.0, 1e6, 1e-3), None);
}

#[test]
fn zigzag_turns_every_other_plane_and_one_way_does_not() {
    let hill = [[0.0, 0.0], [20.0, 5.0], [40.0, 0.0]];
    let forth = |surfaced: &clsmith::surface_milling::SurfaceProgram| -> Vec<bool> {
        let cuts = of_class(surfaced, MotionClass::Cut);
        let mut planes: Vec<(f64, bool)> = Vec::new();
        for (from, to) in cuts {
            match planes.last().filter(|(y, _)| *y == to.to.y) {
                Some((_, forth)) => assert_eq!(*forth, to.to.x > from.to.x),
                None => planes.push((to.to.y, to.to.x > from.to.x)),
            }
        }
        planes.into_iter().map(|(_, forth)| forth).collect()
    };
    let zigzag = along(&hill, &options());
    assert_eq!(forth(&zigzag), [true, false, true, false, true, false]);
    assert_eq!(of_class(&zigzag, MotionClass::StepOver).len(), 5);
    assert_eq!(of_class(&zigzag, MotionClass::Retract).len(), 1);
    let one_way = along(&hill, &SurfaceMillingOptions { pattern: PassPattern::OneWay, ..options() });
    assert_eq!(forth(&one_way), [true; 6]);
    assert_eq!(of_class(&one_way, MotionClass::StepOver).len(), 0);
    assert_eq!(of_class(&one_way, MotionClass::Retract).len(), 6);
    // Up to 10 mm above the top, across, down to 2 mm above what is beside the pass at rapid, and on at the plunge feed.
    for (from, to) in of_class(&one_way, MotionClass::Retract) {
        assert_eq!((to.to.z, to.way, from.to.x, from.to.y), (15.0, DraftMoveKind::Rapid, to.to.x, to.to.y));
    }
    for (from, to) in of_class(&one_way, MotionClass::Engage) {
        assert_eq!((from.to.x, from.to.y), (to.to.x, to.to.y));
        assert_eq!((from.way, to.way), (DraftMoveKind::Rapid, DraftMoveKind::Line { feed: 300.0 }));
        // 2 mm above the highest place within the ball's radius and those 2 mm.
        let above = from.to.z - to.to.z;
        assert!((2.0..=7.0).contains(&above), "{above}");
    }
}

#[test]
fn between_passes_a_feed_may_stand_for_rapid() {
    let options =
        SurfaceMillingOptions { pattern: PassPattern::OneWay, air_feed_mm_min: Some(5000.0), ..options() };
    let surfaced = along(&[[0.0, 0.0], [40.0, 0.0]], &options);
    let rapids = surfaced.draft.moves.iter().filter(|step| step.way == DraftMoveKind::Rapid).count();
    assert_eq!(rapids, 1, "only to the first point, from wherever the tool is");
    assert!(String::from_utf8(surfaced.text).unwrap().contains("FEDRAT/MMPM,5000.0000\nGOTO/"));
}

/// No motion, rapid or not, may come into the part: looked at every 0.2 mm.
fn stays_outside(part: &clsmith::stock::Mesh, options: &SurfaceMillingOptions) -> usize {
    let surfaced = over(part, options);
    let radius = options.radius_mm;
    let cutter = DropCutter::new(part, DropCutterShape::new(2.0 * radius, radius).unwrap());
    let moves = &surfaced.draft.moves;
    for (from, to) in moves.iter().zip(moves.iter().skip(1)).filter(|(_, to)| to.class != MotionClass::Cut) {
        let count = ((to.to - from.to).norm() / 0.2).ceil().max(1.0);
        let mut step = 0.0;
        while step <= count {
            let at = from.to + (to.to - from.to) * (step / count);
            let least = cutter.drop_at(at.x, at.y).map_or(f64::NEG_INFINITY, |drop| drop.tip_z_mm);
            assert!(at.z >= least - 0.03, "{:?} to {at}: {least} at least", to.class);
            step += 1.0;
        }
        if to.way == DraftMoveKind::Rapid && from.to.x != to.to.x {
            let (_, [.., top]) = part.bounds();
            assert!(to.to.z >= top + options.clearance_mm - 1e-9, "across only above everything");
        }
    }
    of_class(&surfaced, MotionClass::StepOver).len()
}

#[test]
fn nothing_between_passes_comes_into_the_part() {
    let wavy = mesh(&terrain(15.0, 12, |x, y| 6.0 * (x / 4.0).sin() * (y / 5.0).cos()));
    let two: Vec<_> =
        [cube([0.0, 0.0, 0.0], [20.0, 20.0, 20.0]), cube([32.0, 0.0, 0.0], [50.0, 20.0, 8.0])].concat();
    for pattern in [PassPattern::ZigZag, PassPattern::OneWay] {
        let options = SurfaceMillingOptions { pattern, radius_mm: 3.0, ..options() };
        let linked = stays_outside(&wavy, &options);
        assert_eq!(linked > 0, pattern == PassPattern::ZigZag, "zigzag goes over the surface");
        stays_outside(
            &mesh(&sphere(9.0, 16)),
            &SurfaceMillingOptions { floor_mm: Some(-2.0), ..options.clone() },
        );
        let surfaced = over(&mesh(&two), &options);
        assert_eq!(surfaced.passes, 2 * surfaced.planes, "two parts are two passes");
        stays_outside(&mesh(&two), &options);
    }
}

#[test]
fn a_gap_that_the_ball_spans_is_not_gone_into() {
    // Two blocks 4 mm apart: a ball of radius 5 goes in by 5 - sqrt(25 - 4) in the middle, and no further for either of them.
    let two: Vec<_> =
        [cube([0.0, 0.0, 0.0], [20.0, 20.0, 10.0]), cube([24.0, 0.0, 0.0], [50.0, 20.0, 10.0])].concat();
    let against = clsmith::surface_milling::PassHeights::Profile;
    let surfaced = over(&mesh(&two), &SurfaceMillingOptions { against, ..options() });
    assert_eq!(surfaced.passes, 2 * surfaced.planes);
    let cuts = of_class(&surfaced, MotionClass::Cut);
    assert!(cuts.iter().all(|(_, to)| to.to.z == 10.0), "on the tops only");
}

#[test]
fn a_floor_ends_passes() {
    let valley = [[0.0, 10.0], [20.0, 0.0], [40.0, 10.0]];
    let surfaced = along(&valley, &SurfaceMillingOptions { floor_mm: Some(4.0), ..options() });
    assert_eq!(surfaced.passes, 2 * surfaced.planes, "the valley below it is left");
    assert!(surfaced.draft.moves.iter().all(|step| step.to.z >= 4.0 - 1e-4));
}

#[test]
fn a_rapid_ends_above_the_wall_beside_it() {
    // A boss 20 mm high; with the floor at 5 the passes begin beside it.
    let boss = [[0.0, 0.0], [10.0, 0.0], [10.0, 20.0], [30.0, 20.0], [30.0, 0.0], [40.0, 0.0]];
    let surfaced = along(&boss, &SurfaceMillingOptions { floor_mm: Some(5.0), ..options() });
    for (from, to) in of_class(&surfaced, MotionClass::Engage) {
        assert!(from.to.z >= 20.0, "{} {}", from.to, to.to);
    }
}

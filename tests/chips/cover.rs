//! What a step covers, against closed forms and a dense union of sections.

use super::brute;
use super::sections::{axis, block, fresh, piece, place, place_at, section};
use clsmith::engagement::PathPiece;
use clsmith::internals::layered_chips::area::signed_area_mm2;
use clsmith::layered_chips::Polygon;
use clsmith::layered_chips::{
    BoundaryDiagram, FlatMill, LayerSweptArea, MillStep, RimDirections, SectionFamily,
};
use proptest::prelude::*;

fn mill(radius: f64) -> FlatMill {
    FlatMill { radius_mm: radius, flute_length_mm: f64::INFINITY }
}

fn cover_of(mill: FlatMill, piece: &PathPiece, z: f64, tolerance: f64) -> LayerSweptArea {
    let step = MillStep::new(mill, piece).unwrap();
    LayerSweptArea::new(
        &BoundaryDiagram::new(&SectionFamily::new(&step, z)),
        &RimDirections::new(&step, tolerance),
    )
}

/// What is entered and was not covered at the beginning: taken from a large block.
fn chip(cover: &LayerSweptArea) -> Vec<Polygon> {
    let stock = block([-400.0, -400.0, 0.0], [400.0, 400.0, 1.0]);
    clsmith::layered_chips::LayerStack::new(&stock, 1.0).unwrap().layers_mut()[0]
        .remove_swept_area(cover)
        .pieces
}

fn chip_area(cover: &LayerSweptArea) -> f64 {
    chip(cover).iter().map(Polygon::area_mm2).sum()
}

/// Areas of the chip, of the dense union of `count` sections less the first, and of where they differ.
fn compare(mill: FlatMill, piece: &PathPiece, z: f64, count: usize) -> (f64, f64, f64) {
    let ours = chip(&cover_of(mill, piece, z, 0.0005));
    let dense = fresh(&mill, piece, z, count);
    let off = brute::area(&brute::difference(&ours, &dense)) + brute::area(&brute::difference(&dense, &ours));
    (brute::area(&ours), brute::area(&dense), off)
}

#[test]
fn a_straight_step_covers_a_hull_less_a_circle() {
    for (way, z) in [([3.0, 0.0, 0.0], 5.0), ([0.3, -0.4, 0.0], 1.0), ([20.0, 5.0, 0.0], 2.0)] {
        let p = piece(
            place([1.0, 2.0, 0.0], [0.0, 0.0, 1.0]),
            place([1.0 + way[0], 2.0 + way[1], 0.0], [0.0, 0.0, 1.0]),
        );
        let cover = cover_of(mill(5.0), &p, z, 1e-5);
        let length = f64::hypot(way[0], way[1]);
        // Hull of two circles: 2 R L + pi R^2, less the circle.
        let expected = 10.0 * length;
        assert!((chip_area(&cover) - expected).abs() < 1e-4 * expected, "{} {expected}", chip_area(&cover));
        assert!((signed_area_mm2(&cover.first) - 25.0 * std::f64::consts::PI).abs() < 1e-3);
    }
}

#[test]
fn steps_agree_with_a_dense_union() {
    let cases: Vec<(&str, FlatMill, PathPiece, f64)> = vec![
        (
            "ramp",
            mill(5.0),
            piece(place([0.0; 3], axis(0.0, 0.0)), place([4.0, 1.0, -2.0], axis(0.0, 0.0))),
            3.0,
        ),
        (
            "ramp into the layer",
            mill(5.0),
            piece(place([0.0, 0.0, 1.0], axis(0.0, 0.0)), place([4.0, 1.0, -2.0], axis(0.0, 0.0))),
            0.3,
        ),
        (
            "tilted, straight",
            mill(5.0),
            piece(place([0.0; 3], axis(30.0, 40.0)), place([4.0, 1.0, -2.0], axis(30.0, 40.0))),
            8.0,
        ),
        (
            "tilted, on the bottom",
            mill(5.0),
            piece(place([0.0; 3], axis(30.0, 40.0)), place([4.0, 1.0, -0.5], axis(30.0, 40.0))),
            0.7,
        ),
        (
            "tilt about the tip, in its layer",
            mill(5.0),
            piece(place([0.0; 3], axis(5.0, 0.0)), place([0.0; 3], axis(25.0, 0.0))),
            0.1,
        ),
        (
            "tilt about the tip",
            mill(5.0),
            piece(place([0.0; 3], axis(0.0, 0.0)), place([0.0; 3], axis(25.0, 0.0))),
            6.0,
        ),
        (
            "tilt through upright",
            mill(5.0),
            piece(place([0.0; 3], axis(10.0, 180.0)), place([0.0; 3], axis(10.0, 0.0))),
            6.0,
        ),
        (
            "tilt about a far point",
            mill(5.0),
            piece(place([0.0; 3], axis(20.0, 0.0)), place([-20.0, 0.0, 3.0], axis(5.0, 180.0))),
            12.0,
        ),
        (
            "tilt about a point in the layer",
            mill(5.0),
            piece(place([2.7, 0.0, 0.0], axis(-20.0, 0.0)), place([-2.7, 0.5, 0.0], axis(20.0, 0.0))),
            7.5,
        ),
        (
            "turning and moving across",
            mill(3.0),
            piece(place([0.0; 3], axis(40.0, 0.0)), place([1.0, 2.0, 0.5], axis(40.0, 60.0))),
            4.0,
        ),
        (
            "turning on the bottom",
            mill(6.0),
            piece(place([0.0; 3], axis(20.0, 0.0)), place([1.0, 2.0, 0.5], axis(35.0, 80.0))),
            1.0,
        ),
        (
            "swinging down through the layer",
            mill(6.0),
            piece(place([0.0, 0.0, 1.5], axis(10.0, 0.0)), place([1.0, 0.0, 0.0], axis(15.0, 180.0))),
            1.2,
        ),
        (
            "upper end of short flutes",
            FlatMill { radius_mm: 4.0, flute_length_mm: 6.0 },
            piece(place([0.0; 3], axis(25.0, 10.0)), place([2.0, 1.0, 1.0], axis(35.0, 30.0))),
            5.5,
        ),
        (
            "both ends at once",
            FlatMill { radius_mm: 8.0, flute_length_mm: 2.0 },
            piece(place([0.0; 3], axis(40.0, 10.0)), place([3.0, 1.0, 1.0], axis(50.0, 30.0))),
            1.5,
        ),
        (
            "leaving the layer",
            mill(5.0),
            piece(place([0.0, 0.0, -1.0], axis(20.0, 90.0)), place([3.0, 0.0, 4.0], axis(25.0, 70.0))),
            0.5,
        ),
        (
            "upside down",
            mill(5.0),
            piece(place([0.0; 3], [0.3, 0.1, -0.9]), place([2.0, 1.0, 0.5], [0.1, 0.4, -0.8])),
            -4.0,
        ),
    ];
    for (name, mill, piece, z) in cases {
        let (ours, dense, off) = compare(mill, &piece, z, 2000);
        // Sections of 360 corners are off by 0.0002 of the radius along their edges.
        assert!(off <= 0.02 + 1e-3 * dense, "{name}: {ours} against {dense}, off by {off}");
        assert!((ours - dense).abs() <= 1e-3 * dense + 0.01, "{name}: {ours} against {dense}");
    }
}

#[test]
fn the_outlines_are_the_sections() {
    let m = FlatMill { radius_mm: 5.0, flute_length_mm: 8.0 };
    let p = piece(place([0.0; 3], axis(30.0, 20.0)), place([3.0, 1.0, 1.0], axis(45.0, 100.0)));
    for z in [-1.0, 0.5, 3.0, 6.5, 9.0] {
        let cover = cover_of(m, &p, z, 1e-4);
        for (ours, t) in [(&cover.first, 0.0), (&cover.last, 1.0)] {
            let brute = section(&m, &place_at(&p, t), z);
            let (ours, brute) = (signed_area_mm2(ours), signed_area_mm2(&brute));
            assert!((ours - brute).abs() < 2e-4 * brute + 1e-6, "z {z}: {ours} {brute}");
        }
    }
}

proptest! {
    #![proptest_config(crate::support::property(16))]

    #[test]
    fn random_steps_agree_with_slices(
        tilts in prop::array::uniform2(0.0..60.0f64),
        towards in 0.0..360.0f64,
        turn in -60.0..60.0f64,
        way in prop::array::uniform3(-4.0..4.0f64),
        radius in 1.0..8.0f64,
        flutes in prop_oneof![Just(f64::INFINITY), 3.0..12.0f64],
        z in -2.0..9.0f64,
    ) {
        let p = piece(place([0.0; 3], axis(tilts[0], towards)), place(way, axis(tilts[1], towards + turn)));
        let m = FlatMill { radius_mm: radius, flute_length_mm: flutes };
        let step = MillStep::new(m, &p).unwrap();
        let (family, rim) = (SectionFamily::new(&step, z), RimDirections::new(&step, 0.002));
        let diagram = BoundaryDiagram::new(&family);
        prop_assert!(diagram.is_resolved());
        let ours = chip(&LayerSweptArea::new(&diagram, &rim));
        // What is within the tolerance of the edges, and slices in which a section comes or goes.
        let edges = 0.002 * 8.0 * (radius + 8.0) / 0.5 + 0.05;
        // Where a corner of the section turns about the tip, slices leave a tooth between each two: the oracle is taken
        // finer until it has converged, and an error of ours would stay.
        let mut told = (f64::INFINITY, 0.0);
        for count in [60, 480, 3840] {
            let slices = chip(&LayerSweptArea::from_slices(&family, &rim, count));
            let off = brute::area(&brute::difference(&ours, &slices)) + brute::area(&brute::difference(&slices, &ours));
            told = (off, brute::area(&slices));
            if off <= edges + 1e-3 * told.1 {
                break;
            }
        }
        prop_assert!(told.0 <= edges + 1e-3 * told.1, "off by {} of {}", told.0, told.1);
    }
}

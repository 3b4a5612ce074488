//! Chips of whole pieces of path: volumes, arcs, thickness.

use super::brute;
use super::sections::{axis, block, fresh, piece, place};
use clsmith::engagement::{PathPiece, Simulation};
use clsmith::layered_chips::{Chip, FlatMill, LayerStack, MillStepError, cut_chips};
use clsmith::stock::{Dexels, Stock};
use proptest::prelude::*;

const MILL: FlatMill = FlatMill { radius_mm: 5.0, flute_length_mm: 30.0 };

fn chips(stock: &Stock, layer: f64, pieces: &[PathPiece]) -> (LayerStack, Vec<Result<Chip, MillStepError>>) {
    let mut stack = LayerStack::new(stock, layer).unwrap();
    let chips = cut_chips(&mut stack, &[MILL], pieces, 0.001);
    (stack, chips)
}

fn upright(x: f64, y: f64, z: f64) -> clsmith::program::geometry::Pose {
    place([x, y, z], [0.0, 0.0, 1.0])
}

#[test]
fn a_slot_is_engaged_over_half_a_turn() {
    let stock = block([0.0, -20.0, -10.0], [60.0, 20.0, 0.0]);
    let (stack, chips) = chips(
        &stock,
        0.5,
        &[
            piece(upright(-6.0, 0.0, -4.0), upright(20.0, 0.0, -4.0)),
            piece(upright(20.0, 0.0, -4.0), upright(21.0, 0.0, -4.0)),
        ],
    );
    let chip = chips[1].as_ref().unwrap();
    assert_eq!(chip.layers.len(), 8);
    assert!((chip.volume_mm3() - 10.0 * 1.0 * 4.0).abs() < 0.02, "{}", chip.volume_mm3());
    for layer in &chip.layers {
        assert_eq!(layer.arcs_deg.len(), 1);
        let [from, to] = layer.arcs_deg[0];
        assert!((from + 90.0).abs() < 1.0 && (to - 90.0).abs() < 1.0, "{from} {to}");
        assert!((layer.advance_mm - 1.0).abs() < 1e-3);
        assert_eq!(layer.inside_mm2, 0.0);
    }
    let removed: f64 = chips.iter().map(|chip| chip.as_ref().unwrap().volume_mm3()).sum();
    assert!((stack.volume_mm3() + removed - 60.0 * 40.0 * 10.0).abs() < 1e-3);
}

#[test]
fn a_side_cut_is_engaged_from_its_depth() {
    // The stock reaches 2 mm into the cutter from the left: from acos((R - a) / R) behind 90 degrees.
    let stock = block([0.0, 3.0, -4.0], [60.0, 30.0, 0.0]);
    let (_, chips) = chips(
        &stock,
        1.0,
        &[
            piece(upright(-6.0, 0.0, -4.0), upright(20.0, 0.0, -4.0)),
            piece(upright(20.0, 0.0, -4.0), upright(20.2, 0.0, -4.0)),
        ],
    );
    let layer = &chips[1].as_ref().unwrap().layers[0];
    let [from, to] = layer.arcs_deg[0];
    let entry = (3.0f64 / 5.0).asin().to_degrees();
    assert!((from - entry).abs() < 1.0 && (to - 90.0).abs() < 1.5, "{from} {to} {entry}");
    // The thickest place is where the tooth meets the stock's old side.
    assert!((layer.advance_mm - 0.2 * (1.0 - 0.36f64).sqrt()).abs() < 0.003, "{}", layer.advance_mm);
}

#[test]
fn a_plunge_takes_whole_discs_and_its_advance_is_its_depth() {
    let stock = block([-20.0, -20.0, -10.0], [20.0, 20.0, 0.0]);
    let (_, chips) = chips(&stock, 0.5, &[piece(upright(0.0, 0.0, 1.0), upright(0.0, 0.0, -3.0))]);
    let chip = chips[0].as_ref().unwrap();
    assert_eq!(chip.layers.len(), 6);
    assert!((chip.volume_mm3() - 3.0 * 25.0 * std::f64::consts::PI).abs() < 0.1);
}

#[test]
fn what_stood_inside_at_the_beginning_is_no_chip() {
    let stock = block([-20.0, -20.0, -2.0], [20.0, 20.0, 0.0]);
    let (_, chips) = chips(&stock, 1.0, &[piece(upright(0.0, 0.0, -2.0), upright(1.0, 0.0, -2.0))]);
    let layer = &chips[0].as_ref().unwrap().layers[0];
    assert!((layer.inside_mm2 - 25.0 * std::f64::consts::PI).abs() < 0.05);
    assert!((layer.area_mm2 - 10.0).abs() < 0.01);
}

#[test]
fn a_chip_may_be_two_pieces() {
    // Tilting about a point in the layer, with the middle already milled: both ends of the section go down into the stock.
    let stock = Stock::new(
        vec![
            clsmith::stock::SolidBody::Block { from: [-20.0, -20.0, 0.0], to: [-4.9, 20.0, 1.0] },
            clsmith::stock::SolidBody::Block { from: [4.9, -20.0, 0.0], to: [20.0, 20.0, 1.0] },
        ],
        0.0,
    )
    .unwrap();
    let p = piece(place([0.0, 0.0, -10.0], axis(0.0, 0.0)), place([-3.0, 0.0, -9.5], axis(16.0, 0.0)));
    let (_, chips) = chips(&stock, 1.0, &[p]);
    let layer = &chips[0].as_ref().unwrap().layers[0];
    assert_eq!(layer.pieces.len(), 2, "{layer:?}");
    let dense = brute::area(&brute::intersection(
        &fresh(&MILL, &p, 0.5, 2000),
        &brute::dense_union(&[
            vec![[-20.0, -20.0], [-4.9, -20.0], [-4.9, 20.0], [-20.0, 20.0]],
            vec![[4.9, -20.0], [20.0, -20.0], [20.0, 20.0], [4.9, 20.0]],
        ]),
    ));
    assert!((layer.area_mm2 - dense).abs() < 1e-3 * dense + 0.003, "{} {dense}", layer.area_mm2);
}

#[test]
fn a_wall_between_two_places_of_the_edge_is_not_engaged() {
    // The slot ends with the edge half through the wall: acos(2 / 5) from straight ahead nothing is left.
    let stock = block([0.0, -20.0, -4.0], [22.0, 20.0, 0.0]);
    let (_, chips) = chips(&stock, 4.0, &[piece(upright(-6.0, 0.0, -4.0), upright(20.0, 0.0, -4.0))]);
    let layer = &chips[0].as_ref().unwrap().layers[0];
    let free = (2.0f64 / 5.0).acos().to_degrees();
    assert_eq!(layer.arcs_deg.len(), 2, "{:?}", layer.arcs_deg);
    let ends: Vec<f64> = layer.arcs_deg.iter().flatten().copied().collect();
    for (found, expected) in ends.iter().zip([-90.0, -free, free, 90.0]) {
        assert!((found - expected).abs() < 2.0, "{ends:?}");
    }
    assert!((layer.advance_mm - 26.0 * free.to_radians().cos()).abs() < 0.4, "{}", layer.advance_mm);
}

#[test]
fn an_edge_that_has_left_the_layer_is_not_engaged() {
    // Up along a tilted axis, with flutes of 1 mm: at the end they are far above.
    let mill = FlatMill { radius_mm: 5.0, flute_length_mm: 1.0 };
    let mut stack = LayerStack::new(&block([-30.0, -30.0, -4.0], [30.0, 30.0, 0.0]), 2.0).unwrap();
    let way = piece(place([0.0, 0.0, -4.0], axis(20.0, 0.0)), place([20.0, 0.0, 50.0], axis(20.0, 0.0)));
    for chip in cut_chips(&mut stack, &[mill], &[way], 0.001) {
        for layer in chip.unwrap().layers {
            assert!(layer.arcs_deg.is_empty() && layer.advance_mm == 0.0, "{layer:?}");
        }
    }
}

#[test]
fn a_bottom_at_a_layers_height_leaves_it_alone() {
    // Layer middles at -0.5, -1.5, ...: down to one, and along it.
    let stock = block([-20.0, -20.0, -4.0], [20.0, 20.0, 0.0]);
    let (_, chips) = chips(
        &stock,
        1.0,
        &[
            piece(upright(0.0, 0.0, 1.0), upright(0.0, 0.0, -1.5)),
            piece(upright(0.0, 0.0, -1.5), upright(4.0, 0.0, -1.5)),
        ],
    );
    for chip in chips {
        let layers = chip.unwrap().layers;
        assert_eq!(layers.iter().map(|layer| layer.layer).collect::<Vec<_>>(), [3]);
        assert_eq!(layers[0].inside_mm2, 0.0);
    }
}

#[test]
fn a_thin_disc_that_swings_through_a_layer_is_cut_soon() {
    let mill = FlatMill { radius_mm: 10.0, flute_length_mm: 1.0 };
    let mut stack = LayerStack::new(&block([-30.0, -30.0, -4.0], [30.0, 30.0, -3.0]), 1.0).unwrap();
    let from = place([5.3035, -0.1236, -6.8933], [0.3797, -0.0545, 0.9235]);
    let to = place([6.9967, -1.3920, -5.1990], [0.2005, -0.2829, 0.9379]);
    let begun = std::time::Instant::now();
    let chip = cut_chips(&mut stack, &[mill], &[piece(from, to)], 0.002).remove(0).unwrap();
    let dense = brute::area(&fresh(&mill, &piece(from, to), -3.5, 2000));
    let area: f64 = chip.layers.iter().map(|layer| layer.area_mm2).sum();
    assert!((area - dense).abs() < 2e-3 * dense + 0.05, "{area} {dense}");
    assert!(begun.elapsed().as_secs() < 60);
}

#[test]
fn thinner_layers_converge() {
    let stock = block([-20.0, -20.0, -6.0], [20.0, 20.0, 0.0]);
    let p = piece(place([0.0, 0.0, -3.0], axis(20.0, 30.0)), place([2.0, 1.0, -3.5], axis(28.0, 50.0)));
    let volume = |layer: f64| {
        let first =
            piece(place([0.0, 0.0, 10.0], axis(20.0, 30.0)), place([0.0, 0.0, -3.0], axis(20.0, 30.0)));
        chips(&stock, layer, &[first, p]).1[1].as_ref().unwrap().volume_mm3()
    };
    let finest = volume(0.01);
    let errors: Vec<f64> =
        [0.5, 0.125, 0.03125].into_iter().map(|layer| (volume(layer) - finest).abs()).collect();
    // The bottom disc's rim cuts layers off, so the error goes with the layer, or better.
    assert!(
        errors[0] < 0.02 * finest && errors[1] < 0.006 * finest && errors[2] < 0.002 * finest,
        "{errors:?} of {finest}"
    );
}

#[test]
fn results_do_not_depend_on_threads() {
    let stock = block([-20.0, -20.0, -6.0], [20.0, 20.0, 0.0]);
    let pieces = [
        piece(place([-30.0, 0.0, -3.0], axis(20.0, 30.0)), place([2.0, 1.0, -3.5], axis(28.0, 50.0))),
        piece(place([2.0, 1.0, -3.5], axis(28.0, 50.0)), place([6.0, -3.0, -3.0], axis(10.0, 90.0))),
    ];
    let run = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| chips(&stock, 0.25, &pieces).1)
    };
    assert_eq!(run(1), run(2));
}

/// Volumes of the same pieces by dexels, and how far half a cell along all borders may make them wrong.
fn by_dexels(stock: &Stock, pieces: &[PathPiece], cell: f64) -> Vec<f64> {
    let profile =
        clsmith::cutter::Meridian::new(2.0 * MILL.radius_mm, 0.0, 0.0, 0.0, MILL.flute_length_mm).unwrap();
    let cutter = clsmith::cutter::CutterModel { profile, collars: Vec::new(), teeth: None };
    let dexels: Dexels = stock.to_dexels(cell, usize::MAX).unwrap();
    let mut simulation = Simulation::new(dexels, false);
    simulation.sweep_pieces(pieces, &[cutter]).into_iter().map(|engagement| engagement.removed_mm3).collect()
}

proptest! {
    #![proptest_config(crate::support::property(12))]

    #[test]
    fn dexels_and_layers_agree_on_random_steps(
        tilts in prop::array::uniform2(0.0..35.0f64),
        towards in prop::array::uniform2(0.0..60.0f64),
        way in prop::array::uniform3(-3.0..3.0f64),
        depth in -5.0..-1.0f64,
    ) {
        let stock = block([-15.0, -15.0, -9.0], [15.0, 15.0, 0.0]);
        let above = place([-25.0, 0.0, depth], axis(tilts[0], towards[0]));
        let from = place([0.0, 0.0, depth], axis(tilts[0], towards[0]));
        let to = place([way[0], way[1], depth + way[2]], axis(tilts[1], towards[1]));
        let pieces = [piece(above, from), piece(from, to)];
        let (cell, layer) = (0.1, 0.1);
        let (_, layers) = chips(&stock, layer, &pieces);
        let dexels = by_dexels(&stock, &pieces, cell);
        for (chip, dexels) in layers.iter().zip(dexels) {
            let volume = chip.as_ref().unwrap().volume_mm3();
            // Columns sample a border to half a cell, layers a slope to half a layer; both errors mostly cancel around the chip. The chip's
            // surface is at most that of both ends' sections and the swept sides.
            let surface = 2.0 * (2.0 * MILL.radius_mm + 25.0) * 9.0;
            let bound = 0.05 * 0.5 * (cell + layer) * surface + 0.02 * volume;
            prop_assert!((volume - dexels).abs() <= bound, "{volume} {dexels} bound {bound}");
        }
    }
}

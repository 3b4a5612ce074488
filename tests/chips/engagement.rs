//! Engagement from chips: closed forms in three axes, and against the dexel simulation in five.

use super::sections::{axis, block, piece, place};
use clsmith::chips::{FlatMill, Stack, cut, engagement};
use clsmith::sim::{Cutter, Engagement, Piece, Profile, Simulation, Stock};
use proptest::prelude::*;

const MILL: FlatMill = FlatMill { radius: 5.0, flutes: 30.0 };
const TOLERANCE: f64 = 0.001;

fn engaged(stock: &Stock, layer: f64, pieces: &[Piece]) -> Vec<Engagement> {
    let mut stack = Stack::new(stock, layer).unwrap();
    let chips = cut(&mut stack, &[MILL], pieces, TOLERANCE);
    let found = pieces.iter().zip(chips);
    found.map(|(piece, chip)| engagement(&chip.unwrap(), &MILL, piece, TOLERANCE)).collect()
}

fn upright(x: f64, y: f64, z: f64) -> clsmith::sim::Place {
    place([x, y, z], [0.0, 0.0, 1.0])
}

/// In and then 1 mm on, 4 mm deep, along y = 0.
fn straight() -> [Piece; 2] {
    [
        piece(upright(-6.0, 0.0, -4.0), upright(20.0, 0.0, -4.0)),
        piece(upright(20.0, 0.0, -4.0), upright(21.0, 0.0, -4.0)),
    ]
}

fn bound(found: &Engagement) -> f64 {
    found.bins.iter().map(|bin| f64::from(bin.share_bound)).fold(found.graze, f64::max)
}

/// Degrees of the middles of the bins engaged.
fn directions(found: &Engagement) -> Vec<f64> {
    let middles = (0..found.bins.len()).map(|index| 3.0 * index as f64 - 178.5);
    middles.zip(&found.bins).filter(|(_, bin)| bin.is_engaged()).map(|(at, _)| at).collect()
}

#[track_caller]
fn near(found: f64, wanted: f64, tolerance: f64) {
    assert!((found - wanted).abs() <= tolerance, "found {found}, wanted {wanted} within {tolerance}");
}

#[test]
fn a_slot_engages_half_a_turn_and_all_of_the_feed() {
    let stock = block([0.0, -20.0, -10.0], [60.0, 20.0, 0.0]);
    let found = &engaged(&stock, 0.5, &straight())[1];
    near(found.share(), 1.0, 1e-3);
    near(bound(found), 1.0, 1e-3);
    near(found.removed_mm3, 40.0, 0.02);
    near(found.length_mm, 1.0, 1e-12);
    near(found.axial_depth_mm(), 4.0, 1e-3);
    near(found.radial_depth_mm(), 10.0, 0.02);
    let directions = directions(found);
    assert!(directions.iter().all(|at| at.abs() < 90.0) && directions.len() >= 58, "{directions:?}");
    for (at, bin) in directions.iter().zip(found.engaged()) {
        let [most, least] = [at.abs() - 1.5, at.abs() + 1.5].map(|at| at.to_radians().cos());
        let [share, bound] = [bin.share, bin.share_bound].map(f64::from);
        assert!(share >= least - 0.01 && share <= most + 0.01, "{at}: {share} of {least}..{most}");
        assert!(bound >= most - 0.03 && bound <= most + 0.06, "{at}: {bound} of {most}");
        // Heights from the tip to the upper side of the stock, as lengths along the meridian.
        near(f64::from(bin.low), 5.0, 1e-3);
        near(f64::from(bin.high), 9.0, 1e-3);
        assert!(f64::from(bin.thickness) <= 1.0 + 0.01, "a chip of a millimetre: {}", bin.thickness);
    }
}

#[test]
fn a_side_cut_has_the_share_of_its_entry() {
    // 2 mm of the radius of 5 are engaged, to the left: the tooth meets the stock's old side at asin(3 / 5).
    let stock = block([0.0, 3.0, -4.0], [60.0, 30.0, 0.0]);
    let found = &engaged(&stock, 1.0, &straight())[1];
    // At the start of the piece, before the cutter has cleared the corner, the same.
    near(found.share(), 0.8, 2e-3);
    assert!(bound(found) >= 0.8 && bound(found) < 0.815, "{}", bound(found));
    let directions = directions(found);
    assert!(directions.iter().all(|at| (36.8 - 1.5..=91.5).contains(at)), "{directions:?}");
    let [right, left] = found.lateral;
    near(right, 3.0, 2e-3);
    near(left, 5.0, 2e-3);
    // From the right, the same mirrored.
    let stock = block([0.0, -30.0, -4.0], [60.0, -3.0, 0.0]);
    let mirrored = &engaged(&stock, 1.0, &straight())[1];
    near(mirrored.share(), 0.8, 2e-3);
    assert!(mirrored.lateral[1] < -2.9);
}

#[test]
fn a_plunge_advances_with_all_of_the_bottom() {
    let stock = block([-20.0, -20.0, -10.0], [20.0, 20.0, 0.0]);
    let found = &engaged(&stock, 0.5, &[piece(upright(0.0, 0.0, 1.0), upright(0.0, 0.0, -3.0))])[0];
    near(found.share(), 1.0, 1e-9);
    near(found.along, -1.0, 1e-12);
    assert!(found.engaged().all(|bin| bin.radial == 0.0 && f64::from(bin.high) <= 5.001));
    assert!(found.engaged().count() == 120 && found.engaged().all(|bin| bin.low < 1.0));
}

#[test]
fn a_cutter_that_begins_in_material_has_the_largest_share() {
    let stock = block([-20.0, -20.0, -2.0], [20.0, 20.0, 0.0]);
    let found = &engaged(&stock, 1.0, &[piece(upright(0.0, 0.0, -2.0), upright(0.3, 0.0, -2.0))])[0];
    near(bound(found), 1.0, 1e-3);
    near(found.removed_mm3, 2.0 * (25.0 * std::f64::consts::PI + 3.0), 0.2);
}

#[test]
fn a_wall_that_is_cut_again_is_air() {
    let stock = block([0.0, -20.0, -4.0], [60.0, 20.0, 0.0]);
    let along =
        |axis: [f64; 3], x: f64, to: f64| piece(place([x, 0.0, -4.0], axis), place([to, 0.0, -4.0], axis));
    let tilted = axis(12.0, 70.0);
    // The same slot again from places between those of the first pass.
    let mut pieces = vec![along(tilted, -8.0, 70.0), along(tilted, 70.0, -8.3)];
    pieces.extend((0..60).map(|index| f64::from(index) - 8.3).map(|x| along(tilted, x, x + 1.0)));
    let found = engaged(&stock, 0.5, &pieces);
    assert!(found[0].cuts());
    for (index, again) in found.iter().enumerate().skip(1) {
        assert!(!again.cuts() && again.engaged().count() == 0, "{index}: {again:?}");
    }
}

fn by_dexels(stock: &Stock, pieces: &[Piece], cell: f64) -> Vec<Engagement> {
    let profile = Profile::new(2.0 * MILL.radius, 0.0, 0.0, 0.0, MILL.flutes).unwrap();
    let cutter = Cutter { profile, collars: Vec::new(), teeth: None };
    Simulation::new(stock.dexels(cell, usize::MAX).unwrap(), false).run(pieces, &[cutter])
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(16))]

    #[test]
    fn dexels_and_layers_agree_on_the_shares_of_random_steps(
        tilts in prop::array::uniform2(0.0..35.0f64),
        towards in prop::array::uniform2(0.0..60.0f64),
        way in prop::array::uniform3(-1.0..1.0f64),
        side in -9.0..4.0f64,
        depth in -5.0..-1.0f64,
    ) {
        prop_assume!(way[0].hypot(way[1]) > 0.2);
        let stock = block([-8.0, side, -7.0], [8.0, 13.0, 0.0]);
        let above = place([-17.0, 0.0, depth], axis(tilts[0], towards[0]));
        let from = place([0.0, 0.0, depth], axis(tilts[0], towards[0]));
        let to = place([way[0], way[1], depth + 0.3 * way[2]], axis(tilts[1], towards[1]));
        let pieces = [piece(above, from), piece(from, to)];
        let layers = &engaged(&stock, 0.1, &pieces)[1];
        let dexels = &by_dexels(&stock, &pieces, 0.1)[1];
        // Slivers that one of them sees and the other one does not.
        prop_assume!(dexels.removed_mm3 > 0.5 && layers.removed_mm3 > 0.5);
        // A contact of columns is known to a cell, over which the turn changes the share.
        let turn = from.axis.angle(&to.axis);
        let hidden = 0.01 + 0.1 * turn / layers.length_mm;
        let (estimate, most) = (dexels.share(), bound(dexels).max(dexels.share()));
        prop_assert!(layers.share() <= most + hidden, "layers {} dexels {estimate}..{most}", layers.share());
        prop_assert!(estimate <= bound(layers) + hidden, "dexels {estimate} layers {}..{}", layers.share(), bound(layers));
        prop_assert!(bound(layers) - layers.share() <= 0.1 * (1.0 + layers.share()), "{} {}", layers.share(), bound(layers));
    }
}

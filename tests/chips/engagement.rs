//! Engagement from chips: closed forms in three axes, and against the dexel simulation in five.

use super::sections::{axis, block, piece, place};
use clsmith::cutter::{CutterModel, Meridian};
use clsmith::engagement::{Engagement, EngagementBin, PathPiece, Simulation};
use clsmith::internals::layered_chips::engagement::largest_feed_fraction;
use clsmith::layered_chips::{FlatMill, LayerStack, cut_chips, measure_engagement};
use clsmith::stock::Stock;
use proptest::prelude::*;

const MILL: FlatMill = FlatMill { radius_mm: 5.0, flute_length_mm: 30.0 };
const TOLERANCE: f64 = 0.001;

fn engaged(stock: &Stock, layer: f64, pieces: &[PathPiece]) -> Vec<Engagement> {
    let mut stack = LayerStack::new(stock, layer).unwrap();
    let chips = cut_chips(&mut stack, &[MILL], pieces, TOLERANCE);
    let found = pieces.iter().zip(chips);
    found.map(|(piece, chip)| measure_engagement(&chip.unwrap(), &MILL, piece, TOLERANCE)).collect()
}

fn upright(x: f64, y: f64, z: f64) -> clsmith::program::geometry::Pose {
    place([x, y, z], [0.0, 0.0, 1.0])
}

/// In and then 1 mm on, 4 mm deep, along y = 0.
fn straight() -> [PathPiece; 2] {
    [
        piece(upright(-6.0, 0.0, -4.0), upright(20.0, 0.0, -4.0)),
        piece(upright(20.0, 0.0, -4.0), upright(21.0, 0.0, -4.0)),
    ]
}

fn bound(found: &Engagement) -> f64 {
    found.bins.iter().map(|bin| f64::from(bin.advance_ratio_bound)).fold(found.graze, f64::max)
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
    near(found.max_advance_ratio(), 1.0, 1e-3);
    near(bound(found), 1.0, 1e-3);
    near(found.removed_mm3, 40.0, 0.02);
    near(found.length_mm, 1.0, 1e-12);
    near(found.axial_depth_mm(), 4.0, 1e-3);
    near(found.radial_depth_mm(), 10.0, 0.02);
    let directions = directions(found);
    assert!(directions.iter().all(|at| at.abs() < 90.0) && directions.len() >= 58, "{directions:?}");
    for (at, bin) in directions.iter().zip(found.engaged_bins()) {
        let [most, least] = [at.abs() - 1.5, at.abs() + 1.5].map(|at| at.to_radians().cos());
        let [share, bound] = [bin.advance_ratio, bin.advance_ratio_bound].map(f64::from);
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
    near(found.max_advance_ratio(), 0.8, 2e-3);
    assert!(bound(found) >= 0.8 && bound(found) < 0.815, "{}", bound(found));
    let directions = directions(found);
    assert!(directions.iter().all(|at| (36.8 - 1.5..=91.5).contains(at)), "{directions:?}");
    let [right, left] = found.lateral_mm;
    near(right, 3.0, 2e-3);
    near(left, 5.0, 2e-3);
    // From the right, the same mirrored.
    let stock = block([0.0, -30.0, -4.0], [60.0, -3.0, 0.0]);
    let mirrored = &engaged(&stock, 1.0, &straight())[1];
    near(mirrored.max_advance_ratio(), 0.8, 2e-3);
    assert!(mirrored.lateral_mm[1] < -2.9);
}

#[test]
fn a_plunge_advances_with_all_of_the_bottom() {
    let stock = block([-20.0, -20.0, -10.0], [20.0, 20.0, 0.0]);
    let found = &engaged(&stock, 0.5, &[piece(upright(0.0, 0.0, 1.0), upright(0.0, 0.0, -3.0))])[0];
    near(found.max_advance_ratio(), 1.0, 1e-9);
    near(found.along, -1.0, 1e-12);
    assert!(found.engaged_bins().all(|bin| bin.radial == 0.0 && f64::from(bin.high) <= 5.001));
    assert!(found.engaged_bins().count() == 120 && found.engaged_bins().all(|bin| bin.low < 1.0));
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
    assert!(found[0].has_removed_material());
    for (index, again) in found.iter().enumerate().skip(1) {
        assert!(!again.has_removed_material() && again.engaged_bins().count() == 0, "{index}: {again:?}");
    }
}

/// A share whose entry is two diagonals of cells of 0.1 mm further out: the cosine of an angle whose sine is so much less.
fn moved(share: f64) -> f64 {
    let side = (1.0 - share * share).max(0.0).sqrt() - 0.3 / MILL.radius_mm;
    share.max((1.0 - side.max(0.0).powi(2)).sqrt().min(1.0))
}

/// How far columns and layers may know a contact wrong, and what that makes of its share.
struct ShareError {
    /// The cell of the columns and the thickness of the layers, mm.
    cell: f64,
    layer: f64,
    /// The turn for each millimetre of the way, which shares relate to.
    turn_per_mm: f64,
    /// The least and the largest lean of the axis on the way.
    lean: [f64; 2],
}

impl ShareError {
    fn new(cell: f64, layer: f64, piece: &PathPiece) -> Self {
        let (from, to) = (piece.from.axis, piece.to.axis);
        let leans =
            (0..=20).map(|index| from.lerp(&to, f64::from(index) / 20.0).normalize().z.min(1.0).acos());
        let lean = leans
            .fold([f64::INFINITY, 0.0], |[least, most]: [f64; 2], lean| [least.min(lean), most.max(lean)]);
        let turn_per_mm = from.angle(&to) / (piece.to.point - piece.from.point).norm();
        Self { cell, layer, turn_per_mm, lean }
    }

    /// By how much the columns' share of a bin may be above the largest that the layers see.
    ///
    /// - **The columns' bias is upward.** The border of the ground lies between the last column in it and the next one, so a contact is turned
    ///   around the axis until it lies half a cell nearer to the middle of the path. Where the border is at the column itself, that is half a
    ///   cell too far.
    /// - **The layers' is downward.** A column that is a layer high meets the middle of one: they see its contact up to a layer higher or
    ///   lower, which on a flank that leans by `a` is `layer tan a` aside, and down a bottom `layer / sin a` away, but in the cutter.
    ///
    /// From `l` to `l - d` beside the path is a turn around the axis by `asin(l / R) - asin((l - d) / R)`; for each radian a share on the flank,
    /// `n.v`, changes by no more than the axis' speed there. On the bottom `v` alone changes with the place, by the turn.
    fn upward(&self, direction: f64, bin: &EngagementBin, height: f64) -> f64 {
        // The place in the bin of 3 degrees that is furthest aside.
        let side = ((90.0 - direction.abs()).abs() - 1.5).max(0.0).to_radians().cos();
        let turned = |by: f64| side.asin() - (side - by / MILL.radius_mm).max(0.0).asin();
        let [least, most] = self.lean;
        if bin.radial > 0.5 {
            let speed = 1.0 + self.turn_per_mm * height;
            speed * turned(0.5 * self.cell + self.layer * most.tan())
                + self.turn_per_mm * self.layer / most.cos()
        } else {
            let away = (self.layer / least.sin()).min(2.0 * MILL.radius_mm);
            self.turn_per_mm * (MILL.radius_mm * turned(0.5 * self.cell) + away)
        }
    }
}

fn by_dexels(stock: &Stock, pieces: &[PathPiece], cell: f64) -> Vec<Engagement> {
    let profile = Meridian::new(2.0 * MILL.radius_mm, 0.0, 0.0, 0.0, MILL.flute_length_mm).unwrap();
    let cutter = CutterModel { profile, collars: Vec::new(), teeth: None };
    Simulation::new(stock.to_dexels(cell, usize::MAX).unwrap(), false).sweep_pieces(pieces, &[cutter])
}

proptest! {
    #![proptest_config(crate::support::property(16))]

    #[test]
    fn dexels_and_layers_agree_on_the_shares_of_random_steps(
        tilts in prop::array::uniform2(0.0..35.0f64),
        towards in prop::array::uniform2(0.0..60.0f64),
        way in prop::array::uniform3(-2.0..2.0f64),
        side in -9.0..4.0f64,
        depth in -5.0..-1.0f64,
    ) {
        prop_assume!(way[0].hypot(way[1]) > 0.4);
        let stock = block([-8.0, side, -7.0], [8.0, 13.0, 0.0]);
        let above = place([-17.0, 0.0, depth], axis(tilts[0], towards[0]));
        let from = place([0.0, 0.0, depth], axis(tilts[0], towards[0]));
        let to = place([way[0], way[1], depth + 0.3 * way[2]], axis(tilts[1], towards[1]));
        let turn = from.axis.angle(&to.axis);
        // Faster turns than 20 degrees a millimetre are beyond what columns know to first order; places are the check there.
        prop_assume!(turn <= 0.35 * (to.point - from.point).norm());
        let pieces = [piece(above, from), piece(from, to)];
        let layers = &engaged(&stock, 0.1, &pieces)[1];
        let dexels = &by_dexels(&stock, &pieces, 0.1)[1];
        // Slivers that one of them sees and the other one does not.
        prop_assume!(dexels.removed_mm3 > 0.5 && layers.removed_mm3 > 0.5);
        // A contact of columns is known to a cell either way, over which the turn changes the share.
        let hidden = 0.02 + 0.2 * turn / layers.length_mm;
        let (estimate, most) = (dexels.max_advance_ratio(), bound(dexels).max(dexels.max_advance_ratio()));
        // Ahead of a tilted cutter columns miss a sliver; places, below, say that the layers are right there.
        let sliver = 0.15;
        prop_assert!(layers.max_advance_ratio() <= moved(most) + hidden + sliver, "layers {} dexels {estimate}..{most}", layers.max_advance_ratio());
        // The other way their errors are known. What is thinner than a layer none of them need see.
        let error = ShareError::new(0.1, 0.1, &pieces[1]);
        for (index, bin) in dexels.bins.iter().enumerate().filter(|(_, bin)| bin.is_engaged() && bin.thickness >= 0.1) {
            let direction = 3.0 * index as f64 - 178.5;
            let least = f64::from(bin.advance_ratio) - error.upward(direction, bin, dexels.height_mm[1]);
            prop_assert!(least <= bound(layers), "{direction}: dexels {}, at least {least}; layers {}..{}", bin.advance_ratio, layers.max_advance_ratio(), bound(layers));
        }
        // A bound holds what the turn does over the arc of a sample and half a layer.
        let close = 0.1 * (1.0 + layers.max_advance_ratio()) + 0.3 * turn / layers.length_mm;
        prop_assert!(bound(layers) - layers.max_advance_ratio() <= close, "{} {}", layers.max_advance_ratio(), bound(layers));
    }
}

/// The largest share of the way by which the cutter's surface advances where it first meets places of the stock, strewn evenly.
fn by_places(stock: ([f64; 3], [f64; 3]), pieces: &[PathPiece; 2], length: f64, apart: f64) -> f64 {
    use nalgebra::Vector3;
    const TIMES: usize = 400;
    let poses = |piece: &PathPiece| -> Vec<(Vector3<f64>, Vector3<f64>)> {
        let (from, to) = (piece.from.axis, piece.to.axis);
        let turn = from.angle(&to);
        let across = (to - from * from.dot(&to)).try_normalize(1e-12).unwrap_or_default();
        (0..=TIMES)
            .map(|index| {
                let t = index as f64 / TIMES as f64;
                let axis = from * (turn * t).cos() + across * (turn * t).sin();
                (piece.from.point.coords.lerp(&piece.to.point.coords, t), axis)
            })
            .collect()
    };
    let inside = |place: &Vector3<f64>, (tip, axis): &(Vector3<f64>, Vector3<f64>)| {
        let here = place - tip;
        let height = here.dot(axis);
        (0.0..=MILL.flute_length_mm).contains(&height) && (here - axis * height).norm() <= MILL.radius_mm
    };
    let [before, now] = [poses(&pieces[0]), poses(&pieces[1])];
    let (low, high) = stock;
    let count = |side: usize| ((high[side] - low[side]) / apart) as usize;
    let mut most: f64 = 0.0;
    for (i, j, k) in
        (0..count(0)).flat_map(|i| (0..count(1)).flat_map(move |j| (0..count(2)).map(move |k| (i, j, k))))
    {
        let at = |side: usize, index: usize| low[side] + apart * (index as f64 + 0.5);
        let place = Vector3::new(at(0, i), at(1, j), at(2, k));
        let (tip, _) = now[0];
        if (place - tip).norm() > 20.0 {
            continue;
        }
        let Some(met) = now.iter().position(|pose| inside(&place, pose)) else { continue };
        if met == 0 || before.iter().any(|pose| inside(&place, pose)) {
            continue;
        }
        // The velocity of the cutter's point that is there, by its place in the cutter a moment before and after.
        let (was, is) = (now[met - 1], now[met]);
        let out = |(tip, axis): (Vector3<f64>, Vector3<f64>)| {
            let here = place - tip;
            let height = here.dot(&axis);
            ((here - axis * height).norm() - MILL.radius_mm).max(-height)
        };
        let share = (out(was) - out(is)) * TIMES as f64 / length;
        most = most.max(share);
    }
    most
}

#[test]
fn large_turns_on_a_short_way_share_as_places_tell() {
    // Tilts and direction, way, side and depth.
    let cases = [
        ([17.845, 27.523, 14.685], [0.2645, -0.977, 1.8678], [1.043, -4.3515]),
        ([33.596, 0.0, 36.522], [0.5601, -0.4166, 0.0], [-1.8406, -4.8817]),
        ([32.5, 3.08, 0.0], [0.0, 0.381, 0.0], [-9.0, -1.0]),
    ];
    for ([lean, leans, towards], way, [side, depth]) in cases {
        let bounds = ([-8.0, side, -7.0], [8.0, 13.0, 0.0]);
        let above = place([-17.0, 0.0, depth], axis(lean, towards));
        let from = place([0.0, 0.0, depth], axis(lean, towards));
        let to = place([way[0], way[1], depth + 0.3 * way[2]], axis(leans, 0.0));
        let pieces = [piece(above, from), piece(from, to)];
        let layers = &engaged(&block(bounds.0, bounds.1), 0.1, &pieces)[1];
        let places = by_places(bounds, &pieces, layers.length_mm, 0.1);
        assert!(places <= bound(layers) + 0.01, "{places} {}..{}", layers.max_advance_ratio(), bound(layers));
        // The place of the largest share lies between the places by up to their distance.
        assert!(
            (0.99 * places..=1.06 * places).contains(&layers.max_advance_ratio()),
            "{places} {}",
            layers.max_advance_ratio()
        );
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 60, ..ProptestConfig::default() })]

    /// The largest advance on a layer is found without measuring most samples; it is that of all samples.
    #[test]
    fn the_largest_advance_is_that_of_all_samples(
        way in prop::array::uniform3(-2.0..2.0_f64),
        leans in prop::array::uniform2((-0.6..0.6_f64, -0.6..0.6_f64)),
        down in 0.5..6.0_f64,
    ) {
        let [first, last] = leans.map(|(i, j)| [i, j, 1.0]);
        let [x, y, z] = [30.0 + way[0], way[1], -down + way[2] / 4.0];
        let pieces = [
            piece(place([-8.0, 0.0, -down], first), place([30.0, 0.0, -down], first)),
            piece(place([30.0, 0.0, -down], first), place([x, y, z], last)),
        ];
        let mut stack = LayerStack::new(&block([0.0, -20.0, -10.0], [60.0, 20.0, 0.0]), 0.5).unwrap();
        for (piece, chip) in pieces.iter().zip(cut_chips(&mut stack, &[MILL], &pieces, TOLERANCE)) {
            let chip = chip.unwrap();
            let clean = chip.layers.iter().all(|layer| layer.inside_mm2 == 0.0);
            let found = chip.layers.iter().filter_map(|layer| largest_feed_fraction(layer, &MILL, piece, TOLERANCE));
            let found = found.fold(0.0, f64::max);
            let all = measure_engagement(&chip, &MILL, piece, TOLERANCE).max_advance_ratio();
            // Bins hold single precision, and material inside the cutter has the largest ratio there can be.
            prop_assert!(!clean || (found - all).abs() <= 1e-6 * all.max(1.0), "{} of {}", found, all);
        }
    }
}

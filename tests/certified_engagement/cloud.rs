//! Random programs and the check that no point of a cloud is above their bounds.

use super::mills::mill;
use super::oracle::{self, Polygon};
use clsmith::certified_engagement::*;
use nalgebra::Vector3;
use std::ops::RangeInclusive;

/// A small generator of random numbers (xorshift).
pub struct Random(pub u64);

impl Random {
    pub fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn within(&mut self, from: f64, to: f64) -> f64 {
        from + (to - from) * self.next()
    }

    pub fn below(&mut self, count: usize) -> usize {
        (self.next() * count as f64) as usize
    }
}

pub struct RandomProgram {
    pub low: Vector3<f64>,
    pub high: Vector3<f64>,
    pub bar: bool,
    pub polygons: Vec<Polygon>,
    pub blocks: Vec<BlockMotion>,
}

impl RandomProgram {
    pub fn stock(&self) -> Box<dyn StockGap> {
        if self.bar {
            let bottom = Vector3::new(0.0, 0.0, self.low.z);
            let top = Vector3::new(0.0, 0.0, self.high.z);
            return Box::new(CylinderGap::new(self.high.x, bottom, top).unwrap());
        }
        Box::new(BoxGap::new(self.low, self.high))
    }

    /// Whether a point is inside the stock by a little.
    pub fn holds(&self, point: &Vector3<f64>) -> bool {
        let little = 2e-6;
        let is_high = point.z < self.high.z - little && point.z > self.low.z + little;
        if self.bar {
            return is_high && point.xy().norm() < self.high.x - little;
        }
        is_high
            && (self.low.x + little..self.high.x - little).contains(&point.x)
            && (self.low.y + little..self.high.y - little).contains(&point.y)
    }

    pub fn is_material(&self, point: &Vector3<f64>, block: usize) -> bool {
        self.holds(point)
            && self.blocks[..block]
                .iter()
                .all(|motion| !oracle::may_be_removed(point, motion, &self.polygons[motion.cutter], 1.0))
    }
}

#[derive(Default)]
pub struct Tally {
    pub blocks: usize,
    pub open: usize,
    pub points: usize,
    pub above: usize,
    pub refuted: usize,
}

/// Checks one program. A scale below 1 makes all bounds too low, to see that the cloud would find that.
pub fn check(made: &RandomProgram, seed: u64, points: usize, scale: f64, tally: &mut Tally) {
    let options = EngagementOptions { most_patches: 4000, ..EngagementOptions::default() };
    check_within(made, seed, (points, scale), &options, tally);
}

/// Checks that no point of any program is above its bounds.
pub fn assert_none_above(seeds: RangeInclusive<u64>, points: usize, make: impl Fn(u64) -> RandomProgram) {
    let mut tally = Tally::default();
    seeds.for_each(|seed| check(&make(seed), seed, points, 1.0, &mut tally));
    assert!(tally.refuted == 0 && tally.points > 0, "{} of {} points", tally.refuted, tally.points);
}

/// Checks that the cloud would find bounds that are a tenth too low: so many blocks of the programs at least.
pub fn assert_low_bounds_are_found(
    seeds: RangeInclusive<u64>,
    (points, least): (usize, usize),
    make: impl Fn(u64) -> RandomProgram,
) {
    let mut tally = Tally::default();
    seeds.for_each(|seed| check(&make(seed), seed, points, 0.9, &mut tally));
    assert!(tally.refuted >= least, "only {} refuted", tally.refuted);
}

/// Checks that intervals hold, and are wider, where the search of a block ends early.
pub fn assert_small_budgets_hold(make: impl Fn(u64) -> RandomProgram) {
    let usual = EngagementOptions::default();
    let patches = [0, 1, 7, 60].map(|most_patches| EngagementOptions { most_patches, ..usual });
    let tests = [0, 100, 2000].map(|most_line_tests| EngagementOptions { most_line_tests, ..usual });
    for options in patches.iter().chain(&tests) {
        let mut tally = Tally::default();
        (500..540).for_each(|seed| check_within(&make(seed), seed, (1500, 1.0), options, &mut tally));
        assert!(tally.refuted == 0 && tally.open > 10, "{options:?}: {} {}", tally.refuted, tally.open);
    }
}

/// Checks one program whose blocks are bounded with these options.
pub fn check_within(
    made: &RandomProgram,
    seed: u64,
    (points, scale): (usize, f64),
    options: &EngagementOptions,
    tally: &mut Tally,
) {
    let cutters = made.polygons.iter().map(|polygon| {
        let [a, b, c, d, e] = polygon.numbers;
        mill(a, b, c, d, e)
    });
    let mut program =
        CertifiedProgram::new(vec![made.stock()], cutters.collect(), StepLimits::default()).unwrap();
    for block in &made.blocks {
        program.push_block(block).unwrap();
    }
    let mut random = Random(seed | 1);
    let (mut warm, mut warm_chip) = (WarmStart::default(), WarmStart::default());
    let fz = 0.08;
    for (number, block) in made.blocks.iter().enumerate() {
        let share = program.certify_block(number, EngagementCriterion::Share, options, &mut warm);
        let chips = EngagementCriterion::Chip { feed_per_tooth_mm: fz };
        let chip = program.certify_block(number, chips, options, &mut warm_chip);
        tally.blocks += 1;
        for (name, found) in [("share", &share), ("chip", &chip)] {
            assert!(found.lower <= found.upper, "seed {seed} block {number}: {found:?}");
            if !found.is_within_tolerance {
                tally.open += 1;
                if std::env::var("CE_OPEN").is_ok() {
                    println!(
                        "open {seed} {number} {name} {found:?}\n   {block:?} {:?}",
                        made.polygons[block.cutter].numbers
                    );
                }
            }
            if let Some(witness) = found.witness {
                let tool = &made.polygons[block.cutter];
                let gap = tool.gap(&witness.point, &oracle::pose_at(block, witness.at));
                // The polygon is circumscribed, so its points are up to a little deeper.
                assert!(gap < 1e-6 && gap > -2e-3, "seed {seed} block {number} {name}: witness off by {gap}");
                if name == "share" {
                    for earlier in &made.blocks[..number] {
                        let [a, b, c, d, e] = made.polygons[earlier.cutter].numbers;
                        let fine = Polygon::with_tangents(a, b, c, d, e, 3000);
                        let removed = oracle::is_surely_removed(&witness.point, earlier, &fine);
                        assert!(
                            !removed,
                            "seed {seed} block {number}: witness in a sweep {witness:?} {earlier:?} {block:?} {:?}",
                            fine.numbers
                        );
                    }
                    assert!(made.holds_loosely(&witness.point), "seed {seed} block {number}: {witness:?}");
                }
            }
        }
        let tool = &made.polygons[block.cutter];
        let radius = program.cutters()[block.cutter].radius_mm();
        let reference = oracle::reference(block, tool, radius);
        let near = [share.witness, chip.witness].map(|found| {
            found.map(|found| (tool.locate(&found.point, &oracle::pose_at(block, found.at)), found.at))
        });
        for count in 0..points {
            // Most places of a cutter are outside the stock; a few draws look for one inside.
            let mut draw = || {
                let (u, phi) = (random.next(), random.within(0.0, std::f64::consts::TAU));
                let t = random.within(0.0, 1.0);
                let pose = oracle::pose_at(block, t);
                let (point, normal) = tool.surface(u, phi, &pose);
                (t, pose, point, normal)
            };
            let mut drawn = draw();
            // A fifth of the points are near the places that the library found itself.
            if let (0, Some(((u, phi), at))) = (count % 5, near[count / 5 % 2]) {
                let mut about = |place: f64, most: f64| place + most * random.within(-1.0, 1.0).powi(3);
                let t = about(at, 0.3).clamp(1e-6, 1.0 - 1e-6);
                let pose = oracle::pose_at(block, t);
                let (point, normal) = tool.surface(about(u, 0.05).clamp(0.0, 1.0), about(phi, 0.4), &pose);
                drawn = (t, pose, point, normal);
            } else {
                for _ in 0..8 {
                    if made.holds(&drawn.2) {
                        break;
                    }
                    drawn = draw();
                }
            }
            let (t, pose, point, normal) = drawn;
            tally.points += 1;
            // The velocity by differences of places.
            // A smaller step would lose the angle between the poses in rounding.
            let step = 1e-3;
            let local = [point - pose.tip, pose.axis];
            let at = |t: f64| moved(&local, &pose, &oracle::pose_at(block, t));
            let velocity = (at(t + step) - at(t - step)) / (2.0 * step);
            let value = velocity.dot(&normal) / reference - 1e-5;
            if value > share.upper * scale {
                tally.above += 1;
                let own = (t - 1e-3).max(0.0);
                if made.is_material(&point, number) && !oracle::may_be_removed(&point, block, tool, own) {
                    tally.refuted += 1;
                    if scale < 1.0 {
                        return;
                    }
                    println!(
                        "seed {seed} block {number}: share {value} above {share:?} at t {t} {point:?} {normal:?}\n {block:?} {:?}",
                        tool.numbers
                    );
                }
            }
            if value * fz > chip.upper * scale {
                let h = value * fz;
                let cells = 24;
                let mut length = 0.0;
                let mut before = false;
                for cell in 0..=cells {
                    let place = point - normal * (h * f64::from(cell) / f64::from(cells));
                    let now = made.is_material(&place, number);
                    if now && before {
                        length += h / f64::from(cells);
                    }
                    before = now;
                }
                if length > chip.upper * scale * (1.0 + 1e-6) + 1e-6 {
                    tally.refuted += 1;
                    if scale < 1.0 {
                        return;
                    }
                    println!(
                        "seed {seed} block {number}: chip {length} above {chip:?} at t {t} {point:?} {normal:?}\n {block:?} {:?}",
                        tool.numbers
                    );
                }
            }
        }
    }
}

impl RandomProgram {
    pub fn holds_loosely(&self, point: &Vector3<f64>) -> bool {
        let inside = (point - self.low).min() > -1e-9 && (self.high - point).min() > -1e-9;
        self.bar || inside
    }
}

/// Moves a point with the cutter from one pose to a near one by the least turn.
pub fn moved(local: &[Vector3<f64>; 2], from: &CutterPose, to: &CutterPose) -> Vector3<f64> {
    let turn = nalgebra::Rotation3::rotation_between(&from.axis, &to.axis).unwrap();
    to.tip + turn * local[0]
}

pub fn random_cutter(random: &mut Random) -> Polygon {
    let diameter = random.within(4.0, 12.0);
    let height = random.within(14.0, 30.0);
    match random.below(6) {
        0 | 1 => Polygon::new(diameter, 0.0, 0.0, 0.0, height),
        2 => Polygon::new(diameter, diameter / 2.0, 0.0, 0.0, height),
        3 => Polygon::new(diameter, random.within(0.3, 0.45) * diameter, 0.0, 0.0, height),
        4 => Polygon::new(
            diameter / 2.0,
            random.within(0.0, 0.2) * diameter,
            random.within(0.05, 0.4),
            0.0,
            height,
        ),
        _ => {
            Polygon::new(diameter, random.within(0.0, 0.15) * diameter, 0.0, random.within(0.1, 0.6), height)
        }
    }
}

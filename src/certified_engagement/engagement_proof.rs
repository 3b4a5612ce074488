//! This module looks for points that refute a bound: random points of a block, and points near the worst ones
//! found, are tested for membership in the stock and in every earlier sweep.
//!
//! Finding nothing is no proof in itself, but it is by other means than those that bounded the block. Nothing of
//! them is used here: cutters, motions, the index over earlier blocks and the membership are its own.

use super::block_motion::BlockMotion;
use super::proof_geometry::{ProofCutter, ProofMotion};
use nalgebra::Vector3;
use std::collections::HashMap;
use std::f64::consts::TAU;

/// Tells whether a point is in the stock.
pub type ProofStock = Box<dyn Fn(&Vector3<f64>) -> bool + Send + Sync>;

/// A program of which blocks are tested.
pub struct EngagementProof {
    stock: ProofStock,
    cutters: Vec<ProofCutter>,
    motions: Vec<ProofMotion>,
    /// A box around all that each motion sweeps.
    boxes: Vec<[Vector3<f64>; 2]>,
    cell: f64,
    /// The blocks over every cell of a grid in x and y.
    cells: HashMap<[i64; 2], ProofCell>,
    bounds: [Vector3<f64>; 2],
}

/// The blocks over a cell, in order, and a box around all that each run of them sweeps.
#[derive(Debug, Default)]
struct ProofCell {
    blocks: Vec<u32>,
    run_boxes: Vec<[Vector3<f64>; 2]>,
}

/// The number of blocks in a run.
const BLOCKS_OF_A_RUN: usize = 32;

impl ProofCell {
    fn add(&mut self, block: u32, [low, high]: [Vector3<f64>; 2]) {
        match self.run_boxes.last_mut().filter(|_| !self.blocks.len().is_multiple_of(BLOCKS_OF_A_RUN)) {
            Some([lowest, highest]) => (*lowest, *highest) = (lowest.inf(&low), highest.sup(&high)),
            None => self.run_boxes.push([low, high]),
        }
        self.blocks.push(block);
    }

    /// Returns the blocks before a block whose runs are near a point, the last ones first: they are the likeliest.
    fn blocks_near<'p>(&'p self, point: &'p Vector3<f64>, before: usize) -> impl Iterator<Item = u32> + 'p {
        let runs = self.blocks.chunks(BLOCKS_OF_A_RUN).zip(&self.run_boxes).rev();
        let near = runs.filter(|(_, around)| !is_beside(point, around));
        let blocks = near.flat_map(|(run, _)| run.iter().rev().copied());
        blocks.filter(move |block| (*block as usize) < before)
    }
}

/// Returns whether a point is outside a box.
fn is_beside(point: &Vector3<f64>, [low, high]: &[Vector3<f64>; 2]) -> bool {
    (point - low).min() < 0.0 || (high - point).min() < 0.0
}

/// What is tested: that nothing exceeds the bounds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProofClaim {
    /// The number of the block.
    pub block: usize,
    /// What no share exceeds.
    pub upper_share: f64,
    /// The feed per tooth in mm, and what no chip exceeds, mm.
    pub chip: Option<[f64; 2]>,
    /// A place on the cutter where much was found, and its time in the block; points near it are tried.
    pub hint: Option<(Vector3<f64>, f64)>,
}

/// What was found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ProofFinding {
    /// The number of points that were tried.
    pub samples: usize,
    /// The number of them that were tested for membership, as their share was above all found before.
    pub tested: usize,
    /// The largest share of a point that is material.
    pub largest_share: f64,
    /// The largest chip, mm.
    pub largest_chip: f64,
    /// A point, and its time in the block, that is above a bound by more than a millionth.
    pub refuted: Option<(Vector3<f64>, f64)>,
}

/// Points are taken as in the stock only if all places so near are (mm).
const SKIN_MM: f64 = 2e-6;
/// Shares and chips above a bound by less than this part refute nothing.
const ROUNDING: f64 = 1e-6;
/// The number of places along the depth of a chip.
const CHIP_PLACES: u32 = 16;
/// The part of a block's time before a point that its own sweep is not asked for.
const JUST_BEFORE: f64 = 1e-3;

/// A place on the cutter's surface: its side (0) or its bottom (1), the part along that, the direction and the
/// time.
type SurfacePlace = [f64; 4];

impl EngagementProof {
    /// Starts a program: what is stock, a box around it, and the cutters.
    pub fn new(stock: ProofStock, bounds: [Vector3<f64>; 2], cutters: Vec<ProofCutter>) -> Self {
        let largest = cutters.iter().map(ProofCutter::largest_radius_mm).fold(0.5, f64::max);
        Self {
            stock,
            cutters,
            motions: Vec::new(),
            boxes: Vec::new(),
            cell: largest,
            cells: HashMap::new(),
            bounds,
        }
    }

    /// Adds a motion, rapids too, in order. Returns false if its cutter does not exist.
    pub fn push_block(&mut self, motion: &BlockMotion) -> bool {
        let Some(cutter) = self.cutters.get(motion.cutter) else { return false };
        let own = ProofMotion::new(motion);
        let number = self.motions.len() as u32;
        let around = own.bounds(cutter);
        let [low, high] = around;
        self.boxes.push(around);
        let (low, high) = (low.sup(&self.bounds[0]), high.inf(&self.bounds[1]));
        if (high - low).min() >= 0.0 {
            let cell = |value: f64| (value / self.cell).floor() as i64;
            for x in cell(low.x)..=cell(high.x) {
                for y in cell(low.y)..=cell(high.y) {
                    self.cells.entry([x, y]).or_default().add(number, around);
                }
            }
        }
        self.motions.push(own);
        true
    }

    /// Tries points of a block: `samples` at random, and half as many near the largest that were found. Equal
    /// seeds give equal points.
    pub fn test_block(&self, claim: &ProofClaim, samples: usize, seed: u64) -> ProofFinding {
        let mut finding =
            ProofFinding { samples: 0, tested: 0, largest_share: 0.0, largest_chip: 0.0, refuted: None };
        let Some(motion) = self.motions.get(claim.block) else { return finding };
        let Some(cutter) = self.cutters.get(motion.cutter) else { return finding };
        let mut random = PointSource(seed ^ (claim.block as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
        random.next();
        let mut best: Option<SurfacePlace> = None;
        let mut likely = None;
        let start = claim.hint.map(|(point, time)| place_near(motion, cutter, &point, time));
        for number in 0..samples + samples / 2 {
            let center = best.or(start).filter(|_| number % 3 == 2);
            let place = match center {
                Some(center) => random.near(&center),
                None => random.anywhere(),
            };
            finding.samples += 1;
            if self.try_place((claim, &mut likely), motion, cutter, &place, &mut finding) {
                best = Some(place);
            }
        }
        finding
    }

    /// Tries one place. Returns whether it is larger than all before.
    fn try_place(
        &self,
        (claim, likely): (&ProofClaim, &mut Option<u32>),
        motion: &ProofMotion,
        cutter: &ProofCutter,
        place: &SurfacePlace,
        finding: &mut ProofFinding,
    ) -> bool {
        let time = place[3];
        let Some((point, normal)) = surface_of(motion, cutter, place) else { return false };
        let reference = motion.reference(cutter);
        let share = motion.velocity(&point, time).dot(&normal) / reference;
        let mut is_larger = false;
        if share > finding.largest_share {
            finding.tested += 1;
            let own = (time - JUST_BEFORE).max(0.0);
            if self.is_material(&point, claim.block, likely) && !motion.may_cut(cutter, &point, own) {
                finding.largest_share = share;
                is_larger = true;
                if share > claim.upper_share * (1.0 + ROUNDING) + ROUNDING {
                    finding.refuted = Some((point, time));
                }
            }
        }
        let Some([feed_per_tooth, upper]) = claim.chip else { return is_larger };
        let depth = share * feed_per_tooth;
        if depth > finding.largest_chip {
            finding.tested += 1;
            let at = |number: u32| point - normal * (depth * f64::from(number) / f64::from(CHIP_PLACES));
            let mut is_there = |number: &u32| self.is_material(&at(*number), claim.block, likely);
            let first = (0..=CHIP_PLACES).find(&mut is_there);
            let last = (0..=CHIP_PLACES).rev().find(&mut is_there);
            if let (Some(first), Some(last)) = (first, last) {
                let chip = depth * f64::from(last - first) / f64::from(CHIP_PLACES);
                if chip > finding.largest_chip {
                    finding.largest_chip = chip;
                    is_larger = true;
                }
                if chip > upper * (1.0 + ROUNDING) + ROUNDING {
                    finding.refuted = Some((point, time));
                }
            }
        }
        is_larger
    }

    /// Returns whether a point is in the stock and in no sweep of a block before. `likely` is the block that took the point
    /// before it.
    fn is_material(&self, point: &Vector3<f64>, before: usize, likely: &mut Option<u32>) -> bool {
        if !(self.stock)(point) {
            return false;
        }
        let skin = [Vector3::x(), Vector3::y(), Vector3::z()];
        let is_deep = |side: &Vector3<f64>| {
            (self.stock)(&(point + side * SKIN_MM)) && (self.stock)(&(point - side * SKIN_MM))
        };
        if !skin.iter().all(is_deep) {
            return false;
        }
        let cell = |value: f64| (value / self.cell).floor() as i64;
        if likely.is_some_and(|block| self.may_have_cut(block, point)) {
            return false;
        }
        let Some(around) = self.cells.get(&[cell(point.x), cell(point.y)]) else { return true };
        let taken = around.blocks_near(point, before).find(|block| self.may_have_cut(*block, point));
        *likely = taken.or(*likely);
        taken.is_none()
    }

    /// Returns whether a whole block may have cut a point.
    fn may_have_cut(&self, block: u32, point: &Vector3<f64>) -> bool {
        if self.boxes.get(block as usize).is_some_and(|around| is_beside(point, around)) {
            return false;
        }
        let motion = self.motions.get(block as usize);
        let cutter = motion.and_then(|motion| self.cutters.get(motion.cutter));
        motion.zip(cutter).is_some_and(|(motion, cutter)| motion.may_cut(cutter, point, 1.0))
    }
}

/// Returns two directions across an axis.
fn sides_of(axis: &Vector3<f64>) -> [Vector3<f64>; 2] {
    let helper = if axis.x.abs() < 0.8 { Vector3::x() } else { Vector3::y() };
    let first = axis.cross(&helper).normalize();
    [first, axis.cross(&first)]
}

/// Returns a point of the surface and its outward normal.
fn surface_of(
    motion: &ProofMotion,
    cutter: &ProofCutter,
    [kind, along, phi, time]: &SurfacePlace,
) -> Option<(Vector3<f64>, Vector3<f64>)> {
    let (tip, axis) = motion.pose(*time);
    let [first, second] = sides_of(&axis);
    let out = first * phi.cos() + second * phi.sin();
    if *kind >= 0.5 {
        let flat = cutter.radius_at(0.0);
        let r = flat * along.sqrt();
        // A point has no normal.
        return (flat > 1e-6).then_some((tip + out * r, -axis));
    }
    // Low places are likelier.
    let z = cutter.height_mm() * along * along * along;
    let step = (z * 1e-4).clamp(1e-9, 1e-4);
    let (low, high) = ((z - step).max(0.0), (z + step).min(cutter.height_mm()));
    let [below, radius, above] = [low, z, high].map(|z| cutter.radius_at(z));
    let slope = (above - below) / (high - low);
    if low < z && z < high {
        // An edge between two faces has no normal, either.
        let change = (above - radius) / (high - z) - (radius - below) / (z - low);
        if change.abs() > 1e-2 * (1.0 + slope.abs()) {
            return None;
        }
    }
    let normal = (out - axis * slope).try_normalize(1e-12)?;
    Some((tip + out * cutter.radius_at(z) + axis * z, normal))
}

/// Returns the place on the surface that is nearest to a point, about.
fn place_near(motion: &ProofMotion, cutter: &ProofCutter, point: &Vector3<f64>, time: f64) -> SurfacePlace {
    let (tip, axis) = motion.pose(time);
    let [first, second] = sides_of(&axis);
    let offset = point - tip;
    let z = offset.dot(&axis);
    let phi = offset.dot(&second).atan2(offset.dot(&first));
    let r = (offset - axis * z).norm();
    let flat = cutter.radius_at(0.0);
    if z < 1e-6 && r < flat {
        return [1.0, (r / flat).powi(2), phi, time];
    }
    [0.0, (z / cutter.height_mm()).clamp(0.0, 1.0).cbrt(), phi, time]
}

/// A source of random places (xorshift).
struct PointSource(u64);

impl PointSource {
    fn next(&mut self) -> f64 {
        self.0 ^= self.0 << 13;
        self.0 ^= self.0 >> 7;
        self.0 ^= self.0 << 17;
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn anywhere(&mut self) -> SurfacePlace {
        let kind = if self.next() < 0.2 { 1.0 } else { 0.0 };
        [kind, self.next(), self.next() * TAU, self.next()]
    }

    /// A place near another one, at any scale.
    fn near(&mut self, [kind, along, phi, time]: &SurfacePlace) -> SurfacePlace {
        let scale = 10.0_f64.powf(-6.0 * self.next());
        let mut off = || (self.next() * 2.0 - 1.0) * scale;
        let (a, b, c) = (off(), off(), off());
        [*kind, (along + a).clamp(0.0, 1.0), phi + b * 3.0, (time + c).clamp(0.0, 1.0)]
    }
}

//! This module holds a program as certified engagement sees it: stock, cutters, and blocks that are divided
//! in steps.

use super::block_motion::{BlockMotion, CertifiedProgramError, FARTHEST_MM, StepLimits, normalized, pose_at};
use super::cutter_contour::CutterContour;
use super::cutter_pose::TipArc;
use super::repeated_steps::LowestOnWay;
use super::step_glance::{StepFootprint, StepGlance};
use super::step_index::StepIndex;
use super::step_runs::{OpenRun, StepRun};
use super::stock_gap::StockGap;
use super::swept_step::SweptStep;
use nalgebra::Vector3;
use std::ops::Range;

/// Tips closer than this (mm) stand still.
const STILL_MM: f64 = 1e-7;
/// The most that an arc may miss its end by, mm.
const MOST_SLIP_MM: f64 = 0.01;
/// The largest angles of a turning axis and of an arc that are searched at once, radians.
const SEARCHED_TURN_RAD: f64 = 0.1;
const SEARCHED_ARC_RAD: f64 = 0.08;
/// The largest number of steps of one block.
const MOST_STEPS: f64 = 20_000.0;

/// A step as the search sees it: the own motion, of which the sweeps are finer parts.
#[derive(Clone, Copy)]
pub(super) struct SearchedStep<'a> {
    pub step: &'a SweptStep,
    /// The length of path that the feed refers to, mm.
    pub reference: f64,
    pub first_sweep: u32,
    pub sweep_count: u32,
    /// The part of the block's time.
    pub time_part: [f64; 2],
}

/// The steps of one block: finer ones as sweeps for later blocks, coarser ones for its own search.
#[derive(Debug, Clone)]
struct BlockSteps {
    sweeps: Range<u32>,
    /// Empty if the block is one sweep, which then is searched itself.
    searched: Range<u32>,
    reference: f64,
}

/// Stock, cutters and steps of a program.
pub struct CertifiedProgram {
    pub(super) stock: Vec<Box<dyn StockGap>>,
    pub(super) index: StepIndex,
    /// The distance by which comparisons are on the safe side, mm. Every compared distance is computed with
    /// fewer than a thousand operations on numbers up to the largest coordinate, each off by at most 1.2e-16
    /// of it; the guard is 4e-13 of it, and never less than a nanometre's thousandth.
    pub(super) guard_mm: f64,
    pub(super) cutters: Vec<CutterContour>,
    pub(super) steps: Vec<SweptStep>,
    /// Runs of short steps, and the last steps, which may become one.
    pub(super) runs: Vec<StepRun>,
    pub(super) open_run: OpenRun,
    searched: Vec<SweptStep>,
    /// The footprints of all steps and what a look at each needs, close together in memory: many steps are only asked
    /// for these.
    pub(super) footprints: Vec<StepFootprint>,
    pub(super) glances: Vec<StepGlance>,
    /// By which step each one was replaced, if it adds nothing to that.
    pub(super) replaced: Vec<u32>,
    pub(super) lowest_on_way: LowestOnWay,
    blocks: Vec<BlockSteps>,
    limits: StepLimits,
    stock_bounds: [Vector3<f64>; 2],
}

impl CertifiedProgram {
    /// Starts a program with its stock and cutters; [`CertifiedProgram::push_block`] adds motions in order.
    ///
    /// # Errors
    /// Returns an error if there is no stock, or if its bounds are not finite.
    pub fn new(
        stock: Vec<Box<dyn StockGap>>,
        cutters: Vec<CutterContour>,
        limits: StepLimits,
    ) -> Result<Self, CertifiedProgramError> {
        let bounds = stock.iter().map(|body| body.bounds());
        let stock_bounds =
            bounds.reduce(|[a, b], [c, d]| [a.inf(&c), b.sup(&d)]).ok_or(CertifiedProgramError::NoStock)?;
        let [low, high] = stock_bounds;
        let largest = low.abs().max().max(high.abs().max());
        if low.iter().chain(high.iter()).any(|part| part.is_nan() || part.abs() > FARTHEST_MM) {
            return Err(CertifiedProgramError::NotFinite);
        }
        let smallest = cutters.iter().map(|cutter| 2.0 * cutter.radius_mm()).fold(f64::INFINITY, f64::min);
        let smallest = if smallest.is_finite() { smallest } else { 1.0 };
        Ok(Self {
            stock,
            index: StepIndex::new(stock_bounds, smallest),
            guard_mm: guard_for(largest),
            cutters,
            steps: Vec::new(),
            runs: Vec::new(),
            open_run: OpenRun::default(),
            searched: Vec::new(),
            footprints: Vec::new(),
            glances: Vec::new(),
            replaced: Vec::new(),
            lowest_on_way: LowestOnWay::new(),
            blocks: Vec::new(),
            limits,
            stock_bounds,
        })
    }

    /// Adds a motion and returns its number. Rapids are added too: they remove material.
    ///
    /// # Errors
    /// Returns an error if a number is not finite, an axis is none, or the cutter does not exist.
    pub fn push_block(&mut self, motion: &BlockMotion) -> Result<usize, CertifiedProgramError> {
        let contour = self.cutters.get(motion.cutter).ok_or(CertifiedProgramError::Cutter)?;
        let [from, to] = [normalized(&motion.from)?, normalized(&motion.to)?];
        let turn = from.axis.cross(&to.axis).norm().atan2(from.axis.dot(&to.axis));
        if turn > std::f64::consts::PI - 1e-6 {
            return Err(CertifiedProgramError::Axis);
        }
        let largest = from.tip.abs().max().max(to.tip.abs().max());
        self.guard_mm = self.guard_mm.max(guard_for(largest));
        if let Some(arc) = &motion.arc {
            let is_axis = (arc.normal.norm() - 1.0).abs() < 1e-9
                && arc.center.iter().all(|part| part.abs() <= FARTHEST_MM);
            let rise = arc.normal * (to.tip - from.tip).dot(&arc.normal);
            let misses = (arc.turned(from.tip, 1.0) + rise - to.tip).norm();
            if !is_axis || misses.is_nan() || misses > MOST_SLIP_MM {
                return Err(CertifiedProgramError::Arc);
            }
        }
        let motion = &BlockMotion { arc: motion.arc.map(|arc| arc.fitted(&from.tip, &to.tip)), ..*motion };
        let block = self.blocks.len();
        let first = self.steps.len() as u32;
        let chord = (to.tip - from.tip).norm();
        let (length, bends) = match &motion.arc {
            Some(arc) => {
                let offset = from.tip - arc.center;
                let radius = (offset - arc.normal * offset.dot(&arc.normal)).norm();
                let rise = (to.tip - from.tip).dot(&arc.normal);
                // An arc over the angle a is at most r a²/8 off its chord.
                let angle = (8.0 * self.limits.most_sagitta_mm / radius.max(1e-9)).sqrt();
                ((radius * arc.angle).hypot(rise), arc.angle.abs() / angle)
            }
            None => (chord, 0.0),
        };
        let reference =
            if length > STILL_MM { length } else { turn * contour.radius_mm().hypot(contour.height_mm()) };
        let flat = motion.arc.filter(|_| turn == 0.0);
        let bends = flat.and_then(|arc| arc.flat_parts(&from, &to, contour.radius_mm())).unwrap_or(bends);
        let count = (turn / self.limits.most_turn_rad).max(bends).ceil().clamp(1.0, MOST_STEPS);
        let swept = motion.arc.map_or(0.0, |arc| arc.angle.abs());
        let parts = (turn / SEARCHED_TURN_RAD).max(swept / SEARCHED_ARC_RAD).ceil().clamp(1.0, count);
        // Every searched step has the same number of sweeps.
        let count = (count / parts).ceil() * parts;
        let part_of = |number: u32, count: f64| {
            let ends = [f64::from(number) / count, f64::from(number + 1) / count];
            let [start, end] = ends.map(|share| pose_at(&from, &to, motion.arc.as_ref(), turn, share));
            let arc = motion.arc.map(|arc| TipArc { angle: arc.angle / count, ..arc });
            SweptStep::new(start, end, arc, motion.cutter, block)
        };
        let first_searched = self.searched.len() as u32;
        if reference > 0.0 {
            for number in 0..count as u32 {
                let step = part_of(number, count);
                if let Some(contour) = self.cutters.get(motion.cutter) {
                    let footprint = step.footprint(contour, self.stock_top());
                    self.glances.push(StepGlance::new(&step, &footprint));
                    self.footprints.push(footprint);
                }
                self.steps.push(step);
                self.index_step(self.steps.len() as u32 - 1);
                self.replace_repeated(self.steps.len() as u32 - 1);
            }
            if count > 1.0 {
                self.searched.extend((0..parts as u32).map(|number| part_of(number, parts)));
            }
        }
        let sweeps = first..self.steps.len() as u32;
        self.blocks.push(BlockSteps {
            sweeps,
            searched: first_searched..self.searched.len() as u32,
            reference,
        });
        Ok(block)
    }

    /// Returns the number of blocks.
    pub fn block_count(&self) -> usize {
        self.blocks.len()
    }

    /// Returns the cutters.
    pub fn cutters(&self) -> &[CutterContour] {
        &self.cutters
    }

    /// Returns the steps of a block that are searched.
    pub(super) fn searched_steps(&self, block: usize) -> Vec<SearchedStep<'_>> {
        let Some(BlockSteps { sweeps, searched, reference }) = self.blocks.get(block) else {
            return Vec::new();
        };
        let (list, range) =
            if searched.is_empty() { (&self.steps, sweeps) } else { (&self.searched, searched) };
        let steps = list.get(range.start as usize..range.end as usize).unwrap_or_default();
        let count = steps.len().max(1) as u32;
        let each = (sweeps.end - sweeps.start) / count;
        let part = |number: u32| f64::from(number) / f64::from(count);
        (0..)
            .zip(steps)
            .map(|(number, step)| SearchedStep {
                step,
                reference: reference / f64::from(count),
                first_sweep: sweeps.start + number * each,
                sweep_count: each,
                time_part: [part(number), part(number + 1)],
            })
            .collect()
    }

    /// Returns the number of a block's first step.
    pub(super) fn first_step_of(&self, block: usize) -> Option<u32> {
        self.blocks.get(block).map(|block| block.sweeps.start)
    }

    /// Returns the greatest height of the stock. What a cutter does above it matters to nothing.
    pub(super) fn stock_top(&self) -> f64 {
        let [_, high] = self.stock_bounds;
        high.z
    }

    /// Returns whether a box meets the box around the stock.
    pub(super) fn is_near_stock(&self, [low, high]: &[Vector3<f64>; 2]) -> bool {
        let [from, to] = &self.stock_bounds;
        (high - from).min() >= 0.0 && (to - low).min() >= 0.0
    }

    /// Returns the largest distance of the stock from one of two points, mm.
    pub(super) fn farthest_from(&self, points: &[Vector3<f64>; 2]) -> f64 {
        let [low, high] = self.stock_bounds;
        points.iter().map(|point| (point - low).abs().sup(&(high - point).abs()).norm()).fold(0.0, f64::max)
    }
}

fn guard_for(largest: f64) -> f64 {
    (largest * 4e-13).max(1e-10)
}

//! This module finds the forces of one motion: at places of its path what cuts is found from the motions themselves, and the
//! forces of these places make the means and the extremes of the motion.
//!
//! Places stand in the middles of stretches. A stretch is no longer than the cutter's radius, and is halved where its
//! quarters differ, down to a sixteenth of the radius; the means of a motion are over its time.

use super::certified_shares::{AskedPiece, BlockList};
use super::motion_forces::ForceAverage;
use super::{CuttingSpeed, EdgeMoment, ForceStretch, MotionForces, ToothPeriod};
use crate::certified_engagement::{BlockMotion, CertifiedProgram, ContactSection, CutterContour};
use crate::engagement::EdgeForceModel;

/// The most stretches of one block before any is halved.
const MOST_STRETCHES: f64 = 64.0;
/// Blocks up to this part of the radius have one place.
const SHORT_PART: f64 = 0.25;
/// Stretches down to this part of the radius are halved.
const LEAST_PART: f64 = 1.0 / 16.0;
/// The part by which what is removed at the quarters of a stretch may differ from its middle.
const ALIKE_PART: f64 = 0.02;
/// The most rows along one motion.
const MOST_ROWS: f64 = 1e5;

/// What a thread needs for the forces of one motion.
pub(super) struct MotionTask<'a> {
    pub program: &'a CertifiedProgram,
    pub list: &'a BlockList,
    pub asked: &'a AskedPiece,
    pub model: &'a EdgeForceModel,
    pub contour: &'a CutterContour,
    pub speed: CuttingSpeed,
    pub radius_mm: f64,
}

impl MotionTask<'_> {
    /// Lists the blocks of the motion with their lengths in mm, and the speed of the tip by the programmed one.
    fn list_blocks(&self) -> Vec<(usize, f64, f64)> {
        let blocks = self.asked.first..self.asked.first + self.asked.count;
        let measured = blocks.filter_map(|block| {
            let length = path_length_mm(self.list.block(block)?);
            let pace = self.list.paces.get(block).copied().unwrap_or(1.0);
            Some((block, length, pace.max(f64::MIN_POSITIVE)))
        });
        measured.collect()
    }

    /// Returns the forces at a time of a block, and what is removed per mm of path, mm2.
    fn find_place(&self, block: usize, time: f64, pace: f64) -> (MotionForces, f64) {
        let Some(section) = self.find_section(block, time, pace) else {
            return (MotionForces::in_air(self.model.is_beam()), 0.0);
        };
        let CuttingSpeed { feed_mm_min, rpm, .. } = self.speed;
        let forces = self.model.forces_of_section(&section, feed_mm_min, rpm);
        let has_heading = section.has_heading && section.tip_speed[0] > 1e-9;
        (MotionForces::of_place(&forces, has_heading, rpm), forces.swept_mm2)
    }

    fn find_section(&self, block: usize, time: f64, pace: f64) -> Option<ContactSection> {
        Some(self.program.find_contact_section(block, time)?.at_pace(pace))
    }

    /// Returns the forces of the whole motion.
    pub(super) fn find_whole(&self) -> MotionForces {
        let mut average = ForceAverage::default();
        for (block, length, pace) in self.list_blocks() {
            let count = if length <= SHORT_PART * self.radius_mm {
                1.0
            } else {
                (length / self.radius_mm).ceil().clamp(1.0, MOST_STRETCHES)
            };
            for number in 0..count as u32 {
                let times = [number, number + 1].map(|at| f64::from(at) / count);
                let middle = self.find_place(block, (times[0] + times[1]) / 2.0, pace);
                self.add_stretch((block, length, pace), times, middle, &mut average);
            }
        }
        average.sum.unwrap_or_default()
    }

    /// Adds a stretch whose middle is known, halving it where its quarters differ.
    fn add_stretch(
        &self,
        (block, length, pace): (usize, f64, f64),
        [from, to]: [f64; 2],
        (middle, swept): (MotionForces, f64),
        average: &mut ForceAverage,
    ) {
        // A block without length turns about its tip, and its time is all that counts.
        let time = (to - from) * if length > 0.0 { length / pace } else { 1.0 };
        let size = (to - from) * length;
        if length <= SHORT_PART * self.radius_mm || size <= LEAST_PART * self.radius_mm {
            average.add(&middle, time);
            return;
        }
        let at = (from + to) / 2.0;
        let quarters = [(from + at) / 2.0, (at + to) / 2.0].map(|time| self.find_place(block, time, pace));
        let [first, second] = &quarters;
        let apart = (first.1 - swept).abs().max((second.1 - swept).abs());
        if apart <= ALIKE_PART * swept.max(first.1).max(second.1) {
            average.add(&middle, time / 3.0);
            average.add(&first.0, time / 3.0);
            average.add(&second.0, time / 3.0);
            return;
        }
        let [first, second] = quarters;
        self.add_stretch((block, length, pace), [from, at], first, average);
        self.add_stretch((block, length, pace), [at, to], second, average);
    }

    /// Returns the forces on stretches that are at most so long.
    pub(super) fn find_stretches(&self, spacing_mm: f64) -> Vec<ForceStretch> {
        let mut stretches = Vec::new();
        let mut passed = 0.0;
        for (block, length, pace) in self.list_blocks() {
            let count = (length / spacing_mm - 1e-9).ceil().clamp(1.0, MOST_ROWS);
            for number in 0..count as u32 {
                let times = [number, number + 1].map(|at| f64::from(at) / count);
                let (forces, _) = self.find_place(block, (times[0] + times[1]) / 2.0, pace);
                let along_mm = times.map(|time| passed + time * length);
                stretches.push(ForceStretch { along_mm, forces });
            }
            passed += length;
        }
        stretches
    }

    /// Returns the block, the time in it and the pace at a share of the motion's length.
    fn find_share(&self, share: f64) -> Option<(usize, f64, f64)> {
        let blocks = self.list_blocks();
        let all: f64 = blocks.iter().map(|(_, length, _)| length).sum();
        let mut rest = all * share;
        for (block, length, pace) in blocks {
            if rest <= length {
                return Some((block, if length > 0.0 { rest / length } else { 0.5 }, pace));
            }
            rest -= length;
        }
        None
    }

    /// Returns the forces over one revolution in the middle of the motion.
    pub(super) fn find_period(&self, rotations: usize) -> ToothPeriod {
        self.find_period_at(0.5, rotations)
    }

    /// Returns the forces over one revolution in the middles of equal parts of the motion.
    pub(super) fn find_periods(&self, parts: usize, rotations: usize) -> Vec<ToothPeriod> {
        let middle = |number: usize| (number as f64 + 0.5) / parts as f64;
        (0..parts).map(|number| self.find_period_at(middle(number), rotations)).collect()
    }

    fn find_period_at(&self, share: f64, rotations: usize) -> ToothPeriod {
        let mut found = ToothPeriod { rotations: Vec::new(), forces: MotionForces::default() };
        let Some((block, time, pace)) = self.find_share(share) else { return found };
        found.forces = self.find_place(block, time, pace).0;
        if let Some(section) = self.find_section(block, time, pace) {
            let CuttingSpeed { feed_mm_min, rpm, .. } = self.speed;
            let turns = self.model.forces_over_revolution(&section, feed_mm_min, rpm, rotations);
            found.rotations = turns
                .into_iter()
                .map(|(turned, force, torque)| (turned.to_degrees(), force, torque))
                .collect();
        }
        found
    }

    /// Returns the chips on edges in the middle of the motion; `None` if it does not move.
    pub(super) fn find_edges(&self, grid: [usize; 2]) -> Option<EdgeMoment> {
        let (block, time, pace) = self.find_share(0.5)?;
        let section = self.find_section(block, time, pace)?;
        let CuttingSpeed { feed_mm_min, rpm, .. } = self.speed;
        Some(EdgeMoment {
            tip_mm: self.list.block(block)?.pose_at(time).tip.into(),
            frame: section.frame.map(Into::into),
            outline_mm: self.contour.list_outline_points(),
            map: self.model.map_edge_thickness(&section, self.contour, [feed_mm_min, rpm], grid),
        })
    }
}

/// Returns the length of the tip's path, mm.
fn path_length_mm(block: &BlockMotion) -> f64 {
    let way = block.to.tip - block.from.tip;
    let Some(arc) = &block.arc else { return way.norm() };
    let offset = block.from.tip - arc.center;
    let radius = (offset - arc.normal * offset.dot(&arc.normal)).norm();
    (radius * arc.angle).hypot(way.dot(&arc.normal))
}

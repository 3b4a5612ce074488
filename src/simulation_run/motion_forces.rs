//! This module finds the forces of motions: at places of their paths what cuts is found from the motions themselves, and the
//! forces of these places make the means and the extremes of a motion.
//!
//! Places stand in the middles of stretches. A stretch is no longer than the cutter's radius, and is halved where its
//! quarters differ, down to a sixteenth of the radius; the means of a motion are over its time.

use super::certified_shares::{AskedPiece, BlockList};
use super::{Machining, RunPhase, RunWatcher};
use crate::certified_engagement::{BlockMotion, CertifiedProgram, ContactSection, CutterContour};
use crate::diagnostic::Failure;
use crate::engagement::{CuttingLaw, EdgeForceModel, EdgeThicknessMap, SectionForces};
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::program::record::SpindleDirection;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::f64::consts::TAU;
use std::sync::atomic::{AtomicUsize, Ordering};

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
/// Motions of which one thread finds the forces before it looks whether it has to stop.
const MOTIONS_OF_A_RUN: usize = 32;

/// The feed and the speed with which a motion cuts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CuttingSpeed {
    /// The feed in mm/min.
    pub feed_mm_min: f64,
    /// The spindle speed in rev/min.
    pub rpm: f64,
    /// The sense of the spindle.
    pub direction: SpindleDirection,
}

/// The forces on the workpiece while a motion cuts, in N and N m. Axes are those of the workpiece frame, which is the frame
/// of the program's first motion.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct MotionForces {
    /// Means ahead, to the left and along the tool axis away from the tip, over the motion's time.
    pub tool_mean_n: [f64; 3],
    /// Whether there is an ahead on all of the motion: a plunge has none.
    pub has_heading: bool,
    /// Means in the axes.
    pub mean_n: [f64; 3],
    /// The least values in the axes, over all revolutions.
    pub least_n: [f64; 3],
    /// The largest values in the axes.
    pub largest_n: [f64; 3],
    /// The largest resultant.
    pub resultant_peak_n: f64,
    /// The largest part across the tool axis.
    pub bending_peak_n: f64,
    /// The mean torque.
    pub torque_mean_nm: f64,
    /// The largest torque.
    pub torque_peak_nm: f64,
    /// The mean power, kW.
    pub power_mean_kw: f64,
    /// The largest power of a place, as its mean over a revolution, kW.
    pub power_peak_kw: f64,
}

impl MotionForces {
    /// Returns the length of the mean force.
    pub fn resultant_mean_n(&self) -> f64 {
        let [x, y, z] = self.mean_n;
        x.hypot(y).hypot(z)
    }

    /// Returns the length of the mean force's part across the tool axis.
    pub fn bending_mean_n(&self) -> f64 {
        let [ahead, left, _] = self.tool_mean_n;
        ahead.hypot(left)
    }

    /// Returns the forces of a motion in air.
    pub(crate) fn in_air() -> Self {
        Self { has_heading: true, ..Self::default() }
    }

    fn of_place(forces: &SectionForces, has_heading: bool, rpm: f64) -> Self {
        let power_kw = forces.torque_mean_nm * TAU * rpm / 60_000.0;
        Self {
            tool_mean_n: forces.tool_mean_n,
            has_heading,
            mean_n: forces.mean_n,
            least_n: forces.least_n,
            largest_n: forces.largest_n,
            resultant_peak_n: forces.resultant_peak_n,
            bending_peak_n: forces.bending_peak_n,
            torque_mean_nm: forces.torque_mean_nm,
            torque_peak_nm: forces.torque_peak_nm,
            power_mean_kw: power_kw,
            power_peak_kw: power_kw,
        }
    }
}

/// The forces of places, each with its part of the time, become those of a motion.
#[derive(Debug, Default)]
struct ForceAverage {
    sum: Option<MotionForces>,
    time: f64,
}

impl ForceAverage {
    fn add(&mut self, place: &MotionForces, time: f64) {
        let Some(sum) = &mut self.sum else {
            (self.sum, self.time) = (Some(*place), time);
            return;
        };
        let part = time / (self.time + time);
        let blend = |sum: &mut f64, value: f64| *sum += (value - *sum) * part;
        sum.tool_mean_n.iter_mut().zip(place.tool_mean_n).for_each(|(sum, value)| blend(sum, value));
        sum.mean_n.iter_mut().zip(place.mean_n).for_each(|(sum, value)| blend(sum, value));
        blend(&mut sum.torque_mean_nm, place.torque_mean_nm);
        blend(&mut sum.power_mean_kw, place.power_mean_kw);
        sum.least_n.iter_mut().zip(place.least_n).for_each(|(sum, value)| *sum = sum.min(value));
        sum.largest_n.iter_mut().zip(place.largest_n).for_each(|(sum, value)| *sum = sum.max(value));
        sum.resultant_peak_n = sum.resultant_peak_n.max(place.resultant_peak_n);
        sum.bending_peak_n = sum.bending_peak_n.max(place.bending_peak_n);
        sum.torque_peak_nm = sum.torque_peak_nm.max(place.torque_peak_nm);
        sum.power_peak_kw = sum.power_peak_kw.max(place.power_peak_kw);
        sum.has_heading &= place.has_heading;
        self.time += time;
    }
}

/// The forces on a stretch inside a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct ForceStretch {
    /// Where it begins and ends, mm from the start of the motion.
    pub along_mm: [f64; 2],
    /// The forces in its middle.
    pub forces: MotionForces,
}

/// The forces over one revolution at the middle of a motion.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ToothPeriod {
    /// For each rotation the angle in degrees from a tooth straight ahead, the force on the workpiece in N, and the torque in
    /// N m.
    pub rotations: Vec<(f64, [f64; 3], f64)>,
    /// The forces there.
    pub forces: MotionForces,
}

/// The chips on edges in the middle of a motion.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct EdgeMoment {
    /// The tip, mm in the workpiece frame.
    pub tip_mm: [f64; 3],
    /// The unit vectors of the workpiece frame ahead, to the left as seen from the holder, and along the axis away from the
    /// tip.
    pub frame: [[f64; 3]; 3],
    /// The meridian of the cutter as a polyline from the tip upwards: distances from the axis and heights, mm.
    pub outline_mm: Vec<[f64; 2]>,
    /// The thickness over edges and rotations.
    pub map: EdgeThicknessMap,
}

/// Which forces are wanted.
pub(crate) struct ForceRequest<'r> {
    /// What the material asks of an edge.
    pub law: CuttingLaw,
    /// Says with what feed and speed a motion cuts; `None` leaves it out.
    pub speed_of: &'r dyn Fn(usize, &Motion) -> Option<CuttingSpeed>,
}

/// The forces of all motions that can cut.
#[derive(Debug, Default)]
pub(crate) struct FoundForces {
    /// The forces, by the numbers of the motions.
    pub of_motions: BTreeMap<usize, MotionForces>,
    /// Whether the forces of all motions were found whose tool has teeth and whose feed and speed are known.
    pub is_complete: bool,
}

/// What a thread needs for the forces of one motion.
struct MotionTask<'a> {
    program: &'a CertifiedProgram,
    list: &'a BlockList,
    asked: &'a AskedPiece,
    model: &'a EdgeForceModel,
    contour: &'a CutterContour,
    speed: CuttingSpeed,
    radius_mm: f64,
}

impl Machining<'_> {
    /// Finds the forces of all motions by the setup's material; none without one.
    ///
    /// # Errors
    /// Returns [`Failure::Interrupted`] if `watch` has stopped the run.
    pub(crate) fn find_all_forces(&self, watch: &dyn RunWatcher) -> Result<FoundForces, Failure> {
        let Ok(material) = self.setup.require_material() else { return Ok(FoundForces::default()) };
        let request =
            ForceRequest { law: material.law, speed_of: &|_, motion| self.cutting_speed_of(motion) };
        let Some(of_motions) = self.find_motion_forces(&request, watch)? else {
            return Ok(FoundForces::default());
        };
        let contours = self.list_contours();
        let cutters = self.tooling.cutters().iter().zip(&contours);
        let is_complete =
            cutters.into_iter().all(|(cutter, contour)| cutter.teeth.is_none() || contour.is_some());
        Ok(FoundForces { of_motions, is_complete })
    }

    /// Returns the feed and the speed of a motion as far as both are known; that of a rapid is the machine's. A spindle
    /// whose sense is not stated turns clockwise.
    pub(crate) fn cutting_speed_of(&self, motion: &Motion) -> Option<CuttingSpeed> {
        if motion.path == MotionPath::Start {
            return None;
        }
        let rpm = motion.spindle_rpm().filter(|rpm| *rpm > 0.0)?;
        let feed = if motion.rapid {
            self.setup.machine.rapid_feed.map(|feed| feed.get())
        } else {
            motion.feed.and_then(|feed| feed.mm_per_minute(self.units, Some(rpm), Some(motion.length())))
        };
        let told = motion.spindle.as_deref().and_then(|spindle| spindle.direction);
        Some(CuttingSpeed {
            feed_mm_min: feed.filter(|feed| *feed > 0.0)?,
            rpm,
            direction: told.unwrap_or(SpindleDirection::Clockwise),
        })
    }

    /// Finds the forces of motions, by their numbers. Returns `None` where the stock has no gap, or a coordinate is beyond a
    /// kilometre; motions of tools without teeth, or that are narrower above their widest place, are left out.
    ///
    /// # Errors
    /// Returns [`Failure::Interrupted`] if `watch` has stopped the run.
    pub(crate) fn find_motion_forces(
        &self,
        request: &ForceRequest<'_>,
        watch: &dyn RunWatcher,
    ) -> Result<Option<BTreeMap<usize, MotionForces>>, Failure> {
        self.examine_places(request, &|task| task.find_whole(), watch)
    }

    /// Finds the forces on stretches of motions that are at most `spacing_mm` long, as
    /// [`Machining::find_motion_forces`] does.
    ///
    /// # Errors
    /// Returns [`Failure::Interrupted`] if `watch` has stopped the run.
    pub(crate) fn find_forces_along(
        &self,
        request: &ForceRequest<'_>,
        spacing_mm: f64,
        watch: &dyn RunWatcher,
    ) -> Result<Option<BTreeMap<usize, Vec<ForceStretch>>>, Failure> {
        self.examine_places(request, &|task| task.find_stretches(spacing_mm), watch)
    }

    /// Finds the forces over one revolution in the middle of motions, at so many rotations.
    ///
    /// # Errors
    /// Returns [`Failure::Interrupted`] if `watch` has stopped the run.
    pub(crate) fn find_tooth_periods(
        &self,
        request: &ForceRequest<'_>,
        rotations: usize,
        watch: &dyn RunWatcher,
    ) -> Result<Option<BTreeMap<usize, ToothPeriod>>, Failure> {
        self.examine_places(request, &|task| task.find_period(rotations), watch)
    }

    /// Maps the chip thickness over edges in the middle of motions, at so many rotations and points of an edge.
    ///
    /// # Errors
    /// Returns [`Failure::Interrupted`] if `watch` has stopped the run.
    pub(crate) fn find_edge_moments(
        &self,
        request: &ForceRequest<'_>,
        grid: [usize; 2],
        watch: &dyn RunWatcher,
    ) -> Result<Option<BTreeMap<usize, EdgeMoment>>, Failure> {
        let found = self.examine_places(request, &|task| task.find_edges(grid), watch)?;
        Ok(found.map(|found| found.into_iter().filter_map(|(at, moment)| Some((at, moment?))).collect()))
    }

    /// Makes something of each motion that is asked for.
    fn examine_places<T: Send>(
        &self,
        request: &ForceRequest<'_>,
        examine: &(dyn Fn(&MotionTask<'_>) -> T + Sync),
        watch: &dyn RunWatcher,
    ) -> Result<Option<BTreeMap<usize, T>>, Failure> {
        let models = self.tooling.build_edge_models(&request.law);
        let contours = self.list_contours();
        let mut speeds: BTreeMap<usize, (usize, CuttingSpeed)> = BTreeMap::new();
        for (number, motion) in self.program.motions().enumerate() {
            let index = self.tooling.cutter_index(&motion);
            let has_model = |index: &usize| models.get(*index).is_some_and(Option::is_some);
            if let Some(index) = index.filter(has_model)
                && let Some(speed) = (request.speed_of)(number, &motion)
            {
                speeds.insert(number, (index, speed));
            }
        }
        if speeds.is_empty() {
            return Ok(Some(BTreeMap::new()));
        }
        let whole = |motion: usize| speeds.contains_key(&motion).then(|| vec![1.0]);
        let Some((program, list)) = self.prepare_blocks(&whole) else { return Ok(None) };
        watch.begin_phase(RunPhase::Simulating);
        let (done, all) = (AtomicUsize::new(0), list.asked.len() as f64);
        let examine_run = |run: &[AskedPiece]| -> Result<Vec<Option<T>>, Failure> {
            let mut made = Vec::with_capacity(run.len());
            for asked in run {
                watch.check_stop()?;
                let speed = speeds.get(&asked.motion).copied();
                made.push(speed.and_then(|(index, speed)| {
                    let [clockwise, counter] = models.get(index)?.as_ref()?;
                    let is_clockwise = speed.direction == SpindleDirection::Clockwise;
                    let model = if is_clockwise { clockwise } else { counter };
                    let radius_mm = self.tooling.cutters().get(index)?.radius_mm();
                    let contour = contours.get(index)?.as_ref()?;
                    let (program, list) = (&program, &list);
                    Some(examine(&MotionTask { program, list, asked, model, contour, speed, radius_mm }))
                }));
            }
            let done = done.fetch_add(run.len(), Ordering::Relaxed) + run.len();
            watch.report_progress(done as f64, all);
            Ok(made)
        };
        let runs: Result<Vec<_>, Failure> =
            list.asked.par_chunks(MOTIONS_OF_A_RUN).map(examine_run).collect();
        let made = list.asked.iter().zip(runs?.into_iter().flatten());
        Ok(Some(made.filter_map(|(asked, made)| Some((asked.motion, made?))).collect()))
    }
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
            return (MotionForces::in_air(), 0.0);
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
    fn find_whole(&self) -> MotionForces {
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
    fn find_stretches(&self, spacing_mm: f64) -> Vec<ForceStretch> {
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

    /// Returns the block, the time in it and the pace in the middle of the motion.
    fn find_middle(&self) -> Option<(usize, f64, f64)> {
        let blocks = self.list_blocks();
        let all: f64 = blocks.iter().map(|(_, length, _)| length).sum();
        let mut rest = all / 2.0;
        for (block, length, pace) in blocks {
            if rest <= length {
                return Some((block, if length > 0.0 { rest / length } else { 0.5 }, pace));
            }
            rest -= length;
        }
        None
    }

    /// Returns the forces over one revolution in the middle of the motion.
    fn find_period(&self, rotations: usize) -> ToothPeriod {
        let mut found = ToothPeriod { rotations: Vec::new(), forces: MotionForces::default() };
        let Some((block, time, pace)) = self.find_middle() else { return found };
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
    fn find_edges(&self, grid: [usize; 2]) -> Option<EdgeMoment> {
        let (block, time, pace) = self.find_middle()?;
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

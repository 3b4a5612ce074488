//! This module joins short steps on nearly one line to runs, so that what a block costs depends less on how
//! finely a program is divided.
//!
//! A run is a chord with the deviation of its steps: every point of the chord is that near to their way, and
//! the other way round. So a place that is deeper than the deviation in the chord's sweep is in that of the
//! steps, and one that is further away from it is in none. A hull for which the chord is too rough is tested
//! against the steps themselves.

use super::certified_program::CertifiedProgram;
use super::cutter_contour::CutterContour;
use super::cutter_pose::CutterPose;
use super::step_index::StepBounds;
use super::swept_step::SweptStep;
use nalgebra::Vector3;
use std::ops::Range;

/// The bit of a number that tells runs from steps.
const RUN_BIT: u32 = 1 << 31;
/// The most steps of a run.
const MOST_STEPS: usize = 16;
/// The largest deviation of a run, mm.
const MOST_DEVIATION_MM: f64 = 0.02;

/// A run of steps.
#[derive(Debug, Clone)]
pub(super) struct StepRun {
    pub chord: SweptStep,
    pub footprint: [f64; 4],
    pub steps: Range<u32>,
}

/// The last steps of a program, which may become a run.
#[derive(Debug, Clone, Default)]
pub(super) struct OpenRun {
    first: u32,
    tips: Vec<Vector3<f64>>,
    axis: Vector3<f64>,
    cutter: usize,
}

/// Returns how far places are from the chord between the first and the last one, if they follow it.
fn deviation_of(tips: &[Vector3<f64>]) -> Option<f64> {
    let (first, last) = (tips.first()?, tips.last()?);
    let way = last - first;
    let squared = way.norm_squared();
    if squared < 1e-12 {
        return None;
    }
    let (mut deviation, mut at) = (0.0_f64, 0.0);
    for tip in tips {
        let share = (tip - first).dot(&way) / squared;
        if share < at || share > 1.0 + 1e-12 {
            return None;
        }
        at = share;
        deviation = deviation.max((tip - first - way * share).norm());
    }
    Some(deviation)
}

impl CertifiedProgram {
    /// Adds the last step to the index, or to the run that it continues.
    pub(super) fn index_step(&mut self, number: u32) {
        let Some((step, contour)) = self.step_and_contour(number) else { return };
        if !step.is_straight() {
            let bounds = step.bounds(contour);
            self.close_run();
            self.index.add(number, number, bounds);
            return;
        }
        let [from, to] = step.tips;
        let (axis, cutter) = (step.axes[0], step.cutter);
        let open = &mut self.open_run;
        let continues = open.cutter == cutter && open.axis == axis && open.tips.last() == Some(&from);
        if continues && open.tips.len() <= MOST_STEPS {
            open.tips.push(to);
            if deviation_of(&open.tips).is_some_and(|deviation| deviation <= MOST_DEVIATION_MM) {
                return;
            }
            open.tips.pop();
        }
        self.close_run();
        self.open_run = OpenRun { first: number, tips: vec![from, to], axis, cutter };
    }

    /// Puts the open run into the index: as a run, or as its only step.
    fn close_run(&mut self) {
        let open = std::mem::take(&mut self.open_run);
        let (Some(from), Some(to)) = (open.tips.first(), open.tips.last()) else { return };
        let Some(contour) = self.cutters.get(open.cutter) else { return };
        let steps = open.first..open.first + open.tips.len() as u32 - 1;
        let deviation = deviation_of(&open.tips);
        if let (2.., Some(deviation)) = (steps.len(), deviation) {
            let pose = |tip: &Vector3<f64>| CutterPose { tip: *tip, axis: open.axis };
            let chord = SweptStep::chord(pose(from), pose(to), deviation, open.cutter, 0);
            let (bounds, footprint) = (chord.bounds(contour), chord.footprint(contour));
            let number = RUN_BIT | self.runs.len() as u32;
            self.runs.push(StepRun { chord, footprint, steps });
            self.index.add(number, open.first, bounds);
            return;
        }
        for number in steps {
            if let Some(step) = self.steps.get(number as usize) {
                self.index.add(number, number, step.bounds(contour));
            }
        }
    }

    /// Finds the steps and runs before a step whose boxes meet a box.
    pub(super) fn find_steps(&self, bounds: &StepBounds, before: u32, out: &mut Vec<u32>) {
        // The last steps are not in the index yet.
        let open = self.open_run.tips.len().saturating_sub(1) as u32;
        let last = self.open_run.first..self.open_run.first + open;
        out.extend(last.rev().filter(|number| *number < before));
        let mut found = Vec::new();
        self.index.find(bounds, before, &mut found);
        for number in found {
            if self.is_earlier(number, before) {
                out.push(number);
            } else {
                out.extend(self.members_of(number).rev().filter(|member| *member < before));
            }
        }
    }

    #[inline]
    fn run(&self, number: u32) -> Option<&StepRun> {
        if number & RUN_BIT == 0 { None } else { self.runs.get((number & !RUN_BIT) as usize) }
    }

    /// Returns a step, or the chord of a run, and its cutter.
    #[inline]
    pub(super) fn step_and_contour(&self, number: u32) -> Option<(&SweptStep, &CutterContour)> {
        let step = match self.run(number) {
            Some(run) => &run.chord,
            None => self.steps.get(number as usize)?,
        };
        Some((step, self.cutters.get(step.cutter)?))
    }

    /// Returns the disc of a step or a run, and its lowest height.
    #[inline]
    pub(super) fn footprint_of_step(&self, number: u32) -> Option<&[f64; 4]> {
        match self.run(number) {
            Some(run) => Some(&run.footprint),
            None => self.footprints.get(number as usize),
        }
    }

    /// Returns the steps of a run; of a step, itself.
    pub(super) fn members_of(&self, number: u32) -> Range<u32> {
        self.run(number).map_or(number..number.saturating_add(1), |run| run.steps.clone())
    }

    /// Returns the steps of a run whose chord is not exact, or what stands for itself.
    pub(super) fn exact_parts_of(&self, number: u32) -> Range<u32> {
        if self.deviation_of(number) > EXACT_MM {
            self.members_of(number)
        } else {
            number..number.saturating_add(1)
        }
    }

    /// Returns the deviation of a run; of a step, none.
    #[inline]
    pub(super) fn deviation_of(&self, number: u32) -> f64 {
        self.run(number).map_or(0.0, |run| run.chord.path_deviation)
    }

    /// Returns whether a step, or all of a run, is before a step.
    #[inline]
    pub(super) fn is_earlier(&self, number: u32, before: u32) -> bool {
        self.run(number).map_or(number, |run| run.steps.end.saturating_sub(1)) < before
    }
}

/// A chord that is so near to its steps (mm) is as good as they are; it is less than the guard.
const EXACT_MM: f64 = 1e-11;

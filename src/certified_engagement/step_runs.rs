//! This module joins short steps on nearly one line to runs, so that what a block costs depends less on how
//! finely a program is divided. The axis may turn nearly evenly.
//!
//! A run is a chord with the deviation of its steps: every point of the chord's cutter is that near to one of theirs,
//! and the other way round. So a place that is deeper than the deviation in the chord's sweep is in that of the
//! steps, and one that is further away from it is in none. A hull for which the chord is too rough is tested
//! against the steps themselves.

use super::certified_program::CertifiedProgram;
use super::cutter_contour::CutterContour;
use super::cutter_pose::CutterPose;
use super::step_glance::{StepFootprint, StepGlance, is_beside};
use super::step_index::StepBounds;
use super::swept_step::SweptStep;
use nalgebra::Vector3;
use std::ops::Range;

/// What stands for the number of a step that there is not.
pub(super) const NEVER: u32 = u32::MAX;
/// The bit of a number that tells runs from steps.
const RUN_BIT: u32 = 1 << 31;
/// The most steps of a run.
const MOST_STEPS: usize = 16;
/// The largest deviation of a run, mm.
const MOST_DEVIATION_MM: f64 = 0.02;
/// The largest angle by which the axis of a run turns, radians.
const MOST_TURN_RAD: f64 = 0.1;

/// A run of steps.
#[derive(Debug, Clone)]
pub(super) struct StepRun {
    pub chord: SweptStep,
    pub footprint: StepFootprint,
    pub glance: StepGlance,
    pub steps: Range<u32>,
    /// The deviation, and about how far a point near the tip is from its line while the axis turns, mm.
    roughness: f64,
}

/// The last steps of a program, which may become a run.
#[derive(Debug, Clone, Default)]
pub(super) struct OpenRun {
    first: u32,
    poses: Vec<CutterPose>,
    cutter: usize,
}

/// Returns how far points of a cutter are from where they are on the chord between the first and the last pose, if the
/// poses follow it; `reach` is the largest distance of such a point from the tip.
///
/// Between two poses the axis turns evenly, and so does the chord's. Their difference is at most that at the poses, and
/// an eighth of both squared angles.
fn deviation_of(poses: &[CutterPose], reach: f64) -> Option<f64> {
    let (first, last) = (poses.first()?, poses.last()?);
    let way = last.tip - first.tip;
    let squared = way.norm_squared();
    let turn = angle_between(&first.axis, &last.axis);
    if squared < 1e-12 || turn > MOST_TURN_RAD {
        return None;
    }
    let (mut aside, mut askew, mut bend) = (0.0_f64, 0.0_f64, 0.0_f64);
    let (mut at, mut axis) = (0.0, first.axis);
    for pose in poses {
        let share = (pose.tip - first.tip).dot(&way) / squared;
        if share < at || share > 1.0 + 1e-12 {
            return None;
        }
        aside = aside.max((pose.tip - first.tip - way * share).norm());
        if pose.axis != first.axis || turn > 0.0 {
            askew = askew.max((pose.axis - turned_axis(&first.axis, &last.axis, turn, share)).norm());
            let [own, of_chord] = [angle_between(&axis, &pose.axis), turn * (share - at)];
            bend = bend.max((own * own + of_chord * of_chord) / 8.0);
        }
        (at, axis) = (share, pose.axis);
    }
    Some(aside + (askew + bend) * reach)
}

fn angle_between(one: &Vector3<f64>, other: &Vector3<f64>) -> f64 {
    if one == other { 0.0 } else { one.cross(other).norm().atan2(one.dot(other)) }
}

/// Returns the axis at a share of an even turn.
fn turned_axis(from: &Vector3<f64>, to: &Vector3<f64>, turn: f64, share: f64) -> Vector3<f64> {
    if turn < 1e-9 {
        return *from;
    }
    (from * ((1.0 - share) * turn).sin() + to * (share * turn).sin()) / turn.sin()
}

impl CertifiedProgram {
    /// Adds the last step to the index, or to the run that it continues.
    pub(super) fn index_step(&mut self, number: u32) {
        let Some((step, contour)) = self.step_and_contour(number) else { return };
        if step.arc.is_some() {
            let bounds = step.bounds(contour, self.stock_top());
            self.close_run();
            self.index.add(number, number, bounds, NEVER);
            return;
        }
        let reach = contour.height_mm().hypot(contour.radius_mm());
        let [from, to] = [0, 1].map(|end| step.pose_at_end(end));
        let cutter = step.cutter;
        let open = &mut self.open_run;
        let continues = open.cutter == cutter && open.poses.last() == Some(&from);
        if continues && open.poses.len() <= MOST_STEPS {
            open.poses.push(to);
            if deviation_of(&open.poses, reach).is_some_and(|deviation| deviation <= MOST_DEVIATION_MM) {
                return;
            }
            open.poses.pop();
        }
        self.close_run();
        self.open_run = OpenRun { first: number, poses: vec![from, to], cutter };
    }

    /// Puts the open run into the index: as a run, or as its only step.
    fn close_run(&mut self) {
        let open = std::mem::take(&mut self.open_run);
        let (Some(from), Some(to)) = (open.poses.first(), open.poses.last()) else { return };
        let Some(contour) = self.cutters.get(open.cutter) else { return };
        let steps = open.first..open.first + open.poses.len() as u32 - 1;
        let deviation = deviation_of(&open.poses, contour.height_mm().hypot(contour.radius_mm()));
        if let (2.., Some(deviation)) = (steps.len(), deviation) {
            let chord = SweptStep::chord(*from, *to, deviation, open.cutter, 0);
            let bounds = chord.bounds(contour, self.stock_top());
            let footprint = chord.footprint(contour, self.stock_top());
            let glance = StepGlance::new(&chord, &footprint);
            let number = RUN_BIT | self.runs.len() as u32;
            let roughness = chord.gap_uncertainty(&chord.tips[0], contour.radius_mm());
            let replaced = self.replaced_whole(steps.clone());
            self.runs.push(StepRun { chord, footprint, glance, steps, roughness });
            self.index.add(number, open.first, bounds, replaced);
            return;
        }
        for number in steps {
            if let Some(step) = self.steps.get(number as usize) {
                let replaced = self.replaced.get(number as usize).copied().unwrap_or(NEVER);
                self.index.add(number, number, step.bounds(contour, self.stock_top()), replaced);
            }
        }
    }

    /// Finds the steps before a step whose boxes meet a box, and the runs before `own`, the first step of a block.
    pub(super) fn find_steps(&self, bounds: &StepBounds, [before, own]: [u32; 2], out: &mut Vec<u32>) {
        // The last steps are not in the index yet.
        let open = self.open_run.poses.len().saturating_sub(1) as u32;
        let last = self.open_run.first..self.open_run.first + open;
        out.extend(last.rev().filter(|number| *number < before));
        let mut found = Vec::new();
        self.index.find(bounds, [before, own], &mut found);
        for number in found {
            if self.is_earlier(number, before.min(own)) {
                out.push(number);
            } else {
                out.extend(self.members_of(number).rev().filter(|member| *member < before));
            }
        }
    }

    /// Returns by which step the last one of some steps was replaced, if all of them are.
    fn replaced_whole(&self, steps: Range<u32>) -> u32 {
        let replaced = self.replaced.get(steps.start as usize..steps.end as usize).unwrap_or_default();
        if replaced.len() < steps.len() { NEVER } else { replaced.iter().copied().max().unwrap_or(NEVER) }
    }

    /// Tells the index that a step was replaced, or the run that holds it if that is replaced now as a whole.
    pub(super) fn replace_in_index(&mut self, step: u32) {
        // What is not in the index yet is told when it is added.
        if step >= self.open_run.first && !self.open_run.poses.is_empty() {
            return;
        }
        let after = self.runs.partition_point(|run| run.steps.start <= step);
        let run =
            after.checked_sub(1).and_then(|at| self.runs.get(at)).filter(|run| run.steps.contains(&step));
        let (first, steps, bounds) = match run {
            Some(run) => (run.steps.start, run.steps.clone(), self.bounds_of(&run.chord)),
            None => {
                let Some(swept) = self.steps.get(step as usize) else { return };
                (step, step..step.saturating_add(1), self.bounds_of(swept))
            }
        };
        let by = self.replaced_whole(steps);
        if let Some(bounds) = bounds
            && by != NEVER
        {
            self.index.replace(first, &bounds, by);
        }
    }

    fn bounds_of(&self, step: &SweptStep) -> Option<StepBounds> {
        self.cutters.get(step.cutter).map(|contour| step.bounds(contour, self.stock_top()))
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

    /// Returns whether a step or a run stands beside or above a place: x, y, radius, and the highest z.
    #[inline]
    pub(super) fn is_far(&self, number: u32, place: &[f64; 4]) -> bool {
        self.footprint_of_step(number).is_none_or(|footprint| is_beside(footprint, place))
    }

    /// Returns the footprint of a step or a run.
    #[inline]
    pub(super) fn footprint_of_step(&self, number: u32) -> Option<&StepFootprint> {
        match self.run(number) {
            Some(run) => Some(&run.footprint),
            None => self.footprints.get(number as usize),
        }
    }

    /// Returns what a look at a step or a run needs.
    #[inline]
    pub(super) fn glance_of(&self, number: u32) -> Option<&StepGlance> {
        match self.run(number) {
            Some(run) => Some(&run.glance),
            None => self.glances.get(number as usize),
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

    /// Returns the deviation of a run, about as its turn makes it near the tip; of a step, none.
    #[inline]
    pub(super) fn deviation_of(&self, number: u32) -> f64 {
        self.run(number).map_or(0.0, |run| run.roughness)
    }

    /// Returns whether a step, or all of a run, is before a step.
    #[inline]
    pub(super) fn is_earlier(&self, number: u32, before: u32) -> bool {
        self.run(number).map_or(number, |run| run.steps.end.saturating_sub(1)) < before
    }
}

/// A chord that is so near to its steps (mm) is as good as they are; it is less than the guard.
const EXACT_MM: f64 = 1e-11;

//! This module finds the forces of motions: which motions have forces, and with what feed, speed and cutter.

use super::certified_shares::AskedPiece;
use super::motion_places::MotionTask;
use super::{
    CuttingSpeed, EdgeMoment, ForceStretch, Machining, MotionForces, RunPhase, RunWatcher, ToothPeriod,
};
use crate::diagnostic::Failure;
use crate::engagement::CuttingLaw;
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::program::record::SpindleDirection;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};

/// Motions of which one thread finds the forces before it looks whether it has to stop.
const MOTIONS_OF_A_RUN: usize = 32;

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

    /// Finds the forces over one revolution in the middles of equal parts of motions, at so many rotations.
    ///
    /// # Errors
    /// Returns [`Failure::Interrupted`] if `watch` has stopped the run.
    pub(crate) fn find_moment_periods(
        &self,
        request: &ForceRequest<'_>,
        [parts, rotations]: [usize; 2],
        watch: &dyn RunWatcher,
    ) -> Result<Option<BTreeMap<usize, Vec<ToothPeriod>>>, Failure> {
        self.examine_places(request, &|task| task.find_periods(parts, rotations), watch)
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

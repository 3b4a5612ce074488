//! This module runs a program over its stock of columns.

use super::faults::FaultCollector;
use super::{Machining, RunPhase, RunWatcher, SimulationRunOptions};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::engagement::{Engagement, MotionPiece, PathPiece, Simulation, removal_window_mm};
use crate::program::motion::Motion;
use crate::stock::{Dexels, StockError};
use nalgebra::Vector3;

/// The number of pieces that are simulated together: enough for every thread, and few enough to need little
/// memory.
const BATCH: usize = 1024;

/// An axis that is no further from z than this in any component is upright. Files print axes with four decimals
/// at least.
const UPRIGHT: f64 = 1e-6;

/// The largest distance of a chord from its arc, as a fraction of a cell, and in mm; the smaller one counts.
const SAGITTA: (f64, f64) = (0.02, 0.002);

/// Returns the largest distance of chords from their arcs and splines, mm, for columns that are `cell_mm`
/// apart.
pub(crate) fn chord_tolerance_mm(cell_mm: f64) -> f64 {
    (cell_mm * SAGITTA.0).min(SAGITTA.1)
}

/// A motion and its engagement.
#[derive(Debug)]
#[non_exhaustive]
pub struct EngagedMotion<'a> {
    /// The motion.
    pub motion: &'a Motion,
    /// The index of the motion among all motions of the program.
    pub number: usize,
    /// The index of its cutter; `None` for a rapid with a tool whose shape is not known.
    pub cutter: Option<usize>,
    /// Its pieces in order, each with its engagement. The list is empty for a motion that stays at its place.
    pub pieces: &'a [(MotionPiece, Engagement)],
}

impl EngagedMotion<'_> {
    /// Returns the engagement of the whole motion, or `None` if it stays at its place.
    pub fn whole_engagement(&self) -> Option<Engagement> {
        let (first, rest) = self.pieces.split_first()?;
        let mut whole = first.1.clone();
        rest.iter().for_each(|(_, piece)| whole.append_piece(piece));
        Some(whole)
    }
}

/// The result of a run.
#[derive(Debug)]
#[non_exhaustive]
pub struct DexelRunResult {
    /// The stock that is left.
    pub left: Dexels,
    /// The volume of the stock before the run, mm3.
    pub before_mm3: f64,
    /// The distance of columns, mm.
    pub cell_mm: f64,
    /// The findings: collisions, and cuts at rapid or with a spindle that does not turn.
    pub findings: Vec<Diagnostic>,
}

/// Looks at the stock while a program cuts it.
pub(crate) trait StockObserver {
    /// Returns whether the stock is wanted once this fraction (0 to 1) of the path is done. It is asked after each motion.
    fn wants_stock_at(&self, path_fraction: f64) -> bool;

    /// Gets the stock as all motions so far have left it. The first call is before any motion.
    fn observe_stock(&mut self, stock: &Dexels);
}

/// Looks at no stock.
struct UnobservedStock;

impl StockObserver for UnobservedStock {
    fn wants_stock_at(&self, _: f64) -> bool {
        false
    }

    fn observe_stock(&mut self, _: &Dexels) {}
}

impl Machining<'_> {
    /// Runs the whole program. `sink` gets every motion in order with its engagement.
    ///
    /// # Errors
    /// Returns the errors of [`Machining::estimate_cost`], and [`Failure::Interrupted`] if `watch` stopped
    /// the run.
    pub fn simulate_program(
        &self,
        options: &SimulationRunOptions,
        watch: &dyn RunWatcher,
        sink: &mut dyn FnMut(&EngagedMotion<'_>),
    ) -> Result<DexelRunResult, Failure> {
        self.simulate_observed_program(options, watch, sink, &mut UnobservedStock)
    }

    /// Does the same, and shows `observer` the stock on the way. Every motion before that place has been given to `sink`
    /// by then.
    pub(crate) fn simulate_observed_program(
        &self,
        options: &SimulationRunOptions,
        watch: &dyn RunWatcher,
        sink: &mut dyn FnMut(&EngagedMotion<'_>),
        observer: &mut dyn StockObserver,
    ) -> Result<DexelRunResult, Failure> {
        watch.begin_phase(RunPhase::Simulating);
        let plan = self.estimate_cost(&options.within_limits(watch))?;
        watch.report_estimate(&plan.to_estimate());
        let stock = self.fill_columns(plan.cell_mm)?;
        let before_mm3 = stock.volume_mm3();
        let window = options.removal_peaks.then(|| removal_window_mm(plan.cell_mm));
        let mut simulation = Simulation::new(stock, options.forces).with_removal_window_mm(window);
        let mut trace = self
            .start_path(chord_tolerance_mm(plan.cell_mm), options.longest_piece_mm)
            .with_air_clip(self.surroundings_of_stock());
        let mut faults = FaultCollector::for_units(self.units);
        let mut batch = PieceBatch::default();
        let mut done = 0.0;
        let mut noted: Vec<usize> = Vec::new();
        let mut motions = self.program.motions().enumerate();
        observer.observe_stock(simulation.stock());
        loop {
            let next = motions.next();
            if let Some((number, motion)) = &next {
                // The first motion defines the workpiece frame, even if the shape of its tool is not known.
                trace.adopt_workpiece_frame(motion);
                let cutter = self.tooling.cutter_index(motion);
                let start = batch.steps.len();
                if let Some(cutter) = cutter {
                    trace.append_pieces((*number, motion), cutter, &mut batch.steps);
                    let pieces = batch.steps.get(start..).unwrap_or_default();
                    if self.has_tilted_middle(cutter, pieces) && !noted.contains(&cutter) {
                        noted.push(cutter);
                        faults.note_tilted_middle(self.program, motion);
                    }
                    if self.has_tilted_undercut(cutter, pieces) {
                        return Err(faults.refuse_tilted_undercut(self.program, motion).into());
                    }
                }
                if trace.take_limit_reached() {
                    faults.report_piece_limit(self.program, motion);
                }
                done += motion.length() * self.units.mm_per_unit();
                batch.motions.push((*number, motion.clone(), cutter, start..batch.steps.len()));
            }
            let observed =
                next.is_some() && observer.wants_stock_at(done / plan.path_mm.max(f64::MIN_POSITIVE));
            // A batch ends with a whole motion, so that every motion has all its pieces.
            if batch.steps.len() >= BATCH || observed || next.is_none() {
                batch.simulate_batch(self, &mut simulation, plan.cell_mm, &mut faults, sink);
                watch.report_progress(done, plan.path_mm);
                watch.check_stop()?;
            }
            if observed {
                observer.observe_stock(simulation.stock());
            }
            if next.is_none() {
                break;
            }
        }
        let findings = faults.take_findings();
        Ok(DexelRunResult { left: simulation.into_stock(), before_mm3, cell_mm: plan.cell_mm, findings })
    }
}

impl Machining<'_> {
    /// Returns the stock before the first cut, as columns. The estimate has compared their number with the budget, so there is
    /// no limit here.
    pub(super) fn fill_columns(&self, cell_mm: f64) -> Result<Dexels, Failure> {
        let filled = self.stock.to_dexels(cell_mm, usize::MAX);
        Ok(filled.map_err(|error| {
            let code = match error {
                StockError::NoMemory(_) => codes::MEMORY_LIMIT,
                _ => codes::TOO_MUCH,
            };
            Diagnostic::new(code, format!("the stock cannot be simulated: {error}"))
        })?)
    }

    /// Returns whether pieces tilt a cutter that is narrower above its widest place, of which only upright
    /// sweeps are known.
    fn has_tilted_undercut(&self, cutter: usize, pieces: &[MotionPiece]) -> bool {
        let undercut =
            self.tooling.cutters().get(cutter).is_some_and(|cutter| cutter.profile.top().is_some());
        undercut && has_tilt(pieces)
    }

    /// Returns whether pieces tilt a cutter whose middle does not cut, which only upright sweeps follow.
    fn has_tilted_middle(&self, cutter: usize, pieces: &[MotionPiece]) -> bool {
        let cutter = self.tooling.cutters().get(cutter);
        cutter.is_some_and(|cutter| cutter.profile.dead_middle().is_some()) && has_tilt(pieces)
    }
}

/// Returns whether an axis of pieces is not upright.
fn has_tilt(pieces: &[MotionPiece]) -> bool {
    let tilted = |axis: &Vector3<f64>| (axis - Vector3::z()).amax() > UPRIGHT;
    pieces.iter().any(|step| tilted(&step.piece.from.axis) || tilted(&step.piece.to.axis))
}

/// The motions that wait to be simulated together.
#[derive(Default)]
struct PieceBatch {
    steps: Vec<MotionPiece>,
    motions: Vec<(usize, Motion, Option<usize>, std::ops::Range<usize>)>,
}

impl PieceBatch {
    /// Simulates the waiting pieces, collects faults, and gives each motion to `sink`.
    fn simulate_batch(
        &mut self,
        machining: &Machining<'_>,
        simulation: &mut Simulation,
        cell: f64,
        faults: &mut FaultCollector,
        sink: &mut dyn FnMut(&EngagedMotion<'_>),
    ) {
        let cutters = machining.tooling.cutters();
        let pieces: Vec<PathPiece> = self.steps.iter().map(|step| step.piece).collect();
        let engaged = simulation.sweep_pieces(&pieces, cutters);
        let found: Vec<(MotionPiece, Engagement)> = self
            .steps
            .drain(..)
            .zip(engaged)
            .map(|(step, engaged)| (step, engaged.at_pace(step.pace)))
            .collect();
        // Faults are checked for whole motions, so that each motion has at most one finding of a kind.
        for (number, motion, cutter, range) in self.motions.drain(..) {
            let pieces = found.get(range);
            debug_assert!(pieces.is_some(), "a motion has pieces of this batch");
            let cut = EngagedMotion { motion: &motion, number, cutter, pieces: pieces.unwrap_or_default() };
            if let (Some(whole), Some(cutter)) =
                (cut.whole_engagement(), cutter.and_then(|index| cutters.get(index)))
            {
                faults.check_engagement(machining.program, &motion, &whole, cutter, cell);
            }
            sink(&cut);
        }
    }
}

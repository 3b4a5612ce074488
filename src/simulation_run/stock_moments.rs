//! This module shows the stock inside motions: as the first half of each has left it.

use super::{Machining, RunPhase, RunWatcher, SimulationRunOptions, chord_tolerance_mm};
use crate::diagnostic::Failure;
use crate::engagement::{MotionPiece, PathPiece, Simulation};
use crate::program::geometry::Pose;
use crate::stock::Dexels;
use std::collections::BTreeSet;

/// The number of pieces that are cut together.
const BATCH: usize = 1024;

impl Machining<'_> {
    /// Cuts the program up to the last of some motions, and shows `look` the stock in the middle of the way of each, with the
    /// motion's number.
    ///
    /// # Errors
    /// Returns the errors of [`Machining::simulate_program`].
    pub(crate) fn show_stock_at_middles(
        &self,
        motions: &BTreeSet<usize>,
        options: &SimulationRunOptions,
        watch: &dyn RunWatcher,
        look: &mut dyn FnMut(usize, &Dexels),
    ) -> Result<(), Failure> {
        let Some(last) = motions.last() else { return Ok(()) };
        watch.begin_phase(RunPhase::Simulating);
        let plan = self.estimate_cost(&options.within_limits(watch))?;
        let stock = self.fill_columns(plan.cell_mm)?;
        let mut simulation = Simulation::new(stock, false);
        let mut path = self.start_path(chord_tolerance_mm(plan.cell_mm), options.longest_piece_mm);
        let cutters = self.tooling.cutters();
        let mut waiting: Vec<MotionPiece> = Vec::new();
        for (number, motion) in self.program.motions().enumerate().take(last + 1) {
            path.adopt_workpiece_frame(&motion);
            let Some(cutter) = self.tooling.cutter_index(&motion) else { continue };
            let is_wanted = motions.contains(&number);
            if is_wanted || waiting.len() >= BATCH {
                sweep_all(&mut simulation, waiting.drain(..).map(|piece| piece.piece), cutters);
                watch.report_progress(number as f64, *last as f64);
                watch.check_stop()?;
            }
            path.append_pieces((number, &motion), cutter, &mut waiting);
            if is_wanted {
                let pieces: Vec<PathPiece> = waiting.drain(..).map(|piece| piece.piece).collect();
                let [first, second] = halve_path(&pieces);
                sweep_all(&mut simulation, first.into_iter(), cutters);
                look(number, simulation.stock());
                sweep_all(&mut simulation, second.into_iter(), cutters);
            }
        }
        Ok(())
    }
}

fn sweep_all(
    simulation: &mut Simulation,
    pieces: impl Iterator<Item = PathPiece>,
    cutters: &[crate::cutter::CutterModel],
) {
    let pieces: Vec<PathPiece> = pieces.collect();
    simulation.sweep_pieces(&pieces, cutters);
}

/// Divides a path in two of the same length of the tip.
fn halve_path(pieces: &[PathPiece]) -> [Vec<PathPiece>; 2] {
    let length = |piece: &PathPiece| (piece.to.point - piece.from.point).norm();
    let mut rest = pieces.iter().map(length).sum::<f64>() / 2.0;
    let mut halves = [Vec::new(), Vec::new()];
    for piece in pieces {
        let own = length(piece);
        let [first, second] = &mut halves;
        if own <= rest && own > 0.0 {
            first.push(*piece);
        } else if rest <= 0.0 && !second.is_empty() {
            second.push(*piece);
        } else {
            let share = if own > 0.0 { rest / own } else { 0.5 };
            let axis = piece.from.axis.slerp(&piece.to.axis, share);
            let middle = Pose { point: piece.from.point + (piece.to.point - piece.from.point) * share, axis };
            first.push(PathPiece { to: middle, ..*piece });
            second.push(PathPiece { from: middle, ..*piece });
        }
        rest -= own;
    }
    halves
}

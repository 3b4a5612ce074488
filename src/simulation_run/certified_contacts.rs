//! This module finds what of a cutter may cut on pieces of motions, from the motions themselves: loads are bounded by it.

use super::{Machining, RunPhase, RunWatcher};
pub(crate) use crate::certified_engagement::ContactGrid;
use crate::certified_engagement::EngagementOptions;
use crate::diagnostic::Failure;
use crate::engagement::edge_lag_rad_per_mm;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The budget of one block: with it the area, the power and the torque of a full slot of a D10 are bounded to 2 %.
const OPTIONS: EngagementOptions =
    EngagementOptions { tolerance: 0.01, most_patches: 4_000, most_line_tests: 300_000 };

/// Pieces that one thread examines before it looks whether it has to stop.
const PIECES_OF_A_RUN: usize = 16;

/// What is known of a piece of a motion, from all that may be engaged on it.
#[derive(Debug, Clone)]
pub(crate) struct ContactPiece<T> {
    /// Where the piece begins, as a fraction of the motion's length.
    pub from: f64,
    /// Where it ends.
    pub to: f64,
    /// What was made of its contacts.
    pub made: T,
}

/// The pieces of motions, by the numbers of the motions.
pub(crate) type PiecesOfMotions<T> = BTreeMap<usize, Vec<ContactPiece<T>>>;

impl Machining<'_> {
    /// Makes something of all that may be engaged on pieces of motions. `parts_of` gives, for each motion that is asked for,
    /// the fractions of its length at which its pieces end. `examine` gets the number of a motion and the contacts of one
    /// of its pieces, part by part of its time. Returns `None` where the stock has no gap, or a coordinate is beyond a
    /// kilometre; a motion that cannot be bounded has no pieces.
    ///
    /// # Errors
    /// Returns [`Failure::Interrupted`] if `watch` has stopped the run.
    pub(crate) fn examine_contacts<T: Send>(
        &self,
        parts_of: &dyn Fn(usize) -> Option<Vec<f64>>,
        examine: &(dyn Fn(usize, &[ContactGrid]) -> T + Sync),
        watch: &dyn RunWatcher,
    ) -> Result<Option<PiecesOfMotions<T>>, Failure> {
        let Some((program, list)) = self.prepare_blocks(parts_of) else { return Ok(None) };
        watch.begin_phase(RunPhase::Simulating);
        let lag_of_motion = self.list_lags();
        let (done, all) = (AtomicUsize::new(0), list.asked.len() as f64);
        let examine_run = |run: &[super::certified_shares::AskedPiece]| -> Result<Vec<T>, Failure> {
            let mut made = Vec::with_capacity(run.len());
            for asked in run {
                watch.check_stop()?;
                let lag = lag_of_motion.get(&asked.motion).copied().unwrap_or(0.0);
                let blocks = asked.first..asked.first + asked.count;
                let grids: Vec<ContactGrid> = blocks
                    .flat_map(|block| {
                        let pace = list.paces.get(block).copied().unwrap_or(1.0);
                        let grids = program.bound_contacts(block, lag, &OPTIONS);
                        grids.into_iter().map(move |grid| grid.at_pace(pace))
                    })
                    .collect();
                made.push(examine(asked.motion, &grids));
            }
            let done = done.fetch_add(run.len(), Ordering::Relaxed) + run.len();
            watch.report_progress(done as f64, all);
            Ok(made)
        };
        let runs: Result<Vec<_>, Failure> = list.asked.par_chunks(PIECES_OF_A_RUN).map(examine_run).collect();
        let mut pieces: PiecesOfMotions<T> = BTreeMap::new();
        for (asked, made) in list.asked.iter().zip(runs?.into_iter().flatten()) {
            let piece = ContactPiece { from: asked.from, to: asked.to, made };
            pieces.entry(asked.motion).or_default().push(piece);
        }
        Ok(Some(pieces))
    }

    /// Returns by how much the edge of each motion's cutter lags behind its tip per mm of height, radians.
    fn list_lags(&self) -> BTreeMap<usize, f64> {
        let lag = |(number, motion)| {
            let cutter = self.tooling.cutters().get(self.tooling.cutter_index(&motion)?)?;
            let teeth = cutter.teeth.as_ref()?;
            Some((number, edge_lag_rad_per_mm(&cutter.profile, teeth.helix_rad)))
        };
        self.program.motions().enumerate().filter_map(lag).collect()
    }
}

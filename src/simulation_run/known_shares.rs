//! This module keeps the shares that a run has certified already, so that a report tells the figures of the step that
//! wrote the feeds, and does not search for them again.

use super::certified_shares::CertifiedShares;
use super::{Machining, RunWatcher};
use crate::diagnostic::Failure;

/// How far apart the bounds of a chip may be that people read, as a part of it: less than four digits tell.
const TOLD_TOLERANCE: f64 = 2e-4;

/// The shares that the steps of a recipe have certified: of the program before and after the last step that did.
///
/// They are taken only for a program whose motions are the same, so they may be handed to any program.
#[derive(Debug, Default)]
pub struct KnownShares(Vec<CertifiedShares>);

impl KnownShares {
    /// Keeps the shares of the programs before and after a step, instead of those that were known.
    pub(crate) fn replace(&mut self, shares: impl IntoIterator<Item = CertifiedShares>) {
        self.0 = shares.into_iter().collect();
    }
}

impl Machining<'_> {
    /// Bounds the shares of whole motions, as [`Machining::certify_shares`] does. What is known of the same program is
    /// not searched for again.
    ///
    /// # Errors
    /// Returns [`Failure::Interrupted`] if `watch` has stopped the run.
    pub(crate) fn certify_whole_motions(
        &self,
        is_asked: &dyn Fn(usize) -> bool,
        known: &KnownShares,
        watch: &dyn RunWatcher,
    ) -> Result<Option<CertifiedShares>, Failure> {
        let whole = |motion: usize| is_asked(motion).then(|| vec![1.0]);
        // The pieces of a known motion are asked for as they are known: a motion in other pieces is no other program.
        let as_known = |known: &CertifiedShares, motion: usize| match known.pieces_of(motion) {
            Some(pieces) if is_asked(motion) => Some(pieces.iter().map(|piece| piece.to).collect()),
            _ => whole(motion),
        };
        let same = known.0.iter().find(|known| self.has_motions_of(known, &|motion| as_known(known, motion)));
        match same {
            Some(known) => {
                self.certify_shares(&|motion| as_known(known, motion), (Some(known), TOLD_TOLERANCE), watch)
            }
            None => self.certify_shares(&whole, (None, TOLD_TOLERANCE), watch),
        }
    }
}

//! This module holds what motions share with the modal state: the tool, the spindle and the frame in force.
//!
//! Sharing is counted, and the count of a thing that several threads may share takes longer than all else that makes
//! a motion. So a motion that nobody needs any more hands its shares to the next one.

use super::Motion;
use super::modal_state::{ActiveTool, CoordinateFrame, ModalState};
use crate::program::record::Spindle;
use std::sync::Arc;

/// The shares of one motion.
#[derive(Debug, Clone, Default)]
pub(super) struct ModalShares {
    pub(super) spindle: Option<Arc<Spindle>>,
    pub(super) tool: Option<Arc<ActiveTool>>,
    pub(super) frame: Option<Arc<CoordinateFrame>>,
}

impl ModalShares {
    /// Takes the shares of a motion that nobody needs any more.
    pub(super) fn from_motion(motion: Motion) -> Self {
        Self { spindle: motion.spindle, tool: motion.tool, frame: motion.frame }
    }

    /// Returns the shares of the next motion, and is empty after it.
    pub(super) fn share_state(&mut self, state: &ModalState) -> Self {
        Self {
            spindle: share(&mut self.spindle, &state.spindle),
            tool: share(&mut self.tool, &state.tool),
            frame: share(&mut self.frame, &state.frame),
        }
    }
}

/// Returns a share of what is in force, the spent one if it is of the same thing.
fn share<T>(spent: &mut Option<Arc<T>>, in_force: &Option<Arc<T>>) -> Option<Arc<T>> {
    match (spent.take(), in_force) {
        (Some(spent), Some(in_force)) if Arc::ptr_eq(&spent, in_force) => Some(spent),
        _ => in_force.clone(),
    }
}

//! This module stops the state machine at a place, and goes on from there later without the statements before.

use super::modal_shares::ModalShares;
use super::modal_state::ModalState;
use super::state_machine::PendingMotion;
use super::{Motion, Motions};
use crate::program::geometry::PathEnd;
use crate::program::record::DrillingCycle;
use crate::program::turning::UndescribedTool;
use crate::program::{LengthUnit, Program, StatementId, TurningPlane};
use std::collections::{BTreeMap, VecDeque};
use std::sync::Arc;

/// Motions of a program that were stopped at a place. They hold no reference to the program, so they can be kept beside
/// it; a program of a million motions with one of them for every 2000 gives the state at any line at once.
#[derive(Debug, Clone)]
pub struct SuspendedMotions {
    next: usize,
    state: ModalState,
    pending: PendingMotion,
    queue: VecDeque<Motion>,
    last_end: Option<PathEnd>,
    operations_seen: bool,
    holes: usize,
    length_unit: Option<LengthUnit>,
    turning_plane: Option<Option<TurningPlane>>,
    undescribed: Option<UndescribedTool>,
    channel: Option<u32>,
    channels: BTreeMap<u32, ModalState>,
    last_cycle: Option<(Arc<DrillingCycle>, StatementId)>,
    cycle_feed: Option<StatementId>,
}

impl Motions<'_> {
    /// Returns how many statements were read so far.
    pub fn statements_read(&self) -> usize {
        self.next
    }

    /// Stops here. Problems that were found so far are not kept.
    pub fn suspend(&self) -> SuspendedMotions {
        SuspendedMotions {
            next: self.next,
            state: self.state.clone(),
            pending: self.pending.clone(),
            queue: self.queue.clone(),
            last_end: self.last_end,
            operations_seen: self.operations_seen,
            holes: self.holes,
            length_unit: self.length_unit,
            turning_plane: self.turning_plane,
            undescribed: self.undescribed,
            channel: self.channel,
            channels: self.channels.clone(),
            last_cycle: self.last_cycle.clone(),
            cycle_feed: self.cycle_feed,
        }
    }
}

impl SuspendedMotions {
    /// Goes on in the program in which the motions were stopped.
    pub fn resume<'p>(&self, program: &'p Program) -> Motions<'p> {
        let kept = self.clone();
        Motions {
            program,
            next: kept.next,
            state: kept.state,
            pending: kept.pending,
            queue: kept.queue,
            spent: ModalShares::default(),
            problems: Vec::new(),
            last_end: kept.last_end,
            operations_seen: kept.operations_seen,
            holes: kept.holes,
            length_unit: kept.length_unit,
            turning_plane: kept.turning_plane,
            undescribed: kept.undescribed,
            channel: kept.channel,
            channels: kept.channels,
            last_cycle: kept.last_cycle,
            cycle_feed: kept.cycle_feed,
        }
    }

    /// Returns how many statements were read before.
    pub fn statements_read(&self) -> usize {
        self.next
    }
}

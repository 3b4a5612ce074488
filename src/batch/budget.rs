//! Memory: who may start, and who waits until there is room.

use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// Bytes of memory for a byte of CL text: the file, its statements, the corrected text, and that text read back.
///
/// Measured on whole runs of `apply` (see ARCHITECTURE.md); what a simulation takes for its stock is not in it.
pub const PER_BYTE: u64 = 7;

/// Bytes of memory that a file takes however small it is.
pub const LEAST: u64 = 4 << 20;

/// What a file of a size is taken to need, in bytes.
pub fn need(size: u64) -> u64 {
    size.saturating_mul(PER_BYTE).saturating_add(LEAST)
}

/// Files that wait, the largest first, and the room that is left.
///
/// Large files start first, since the batch is not done before they are, and small ones fill what room they leave. A file
/// that needs more than all there is runs when nothing else does.
#[derive(Debug)]
pub struct Queue {
    state: Mutex<State>,
    wake: Condvar,
    budget: u64,
}

#[derive(Debug, Default)]
struct State {
    waiting: Vec<(usize, u64)>,
    used: u64,
    running: usize,
    closed: bool,
}

/// The right to work on a file; room is given back when it is dropped.
#[derive(Debug)]
pub struct Ticket<'q> {
    queue: &'q Queue,
    /// Which file.
    pub file: usize,
    /// What it is taken to need.
    pub need: u64,
}

impl Queue {
    /// A queue of files, each with its need in bytes, for a budget in bytes.
    pub fn new(needs: impl IntoIterator<Item = (usize, u64)>, budget: u64) -> Self {
        let mut waiting: Vec<(usize, u64)> = needs.into_iter().collect();
        waiting.sort_by_key(|&(file, need)| (std::cmp::Reverse(need), file));
        Self { state: Mutex::new(State { waiting, ..State::default() }), wake: Condvar::new(), budget }
    }

    /// The next file, once there is room for it; `None` when none is left or the queue is closed.
    pub fn take(&self) -> Option<Ticket<'_>> {
        let mut state = self.lock();
        loop {
            if state.closed || state.waiting.is_empty() {
                return None;
            }
            let room = self.budget.saturating_sub(state.used);
            let fits = state.waiting.iter().position(|&(_, need)| need <= room);
            if let Some(next) = fits.or((state.running == 0).then_some(0)) {
                let (file, need) = state.waiting.remove(next);
                state.used = state.used.saturating_add(need);
                state.running += 1;
                return Some(Ticket { queue: self, file, need });
            }
            state = self.wake.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Lets nobody start any more; who runs, goes on.
    pub fn close(&self) {
        self.lock().closed = true;
        self.wake.notify_all();
    }

    fn lock(&self) -> MutexGuard<'_, State> {
        // The counters are right even if a thread died: they change in one go.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for Ticket<'_> {
    fn drop(&mut self) {
        let mut state = self.queue.lock();
        state.used = state.used.saturating_sub(self.need);
        state.running = state.running.saturating_sub(1);
        drop(state);
        self.queue.wake.notify_all();
    }
}

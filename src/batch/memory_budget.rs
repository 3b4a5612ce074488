//! Memory: who may start, and who waits until there is room.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::Path;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// Bytes of memory for a byte of CL text: the file, the changed text, and that text read back.
///
/// Measured on whole runs with steps that change every number (see ARCHITECTURE.md); what a simulation takes for its
/// stock is not in it.
pub const PER_BYTE: u64 = 4;

/// Bytes of memory for a line: its statement, changed and read back, and lists that grow by doubling.
pub const PER_LINE: u64 = 320;

/// Bytes of memory for a comment before a line, where a recipe asks for them and changes every line: the texts before, the
/// comment's own, its statement, and both read back. Measured on a program whose every number changes.
pub(crate) const PER_COMMENT: u64 = 480;

/// Bytes of memory that a file takes however small it is.
pub const LEAST: u64 = 4 << 20;

/// So much of a file is looked at, in two places, to know how long its lines are.
const SAMPLE: u64 = 64 * 1024;

/// What a file of so many bytes and lines is taken to need, in bytes.
pub fn estimate_memory_bytes(bytes: u64, lines: u64) -> u64 {
    bytes.saturating_mul(PER_BYTE).saturating_add(lines.saturating_mul(PER_LINE)).saturating_add(LEAST)
}

/// What a file is taken to need, in bytes: from its size, and the lines in samples of it. One that cannot be read needs
/// little.
pub fn estimate_file_memory_bytes(path: &Path, bytes: u64) -> u64 {
    estimate_memory_bytes(bytes, estimate_line_count(path, bytes).unwrap_or(0))
}

/// What the comments of a recipe with `provenance: comments` may need beside that: one for every line.
pub(crate) fn estimate_comment_memory_bytes(path: &Path, bytes: u64) -> u64 {
    estimate_line_count(path, bytes).unwrap_or(0).saturating_mul(PER_COMMENT)
}

/// About how many lines a file has; rather too many.
fn estimate_line_count(path: &Path, bytes: u64) -> io::Result<u64> {
    // Opening a pipe would wait for somebody to write.
    if !std::fs::metadata(path)?.is_file() {
        return Ok(0);
    }
    let mut file = File::open(path)?;
    let mut most = 0.0_f64;
    for place in [0, bytes / 2] {
        file.seek(SeekFrom::Start(place))?;
        let mut sample = Vec::new();
        file.by_ref().take(SAMPLE).read_to_end(&mut sample)?;
        let ends = memchr::memchr2_iter(b'\n', b'\r', &sample).count();
        if !sample.is_empty() {
            most = most.max(ends as f64 / sample.len() as f64);
        }
    }
    Ok((most * bytes as f64).ceil() as u64)
}

/// Files that wait, the largest first, and the room that is left.
///
/// Large files start first, since the batch is not done before they are, and small ones fill what room they leave. A file
/// that needs more than all there is runs when nothing else does.
#[derive(Debug)]
pub struct MemoryQueue {
    state: Mutex<MemoryQueueState>,
    wake: Condvar,
    budget: u64,
}

#[derive(Debug, Default)]
struct MemoryQueueState {
    waiting: Vec<(usize, u64)>,
    used: u64,
    running: usize,
    closed: bool,
}

/// The right to work on a file; room is given back when it is dropped.
#[derive(Debug)]
pub struct MemoryTicket<'q> {
    queue: &'q MemoryQueue,
    /// Which file.
    pub file: usize,
    /// What it is taken to need.
    pub need: u64,
}

impl MemoryQueue {
    /// A queue of files, each with its need in bytes, for a budget in bytes.
    pub fn new(needs: impl IntoIterator<Item = (usize, u64)>, budget: u64) -> Self {
        let mut waiting: Vec<(usize, u64)> = needs.into_iter().collect();
        waiting.sort_by_key(|&(file, need)| (std::cmp::Reverse(need), file));
        Self {
            state: Mutex::new(MemoryQueueState { waiting, ..MemoryQueueState::default() }),
            wake: Condvar::new(),
            budget,
        }
    }

    /// The next file, once there is room for it; `None` when none is left or the queue is closed.
    pub fn take_next(&self) -> Option<MemoryTicket<'_>> {
        let mut state = self.lock_state();
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
                return Some(MemoryTicket { queue: self, file, need });
            }
            state = self.wake.wait(state).unwrap_or_else(PoisonError::into_inner);
        }
    }

    /// Lets nobody start any more; who runs, goes on.
    pub fn close_queue(&self) {
        self.lock_state().closed = true;
        self.wake.notify_all();
    }

    fn lock_state(&self) -> MutexGuard<'_, MemoryQueueState> {
        // The counters are right even if a thread died: they change in one go.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for MemoryTicket<'_> {
    fn drop(&mut self) {
        let mut state = self.queue.lock_state();
        state.used = state.used.saturating_sub(self.need);
        state.running = state.running.saturating_sub(1);
        drop(state);
        self.queue.wake.notify_all();
    }
}

//! This module distributes memory: it decides which file may start, and which waits until enough memory is
//! free.

use std::fs::File;
use std::io::{self, Read, Seek, SeekFrom};
use std::path::Path;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};

/// The bytes of memory for each byte of CL text: the file, the changed text, and that text read back.
///
/// It was measured on whole runs with steps that change every number (see benches/README.md). The memory of a
/// simulation's stock is not included.
pub const PER_BYTE: u64 = 4;

/// The bytes of memory for each line: its statement, changed and read back, and lists that grow by doubling.
pub const PER_LINE: u64 = 320;

/// The bytes of memory for a comment before a line, if a recipe asks for comments and changes every line: the
/// old texts, the text of the comment, its statement, and both of them read back. It was measured on a
/// program in which every number changes.
pub(crate) const PER_COMMENT: u64 = 480;

/// The bytes of memory that even the smallest file needs.
pub const LEAST: u64 = 4 << 20;

/// The number of bytes that are read in two places of a file to estimate the length of its lines.
const SAMPLE: u64 = 64 * 1024;

/// Returns the estimated need of memory of a file, in bytes, by its bytes and lines.
pub fn estimate_memory_bytes(bytes: u64, lines: u64) -> u64 {
    bytes.saturating_mul(PER_BYTE).saturating_add(lines.saturating_mul(PER_LINE)).saturating_add(LEAST)
}

/// Returns the estimated need of memory of a file, in bytes, by its size and the lines in samples of it. A
/// file that cannot be read needs little.
pub fn estimate_file_memory_bytes(path: &Path, bytes: u64) -> u64 {
    estimate_memory_bytes(bytes, estimate_line_count(path, bytes).unwrap_or(0))
}

/// Returns the additional memory that comments may need with `provenance: comments`, one comment for every
/// line.
pub(crate) fn estimate_comment_memory_bytes(path: &Path, bytes: u64) -> u64 {
    estimate_line_count(path, bytes).unwrap_or(0).saturating_mul(PER_COMMENT)
}

/// Estimates the number of lines of a file. The estimate is rather too high.
fn estimate_line_count(path: &Path, bytes: u64) -> io::Result<u64> {
    // Opening a pipe would wait for a writer.
    if !std::fs::metadata(path)?.is_file() {
        return Ok(0);
    }
    let mut file = File::open(path)?;
    let mut most = 0.0_f64;
    // Remarks at the head of a file may be longer than its other lines, so its middle is sampled, too. The
    // denser sample counts, because a batch that runs out of memory loses more than one that waits.
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

/// The files that wait, with the largest first, and the free memory.
///
/// Large files start first, because the batch cannot end before they do, and small ones use the memory that
/// remains. A file that needs more than the whole memory runs alone.
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

/// The permission to process a file. Its memory becomes free when the ticket is dropped.
#[derive(Debug)]
pub struct MemoryTicket<'q> {
    queue: &'q MemoryQueue,
    /// The index of the file.
    pub file: usize,
    /// Its estimated need of memory.
    pub need: u64,
}

impl MemoryQueue {
    /// Makes a queue of files, each with its need in bytes, for a budget in bytes.
    pub fn new(needs: impl IntoIterator<Item = (usize, u64)>, budget: u64) -> Self {
        let mut waiting: Vec<(usize, u64)> = needs.into_iter().collect();
        waiting.sort_by_key(|&(file, need)| (std::cmp::Reverse(need), file));
        Self {
            state: Mutex::new(MemoryQueueState { waiting, ..MemoryQueueState::default() }),
            wake: Condvar::new(),
            budget,
        }
    }

    /// Returns the next file once there is enough memory for it. Returns `None` if no file is left or the
    /// queue is closed.
    pub fn take_next(&self) -> Option<MemoryTicket<'_>> {
        let mut state = self.lock_state();
        loop {
            if state.closed || state.waiting.is_empty() {
                return None;
            }
            let room = self.budget.saturating_sub(state.used);
            // The files are sorted by need, so this is the largest one that still fits. If none fits and
            // nothing runs, waiting would never end, so the largest one starts all the same.
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

    /// Lets no further file start. Files that are running continue.
    pub fn close_queue(&self) {
        self.lock_state().closed = true;
        self.wake.notify_all();
    }

    fn lock_state(&self) -> MutexGuard<'_, MemoryQueueState> {
        // The counters are right even if a thread has panicked, because they change under a single lock.
        self.state.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Drop for MemoryTicket<'_> {
    fn drop(&mut self) {
        let mut state = self.queue.lock_state();
        state.used = state.used.saturating_sub(self.need);
        state.running = state.running.saturating_sub(1);
        // The threads that wake need this lock, so it is released first. All of them are woken, because the
        // memory of a large file may be enough for several small ones.
        drop(state);
        self.queue.wake.notify_all();
    }
}

//! This module lets a caller watch a run: it gets progress, and it can stop the run.

use crate::diagnostic::Failure;

/// A part of the work on a program. Parts may come again: a step that proves its result simulates twice.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum RunPhase {
    /// The text is read and checked.
    Reading,
    /// A step of a recipe begins. Steps are counted from 0.
    Step {
        /// The index of the step.
        index: usize,
        /// The number of steps of the recipe.
        count: usize,
    },
    /// Stock is removed motion by motion.
    Simulating,
    /// New feeds are planned.
    Planning,
    /// The corrected program is read back and compared.
    Checking,
    /// Outputs are written.
    Writing,
}

impl RunPhase {
    /// Returns the word for people: `simulating`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Reading => "reading",
            Self::Step { .. } => "correcting",
            Self::Simulating => "simulating",
            Self::Planning => "planning",
            Self::Checking => "checking",
            Self::Writing => "writing",
        }
    }
}

/// What long work will take, as it is told before it begins.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct WorkEstimate {
    /// What the work is: `the simulation`.
    pub work: &'static str,
    /// About how long one thread takes at most, in seconds.
    pub thread_seconds: f64,
    /// The memory in bytes.
    pub bytes: u64,
    /// What there is to do, in words: `25000000 columns of 0.020 mm`.
    pub size: String,
}

impl WorkEstimate {
    /// Returns about how long the work takes at most on so many threads, in seconds.
    pub fn estimate_seconds(&self, threads: usize) -> f64 {
        self.thread_seconds / threads.max(1) as f64
    }
}

/// A caller that watches a run.
pub trait RunWatcher: Sync {
    /// Learns that another part of the work begins.
    fn begin_phase(&self, _phase: RunPhase) {}

    /// Gets the length of the path that is done and the whole length, in mm, from time to time.
    fn report_progress(&self, done: f64, whole: f64);

    /// Gets what long work will take, before it begins.
    fn report_estimate(&self, _estimate: &WorkEstimate) {}

    /// Returns whether the run must stop; it is called from time to time.
    fn is_stop_requested(&self) -> bool {
        false
    }

    /// Stops long work if the run must stop; it is called between two parts of the work.
    ///
    /// # Errors
    /// Returns [`Failure::Interrupted`] if the run must stop, or findings if the run takes more than it may.
    fn check_stop(&self) -> Result<(), Failure> {
        if self.is_stop_requested() { Err(Failure::Interrupted) } else { Ok(()) }
    }

    /// Returns the memory in bytes that the run may take, where there is a limit. It is asked before the run, so that
    /// stock that is too large is not made.
    fn memory_limit_bytes(&self) -> Option<u64> {
        None
    }
}

/// A watcher that ignores progress and never stops the run.
#[derive(Debug, Clone, Copy, Default)]
pub struct SilentWatcher;

impl RunWatcher for SilentWatcher {
    fn report_progress(&self, _: f64, _: f64) {}
}

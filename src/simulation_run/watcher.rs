//! This module lets a caller watch a run: it gets progress, and it can stop the run.

use crate::diagnostic::Failure;

/// A caller that watches a run.
pub trait RunWatcher: Sync {
    /// Gets the length of the path that is done and the whole length, in mm, from time to time.
    fn report_progress(&self, done: f64, whole: f64);

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

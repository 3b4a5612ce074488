//! This module lets a caller watch the work on planes, and stop it between two of them.

use crate::diagnostic::Failure;
use crate::simulation_run::RunWatcher;
use std::sync::atomic::{AtomicUsize, Ordering};

/// The work on some planes, which several threads share.
pub(super) struct WatchedPlanes<'w> {
    watch: &'w dyn RunWatcher,
    planes: usize,
    done: AtomicUsize,
}

impl<'w> WatchedPlanes<'w> {
    pub(super) fn new(watch: &'w dyn RunWatcher, planes: usize) -> Self {
        Self { watch, planes, done: AtomicUsize::new(0) }
    }

    /// Does the work on one plane.
    ///
    /// # Errors
    /// Returns what stops the work; then it is not begun.
    pub(super) fn do_next<T>(&self, work: impl FnOnce() -> T) -> Result<T, Failure> {
        self.check()?;
        let made = work();
        let done = self.done.fetch_add(1, Ordering::Relaxed) + 1;
        self.watch.report_progress(done as f64, self.planes as f64);
        Ok(made)
    }

    /// Looks whether the work must stop.
    ///
    /// # Errors
    /// Returns what stops it.
    pub(super) fn check(&self) -> Result<(), Failure> {
        self.watch.check_stop()
    }
}

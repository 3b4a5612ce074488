//! This module holds the memory of the chips that a run keeps to a budget.

use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::simulation_run::{RunPhase, RunWatcher, SimulationBudget, WorkEstimate};
use std::sync::atomic::{AtomicU64, Ordering};

/// A watcher that also stops the run when the chips that it keeps take more memory than they may: what the
/// caller's watcher allows, or as much as the columns of a simulation may take.
pub(super) struct KeptChipsWatcher<'w> {
    watch: &'w dyn RunWatcher,
    kept_bytes: AtomicU64,
    most_bytes: u64,
}

impl<'w> KeptChipsWatcher<'w> {
    pub(super) fn new(watch: &'w dyn RunWatcher) -> Self {
        let most_bytes = watch.memory_limit_bytes().unwrap_or(SimulationBudget::default().bytes);
        Self { watch, kept_bytes: AtomicU64::new(0), most_bytes }
    }

    /// Tells how many bytes are kept.
    pub(super) fn set_kept_bytes(&self, bytes: u64) {
        self.kept_bytes.store(bytes, Ordering::Relaxed);
    }
}

impl RunWatcher for KeptChipsWatcher<'_> {
    fn begin_phase(&self, phase: RunPhase) {
        self.watch.begin_phase(phase);
    }

    fn report_progress(&self, done: f64, whole: f64) {
        self.watch.report_progress(done, whole);
    }

    fn report_estimate(&self, estimate: &WorkEstimate) {
        self.watch.report_estimate(estimate);
    }

    fn is_stop_requested(&self) -> bool {
        self.watch.is_stop_requested()
    }

    fn check_stop(&self) -> Result<(), Failure> {
        self.watch.check_stop()?;
        if self.kept_bytes.load(Ordering::Relaxed) <= self.most_bytes {
            return Ok(());
        }
        let most = self.most_bytes as f64 / f64::from(1 << 30);
        let message = format!("the chips take more than the {most:.1} GiB of memory that they may");
        let help = "Take thicker layers, ask for fewer motions by --lines, or allow more by --memory.";
        Err(Diagnostic::new(codes::TOO_MUCH, message).with_help(help).into())
    }

    fn memory_limit_bytes(&self) -> Option<u64> {
        self.watch.memory_limit_bytes()
    }
}

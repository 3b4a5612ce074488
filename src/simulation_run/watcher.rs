//! Watching a run: progress out, a wish to stop in.

/// Somebody who watches a run.
pub trait RunWatcher: Sync {
    /// Told now and then how much of the path is done, in mm.
    fn report_progress(&self, done: f64, whole: f64);

    /// Asked now and then whether to stop.
    fn is_stop_requested(&self) -> bool {
        false
    }
}

/// Nobody watches.
#[derive(Debug, Clone, Copy, Default)]
pub struct SilentWatcher;

impl RunWatcher for SilentWatcher {
    fn report_progress(&self, _: f64, _: f64) {}
}

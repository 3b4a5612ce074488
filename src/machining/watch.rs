//! Watching a run: progress out, a wish to stop in.

/// Somebody who watches a run.
pub trait Watch: Sync {
    /// Told now and then how much of the path is done, in mm.
    fn progress(&self, done: f64, whole: f64);

    /// Asked now and then whether to stop.
    fn is_stopped(&self) -> bool {
        false
    }
}

/// Nobody watches.
#[derive(Debug, Clone, Copy, Default)]
pub struct Unwatched;

impl Watch for Unwatched {
    fn progress(&self, _: f64, _: f64) {}
}

//! This module runs two pieces of work at once, where the crate has threads at all.

/// Returns whether two pieces of work can run at once.
#[cfg(feature = "simulation")]
pub(crate) fn has_several_threads() -> bool {
    rayon::current_num_threads() > 1
}

/// Returns whether two pieces of work can run at once.
#[cfg(not(feature = "simulation"))]
pub(crate) fn has_several_threads() -> bool {
    false
}

/// Runs both, at the same time if it is `worth` a thread. The results do not depend on that.
#[cfg(feature = "simulation")]
pub(crate) fn both_ways<A: Send, B: Send>(
    worth: bool,
    first: impl FnOnce() -> A + Send,
    second: impl FnOnce() -> B + Send,
) -> (A, B) {
    if worth { rayon::join(first, second) } else { (first(), second()) }
}

/// Runs both, one after the other: the least library has no threads.
#[cfg(not(feature = "simulation"))]
pub(crate) fn both_ways<A, B>(_worth: bool, first: impl FnOnce() -> A, second: impl FnOnce() -> B) -> (A, B) {
    (first(), second())
}

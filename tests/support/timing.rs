//! Time in tests: nothing here fails because the machine is busy with something else.

use std::time::{Duration, Instant};

/// How long a test waits for another process or thread before it gives up.
const PATIENCE: Duration = Duration::from_secs(120);

/// Waits until something is so.
#[track_caller]
pub fn wait_for(what: &str, mut is_so: impl FnMut() -> bool) {
    let begun = Instant::now();
    while !is_so() {
        assert!(begun.elapsed() < PATIENCE, "waited in vain for {what}");
        std::thread::sleep(Duration::from_millis(2));
    }
}

/// Runs what must be done within some seconds of work of this thread. Quadratic work where linear work is meant takes far longer.
#[track_caller]
pub fn within_seconds<T>(limit: f64, work: impl FnOnce() -> T) -> T {
    let (clock, before) = (Instant::now(), thread_seconds());
    let done = work();
    let worked = thread_seconds().zip(before).map(|(now, before)| now - before);
    let seconds = worked.unwrap_or_else(|| clock.elapsed().as_secs_f64());
    assert!(seconds < limit, "{seconds} s of work, and {limit} s are the most");
    done
}

/// Seconds for which a processor has worked for this thread, where the system tells (Linux).
fn thread_seconds() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(text.split_whitespace().next()?.parse::<f64>().ok()? * 1e-9)
}

/// Tries what depends on a moment, such as a signal to a process that still runs: on a busy machine the moment may have passed before
/// this thread is there. `attempt` gets a size that doubles from try to try, and says whether it met the moment.
#[track_caller]
pub fn try_until_met(mut attempt: impl FnMut(usize) -> bool) {
    assert!((0..8).map(|round| 1 << round).any(&mut attempt), "the moment was missed eight times");
}

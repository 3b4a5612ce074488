//! Work on a thread of its own, while the calling thread answers to Ctrl-C and calls back.

use crate::finding::to_exception;
use clsmith::diagnostic::Failure;
use clsmith::job::catch_defect;
use clsmith::simulation_run::{RunPhase, RunWatcher};
use pyo3::prelude::*;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, Sender, channel};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// How long the calling thread waits before it looks for Ctrl-C again.
const LOOK_EVERY: Duration = Duration::from_millis(20);

/// What the work tells the calling thread.
enum Told<T> {
    Progress { phase: &'static str, part: f64 },
    Done(Result<T, Failure>),
}

/// Gets progress from the library and passes it on; tells the library when it must stop.
struct Relay<'s, T> {
    stop: &'s AtomicBool,
    // Channels cannot be shared between threads, and the library reports from several.
    state: Mutex<(Sender<Told<T>>, &'static str)>,
}

impl<T> Relay<'_, T> {
    fn tell(&self, next: Option<&'static str>, part: f64) {
        let mut state = self.state.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(phase) = next {
            state.1 = phase;
        }
        let phase = state.1;
        // The calling thread waits until the work has ended, so somebody receives.
        let _ = state.0.send(Told::Progress { phase, part });
    }
}

impl<T: Send> RunWatcher for Relay<'_, T> {
    fn begin_phase(&self, phase: RunPhase) {
        self.tell(Some(phase.name()), 0.0);
    }

    fn report_progress(&self, done: f64, whole: f64) {
        if whole > 0.0 {
            self.tell(None, (done / whole).clamp(0.0, 1.0));
        }
    }

    fn is_stop_requested(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }
}

/// Runs work on `file` without the interpreter's lock. `progress`, if it is given, is called on this thread with the name of
/// the phase and the part of it that is done, 0 to 1. An exception in it ends the work, and so does Ctrl-C.
///
/// # Errors
/// Returns the exception of the failure, of `progress`, or of the signal.
pub(crate) fn run<T: Send>(
    py: Python<'_>,
    file: &str,
    progress: Option<&Bound<'_, PyAny>>,
    work: impl FnOnce(&dyn RunWatcher) -> Result<T, Failure> + Send,
) -> PyResult<T> {
    let stop = AtomicBool::new(false);
    let (sender, receiver) = channel();
    std::thread::scope(|scope| {
        let stop = &stop;
        scope.spawn(move || {
            let relay = Relay { stop, state: Mutex::new((sender.clone(), "reading")) };
            let done = catch_defect(file, || work(&relay)).unwrap_or_else(|defect| Err(defect.into()));
            let _ = sender.send(Told::Done(done));
        });
        // So that it may be waited for without the lock.
        let receiver = Mutex::new(receiver);
        let ended = wait(py, &receiver, progress);
        if ended.is_err() {
            stop.store(true, Ordering::Relaxed);
            // The work ends soon; the lock is not held while it does.
            py.detach(|| while !matches!(lock(&receiver).recv(), Ok(Told::Done(_)) | Err(_)) {});
        }
        ended?.map_err(|failure| to_exception(py, &failure))
    })
}

fn lock<T>(receiver: &Mutex<T>) -> MutexGuard<'_, T> {
    receiver.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Waits for the end of the work, and returns the exception of this thread if there is one before.
fn wait<T: Send>(
    py: Python<'_>,
    receiver: &Mutex<Receiver<Told<T>>>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Result<T, Failure>> {
    let mut last: Option<(&'static str, f64)> = None;
    loop {
        let told = py.detach(|| lock(receiver).recv_timeout(LOOK_EVERY));
        match told {
            Ok(Told::Done(done)) => return Ok(done),
            Ok(Told::Progress { phase, part }) => {
                // A hundred calls a phase are enough for any bar.
                let is_new =
                    last.is_none_or(|(of, at)| of != phase || part >= at + 0.01 || (part >= 1.0 && at < 1.0));
                if let (Some(progress), true) = (progress, is_new) {
                    last = Some((phase, part));
                    progress.call1((phase, part))?;
                }
            }
            Err(RecvTimeoutError::Timeout) => {}
            Err(RecvTimeoutError::Disconnected) => return Ok(Err(Failure::Interrupted)),
        }
        py.check_signals()?;
    }
}

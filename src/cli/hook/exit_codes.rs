//! This module holds the exit codes of the hook: those of `timeout` and the shell, and otherwise the post's
//! own.

use super::post_process::PostOutcome;
use clsmith::diagnostic::{Diagnostic, codes};
use std::time::Duration;

/// The post took too long.
const TIMED_OUT: i32 = 124;
/// Nothing was posted.
pub(super) const REFUSED: i32 = 125;
/// The post could not be started.
const NOT_STARTED: i32 = 126;
/// The post was not found.
const MISSING: i32 = 127;
/// This number is added to the number of a signal.
const SIGNAL: i32 = 128;
/// Ctrl-C.
pub(super) const STOPPED: i32 = 130;

/// Returns the exit code, and a finding about how the post ended if there is one.
pub(super) fn judge_post_outcome(
    name: &str,
    timeout: Option<Duration>,
    ended: &PostOutcome,
) -> (i32, Option<Diagnostic>) {
    let (exit, code, message) = match ended {
        PostOutcome::Exit(code)
            if (TIMED_OUT..=MISSING).contains(code) || (SIGNAL + 1..256).contains(code) =>
        {
            let message = format!("{name} itself ended with {code}, which the hook uses, too");
            (*code, codes::EXIT_CODE_SHARED, message)
        }
        PostOutcome::Exit(code) => return (*code, None),
        PostOutcome::Stopped => return (STOPPED, None),
        PostOutcome::Signal(signal) => {
            (SIGNAL + signal, codes::POST_KILLED, format!("{name} was ended by signal {signal}"))
        }
        PostOutcome::TimedOut => {
            let limit = timeout.unwrap_or_default().as_secs_f64();
            let message = format!("{name} had not ended after {limit} s and was stopped");
            (TIMED_OUT, codes::POST_TIMED_OUT, message)
        }
        PostOutcome::Missing(error) => {
            (MISSING, codes::POST_MISSING, format!("{name} cannot be found: {error}"))
        }
        PostOutcome::NotStarted(error) => {
            (NOT_STARTED, codes::POST_NOT_STARTED, format!("{name} cannot be started: {error}"))
        }
    };
    (exit, Some(Diagnostic::new(code, message)))
}

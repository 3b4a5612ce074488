//! This module runs the post-processor: an external program that is started, awaited, and stopped together
//! with everything that it has started.

use clsmith::output_files::Interrupt;
use process_wrap::std::{ChildWrapper, CommandWrap};
use std::ffi::{OsStr, OsString};
use std::io;
use std::process::{Command, ExitStatus, Stdio};
use std::time::{Duration, Instant};

/// The longest pause between two checks of the post.
const LONGEST_PAUSE: Duration = Duration::from_millis(50);

/// How long a post that took too long may tidy up before it is killed.
const GRACE_TIMED_OUT: Duration = Duration::from_secs(2);

/// The same for a post that is stopped together with the hook, which itself has to end within two seconds.
const GRACE_STOPPED: Duration = Duration::from_millis(700);

/// The placeholder for the path of the program in arguments.
pub(super) const MARK: &str = "{}";

/// How the post ended.
#[derive(Debug)]
pub(super) enum PostOutcome {
    /// It ended by itself, with this code.
    Exit(i32),
    /// It was ended by this signal, which only Unix has.
    #[cfg_attr(not(unix), allow(dead_code))]
    Signal(i32),
    /// It took too long.
    TimedOut,
    /// It was stopped, because Ctrl-C was pressed.
    Stopped,
    /// It was not found.
    Missing(io::Error),
    /// It could not be started.
    NotStarted(io::Error),
}

/// Starts a program with its arguments and waits for it. When the time is over or a stop is requested, it
/// ends the program and everything that this has started. The program writes to our standard output and
/// standard error, or to standard error alone if our standard output `is_output_taken`. Its standard input is
/// empty, so that it cannot hang on a question.
///
/// # Errors
/// Returns the error of the system if the program cannot be awaited or stopped.
pub(super) fn run_post(
    program: &OsStr,
    arguments: &[OsString],
    timeout: Option<Duration>,
    interrupt: &Interrupt,
    is_output_taken: bool,
) -> io::Result<PostOutcome> {
    let mut command = Command::new(program);
    command.args(arguments).stdin(Stdio::null());
    if is_output_taken {
        command.stdout(io::stderr());
    }
    // A post is often a script that starts the real program. In a group of their own, both can be ended
    // together.
    let mut command = CommandWrap::from(command);
    #[cfg(unix)]
    command.wrap(process_wrap::std::ProcessGroup::leader());
    #[cfg(windows)]
    command.wrap(process_wrap::std::JobObject);
    let started = Instant::now();
    let mut child = match command.spawn() {
        Ok(child) => child,
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(PostOutcome::Missing(error)),
        Err(error) => return Ok(PostOutcome::NotStarted(error)),
    };
    // Many posts end within moments and should not be awaited longer than that, but a long one must not keep
    // a core busy. So the pauses begin short and double.
    let mut pause = Duration::from_millis(1);
    loop {
        if let Some(status) = child.try_wait()? {
            return Ok(outcome_of_status(status));
        }
        if interrupt.is_raised() {
            stop_process_group(child.as_mut(), GRACE_STOPPED)?;
            return Ok(PostOutcome::Stopped);
        }
        let left = timeout.map(|timeout| timeout.saturating_sub(started.elapsed()));
        if left.is_some_and(|left| left.is_zero()) {
            stop_process_group(child.as_mut(), GRACE_TIMED_OUT)?;
            return Ok(PostOutcome::TimedOut);
        }
        std::thread::sleep(left.map_or(pause, |left| pause.min(left)));
        pause = (pause * 2).min(LONGEST_PAUSE);
    }
}

fn outcome_of_status(status: ExitStatus) -> PostOutcome {
    #[cfg(unix)]
    if let Some(signal) = std::os::unix::process::ExitStatusExt::signal(&status) {
        return PostOutcome::Signal(signal);
    }
    // Only a signal leaves no code.
    PostOutcome::Exit(status.code().unwrap_or(1))
}

/// Ends a program and everything that it started. On Unix, it first requests this by SIGTERM and waits for
/// `grace` at most; then it kills.
#[cfg_attr(not(unix), allow(unused_variables))]
fn stop_process_group(child: &mut dyn ChildWrapper, grace: Duration) -> io::Result<()> {
    #[cfg(unix)]
    {
        const SIGTERM: i32 = 15;
        let asked = Instant::now();
        if child.signal(SIGTERM).is_ok() {
            while asked.elapsed() < grace && child.try_wait()?.is_none() {
                std::thread::sleep(LONGEST_PAUSE);
            }
        }
    }
    // This is also needed after the program itself has ended, because its children may have ignored the
    // request. If nothing is left, there is nothing to kill, which is no error.
    let _ = child.start_kill();
    child.wait().map(drop)
}

/// Returns whether an argument contains `{}`.
pub(super) fn has_path_mark(argument: &OsStr) -> bool {
    fill_path_mark(argument, OsStr::new("")) != argument
}

/// Replaces every `{}` of an argument by a path. All other bytes stay.
#[cfg(unix)]
pub(super) fn fill_path_mark(argument: &OsStr, path: &OsStr) -> OsString {
    use std::os::unix::ffi::{OsStrExt, OsStringExt};
    OsString::from_vec(replace_all(argument.as_bytes(), MARK.as_bytes(), path.as_bytes()))
}

/// Replaces every `{}` of an argument by a path. All other units stay.
#[cfg(windows)]
pub(super) fn fill_path_mark(argument: &OsStr, path: &OsStr) -> OsString {
    use std::os::windows::ffi::{OsStrExt, OsStringExt};
    let wide = |text: &OsStr| text.encode_wide().collect::<Vec<u16>>();
    OsString::from_wide(&replace_all(&wide(argument), &wide(OsStr::new(MARK)), &wide(path)))
}

fn replace_all<T: Copy + PartialEq>(text: &[T], mark: &[T], by: &[T]) -> Vec<T> {
    let mut out = Vec::with_capacity(text.len() + by.len());
    let mut rest = text;
    while let Some((first, others)) = rest.split_first() {
        match rest.strip_prefix(mark) {
            Some(behind) => {
                out.extend_from_slice(by);
                rest = behind;
            }
            None => {
                out.push(*first);
                rest = others;
            }
        }
    }
    out
}

//! This module distinguishes a reader that has closed its pipe from an output that failed.

use std::io;

/// Ignores a closed pipe. What only people see may fail: with `clsmith ... 2>&1 | head` the outputs are still
/// written.
pub(super) fn ignore_closed_pipe(shown: io::Result<()>) -> io::Result<()> {
    match shown {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        shown => shown,
    }
}

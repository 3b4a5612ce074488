//! This module handles Ctrl-C while a file is being written.

use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// A request to stop, which the signal handler and the working code share.
///
/// The signal handler only raises the flag. The writer checks it between two chunks and fails with an error,
/// so the temporary file is removed by its destructor, as after any other error. So no handler needs a list
/// of files to delete. A process that is killed outright leaves one `.clsmith-*.tmp` file behind, but never
/// half an output.
///
/// ```
/// use clsmith::output_files::Interrupt;
///
/// let interrupt = Interrupt::new();
/// let handler = interrupt.clone();
/// std::thread::spawn(move || handler.raise()).join().expect("the thread ends");
/// assert!(interrupt.is_raised());
/// ```
#[derive(Debug, Clone, Default)]
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// Makes a flag that is not raised.
    pub fn new() -> Self {
        Self::default()
    }

    /// Requests a stop. It is safe to call this from a signal handler's thread.
    pub fn raise(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Returns whether a stop was requested.
    pub fn is_raised(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// Returns an error if a stop was requested. [`WriteError`] recognizes it, since `Write` knows
    /// `io::Error` alone.
    pub(super) fn check(&self) -> io::Result<()> {
        if self.is_raised() { Err(io::Error::other(WriteInterrupted)) } else { Ok(()) }
    }
}

/// The reason why a file was not written.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// A stop was requested.
    #[error("stopped before the file was complete")]
    Interrupted,
    /// The error came from the system or from the writer of the content.
    #[error(transparent)]
    Io(io::Error),
}

impl From<io::Error> for WriteError {
    fn from(error: io::Error) -> Self {
        match error.get_ref() {
            Some(inner) if inner.is::<WriteInterrupted>() => Self::Interrupted,
            _ => Self::Io(error),
        }
    }
}

// The kind is not `ErrorKind::Interrupted`, because `write_all` takes that as "try again" and would never
// return.
#[derive(Debug, thiserror::Error)]
#[error("stopped before the file was complete")]
struct WriteInterrupted;

/// A writer that fails once the flag is raised.
pub(super) struct InterruptibleWriter<'a, W> {
    pub(super) inner: W,
    pub(super) interrupt: &'a Interrupt,
}

impl<W: Write> Write for InterruptibleWriter<'_, W> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.interrupt.check()?;
        self.inner.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.inner.flush()
    }
}

//! Ctrl-C while a file is being written.

use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};

/// The wish to stop, shared by whoever hears the signal and whoever does the work.
///
/// The signal handler only raises the flag. The writer looks at it between two chunks and fails with an error, so the
/// temporary file is removed the way it is after any other error: by its destructor. No handler needs a list of files to
/// delete, and a process that is killed outright leaves one `.clsmith-*.tmp` behind but never half an output.
#[derive(Debug, Clone, Default)]
pub struct Interrupt(Arc<AtomicBool>);

impl Interrupt {
    /// A flag that nobody has raised.
    pub fn new() -> Self {
        Self::default()
    }

    /// Asks the work to stop; safe to call from a signal handler's thread.
    pub fn raise(&self) {
        self.0.store(true, Ordering::Relaxed);
    }

    /// Whether somebody asked to stop.
    pub fn is_raised(&self) -> bool {
        self.0.load(Ordering::Relaxed)
    }

    /// For loops that work long between two writes.
    ///
    /// # Errors
    /// One that [`is_interrupt`] recognizes, once the flag is raised.
    pub fn check(&self) -> io::Result<()> {
        if self.is_raised() { Err(io::Error::other(WriteInterrupted)) } else { Ok(()) }
    }
}

/// Whether an error means that the user stopped the run, rather than that writing failed.
pub fn is_interrupt(error: &io::Error) -> bool {
    error.get_ref().is_some_and(|inner| inner.is::<WriteInterrupted>())
}

// Not `ErrorKind::Interrupted`: `write_all` takes that kind as "try again" and would never return.
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

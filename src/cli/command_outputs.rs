//! This module writes outputs and handles Ctrl-C.

use super::input_files::STANDARD;
use crate::cli::stop::Stop;
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::output_files::{Interrupt, WriteError, is_same_file, write_atomically_unless};
use std::io::{self, Write};
use std::path::Path;
use std::sync::{Arc, LockResult, Mutex, MutexGuard};

/// The writer of outputs. It writes one at a time, either completely or not at all.
#[derive(Clone, Default)]
pub struct CommandOutputs {
    interrupt: Interrupt,
    writing: Arc<Mutex<()>>,
}

impl CommandOutputs {
    /// Returns the request to stop.
    pub fn interrupt(&self) -> &Interrupt {
        &self.interrupt
    }

    /// Makes Ctrl-C end the process at once, except while an output is written. Then the writer stops between
    /// two chunks and removes its temporary file. `before` is called before the last message.
    pub fn stop_on_ctrl_c(&self, before: impl Fn() + Send + 'static) -> io::Result<()> {
        let Self { interrupt, writing } = self.clone();
        ctrlc::set_handler(move || {
            interrupt.raise();
            if let Ok(_nobody_writes) = writing.try_lock() {
                before();
                eprintln!("clsmith: stopped");
                std::process::exit(130);
            }
        })
        .map_err(io::Error::other)
    }

    /// Makes the first Ctrl-C ask work on many files to stop, so that it can finish what it has begun. The
    /// second one ends the process at once. `before` is called before any message.
    pub fn stop_gently(&self, before: impl Fn() + Send + 'static) -> io::Result<()> {
        let interrupt = self.interrupt.clone();
        ctrlc::set_handler(move || {
            before();
            if interrupt.is_raised() {
                eprintln!("clsmith: stopped");
                std::process::exit(130);
            }
            interrupt.raise();
            eprintln!("clsmith: stopping; Ctrl-C again ends it at once");
        })
        .map_err(io::Error::other)
    }

    /// Writes an output.
    ///
    /// # Errors
    /// Returns a finding if the file cannot be written, an interruption, or that the reader of standard
    /// output went away.
    pub fn write_output(
        &self,
        target: &Path,
        write_all: impl Fn(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Stop> {
        let _held = self.hold_ctrl_c();
        self.write_held_output(target, write_all)
    }

    /// Keeps Ctrl-C from ending the process at once, for a caller that must remove something first and checks
    /// the interrupt.
    pub fn hold_ctrl_c(&self) -> LockResult<MutexGuard<'_, ()>> {
        self.writing.lock()
    }

    /// Does the same as [`CommandOutputs::write_output`], for a caller that already holds the outputs.
    pub fn write_held_output(
        &self,
        target: &Path,
        write_all: impl Fn(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Stop> {
        let done = if target == Path::new(STANDARD) {
            let mut out = io::BufWriter::new(io::stdout().lock());
            write_all(&mut out).and_then(|()| out.flush()).map_err(WriteError::from)
        } else {
            write_atomically_unless(target, &self.interrupt, write_all)
        };
        match done {
            Ok(()) => Ok(()),
            Err(WriteError::Interrupted) => Err(Stop::Interrupted),
            Err(WriteError::Io(error)) if error.kind() == io::ErrorKind::BrokenPipe => Err(error.into()),
            Err(WriteError::Io(error)) => Err(report_unwritable(target, &error).into()),
        }
    }
}

/// Refuses outputs that would overwrite an input. Standard input and output are no files.
///
/// # Errors
/// Returns a finding about the first such output.
pub fn refuse_overwritten_input<'a>(
    mut outputs: impl Iterator<Item = &'a Path>,
    inputs: &[&Path],
) -> Result<(), Stop> {
    let found = outputs.find_map(|target| {
        let files = inputs.iter().filter(|path| **path != Path::new(STANDARD));
        let mut files = files.filter(|_| target != Path::new(STANDARD));
        let hit = files.find(|path| is_same_file(path, target))?;
        let message = format!("writing {} would overwrite the input {}", target.display(), hit.display());
        Some(Diagnostic::new(codes::OUTPUT_IS_INPUT, message))
    });
    found.map_or(Ok(()), |found| Err(found.into()))
}

/// Reports an output that cannot be written.
pub fn report_unwritable(target: &Path, error: &io::Error) -> Diagnostic {
    Diagnostic::new(codes::UNWRITABLE, format!("{} cannot be written: {error}", target.display()))
}

/// Ignores a closed pipe. What only people see may fail: with `clsmith ... 2>&1 | head` the outputs are still
/// written.
pub fn ignore_closed_pipe(shown: io::Result<()>) -> io::Result<()> {
    match shown {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        shown => shown,
    }
}

/// Prints a summary on standard output, or on standard error if an output goes there.
pub fn print_summary(text: &str, output_is_taken: bool) -> io::Result<()> {
    if output_is_taken {
        return io::stderr().lock().write_all(text.as_bytes());
    }
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())?;
    out.flush()
}

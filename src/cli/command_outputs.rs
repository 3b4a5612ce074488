//! This module writes outputs and handles Ctrl-C.

use super::input_files::STANDARD;
use crate::cli::stop::Stop;
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::output_files::{Interrupt, OutputAccess, TemporaryFiles, WriteError, is_same_file};
use std::collections::BTreeSet;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::{Arc, LockResult, Mutex, MutexGuard, PoisonError, TryLockError, mpsc};
use std::time::{Duration, Instant};

/// How long the work may take to end by itself after a request to stop. Together with the time to notice the
/// request and to report it, a command ends within two seconds.
const GRACE: Duration = Duration::from_millis(1500);

/// How long a last line of a log or a last message may take. Whoever reads standard error may have stopped to
/// read, and a log may lie on a network drive that does not answer.
const MOMENTS: Duration = Duration::from_millis(150);

/// The pause of the handler of Ctrl-C while it waits for the work to end.
const BETWEEN_LOOKS: Duration = Duration::from_millis(10);

/// A function that the handler of Ctrl-C calls before it ends the process, for example to write a line of a
/// log.
type LastWords = Box<dyn FnOnce() + Send>;

/// The writer of outputs. It writes one at a time, either completely or not at all.
#[derive(Clone, Default)]
pub(super) struct CommandOutputs {
    interrupt: Interrupt,
    writing: Arc<Mutex<()>>,
    last_words: Arc<Mutex<Option<LastWords>>>,
    /// The folders from which this run has removed the left-overs of killed runs.
    tidy_folders: Arc<Mutex<BTreeSet<PathBuf>>>,
    /// Who may read new outputs.
    access: OutputAccess,
    /// The names of temporary files.
    temporaries: TemporaryFiles,
}

impl CommandOutputs {
    /// Returns the request to stop.
    pub(super) fn interrupt(&self) -> &Interrupt {
        &self.interrupt
    }

    /// Returns the writer of outputs that are made of these inputs: whoever may not read those may not read the outputs.
    pub(super) fn for_inputs<'a>(&self, inputs: impl IntoIterator<Item = &'a Path>) -> Self {
        Self { access: OutputAccess::of_inputs(inputs), ..self.clone() }
    }

    /// Returns the writer of outputs whose temporary files have names of their own, so that their owner knows them again
    /// after it was killed.
    pub(super) fn with_temporaries(&self, temporaries: TemporaryFiles) -> Self {
        Self { temporaries, ..self.clone() }
    }

    /// Sets the handler of Ctrl-C. It ends the process at once, unless an output is being written: then the
    /// writer stops between two chunks and removes its temporary file. If the work does not end by itself
    /// within [`GRACE`], for example because a pipe or a network drive does not answer, the process is ended
    /// nevertheless. `before` is called before the last message.
    ///
    /// # Errors
    /// Returns the error of the system if the handler cannot be set.
    pub(super) fn stop_on_ctrl_c(&self, before: impl Fn() + Send + Sync + 'static) -> io::Result<()> {
        let outputs = self.clone();
        let before: Arc<dyn Fn() + Send + Sync> = Arc::new(before);
        ctrlc::set_handler(move || {
            outputs.interrupt.raise();
            match outputs.writing.try_lock() {
                Err(TryLockError::WouldBlock) => {}
                // The lock is held until the process ends, so nobody begins to write meanwhile.
                _held => outputs.end_process(&before),
            }
            let raised = Instant::now();
            while raised.elapsed() < GRACE {
                std::thread::sleep(BETWEEN_LOOKS);
            }
            outputs.end_process(&before);
        })
        .map_err(io::Error::other)
    }

    /// Sets the handler of Ctrl-C for work on many files. The first Ctrl-C requests a stop, so that the work
    /// can end what it began. The process ends at a second Ctrl-C, or when [`GRACE`] is over. `before` is
    /// called before any message.
    ///
    /// # Errors
    /// Returns the error of the system if the handler cannot be set.
    pub(super) fn stop_gently(&self, before: impl Fn() + Send + Sync + 'static) -> io::Result<()> {
        let outputs = self.clone();
        let before: Arc<dyn Fn() + Send + Sync> = Arc::new(before);
        ctrlc::set_handler(move || {
            if outputs.interrupt.is_raised() {
                outputs.end_process(&before);
            }
            outputs.interrupt.raise();
            let (late, before_end) = (outputs.clone(), Arc::clone(&before));
            std::thread::spawn(move || {
                std::thread::sleep(GRACE);
                late.end_process(&before_end);
            });
            let before = Arc::clone(&before);
            do_within_moments(move || {
                before();
                eprintln!("clsmith: stopping; Ctrl-C again ends it at once");
            });
        })
        .map_err(io::Error::other)
    }

    /// Keeps a function that the handler of Ctrl-C calls before it ends the process.
    pub(super) fn keep_last_words(&self, words: impl FnOnce() + Send + 'static) {
        *self.last_words.lock().unwrap_or_else(PoisonError::into_inner) = Some(Box::new(words));
    }

    /// Takes back the function that was kept. Returns `false` if there is none, because the handler of Ctrl-C
    /// is calling it.
    pub(super) fn take_last_words(&self) -> bool {
        self.last_words.lock().unwrap_or_else(PoisonError::into_inner).take().is_some()
    }

    fn end_process(&self, before: &Arc<dyn Fn() + Send + Sync>) {
        let (before, words) = (Arc::clone(before), Arc::clone(&self.last_words));
        // A log comes first: a terminal can be done without.
        do_within_moments(move || {
            let words = words.lock().unwrap_or_else(PoisonError::into_inner).take();
            if let Some(words) = words {
                words();
            }
        });
        do_within_moments(move || {
            before();
            eprintln!("clsmith: stopped");
        });
        std::process::exit(130);
    }

    /// Writes an output.
    ///
    /// # Errors
    /// Returns a finding if the file cannot be written, an interruption, or that the reader of standard
    /// output went away.
    pub(super) fn write_output(
        &self,
        target: &Path,
        write_all: impl Fn(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Stop> {
        let _held = self.hold_ctrl_c();
        self.write_held_output(target, write_all)
    }

    /// Keeps Ctrl-C from ending the process at once, for a caller that must remove something first and checks
    /// the interrupt.
    pub(super) fn hold_ctrl_c(&self) -> LockResult<MutexGuard<'_, ()>> {
        self.writing.lock()
    }

    /// Does the same as [`CommandOutputs::write_output`], for a caller that already holds the outputs.
    pub(super) fn write_held_output(
        &self,
        target: &Path,
        write_all: impl Fn(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), Stop> {
        let done = if target == Path::new(STANDARD) {
            let mut out = io::BufWriter::new(io::stdout().lock());
            write_all(&mut out).and_then(|()| out.flush()).map_err(WriteError::from)
        } else {
            self.tidy_folder_of(target);
            self.temporaries.clone().with_access(self.access).write_file(target, &self.interrupt, write_all)
        };
        match done {
            Ok(()) => Ok(()),
            Err(WriteError::Interrupted) => Err(Stop::Interrupted),
            Err(WriteError::Io(error)) if error.kind() == io::ErrorKind::BrokenPipe => Err(error.into()),
            Err(WriteError::Io(error)) => Err(report_unwritable(target, &error).into()),
        }
    }
}

impl CommandOutputs {
    /// Removes the temporary files that killed runs left in the folder of an output. A run does so once for
    /// each folder.
    fn tidy_folder_of(&self, target: &Path) {
        let folder = match target.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder,
            _ => Path::new("."),
        };
        let mut tidy = self.tidy_folders.lock().unwrap_or_else(PoisonError::into_inner);
        if tidy.insert(folder.to_path_buf()) {
            TemporaryFiles::default().remove_leftovers(folder);
        }
    }
}

/// Does something that may block for ever, and goes on without it after [`MOMENTS`].
fn do_within_moments(work: impl FnOnce() + Send + 'static) {
    let (sender, done) = mpsc::channel();
    let spawned = std::thread::Builder::new().spawn(move || {
        work();
        // Nobody may listen any more.
        let _ = sender.send(());
    });
    if spawned.is_ok() {
        let _ = done.recv_timeout(MOMENTS);
    }
}

/// Refuses outputs that would overwrite an input. Standard input and output are no files and not compared.
///
/// # Errors
/// Returns a finding about the first such output.
pub(super) fn refuse_overwritten_input<'a>(
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
pub(super) fn report_unwritable(target: &Path, error: &io::Error) -> Diagnostic {
    Diagnostic::new(codes::UNWRITABLE, format!("{} cannot be written: {error}", target.display()))
}

/// Prints a summary on standard output, or on standard error if an output goes there.
pub(super) fn print_summary(text: &str, output_is_taken: bool) -> io::Result<()> {
    if output_is_taken {
        return io::stderr().lock().write_all(text.as_bytes());
    }
    let mut out = io::stdout().lock();
    out.write_all(text.as_bytes())?;
    out.flush()
}

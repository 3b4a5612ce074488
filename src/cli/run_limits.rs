//! This module holds the limits of memory, time and threads, and checks them during the work on one program.

use super::input_files;
use crate::cli::bad_argument::BadArgument;
use bytesize::ByteSize;
use clap::Args;
use clsmith::batch::memory_budget::estimate_memory_bytes;
use clsmith::diagnostic::{Diagnostic, Failure, codes};
use clsmith::source::{LARGEST_STREAM_BYTES, Source};
use std::io;
use std::num::NonZeroUsize;
use std::path::Path;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::{Duration, Instant};

/// The shortest time between two measurements of the process's memory.
const BETWEEN_LOOKS: Duration = Duration::from_millis(50);

/// What a command that computes may take.
#[derive(Debug, Clone, Copy, Default, Args)]
#[command(next_help_heading = "Limits")]
pub(super) struct LimitArgs {
    #[command(flatten)]
    memory: MemoryArgs,
    /// Longest time for one program. It ends with an error when it takes longer, and nothing of it is written
    #[arg(long, value_name = "SECONDS", value_parser = input_files::parse_seconds)]
    time_limit: Option<Duration>,
    #[command(flatten)]
    threads: ThreadArgs,
}

/// How much memory a command may take.
#[derive(Debug, Clone, Copy, Default, Args)]
#[command(next_help_heading = "Limits")]
pub(super) struct MemoryArgs {
    /// Memory that the run may take, with its unit: 512MB, 4GiB. It ends with an error when it needs more
    #[arg(long, value_name = "SIZE", value_parser = parse_memory)]
    memory: Option<ByteSize>,
}

/// What a command that reads programs, and computes no more than a check, may take.
#[derive(Debug, Clone, Copy, Default, Args)]
#[command(next_help_heading = "Limits")]
pub(super) struct ReadLimitArgs {
    #[command(flatten)]
    memory: MemoryArgs,
    #[command(flatten)]
    threads: ThreadArgs,
}

/// How many processors a command that computes may use.
#[derive(Debug, Clone, Copy, Default, Args)]
#[command(next_help_heading = "Limits")]
pub(super) struct ThreadArgs {
    /// Threads; by default as many as there are processors. The result is the same
    #[arg(long, alias = "jobs", value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
}

impl LimitArgs {
    /// Returns the limits of a run on one program at a time.
    pub(super) fn of_run(self) -> RunLimits {
        RunLimits { memory_bytes: self.memory_bytes(), time: self.time_limit }
    }

    /// Returns the limits of a program of a batch, whose memory is planned for all programs together.
    pub(super) fn of_batch_file(self) -> RunLimits {
        RunLimits { memory_bytes: None, time: self.time_limit }
    }

    /// Returns the memory that was asked for, in bytes.
    pub(super) fn memory_bytes(self) -> Option<u64> {
        self.memory.bytes()
    }

    /// Returns how many threads compute.
    pub(super) fn threads(self) -> ThreadArgs {
        self.threads
    }
}

impl MemoryArgs {
    /// Returns the memory that was asked for, in bytes.
    fn bytes(self) -> Option<u64> {
        self.memory.map(|size| size.as_u64())
    }
}

impl ReadLimitArgs {
    /// Makes the threads of the process, before anything is read.
    pub(super) fn start_threads(self) -> io::Result<()> {
        self.threads.start_threads()
    }

    /// Reads a program; `-` is standard input.
    ///
    /// # Errors
    /// Returns a finding if it cannot be read, or if it takes more memory than was allowed.
    pub(super) fn read_program(self, path: &Path) -> Result<Arc<Source>, Failure> {
        read_program_within(path, self.memory.bytes())
    }
}

/// Reads a program of which so much memory is allowed.
fn read_program_within(path: &Path, most: Option<u64>) -> Result<Arc<Source>, Failure> {
    refuse_large_file(path, most)?;
    let most_read = most.map_or(LARGEST_STREAM_BYTES, |most| most.min(LARGEST_STREAM_BYTES));
    let source = input_files::read_source_within(path, most_read)?;
    refuse_large_program(&source, most)?;
    Ok(source)
}

impl ThreadArgs {
    /// Makes the threads of the process. It must be called before anything computes.
    ///
    /// # Errors
    /// Returns an error if the threads cannot be made.
    pub(super) fn start_threads(self) -> io::Result<()> {
        let Some(threads) = self.threads else { return Ok(()) };
        rayon::ThreadPoolBuilder::new().num_threads(threads.into()).build_global().map_err(io::Error::other)
    }

    /// Returns how many threads were asked for, or how many processors there are.
    pub(super) fn count(self) -> usize {
        let processors = || std::thread::available_parallelism().map_or(1, NonZeroUsize::get);
        self.threads.map_or_else(processors, usize::from)
    }
}

/// Refuses a file that is larger than `most` bytes, before it is read.
fn refuse_large_file(path: &Path, most: Option<u64>) -> Result<(), Failure> {
    let Some(most) = most else { return Ok(()) };
    let size = std::fs::metadata(path).ok().filter(|there| there.is_file()).map_or(0, |there| there.len());
    if size <= most {
        return Ok(());
    }
    let [size, most] = [size, most].map(|bytes| ByteSize::b(bytes).display().si());
    let message = format!("{} has {size}, more than the {most} of `--memory`", path.display());
    Err(Diagnostic::new(codes::MEMORY_LIMIT, message).into())
}

/// Refuses a program if its size alone tells that it takes more memory than `most` bytes.
fn refuse_large_program(source: &Source, most: Option<u64>) -> Result<(), Failure> {
    let Some(most) = most else { return Ok(()) };
    let bytes = source.bytes();
    // The samples of a large file would do, but it is in memory already.
    let lines = bytes.iter().filter(|byte| **byte == b'\n').count();
    let need = estimate_memory_bytes(bytes.len() as u64, lines as u64);
    if need <= most {
        return Ok(());
    }
    let [need, most] = [need, most].map(|bytes| ByteSize::b(bytes).display().si());
    let message = format!("{} may need {need} of memory, more than the {most} of `--memory`", source.name());
    Err(Diagnostic::new(codes::MEMORY_LIMIT, message).into())
}

/// The largest amount of memory that somebody can mean: more than any machine has.
const MOST_MEMORY_BYTES: u64 = 1 << 50;

/// Reads an amount of memory. A number without a unit is an error. It would be a number of bytes, which is
/// hardly what was meant.
fn parse_memory(text: &str) -> Result<ByteSize, BadArgument> {
    let help = "this must be a size with its unit: 512MB, 4GiB, 1.5G";
    if text.trim().parse::<f64>().is_ok() {
        return Err(BadArgument::new(help));
    }
    let size = text.trim().parse().ok().filter(|size: &ByteSize| size.as_u64() > 0);
    let size = size.ok_or(BadArgument::new(help))?;
    if size.as_u64() > MOST_MEMORY_BYTES {
        return Err(BadArgument::new("no machine has more than 1 PiB"));
    }
    Ok(size)
}

/// The limits for the work on one program. `None` means no limit.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct RunLimits {
    /// The memory of the process, in bytes.
    pub memory_bytes: Option<u64>,
    /// The time from the beginning of the work.
    pub time: Option<Duration>,
}

/// Checks whether the work on a program keeps its limits.
#[derive(Debug)]
pub(super) struct RunLimitWatch {
    limits: RunLimits,
    program: Mutex<WatchedProgram>,
}

#[derive(Debug)]
struct WatchedProgram {
    name: String,
    started: Instant,
    /// When the memory was measured last.
    looked: Option<Instant>,
}

impl RunLimitWatch {
    /// Watches the work on a program that begins now.
    pub(super) fn new(limits: RunLimits, name: &str) -> Self {
        Self { limits, program: Mutex::new(WatchedProgram::begin(name)) }
    }

    /// Begins to watch the work on the next program.
    pub(super) fn begin_program(&self, name: &str) {
        *self.lock_program() = WatchedProgram::begin(name);
    }

    /// Returns the memory that the process may take, in bytes.
    pub(super) fn memory_bytes(&self) -> Option<u64> {
        self.limits.memory_bytes
    }

    /// Refuses a file that is larger than the memory, before it is read.
    ///
    /// # Errors
    /// Returns [`codes::MEMORY_LIMIT`].
    pub(super) fn check_file(&self, path: &Path) -> Result<(), Failure> {
        refuse_large_file(path, self.limits.memory_bytes)
    }

    /// Refuses a program before the work on it if its size alone shows that it needs too much memory.
    ///
    /// # Errors
    /// Returns [`codes::MEMORY_LIMIT`].
    pub(super) fn check_size(&self, source: &Source) -> Result<(), Failure> {
        refuse_large_program(source, self.limits.memory_bytes)
    }

    /// Reads a program, unless it takes more memory than is allowed; `-` is standard input.
    ///
    /// # Errors
    /// Returns a finding if it cannot be read, and [`codes::MEMORY_LIMIT`].
    pub(super) fn read_program(&self, path: &Path) -> Result<Arc<Source>, Failure> {
        read_program_within(path, self.limits.memory_bytes)
    }

    /// Checks whether the limits are kept. It is called often during the work.
    ///
    /// # Errors
    /// Returns [`codes::TIME_LIMIT`] or [`codes::MEMORY_LIMIT`] once a limit is exceeded.
    pub(super) fn check_limits(&self) -> Result<(), Failure> {
        let mut program = self.lock_program();
        panic_if_asked(&program.name);
        if let Some(most) = self.limits.time.filter(|most| program.started.elapsed() > *most) {
            let message =
                format!("{} takes longer than the {} s of `--time-limit`", program.name, most.as_secs_f64());
            return Err(Diagnostic::new(codes::TIME_LIMIT, message).into());
        }
        let Some(most) = self.limits.memory_bytes else { return Ok(()) };
        if program.looked.is_some_and(|looked| looked.elapsed() < BETWEEN_LOOKS) {
            return Ok(());
        }
        program.looked = Some(Instant::now());
        match resident_memory_bytes() {
            Some(taken) if taken > most => {
                let [taken, most] = [taken, most].map(|bytes| ByteSize::b(bytes).display().si());
                let message = format!(
                    "{} has taken {taken} of memory, more than the {most} of `--memory`",
                    program.name
                );
                Err(Diagnostic::new(codes::MEMORY_LIMIT, message).into())
            }
            _ => Ok(()),
        }
    }

    fn lock_program(&self) -> MutexGuard<'_, WatchedProgram> {
        self.program.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl WatchedProgram {
    fn begin(name: &str) -> Self {
        Self { name: name.to_owned(), started: Instant::now(), looked: None }
    }
}

/// Returns the memory that this process takes at this moment, in bytes. Returns `None` if the system does not
/// state it.
fn resident_memory_bytes() -> Option<u64> {
    use sysinfo::{ProcessRefreshKind, ProcessesToUpdate, System};
    let own = sysinfo::get_current_pid().ok()?;
    let mut system = System::new();
    let kind = ProcessRefreshKind::nothing().with_memory();
    system.refresh_processes_specifics(ProcessesToUpdate::Some(&[own]), false, kind);
    system.process(own).map(sysinfo::Process::memory)
}

/// Panics for a program whose name contains the value of the environment variable `CLSMITH_TEST_PANIC`. So
/// tests can check that a defect of clsmith in one file stops no other file. A release build ignores the
/// variable.
#[cfg(debug_assertions)]
#[allow(clippy::panic)] // that is what it is for
fn panic_if_asked(name: &str) {
    if let Ok(mark) = std::env::var("CLSMITH_TEST_PANIC")
        && !mark.is_empty()
        && name.contains(&mark)
    {
        panic!("the test asked for it");
    }
}

#[cfg(not(debug_assertions))]
fn panic_if_asked(_: &str) {}

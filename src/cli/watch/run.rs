//! The watch at work: look, wait until a file rests, correct it, write it, remember it.

use super::Watch;
use super::folders::Folders;
use super::look::{Export, Stamp, look, unreadable};
use super::state::State;
use crate::cli::exit::Exit;
use crate::cli::output::Outputs;
use crate::cli::progress::Progress;
use crate::cli::shop::{self, Correction, Log, Outcome};
use crate::cli::terminal::plain;
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::fingerprint::Digest;
use clsmith::report::policy::Policy;
use clsmith::source::Source;
use clsmith::write::is_interrupt;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// The longest pause between two tries of what fails.
const LONGEST_PAUSE: Duration = Duration::from_secs(300);

/// What a watch knows.
pub struct Watching<'w> {
    pub(super) watch: &'w Watch,
    pub(super) folders: &'w Folders,
    pub(super) outputs: &'w Outputs,
    policy: &'w Policy,
    progress: &'w Progress,
    pub(super) log: Option<Log>,
    pub(super) state: State,
    seen: BTreeMap<PathBuf, Seen>,
    told: BTreeSet<String>,
    pub(super) worst: Exit,
}

/// A file that was seen.
struct Seen {
    stamp: Stamp,
    status: Status,
}

/// What a file waits for.
#[derive(Clone)]
pub enum Status {
    /// Not to change for some time, from then on.
    Settling(Instant),
    /// For nothing: it was done, or is told and left.
    Done,
    /// Another try at that time, after that pause; the message was told.
    Failed { next: Instant, pause: Duration, message: String },
}

/// What a file that was taken waits for, or what stands in the way around it.
pub type Taken = Result<Status, Vec<Diagnostic>>;

impl<'w> Watching<'w> {
    pub fn new(
        watch: &'w Watch,
        folders: &'w Folders,
        outputs: &'w Outputs,
        policy: &'w Policy,
        progress: &'w Progress,
        (log, state): (Option<Log>, State),
    ) -> Self {
        let (seen, told) = (BTreeMap::new(), BTreeSet::new());
        Self { watch, folders, outputs, policy, progress, log, state, seen, told, worst: Exit::Done }
    }

    /// Watches, until Ctrl-C; with `--once` until what is there is done.
    pub fn run(mut self) -> io::Result<Exit> {
        let begun = Instant::now();
        let pause = if self.watch.once { self.watch.poll.min(self.watch.settle) } else { self.watch.poll };
        let mut first: Option<BTreeSet<PathBuf>> = None;
        loop {
            let (mut exports, faults) = look(&self.folders.watched, &self.watch.files);
            for fault in faults {
                self.tell_once(fault)?;
            }
            if self.watch.once {
                let names = || exports.iter().map(|export| export.name.clone()).collect();
                let first = first.get_or_insert_with(names);
                exports.retain(|export| first.contains(&export.name));
            }
            // Exports come in the order of their names.
            self.seen.retain(|name, _| exports.binary_search_by(|export| export.name.cmp(name)).is_ok());
            for export in &exports {
                match self.consider(export) {
                    Err(error) if is_interrupt(&error) => return Ok(Exit::Interrupted),
                    done => done?,
                }
                // Ctrl-C while an output was written is only remembered, and may come when all is written.
                if self.outputs.interrupt().is_raised() {
                    return Ok(Exit::Interrupted);
                }
            }
            if self.watch.once && self.is_over(begun)? {
                return Ok(self.worst);
            }
            std::thread::sleep(pause);
        }
    }

    /// Whether `--once` has done what it can: a file that goes on changing is left.
    fn is_over(&mut self, begun: Instant) -> io::Result<bool> {
        let settling: Vec<String> = self
            .seen
            .iter()
            .filter(|(_, seen)| matches!(seen.status, Status::Settling(_)))
            .map(|(name, _)| plain(&name.to_string_lossy()))
            .collect();
        if settling.is_empty() {
            return Ok(true);
        }
        if begun.elapsed() < self.watch.settle * 3 {
            return Ok(false);
        }
        for name in settling {
            eprintln!("{name}: still changing, left for the next time");
        }
        self.worst = self.worst.max(Exit::Errors);
        Ok(true)
    }

    /// Takes a file if it has come to rest.
    fn consider(&mut self, export: &Export) -> io::Result<()> {
        let now = Instant::now();
        let status = match self.seen.get(&export.name) {
            Some(seen) if seen.stamp == export.stamp => seen.status.clone(),
            _ => {
                self.set(export, Status::Settling(now));
                return Ok(());
            }
        };
        let pause = match &status {
            Status::Done => return Ok(()),
            Status::Settling(since) if now.duration_since(*since) < self.watch.settle => return Ok(()),
            Status::Failed { next, .. } if now < *next => return Ok(()),
            Status::Settling(_) => self.watch.poll,
            Status::Failed { pause, .. } => (*pause * 2).min(LONGEST_PAUSE),
        };
        let taken = self.take(export)?;
        let after = match taken {
            Ok(after) => after,
            Err(found) => {
                self.worst = self.worst.max(Exit::Errors);
                let message: String = found.iter().map(|found| found.message.as_str()).collect();
                if !matches!(&status, Status::Failed { message: before, .. } if *before == message) {
                    self.watch.show(&found, &export.name.to_string_lossy())?;
                    eprintln!("{}: left, and tried again", plain(&export.name.to_string_lossy()));
                }
                Status::Failed { next: Instant::now() + pause, pause, message }
            }
        };
        self.set(export, after);
        Ok(())
    }

    fn set(&mut self, export: &Export, status: Status) {
        self.seen.insert(export.name.clone(), Seen { stamp: export.stamp, status });
    }

    /// Reads, corrects and writes one file; what it then waits for, or what stands around it that is in the way.
    fn take(&mut self, export: &Export) -> io::Result<Taken> {
        let changed = || Ok(Ok(Status::Settling(Instant::now())));
        let fits = export.stamp.size < u64::from(u32::MAX);
        let read = || -> io::Result<_> {
            let bytes = if fits { Some(fs::read(&export.path)?) } else { None };
            let digest = match &bytes {
                Some(bytes) => Digest::of(bytes),
                None => Digest::of_file(&export.path)?,
            };
            let is_done = self.state.is_done(&export.name, digest);
            let rests = is_done || Digest::of_file(&export.path)? == digest;
            Ok((bytes, digest, is_done, rests && Stamp::of(&export.path)? == export.stamp))
        };
        let (bytes, digest, is_done, rests) = match read() {
            Ok(read) => read,
            // Taken away again.
            Err(error) if error.kind() == io::ErrorKind::NotFound => return changed(),
            Err(error) => return Ok(Err(vec![unreadable(&export.path, &error)])),
        };
        if !rests {
            return changed();
        }
        if is_done {
            return Ok(Ok(Status::Done));
        }
        let when = (shop::now(), Instant::now());
        let name = export.path.to_string_lossy().into_owned();
        self.progress.begin(&export.name.to_string_lossy());
        let source = Source::new(name, bytes.unwrap_or_default());
        let correction = match (&source, fits) {
            (Ok(source), true) => self.correct(&export.name, source),
            _ => {
                let message =
                    format!("the file has {} bytes; clsmith reads files below 4 GiB", export.stamp.size);
                Correction::refused(vec![Diagnostic::new(codes::TOO_LARGE, message)])
            }
        };
        self.progress.clear();
        if correction.surroundings {
            return Ok(Err(correction.findings));
        }
        // A new export while we worked: the one that was read is of no use to anybody.
        if Stamp::of(&export.path).ok() != Some(export.stamp) {
            return changed();
        }
        match source {
            Ok(source) if correction.outcome != Outcome::Refused => {
                self.write(export, digest, &source, correction, when)
            }
            _ => self.refuse(export, digest, correction, when),
        }
    }

    fn correct(&self, name: &Path, source: &std::sync::Arc<Source>) -> Correction {
        let args = &self.watch.recipe;
        let file = name.file_name().unwrap_or_default().to_string_lossy();
        // Read anew for each program, so that a corrected recipe counts from the next one on.
        match args.chooser() {
            Ok(chooser) => shop::correct(args, &chooser, self.policy, self.progress, &file, source),
            Err(found) => Correction::without_recipe(found),
        }
    }

    /// Tells what would otherwise be told at every look.
    pub(super) fn tell_once(&mut self, found: Diagnostic) -> io::Result<()> {
        if found.is_error() {
            self.worst = self.worst.max(Exit::Errors);
        }
        if self.told.insert(found.message.clone()) {
            self.watch.show(&[found], &self.folders.watched.to_string_lossy())?;
        }
        Ok(())
    }
}

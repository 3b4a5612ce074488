//! The watch at work: look, wait until a file rests, correct it, write it, remember it.

use super::Watch;
use super::folders::Folders;
use super::look::{Export, Stamp, look, unreadable};
use super::refused::{Moved, aside};
use super::state::State;
use crate::cli::exit::Exit;
use crate::cli::output::{Outputs, unwritable};
use crate::cli::progress::Progress;
use crate::cli::shop::{self, Correction, InputRecord, Log, Outcome, OutputRecord, Record};
use crate::cli::terminal::plain;
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::fingerprint::Digest;
use clsmith::report::policy::Policy;
use clsmith::report::render::human;
use clsmith::source::Source;
use clsmith::write::{is_interrupt, same_file};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// The longest pause between two tries of what fails.
const LONGEST_PAUSE: Duration = Duration::from_secs(300);

/// What a watch knows.
pub struct Watching<'w> {
    watch: &'w Watch,
    folders: &'w Folders,
    outputs: &'w Outputs,
    policy: &'w Policy,
    progress: &'w Progress,
    log: Option<Log>,
    state: State,
    seen: BTreeMap<PathBuf, Seen>,
    told: BTreeSet<String>,
    worst: Exit,
}

/// A file that was seen.
struct Seen {
    stamp: Stamp,
    status: Status,
}

/// What a file waits for.
#[derive(Clone)]
enum Status {
    /// Not to change for some time, from then on.
    Settling(Instant),
    /// For nothing: it was done, or is told and left.
    Done,
    /// Another try at that time, after that pause; the message was told.
    Failed { next: Instant, pause: Duration, message: String },
}

/// What a file that was taken waits for, or what stands in the way around it.
type Taken = Result<Status, Vec<Diagnostic>>;

/// What only the lines of a watch say.
#[derive(Debug, Serialize)]
struct More<'r> {
    /// Where a refused program is now.
    refused_to: Option<&'r str>,
}

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

    fn write(
        &mut self,
        export: &Export,
        digest: Digest,
        source: &Source,
        correction: Correction,
        when: (String, Instant),
    ) -> io::Result<Taken> {
        let target = self.folders.out.join(&export.name);
        let print = correction.recipe.iter().flat_map(|recipe| &recipe.print.files);
        let mut inputs =
            print.map(|file| PathBuf::from(&file.path)).chain(self.watch.recipe.files().cloned());
        if same_file(&target, &export.path) || inputs.any(|input| same_file(&target, &input)) {
            let message = format!("writing {} would overwrite an input", target.display());
            return Ok(Err(vec![Diagnostic::new(codes::OUTPUT_IS_INPUT, message)]));
        }
        let new = Digest::of_chunks(correction.pieces(source));
        // After a crash between output and state the output stands already, and nobody must see it change.
        if Digest::of_file(&target).ok() != Some(new) {
            if let Some(folder) = target.parent()
                && let Err(error) = fs::create_dir_all(folder)
            {
                return Ok(Err(vec![unwritable(folder, &error)]));
            }
            let pieces = |out: &mut dyn io::Write| {
                correction.pieces(source).try_for_each(|piece| out.write_all(piece))
            };
            if let Some(found) = self.outputs.write(&target, pieces)? {
                return Ok(Err(vec![found]));
            }
        }
        let name = export.name.to_string_lossy();
        if !correction.findings.is_empty() {
            self.watch.show(&correction.findings, &name)?;
        }
        self.say(&name, &correction, &target);
        self.remember(export, digest, correction.outcome)?;
        let output = OutputRecord { path: Some(target.to_string_lossy().into_owned()), sha256: new };
        self.add_to_log(export, digest, &correction, (Some(output), None), when)?;
        Ok(Ok(Status::Done))
    }

    fn refuse(
        &mut self,
        export: &Export,
        digest: Digest,
        correction: Correction,
        when: (String, Instant),
    ) -> io::Result<Taken> {
        let name = export.name.to_string_lossy();
        let mut text = Vec::new();
        human::render(&mut text, &correction.findings, Some(&name), &human::HumanOptions::default())?;
        let text = String::from_utf8_lossy(&text);
        let moved = match aside(export, digest, &text, &self.folders.refused) {
            Ok(moved) => moved,
            Err(found) => return Ok(Err(vec![*found])),
        };
        let (to, stays) = match moved {
            Moved::Changed => return Ok(Ok(Status::Settling(Instant::now()))),
            Moved::To(to) => (to, None),
            Moved::Copied(to, found) => (to, Some(found)),
        };
        self.worst = self.worst.max(Exit::Errors);
        self.watch.show(&correction.findings, &name)?;
        eprintln!("{}: refused -> {}", plain(&name), plain(&to.to_string_lossy()));
        if let Some(found) = stays {
            self.watch.show(&[*found], &name)?;
            // It stays among the exports, and must not be refused again for ever.
            self.remember(export, digest, Outcome::Refused)?;
        }
        let to = to.to_string_lossy().into_owned();
        self.add_to_log(export, digest, &correction, (None, Some(&to)), when)?;
        Ok(Ok(Status::Done))
    }

    fn say(&self, name: &str, correction: &Correction, target: &Path) {
        if self.watch.quiet {
            return;
        }
        let what = match (correction.outcome, &correction.recipe) {
            (Outcome::Corrected, Some(recipe)) => {
                format!("corrected by {} ({})", recipe.path, recipe.chosen_by)
            }
            (Outcome::Unchanged, Some(recipe)) => {
                format!("nothing to change for {} ({})", recipe.path, recipe.chosen_by)
            }
            _ => "no rule fits, passed as it is".to_owned(),
        };
        eprintln!("{}: {what} -> {}", plain(name), plain(&target.to_string_lossy()));
    }

    fn remember(&mut self, export: &Export, digest: Digest, outcome: Outcome) -> io::Result<()> {
        match self.state.add(&export.name, digest, outcome) {
            Ok(()) => Ok(()),
            Err(found) => self.tell_once(*found),
        }
    }

    fn add_to_log(
        &mut self,
        export: &Export,
        digest: Digest,
        correction: &Correction,
        (output, refused_to): (Option<OutputRecord>, Option<&str>),
        (time, started): (String, Instant),
    ) -> io::Result<()> {
        let Some(log) = &mut self.log else { return Ok(()) };
        let path = export.path.to_string_lossy().into_owned();
        let input = InputRecord { path, sha256: Some(digest) };
        let more = More { refused_to };
        let record = Record::of("watch", (&time, started), &input, correction, output.as_ref(), more);
        match log.add(&record) {
            Ok(()) => Ok(()),
            Err(found) => self.tell_once(*found),
        }
    }

    /// Tells what would otherwise be told at every look.
    fn tell_once(&mut self, found: Diagnostic) -> io::Result<()> {
        if found.is_error() {
            self.worst = self.worst.max(Exit::Errors);
        }
        if self.told.insert(found.message.clone()) {
            self.watch.show(&[found], &self.folders.watched.to_string_lossy())?;
        }
        Ok(())
    }
}

//! This module runs the watch: it finds files, waits until they do not change any more, corrects, writes and
//! remembers them.

use super::WatchArgs;
use super::folder_scan::{ExportStamp, ExportedFile, report_unreadable, scan_exports};
use super::json_lines::{JsonLines, LostLine};
use super::watch_folders::WatchFolders;
use super::watch_state::WatchState;
use crate::cli::command_exit::CommandExit;
use crate::cli::command_outputs::CommandOutputs;
use crate::cli::progress::CommandProgress;
use crate::cli::stop::Stop;
use crate::cli::terminal::escape_controls;
use crate::cli::unattended::{self, RunLog, UnattendedCorrection, UnattendedOutcome};
use clsmith::diagnostic::{Diagnostic, Failure, codes};
use clsmith::fingerprint::Digest;
use clsmith::job::catch_defect;
use clsmith::report::finding_policy::FindingPolicy;
use clsmith::source::{Source, read_file_bytes};
use serde::Serialize;
use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// The longest pause between two tries of something that fails.
const LONGEST_PAUSE: Duration = Duration::from_secs(300);

/// The state of a watch.
pub(super) struct WatchRun<'w> {
    pub(super) watch: &'w WatchArgs,
    pub(super) folders: &'w WatchFolders,
    pub(super) outputs: &'w CommandOutputs,
    policy: &'w FindingPolicy,
    progress: &'w CommandProgress,
    pub(super) log: Option<RunLog>,
    pub(super) json: JsonLines,
    pub(super) state: WatchState,
    /// The files of the last check of the folder, by name.
    seen: BTreeMap<PathBuf, SeenExport>,
    /// The messages that were shown and are not repeated.
    told: BTreeSet<String>,
    /// The worst result so far, for the exit code of `--once`.
    pub(super) worst: CommandExit,
}

/// A file as it was found at the last check.
struct SeenExport {
    stamp: ExportStamp,
    status: ExportStatus,
}

/// What has to happen before a file is taken.
#[derive(Clone)]
pub(super) enum ExportStatus {
    /// It must not change for the settling time, which began at this moment.
    Settling(Instant),
    /// Nothing has to happen, because it was processed, or reported and left.
    Done,
    /// It failed and is tried again at `next`. `pause` is the time from the failure to then, and `message`
    /// was shown.
    Failed { next: Instant, pause: Duration, message: String },
}

impl<'w> WatchRun<'w> {
    pub(super) fn new(
        watch: &'w WatchArgs,
        folders: &'w WatchFolders,
        outputs: &'w CommandOutputs,
        policy: &'w FindingPolicy,
        progress: &'w CommandProgress,
        (log, json, state): (Option<RunLog>, JsonLines, WatchState),
    ) -> Self {
        let (seen, told) = (BTreeMap::new(), BTreeSet::new());
        let worst = CommandExit::Done;
        Self { watch, folders, outputs, policy, progress, log, json, state, seen, told, worst }
    }

    /// Watches until Ctrl-C, or with `--once` until all existing files are processed.
    pub(super) fn watch_folder(mut self) -> Result<CommandExit, Stop> {
        let begun = Instant::now();
        // With --once somebody waits for the end, so the watch does not sleep longer than a file needs to
        // settle.
        let pause = if self.watch.once { self.watch.poll.min(self.watch.settle) } else { self.watch.poll };
        let mut first: Option<BTreeSet<PathBuf>> = None;
        loop {
            let (mut exports, faults) = scan_exports(&self.folders.watched, &self.watch.files);
            for fault in faults {
                self.tell_once(fault)?;
            }
            if self.watch.once {
                // With --once only the files of the first look count, or a folder that is always busy would
                // never let it end.
                let names = || exports.iter().map(|export| export.name.clone()).collect();
                let first = first.get_or_insert_with(names);
                exports.retain(|export| first.contains(&export.name));
            }
            // A file that is gone is forgotten, so that a later one of the same name has to settle, too.
            // Exports are in the order of their names.
            self.seen.retain(|name, _| exports.binary_search_by(|export| export.name.cmp(name)).is_ok());
            for export in &exports {
                self.take_settled(export)?;
                // Ctrl-C while an output is written is only remembered, and may come after everything is
                // written.
                if self.outputs.interrupt().is_raised() {
                    return Err(Stop::Interrupted);
                }
            }
            if self.watch.once && self.is_once_finished(begun)? {
                return Ok(self.worst);
            }
            std::thread::sleep(pause);
        }
    }

    /// Returns whether `--once` has done what it can. A file that keeps changing is left.
    fn is_once_finished(&mut self, begun: Instant) -> io::Result<bool> {
        let settling: Vec<String> = self
            .seen
            .iter()
            .filter(|(_, seen)| matches!(seen.status, ExportStatus::Settling(_)))
            .map(|(name, _)| escape_controls(&name.to_string_lossy()))
            .collect();
        if settling.is_empty() {
            return Ok(true);
        }
        // Without this bound, a single file that is written to all the time would keep --once from ending.
        if begun.elapsed() < self.watch.settle * 3 {
            return Ok(false);
        }
        for name in settling {
            eprintln!("{name}: still changing, left for the next time");
        }
        self.worst = self.worst.max(CommandExit::Errors);
        Ok(true)
    }

    /// Takes a file if it does not change any more.
    fn take_settled(&mut self, export: &ExportedFile) -> Result<(), Stop> {
        let now = Instant::now();
        let status = match self.seen.get(&export.name) {
            Some(seen) if seen.stamp == export.stamp => seen.status.clone(),
            _ => {
                self.set_status(export, ExportStatus::Settling(now));
                return Ok(());
            }
        };
        let pause = match &status {
            ExportStatus::Done => return Ok(()),
            ExportStatus::Settling(since) if now.duration_since(*since) < self.watch.settle => return Ok(()),
            ExportStatus::Failed { next, .. } if now < *next => return Ok(()),
            ExportStatus::Settling(_) => self.watch.poll,
            // A full disk or a lost network drive stays so for some time, so each pause is twice the last
            // one.
            ExportStatus::Failed { pause, .. } => (*pause * 2).min(LONGEST_PAUSE),
        };
        let taken = catch_defect(&export.path.to_string_lossy(), || self.take_export(export));
        let after = match taken.unwrap_or_else(|defect| Err(defect.into())) {
            Ok(after) => after,
            Err(Stop::Found { findings: found, .. }) => {
                self.worst = self.worst.max(CommandExit::Errors);
                let message: String = found.iter().map(|found| found.message.as_str()).collect();
                if !matches!(&status, ExportStatus::Failed { message: before, .. } if *before == message) {
                    self.watch.show_findings(&found, &export.name.to_string_lossy())?;
                    self.add_json(None::<&()>, &found)?;
                    eprintln!("{}: left, and tried again", escape_controls(&export.name.to_string_lossy()));
                }
                ExportStatus::Failed { next: Instant::now() + pause, pause, message }
            }
            Err(stop) => return Err(stop),
        };
        self.set_status(export, after);
        Ok(())
    }

    fn set_status(&mut self, export: &ExportedFile, status: ExportStatus) {
        self.seen.insert(export.name.clone(), SeenExport { stamp: export.stamp, status });
    }

    /// Reads, corrects and writes one file. Returns its new status.
    ///
    /// # Errors
    /// Returns findings about an obstacle, after which the file is tried again, or an interruption.
    fn take_export(&mut self, export: &ExportedFile) -> Result<ExportStatus, Stop> {
        let changed = || Ok(ExportStatus::Settling(Instant::now()));
        let too_large = self.progress.check_file(&export.path).err();
        let fits = too_large.is_none() && export.stamp.size < u64::from(u32::MAX);
        let read = || -> io::Result<_> {
            let bytes = if fits { Some(read_file_bytes(&export.path)?) } else { None };
            let digest = match &bytes {
                Some(bytes) => Digest::from_bytes(bytes),
                None => Digest::from_file(&export.path)?,
            };
            let is_done = self.state.is_done(&export.name, digest);
            // Some programs reserve the whole size of a file before they write its content, and a network
            // drive may tell its new time late. Then only a second reading shows that they are still at work.
            let rests = is_done || Digest::from_file(&export.path)? == digest;
            Ok((bytes, digest, is_done, rests && ExportStamp::read_stamp(&export.path)? == export.stamp))
        };
        let (bytes, digest, is_done, rests) = match read() {
            Ok(read) => read,
            // It was removed again.
            Err(error) if error.kind() == io::ErrorKind::NotFound => return changed(),
            Err(error) => return Err(report_unreadable(&export.path, &error).into()),
        };
        if !rests {
            return changed();
        }
        if is_done {
            return Ok(ExportStatus::Done);
        }
        let when = (unattended::utc_now(), Instant::now());
        let name = export.path.to_string_lossy().into_owned();
        self.progress.begin_program(&export.name.to_string_lossy());
        let source = Source::new(name, bytes.unwrap_or_default());
        let correction = match (&source, fits) {
            (Ok(source), true) => self.correct_source(&export.name, source),
            _ => UnattendedCorrection::refused(too_large.map_or_else(
                || {
                    let size = export.stamp.size;
                    let message = format!("the file has {size} bytes; clsmith reads files below 4 GiB");
                    vec![Diagnostic::new(codes::TOO_LARGE, message)]
                },
                Failure::into_findings,
            )),
        };
        self.progress.clear_bar();
        if correction.outcome == UnattendedOutcome::Stopped {
            return Err(Stop::Interrupted);
        }
        // The fault is not in the program but in a recipe or setup. So the program stays, and is tried again
        // until that is repaired.
        if correction.surroundings {
            return Err(correction.findings.into());
        }
        // A new export was written meanwhile, so the one that was read is of no use.
        if ExportStamp::read_stamp(&export.path).ok() != Some(export.stamp) {
            return changed();
        }
        match source {
            Ok(source) if correction.outcome != UnattendedOutcome::Refused => {
                self.write_corrected(export, digest, &source, correction, when)
            }
            _ => self.move_refused(export, digest, correction, when),
        }
    }

    fn correct_source(&self, name: &Path, source: &std::sync::Arc<Source>) -> UnattendedCorrection {
        let args = &self.watch.recipe;
        let file = name.file_name().unwrap_or_default().to_string_lossy();
        if let Err(failure) = self.progress.check_size(source) {
            return UnattendedCorrection::refused(failure.into_findings());
        }
        // The rules are read anew for each program, so that a change of them counts from the next program on.
        match args.read_chooser() {
            Ok(chooser) => {
                unattended::correct_unattended(args, &chooser, self.policy, self.progress, &file, source)
            }
            Err(failure) => UnattendedCorrection::without_recipe(failure.into_findings()),
        }
    }

    /// Reports once what would otherwise be reported at every check.
    pub(super) fn tell_once(&mut self, found: Diagnostic) -> io::Result<()> {
        if found.is_error() {
            self.worst = self.worst.max(CommandExit::Errors);
        }
        if self.told.insert(found.message.clone()) {
            let found = [found];
            self.watch.show_findings(&found, &self.folders.watched.to_string_lossy())?;
            self.add_json(None::<&()>, &found)?;
        }
        Ok(())
    }

    /// Adds a line of JSON, if it is wanted. A line that cannot be written is reported once.
    pub(super) fn add_json(
        &mut self,
        run: Option<&impl Serialize>,
        findings: &[Diagnostic],
    ) -> io::Result<()> {
        match self.json.add_line(run, findings) {
            Ok(()) => Ok(()),
            Err(LostLine::NobodyReads(error)) => Err(error),
            Err(LostLine::Unwritable(found)) => {
                self.worst = self.worst.max(CommandExit::Errors);
                if self.told.insert(found.message.clone()) {
                    self.watch.show_findings(&[found], &self.folders.watched.to_string_lossy())?;
                }
                Ok(())
            }
        }
    }
}

//! This module processes all files of a batch, several at the same time.

use super::batch_plan::{BatchPlan, PlannedFile, PreparedRecipe};
use super::file_run::{self, FileRunResult, FileRunSettings};
use super::memory_budget::{MemoryQueue, MemoryTicket};
use super::{BatchJournal, BatchRecord, FileOutcome, JournalEntry, LockedFolder};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::fingerprint::Digest;
use crate::output_files::Interrupt;
use crate::program::Dialect;
use crate::report::finding_policy::FindingPolicy;
use crate::simulation_run;
use std::collections::BTreeMap;
use std::io;
use std::path::Path;
use std::sync::mpsc;

/// A batch that is ready to run.
///
/// ```
/// use clsmith::batch::jobs_file::load_jobs;
/// use clsmith::source::Source;
/// use std::path::Path;
///
/// // A jobs file says which recipe which files get.
/// let text = b"out: done\njobs:\n  - { recipe: slow.yaml, files: [\"programs/**/*.cls\"] }\n";
/// let jobs = load_jobs(&Source::new("jobs.yaml", text.to_vec())?, Path::new("jobs.yaml"))?;
/// assert_eq!(jobs.jobs.len(), 1);
/// assert!(jobs.jobs[0].recipe.ends_with("slow.yaml"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct BatchRun<'a> {
    /// The planned files.
    pub plan: &'a BatchPlan,
    /// The recipes, in the order of the jobs.
    pub works: &'a [PreparedRecipe],
    /// The policy that decides which findings stop a file.
    pub policy: &'a FindingPolicy,
    /// The dialect, if it is forced.
    pub dialect: Option<Dialect>,
    /// Everything else that decides results, in words: policy and dialect.
    pub options: &'a str,
    /// The output folder.
    pub folder: &'a LockedFolder,
    /// The threads. Their number limits how many files are processed at the same time, together with the
    /// parallel work of steps.
    pub pool: &'a rayon::ThreadPool,
    /// The memory for all files together, in bytes.
    pub memory: u64,
    /// Whether no further file is begun after one has failed.
    pub fail_fast: bool,
    /// Whether files that are finished and unchanged are skipped.
    pub resume: bool,
    /// The request to stop.
    pub interrupt: &'a Interrupt,
}

/// An observer of a batch. It is called from many threads.
pub trait BatchWatcher: Sync {
    /// Is called when a file begins. The returned watcher is informed about the progress of its steps, and is
    /// asked whether to stop.
    fn begin_file(&self, file: &PlannedFile) -> Box<dyn simulation_run::RunWatcher + '_>;

    /// Is called when a file has ended. `before` is true if an earlier run has processed it.
    fn end_file(&self, file: &PlannedFile, record: &BatchRecord, findings: &[Diagnostic], before: bool);
}

/// The outcome of a batch.
#[derive(Debug)]
#[non_exhaustive]
pub struct BatchOutcome {
    /// The records of all files, sorted by name. Those that were not run are included.
    pub records: Vec<BatchRecord>,
    /// The number of files that an earlier run has processed.
    pub before: usize,
    /// Findings about the batch itself.
    pub findings: Vec<Diagnostic>,
    /// Whether the batch was stopped. Then only the journal is complete, not `records`.
    pub interrupted: bool,
}

impl BatchRun<'_> {
    /// Runs the batch.
    ///
    /// # Errors
    /// Returns [`codes::UNWRITABLE`] if the journal cannot be begun, and [`codes::OUTPUT_IN_USE`] if shards
    /// of another batch are running.
    pub fn run_batch(&self, watch: &dyn BatchWatcher) -> Result<BatchOutcome, Failure> {
        let id = self.plan.batch_id(self.works, self.options);
        let mine = self.plan.files_of_shard(self.folder.folder().shard());
        self.folder.check_same_batch(id)?;
        // The folder is locked, so temporary files of this batch or shard can only be left from a run that
        // was killed.
        self.folder.remove_leftovers(self.plan.files.iter().map(|file| file.output.as_path()));
        let known = if self.resume { self.find_finished_files(&mine) } else { BTreeMap::new() };
        let unwritable = |error: io::Error| {
            let journal = self.folder.folder().journal_path();
            let message = format!("the journal {} cannot be written: {error}", journal.display());
            Diagnostic::new(codes::UNWRITABLE, message)
        };
        let journal = BatchJournal::begin_journal(self.folder, id, known.values()).map_err(unwritable)?;
        let settings = FileRunSettings {
            policy: self.policy,
            dialect: self.dialect,
            options: self.options,
            folder: self.folder,
            interrupt: self.interrupt,
        };
        let needs =
            mine.iter().filter_map(|&index| self.plan.files.get(index).map(|file| (index, file.need)));
        let queue = MemoryQueue::new(needs, self.memory);
        let (sender, told) = mpsc::channel();
        let work = |sender: mpsc::Sender<_>| {
            while let Some(ticket) = queue.take_next() {
                // Files run inside the pool, so that all files and the parallel work of their steps use that
                // many threads together. Waiting for memory happens outside of it, where it blocks no thread.
                let ended = self.pool.install(|| self.run_ticket(settings, &ticket, &known, &journal, watch));
                let stop = ended.as_ref().is_none_or(|(_, end)| self.fail_fast && end.has_failed());
                if stop || self.interrupt.is_raised() {
                    queue.close_queue();
                }
                if let Some(ended) = ended {
                    // The receiver lives longer than this thread, so sending cannot fail.
                    let _ = sender.send(ended);
                }
            }
        };
        let work = &work;
        std::thread::scope(|scope| {
            // This thread works, too, so one less is started.
            for _ in 1..self.pool.current_num_threads().min(mine.len()) {
                let sender = sender.clone();
                // If the system gives no more threads, the existing ones do the work.
                let _ = std::thread::Builder::new().spawn_scoped(scope, move || work(sender));
            }
            work(sender);
        });
        Ok(self.gather_records(&mine, told.into_iter().collect()))
    }

    fn find_finished_files(&self, mine: &[usize]) -> BTreeMap<usize, JournalEntry> {
        let mut all = BatchJournal::read_entries(self.folder);
        let files = mine.iter().filter_map(|&index| Some((index, self.plan.files.get(index)?)));
        files
            .filter_map(|(index, file)| {
                Some((index, all.remove(&(file.input.clone(), file.output_name.clone()))?))
            })
            .collect()
    }

    /// Processes the file of a ticket. Returns `None` once the batch was stopped.
    fn run_ticket(
        &self,
        settings: FileRunSettings<'_>,
        ticket: &MemoryTicket<'_>,
        known: &BTreeMap<usize, JournalEntry>,
        journal: &BatchJournal,
        watch: &dyn BatchWatcher,
    ) -> Option<(usize, FileCompletion)> {
        let file = self.plan.files.get(ticket.file)?;
        let work = self.works.get(file.job)?;
        if self.interrupt.is_raised() {
            return None;
        }
        let steps = watch.begin_file(file);
        let ended = file_run::run_file(settings, file, work, known.get(&ticket.file), steps.as_ref());
        let (record, findings, key, before) = match ended {
            FileRunResult::Before(record) => (record, Vec::new(), None, true),
            FileRunResult::Now { record, findings, key } => (record, findings, key, false),
            FileRunResult::Interrupted => return None,
        };
        drop(steps);
        watch.end_file(file, &record, &findings, before);
        // A journal that cannot be written does not make the file fail: its output is right, and a resumed
        // batch only repeats it.
        let lost = key.and_then(|key| journal.add_entry(&JournalEntry { key, record: record.clone() }).err());
        Some((ticket.file, FileCompletion { record, before, lost }))
    }

    fn gather_records(&self, mine: &[usize], ended: Vec<(usize, FileCompletion)>) -> BatchOutcome {
        let mut ended: BTreeMap<usize, FileCompletion> = ended.into_iter().collect();
        let interrupted = self.interrupt.is_raised();
        let mut ran = BatchOutcome {
            records: Vec::new(),
            before: 0,
            findings: self.find_changed_inputs(),
            interrupted,
        };
        for &index in mine {
            let Some(file) = self.plan.files.get(index) else { continue };
            let Some(FileCompletion { record, before, lost }) = ended.remove(&index) else {
                let work = self.works.get(file.job);
                ran.records.extend(work.map(|work| BatchRecord::new(file, work, FileOutcome::NotRun)));
                continue;
            };
            ran.before += usize::from(before);
            ran.records.push(record);
            ran.findings.extend(lost.map(|error| {
                let message = format!(
                    "the journal cannot be written: {error}; --resume will repeat every file after {}",
                    file.input
                );
                Diagnostic::new(codes::UNWRITABLE, message)
            }));
        }
        ran
    }

    /// Reports setups and models that have changed since they were read.
    fn find_changed_inputs(&self) -> Vec<Diagnostic> {
        let prints = self.works.iter().flat_map(|work| &work.print.files);
        let all: BTreeMap<&str, Digest> = prints.map(|file| (file.path.as_str(), file.sha256)).collect();
        let changed = all.into_iter().filter(|(path, then)| {
            // The path of a name that is not UTF-8 is not known here, so such names are skipped.
            Digest::from_file(Path::new(path)).is_ok_and(|now| now != *then)
        });
        changed
            .map(|(path, _)| {
                let message = format!("{path} was changed while the batch ran");
                Diagnostic::new(codes::INPUT_CHANGED, message)
                    .with_help("Some files may have been processed with the old one and some with the new one. Run the batch again, without --resume.")
            })
            .collect()
    }
}

struct FileCompletion {
    record: BatchRecord,
    before: bool,
    lost: Option<io::Error>,
}

impl FileCompletion {
    fn has_failed(&self) -> bool {
        self.record.outcome == FileOutcome::Failed
    }
}

//! All files of a batch, several at once.

use super::budget::{Queue, Ticket};
use super::one::{self, Ended, Settings};
use super::plan::{Plan, Planned, Work};
use super::{Done, Journal, Locked, Outcome, Record};
use crate::diagnostic::{Diagnostic, codes};
use crate::fingerprint::Digest;
use crate::machining;
use crate::program::Dialect;
use crate::report::policy::Policy;
use crate::write::Interrupt;
use std::collections::BTreeMap;
use std::io;
use std::path::Path;
use std::sync::mpsc;

/// A batch that is ready to run.
pub struct Batch<'a> {
    /// Which files.
    pub plan: &'a Plan,
    /// The recipes, in the order of the jobs.
    pub works: &'a [Work],
    /// Which findings stop a file.
    pub policy: &'a Policy,
    /// The dialect, where it is forced.
    pub dialect: Option<Dialect>,
    /// What else decides results, in words: policy and dialect.
    pub options: &'a str,
    /// Where outputs go.
    pub folder: &'a Locked,
    /// The threads: so many files at once, and what steps do in parallel.
    pub pool: &'a rayon::ThreadPool,
    /// Memory for all files together, in bytes.
    pub memory: u64,
    /// Whether no file is begun after one has failed.
    pub fail_fast: bool,
    /// Whether files that are done and unchanged are skipped.
    pub resume: bool,
    /// The wish to stop.
    pub interrupt: &'a Interrupt,
}

/// Somebody who watches a batch; called from many threads.
pub trait Watch: Sync {
    /// A file begins; what is returned is told how far its steps are, and asked whether to stop.
    fn begins(&self, file: &Planned) -> Box<dyn machining::Watch + '_>;

    /// A file has ended; `before` if it was done by an earlier run.
    fn ended(&self, file: &Planned, record: &Record, findings: &[Diagnostic], before: bool);
}

/// What came of a batch.
#[derive(Debug)]
pub struct Ran {
    /// What became of each file, sorted by name. Those that were not run are there, too.
    pub records: Vec<Record>,
    /// How many were done by an earlier run.
    pub before: usize,
    /// Findings about the batch itself.
    pub findings: Vec<Diagnostic>,
    /// Whether somebody stopped it; `records` is then of no use, the journal is.
    pub interrupted: bool,
}

impl Batch<'_> {
    /// Runs it.
    ///
    /// # Errors
    /// [`codes::UNWRITABLE`] if the journal cannot be begun, [`codes::OUTPUT_IN_USE`] if shards of another batch run.
    pub fn run(&self, watch: &dyn Watch) -> Result<Ran, Box<Diagnostic>> {
        let id = self.plan.id(self.works, self.options);
        let mine = self.plan.of_shard(self.folder.folder().shard());
        self.folder.same_batch(id)?;
        self.folder.sweep(self.plan);
        let known = if self.resume { self.known(&mine) } else { BTreeMap::new() };
        let unwritable = |error: io::Error| {
            let journal = self.folder.folder().journal();
            let message = format!("the journal {} cannot be written: {error}", journal.display());
            Box::new(Diagnostic::new(codes::UNWRITABLE, message))
        };
        let journal = Journal::begin(self.folder, id, known.values()).map_err(unwritable)?;
        let settings = Settings {
            policy: self.policy,
            dialect: self.dialect,
            options: self.options,
            folder: self.folder,
            interrupt: self.interrupt,
        };
        let needs =
            mine.iter().filter_map(|&index| self.plan.files.get(index).map(|file| (index, file.need)));
        let queue = Queue::new(needs, self.memory);
        let (tell, told) = mpsc::channel();
        let work = |tell: mpsc::Sender<_>| {
            while let Some(ticket) = queue.take() {
                // In the pool, so that all files and what their steps do in parallel have so many threads together; the
                // wait for room is outside, where it keeps no thread from its work.
                let ended = self.pool.install(|| self.one(settings, &ticket, &known, &journal, watch));
                let stop = ended.as_ref().is_none_or(|(_, end)| self.fail_fast && end.has_failed());
                if stop || self.interrupt.is_raised() {
                    queue.close();
                }
                if let Some(ended) = ended {
                    // The receiver lives longer than this.
                    let _ = tell.send(ended);
                }
            }
        };
        let work = &work;
        std::thread::scope(|scope| {
            for _ in 1..self.pool.current_num_threads().min(mine.len()) {
                let tell = tell.clone();
                // Where the system gives no more threads, those there are do it.
                let _ = std::thread::Builder::new().spawn_scoped(scope, move || work(tell));
            }
            work(tell);
        });
        Ok(self.gather(&mine, told.into_iter().collect()))
    }

    fn known(&self, mine: &[usize]) -> BTreeMap<usize, Done> {
        let mut all = Journal::read(self.folder);
        let files = mine.iter().filter_map(|&index| Some((index, self.plan.files.get(index)?)));
        files
            .filter_map(|(index, file)| {
                Some((index, all.remove(&(file.input.clone(), file.output_name.clone()))?))
            })
            .collect()
    }

    /// Does the file of a ticket; `None` once somebody stopped the batch.
    fn one(
        &self,
        settings: Settings<'_>,
        ticket: &Ticket<'_>,
        known: &BTreeMap<usize, Done>,
        journal: &Journal,
        watch: &dyn Watch,
    ) -> Option<(usize, End)> {
        let file = self.plan.files.get(ticket.file)?;
        let work = self.works.get(file.job)?;
        if self.interrupt.is_raised() {
            return None;
        }
        let steps = watch.begins(file);
        let ended = one::run(settings, file, work, known.get(&ticket.file), steps.as_ref());
        let (record, findings, key, before) = match ended {
            Ended::Before(record) => (record, Vec::new(), None, true),
            Ended::Now { record, findings, key } => (record, findings, key, false),
            Ended::Interrupted => return None,
        };
        drop(steps);
        watch.ended(file, &record, &findings, before);
        let lost = key.and_then(|key| journal.add(&Done { key, record: record.clone() }).err());
        Some((ticket.file, End { record, before, lost }))
    }

    fn gather(&self, mine: &[usize], ended: Vec<(usize, End)>) -> Ran {
        let mut ended: BTreeMap<usize, End> = ended.into_iter().collect();
        let interrupted = self.interrupt.is_raised();
        let mut ran = Ran { records: Vec::new(), before: 0, findings: self.changed_meanwhile(), interrupted };
        for &index in mine {
            let Some(file) = self.plan.files.get(index) else { continue };
            let Some(End { record, before, lost }) = ended.remove(&index) else {
                let work = self.works.get(file.job);
                ran.records.extend(work.map(|work| Record::new(file, work, Outcome::NotRun)));
                continue;
            };
            ran.before += usize::from(before);
            ran.records.push(record);
            ran.findings.extend(lost.map(|error| {
                let message = format!(
                    "the journal cannot be written: {error}; --resume will do again what came after {}",
                    file.input
                );
                Diagnostic::new(codes::UNWRITABLE, message)
            }));
        }
        ran
    }

    /// Setups and models that are no longer what the results were made with.
    fn changed_meanwhile(&self) -> Vec<Diagnostic> {
        let prints = self.works.iter().flat_map(|work| &work.print.files);
        let all: BTreeMap<&str, Digest> = prints.map(|file| (file.path.as_str(), file.sha256)).collect();
        let changed = all.into_iter().filter(|(path, then)| {
            // Names that are no UTF-8 were opened by another path than is known here; they are left out.
            Digest::of_file(Path::new(path)).is_ok_and(|now| now != *then)
        });
        changed
            .map(|(path, _)| {
                let message = format!("{path} was changed while the batch ran");
                Diagnostic::new(codes::INPUT_CHANGED, message)
                    .help("Some files may have been done with the old one and some with the new: run the batch again, without --resume.")
            })
            .collect()
    }
}

struct End {
    record: Record,
    before: bool,
    lost: Option<io::Error>,
}

impl End {
    fn has_failed(&self) -> bool {
        self.record.outcome == Outcome::Failed
    }
}

//! This module processes one file of a batch: it reads and corrects it, checks that it has not changed
//! meanwhile, and writes it.

use super::batch_plan::{PlannedFile, PreparedRecipe, report_outside_link};
use super::{
    BatchRecord, FileOutcome, JournalEntry, LockedFolder, StatementChangeCounts, set_older_output_aside,
};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::fingerprint::Digest;
use crate::job::{self, CorrectionJob, JobOutcome};
use crate::output_files::{Interrupt, OutputAccess, WriteError};
use crate::program::{Dialect, Program};
use crate::report::finding_policy::FindingPolicy;
use crate::simulation_run::RunWatcher;
use crate::source::{Source, read_open_file_bytes};
use std::fs::{self, Metadata};
use std::io::{self, Read, Write};
use std::path::Path;
use std::time::{Duration, Instant, SystemTime};

/// The settings that all files of a batch have in common.
#[derive(Clone, Copy)]
pub(super) struct FileRunSettings<'a> {
    pub policy: &'a FindingPolicy,
    pub dialect: Option<Dialect>,
    pub options: &'a str,
    pub folder: &'a LockedFolder,
    pub interrupt: &'a Interrupt,
}

/// How the processing of a file ended.
pub(super) enum FileRunResult {
    /// An earlier run has processed it, and nothing has changed since.
    Before(BatchRecord),
    /// It was processed now. The key is given if its output was written.
    Now { record: BatchRecord, findings: Vec<Diagnostic>, key: Option<Digest> },
    /// The batch was stopped, and nothing was written.
    Interrupted,
}

/// A file that is younger than this may be changed again within one tick of the file system's clock, so its
/// time proves nothing.
const YOUNG: Duration = Duration::from_secs(2);

pub(super) fn run_file(
    settings: FileRunSettings<'_>,
    file: &PlannedFile,
    work: &PreparedRecipe,
    before: Option<&JournalEntry>,
    watch: &dyn RunWatcher,
) -> FileRunResult {
    if let Some(done) = before.filter(|done| is_still_done(settings, file, work, done)) {
        // A recipe that was moved is still the same recipe, so only its name is updated.
        return FileRunResult::Before(BatchRecord { recipe: work.name.clone(), ..done.record.clone() });
    }
    let started = Instant::now();
    let mut record = BatchRecord::new(file, work, FileOutcome::Failed);
    let name = file.input.to_string();
    let corrected = job::catch_defect(&name, || correct_file(settings, file, work, &mut record, watch));
    let findings = match corrected.unwrap_or_else(|defect| Err(defect.into())) {
        Ok(findings) => findings,
        Err(Failure::Interrupted) => return FileRunResult::Interrupted,
        Err(Failure::Found(mut found)) => {
            let older = settings.folder.folder().root().join(&file.output);
            found.extend(set_older_output_aside(&older, &file.output_name.to_string()));
            found
        }
    };
    record.count_findings(&findings, &name);
    record.seconds = Some(started.elapsed().as_secs_f64());
    let input = record.sha256.input.filter(|_| record.outcome.is_written());
    let key = input.map(|input| work.print.result_key(input, settings.options));
    FileRunResult::Now { record, findings, key }
}

/// Returns whether input, recipe, options and version are still the same, and the output is still what was
/// written.
fn is_still_done(
    settings: FileRunSettings<'_>,
    file: &PlannedFile,
    work: &PreparedRecipe,
    done: &JournalEntry,
) -> bool {
    let is_file = |path: &Path| fs::symlink_metadata(path).is_ok_and(|there| there.is_file());
    let output = settings.folder.folder().root().join(&file.output);
    // The digests read both files from end to end, so what is known without reading is asked first.
    done.record.outcome.is_written()
        && fs::metadata(&file.path).is_ok_and(|there| there.is_file())
        && is_file(&output)
        && Digest::from_file(&file.path)
            .is_ok_and(|now| work.print.result_key(now, settings.options) == done.key)
        && Digest::from_file(&output).is_ok_and(|now| done.record.sha256.output == Some(now))
}

/// Reports an input that was written to while it was read.
pub fn report_input_changed(name: &str) -> Diagnostic {
    Diagnostic::new(codes::INPUT_CHANGED, format!("{name} was changed while it was read"))
}

fn correct_file(
    settings: FileRunSettings<'_>,
    file: &PlannedFile,
    work: &PreparedRecipe,
    record: &mut BatchRecord,
    watch: &dyn RunWatcher,
) -> Result<Vec<Diagnostic>, Failure> {
    let name = file.input.to_string();
    let unreadable = |error: io::Error| match error.kind() {
        io::ErrorKind::FileTooLarge => Diagnostic::new(codes::TOO_LARGE, error.to_string()),
        _ => Diagnostic::new(codes::UNREADABLE, format!("{name} cannot be read: {error}")),
    };
    let began = SystemTime::now();
    let (bytes, stamp) = read_input(&file.path).map_err(unreadable)?;
    let source = Source::new(name.clone(), bytes)
        .map_err(|error| Diagnostic::new(codes::TOO_LARGE, error.to_string()))?;
    let digest = Digest::from_bytes(source.bytes());
    record.sha256.input = Some(digest);
    let job = CorrectionJob {
        recipe: &work.recipe,
        setup: &work.setup,
        print: Some(&work.print),
        policy: settings.policy,
        dialect: settings.dialect,
        watch,
    };
    let done = job.correct_source(&source);
    // A job that was stopped ends with an error, which is no fault of the file.
    if settings.interrupt.is_raised() {
        return Err(Failure::Interrupted);
    }
    // This comes before the findings of the job: those of a file that was only half written would mislead.
    if !is_unchanged(&file.path, &stamp, began, digest).map_err(unreadable)? {
        return Err(report_input_changed(&name).into());
    }
    let JobOutcome { program, findings, .. } = done?;
    write_corrected(settings, file, &program)?;
    record.sha256.output =
        Some(Digest::from_reader(ChunkReader::new(program.byte_chunks())).map_err(unreadable)?);
    record.changed = StatementChangeCounts::count_changes(&program);
    record.outcome =
        if job::is_program_changed(&program) { FileOutcome::Corrected } else { FileOutcome::Unchanged };
    Ok(findings)
}

/// The data by which a changed file is recognized without reading it.
#[derive(PartialEq)]
struct InputStamp {
    size: u64,
    modified: Option<SystemTime>,
}

impl InputStamp {
    fn from_metadata(there: &Metadata) -> Self {
        Self { size: there.len(), modified: there.modified().ok() }
    }
}

fn read_input(path: &Path) -> io::Result<(Vec<u8>, InputStamp)> {
    // The kind of the file is checked before it is opened, because opening a pipe would wait for a writer.
    if !fs::metadata(path)?.is_file() {
        return Err(io::Error::other("it is not a file"));
    }
    let file = fs::File::open(path)?;
    let there = file.metadata()?;
    let bytes = read_open_file_bytes(&file, there.len())?;
    Ok((bytes, InputStamp::from_metadata(&there)))
}

/// Returns whether a file is still the one that was read since `began`.
fn is_unchanged(path: &Path, stamp: &InputStamp, began: SystemTime, digest: Digest) -> io::Result<bool> {
    if InputStamp::from_metadata(&fs::metadata(path)?) != *stamp {
        return Ok(false);
    }
    let young = |modified: SystemTime| began.duration_since(modified).map_or(true, |age| age < YOUNG);
    if stamp.modified.is_none_or(young) { Ok(Digest::from_file(path)? == digest) } else { Ok(true) }
}

fn write_corrected(
    settings: FileRunSettings<'_>,
    file: &PlannedFile,
    program: &Program,
) -> Result<(), Failure> {
    let folder = settings.folder.folder();
    let target = folder.root().join(&file.output);
    let unwritable = |error: io::Error| {
        Diagnostic::new(codes::UNWRITABLE, format!("{} cannot be written: {error}", file.output_name))
    };
    if let Some(parent) = target.parent() {
        fs::create_dir_all(parent).map_err(unwritable)?;
    }
    // The path is checked again, because a link may have been put there since the batch was planned.
    let mut parts = file.output.ancestors().filter(|path| !path.as_os_str().is_empty());
    if let Some(link) = parts.find(|path| folder.is_link(path)) {
        return Err(report_outside_link(link).into());
    }
    let all = |out: &mut dyn Write| program.byte_chunks().try_for_each(|piece| out.write_all(piece));
    let access = OutputAccess::of_inputs([file.path.as_path()]);
    let temporaries = folder.temporary_files().clone().with_access(access);
    temporaries.write_file(&target, settings.interrupt, all).map_err(|error| match error {
        WriteError::Interrupted => Failure::Interrupted,
        WriteError::Io(error) => unwritable(error).into(),
    })
}

/// Reads slices one after the other.
struct ChunkReader<'p, I> {
    pieces: I,
    now: &'p [u8],
}

impl<'p, I: Iterator<Item = &'p [u8]>> ChunkReader<'p, I> {
    fn new(pieces: I) -> Self {
        Self { pieces, now: &[] }
    }
}

impl<'p, I: Iterator<Item = &'p [u8]>> Read for ChunkReader<'p, I> {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        while self.now.is_empty() {
            match self.pieces.next() {
                Some(piece) => self.now = piece,
                None => return Ok(0),
            }
        }
        self.now.read(into)
    }
}

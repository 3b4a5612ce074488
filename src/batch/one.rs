//! One file of a batch: read, correct, look whether it is still the same, write.

use super::plan::{Planned, Work, outside};
use super::{Changed, Done, Locked, Outcome, Record};
use crate::diagnostic::{Code, Diagnostic, codes};
use crate::fingerprint::Digest;
use crate::job::{self, Job};
use crate::machining::Watch;
use crate::program::{Dialect, Program};
use crate::report::policy::Policy;
use crate::source::Source;
use crate::write::{Interrupt, is_interrupt};
use std::fs::{self, Metadata};
use std::io::{self, Read, Write};
use std::path::Path;
use std::time::{Duration, Instant, SystemTime};

/// What all files of a batch are done with.
#[derive(Clone, Copy)]
pub(super) struct Settings<'a> {
    pub policy: &'a Policy,
    pub dialect: Option<Dialect>,
    pub options: &'a str,
    pub folder: &'a Locked,
    pub interrupt: &'a Interrupt,
}

/// How a file ended.
pub(super) enum Ended {
    /// It was done before, and nothing changed since.
    Before(Record),
    /// It is done now. The key is there if its output is.
    Now { record: Record, findings: Vec<Diagnostic>, key: Option<Digest> },
    /// Somebody stopped the batch; nothing was written.
    Interrupted,
}

/// A file younger than this may be changed again within one tick of the file system's clock, so its time proves nothing.
const YOUNG: Duration = Duration::from_secs(2);

pub(super) fn run(
    settings: Settings<'_>,
    file: &Planned,
    work: &Work,
    before: Option<&Done>,
    watch: &dyn Watch,
) -> Ended {
    if let Some(done) = before.filter(|done| is_still_done(settings, file, work, done)) {
        // A recipe that was moved is the same recipe; its name is the one of now.
        return Ended::Before(Record { recipe: work.name.clone(), ..done.record.clone() });
    }
    let started = Instant::now();
    let mut record = Record::new(file, work, Outcome::Failed);
    let findings = match correct(settings, file, work, &mut record, watch) {
        Ok(findings) => findings,
        Err(Stop::Interrupted) => return Ended::Interrupted,
        Err(Stop::Found(found)) => settings.policy.apply(vec![*found]),
    };
    record.count(&findings, &file.input.to_string());
    record.seconds = Some(started.elapsed().as_secs_f64());
    let input = record.sha256.input.filter(|_| record.outcome.is_written());
    let key = input.map(|input| work.print.key(input, settings.options));
    Ended::Now { record, findings, key }
}

/// Whether input, recipe, options and version are those of then, and the output is still what was written.
fn is_still_done(settings: Settings<'_>, file: &Planned, work: &Work, done: &Done) -> bool {
    let is_file = |path: &Path| fs::symlink_metadata(path).is_ok_and(|there| there.is_file());
    let output = settings.folder.folder().root().join(&file.output);
    done.record.outcome.is_written()
        && fs::metadata(&file.path).is_ok_and(|there| there.is_file())
        && is_file(&output)
        && Digest::of_file(&file.path).is_ok_and(|now| work.print.key(now, settings.options) == done.key)
        && Digest::of_file(&output).is_ok_and(|now| done.record.sha256.output == Some(now))
}

/// An input that somebody wrote to while it was read.
pub fn changed(name: &str) -> Diagnostic {
    Diagnostic::new(codes::INPUT_CHANGED, format!("{name} was changed while it was read"))
}

enum Stop {
    Found(Box<Diagnostic>),
    Interrupted,
}

impl Stop {
    fn found(code: Code, message: String) -> Self {
        Self::Found(Box::new(Diagnostic::new(code, message)))
    }
}

fn correct(
    settings: Settings<'_>,
    file: &Planned,
    work: &Work,
    record: &mut Record,
    watch: &dyn Watch,
) -> Result<Vec<Diagnostic>, Stop> {
    let name = file.input.to_string();
    let unreadable =
        |error: io::Error| Stop::found(codes::UNREADABLE, format!("{name} cannot be read: {error}"));
    let began = SystemTime::now();
    let (bytes, stamp) = read(&file.path).map_err(unreadable)?;
    let source =
        Source::new(name.clone(), bytes).map_err(|error| Stop::found(codes::TOO_LARGE, error.to_string()))?;
    let digest = Digest::of(source.bytes());
    record.sha256.input = Some(digest);
    let job = Job {
        recipe: &work.recipe,
        setup: &work.setup,
        print: Some(&work.print),
        policy: settings.policy,
        dialect: settings.dialect,
        watch,
    };
    let done = job.run(&source);
    if settings.interrupt.is_raised() {
        return Err(Stop::Interrupted);
    }
    if !is_unchanged(&file.path, &stamp, began, digest).map_err(unreadable)? {
        return Err(Stop::Found(Box::new(changed(&name))));
    }
    if let Some(program) = done.program {
        write(settings, file, &program)?;
        record.sha256.output = Some(Digest::of_reader(Pieces::new(program.pieces())).map_err(unreadable)?);
        record.changed = Changed::of(&program);
        record.outcome = if job::is_changed(&program) { Outcome::Corrected } else { Outcome::Unchanged };
    }
    Ok(done.findings)
}

/// What tells a file from a changed one without reading it.
#[derive(PartialEq)]
struct Stamp {
    size: u64,
    modified: Option<SystemTime>,
}

impl Stamp {
    fn of(there: &Metadata) -> Self {
        Self { size: there.len(), modified: there.modified().ok() }
    }
}

fn read(path: &Path) -> io::Result<(Vec<u8>, Stamp)> {
    // Looked at before it is opened: opening a pipe waits for somebody to write.
    if !fs::metadata(path)?.is_file() {
        return Err(io::Error::other("it is no file"));
    }
    let mut file = fs::File::open(path)?;
    let there = file.metadata()?;
    let mut bytes = Vec::with_capacity(usize::try_from(there.len()).unwrap_or_default());
    file.read_to_end(&mut bytes)?;
    Ok((bytes, Stamp::of(&there)))
}

/// Whether a file is the one that was read, from `began` on.
fn is_unchanged(path: &Path, stamp: &Stamp, began: SystemTime, digest: Digest) -> io::Result<bool> {
    if Stamp::of(&fs::metadata(path)?) != *stamp {
        return Ok(false);
    }
    let young = |modified: SystemTime| began.duration_since(modified).map_or(true, |age| age < YOUNG);
    if stamp.modified.is_none_or(young) { Ok(Digest::of_file(path)? == digest) } else { Ok(true) }
}

fn write(settings: Settings<'_>, file: &Planned, program: &Program) -> Result<(), Stop> {
    let folder = settings.folder.folder();
    let target = folder.root().join(&file.output);
    let unwritable = |error: io::Error| {
        Stop::found(codes::UNWRITABLE, format!("{} cannot be written: {error}", file.output_name))
    };
    if let Some(parent) = target.parent() {
        fs::create_dir_all(parent).map_err(unwritable)?;
    }
    // Again: somebody may have put a link there since the batch was planned.
    let mut parts = file.output.ancestors().filter(|path| !path.as_os_str().is_empty());
    if let Some(link) = parts.find(|path| folder.is_link(path)) {
        return Err(Stop::Found(Box::new(outside(link))));
    }
    let all = |out: &mut dyn Write| program.pieces().try_for_each(|piece| out.write_all(piece));
    folder
        .temporaries()
        .write(&target, settings.interrupt, all)
        .map_err(|error| if is_interrupt(&error) { Stop::Interrupted } else { unwritable(error) })
}

/// Slices one after the other, to be read.
struct Pieces<'p, I> {
    pieces: I,
    now: &'p [u8],
}

impl<'p, I: Iterator<Item = &'p [u8]>> Pieces<'p, I> {
    fn new(pieces: I) -> Self {
        Self { pieces, now: &[] }
    }
}

impl<'p, I: Iterator<Item = &'p [u8]>> Read for Pieces<'p, I> {
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

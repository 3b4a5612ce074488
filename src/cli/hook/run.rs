//! One run of the hook, from the export to the line in the log.

use super::desk::Desk;
use super::exit_codes::{REFUSED, STOPPED, judge};
use super::post::{self, Ended};
use super::{Hook, OnError};
use crate::cli::exit::Exit;
use crate::cli::files;
use crate::cli::output::{Outputs, unless_nobody_reads, unwritable};
use crate::cli::progress::Progress;
use crate::cli::shop::{self, Correction, InputRecord, Log, Outcome, OutputRecord, Record};
use crate::cli::terminal::plain;
use clsmith::batch;
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::fingerprint::Digest;
use clsmith::report::policy::Policy;
use clsmith::report::{changes, step_report};
use clsmith::source::Source;
use clsmith::write::{is_interrupt, same_file};
use serde::Serialize;
use std::ffi::{OsStr, OsString};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

/// What is known of a run so far; in the end it becomes a line of the log.
pub struct Run<'h> {
    hook: &'h Hook,
    outputs: &'h Outputs,
    log: Option<Log>,
    started: Instant,
    time: String,
    input: InputRecord,
    correction: Correction,
    output: Option<OutputRecord>,
    post: Option<PostRecord>,
}

/// What the log says about the post.
#[derive(Debug, Serialize)]
struct PostRecord {
    /// As it stands after `--`, `{}` included.
    command: Vec<String>,
    /// `exit`, `signal`, `timed_out`, `stopped`, `missing`, `not_started`.
    ended: &'static str,
    /// The exit code or the signal.
    code: Option<i32>,
    seconds: f64,
    /// Files that it left beside the program, where they were put.
    left: Vec<String>,
}

/// What only the hook's lines say.
#[derive(Debug, Serialize)]
struct More<'r> {
    post: Option<&'r PostRecord>,
    exit: i32,
}

impl<'h> Run<'h> {
    pub fn new(hook: &'h Hook, outputs: &'h Outputs, log: Option<Log>) -> Self {
        let input = InputRecord { path: hook.input.to_string_lossy().into_owned(), sha256: None };
        Self {
            hook,
            outputs,
            log,
            started: Instant::now(),
            time: shop::now(),
            input,
            correction: Correction::refused(Vec::new()),
            output: None,
            post: None,
        }
    }

    /// Corrects, keeps, posts, logs.
    pub fn whole(mut self, policy: &Policy, progress: &Progress) -> io::Result<Exit> {
        let source = match files::read(&self.hook.input) {
            Ok(source) => source,
            Err(found) => {
                self.found(vec![*found])?;
                return self.end(REFUSED);
            }
        };
        self.input.sha256 = Some(Digest::of(source.bytes()));
        // From here on Ctrl-C leaves a line in the log and no file behind.
        let outputs = self.outputs;
        let _held = outputs.hold();
        progress.begin(&self.input.path);
        self.correction = self.correct(policy, progress, &source);
        progress.clear();
        if outputs.interrupt().is_raised() {
            return self.end(STOPPED);
        }
        self.hook.show(&self.correction.findings)?;
        let passes_original = self.hook.on_error == OnError::PassOriginal;
        if self.correction.outcome == Outcome::Refused {
            if !passes_original {
                return self.end(REFUSED);
            }
            self.correction.outcome = Outcome::PassedOriginal;
            let message = format!(
                "{} goes to the post UNTOUCHED, without what the recipe is there for",
                self.input.path
            );
            self.found(vec![Diagnostic::new(codes::PASSED_ORIGINAL, message)])?;
        }
        if let Some(found) = self.keep(&source)? {
            self.found(vec![found])?;
            if !passes_original {
                self.correction.outcome = Outcome::Refused;
                return self.end(REFUSED);
            }
        }
        if let Some(found) = self.changed_meanwhile() {
            self.found(vec![found])?;
            self.correction.outcome = Outcome::Refused;
            return self.end(REFUSED);
        }
        let exit = self.post(&source)?;
        self.end(exit)
    }

    fn correct(&self, policy: &Policy, progress: &Progress, source: &Arc<Source>) -> Correction {
        let args = &self.hook.recipe;
        let name = self.hook.name().to_string_lossy();
        match args.chooser() {
            Ok(chooser) => shop::correct(args, &chooser, policy, progress, &name, source),
            Err(found) => Correction::without_recipe(found),
        }
    }

    /// Shows findings and remembers them.
    fn found(&mut self, findings: Vec<Diagnostic>) -> io::Result<()> {
        self.hook.show(&findings)?;
        self.correction.findings.extend(findings);
        Ok(())
    }

    /// What there is to say when the export is not what was read any more: who writes it was not done.
    fn changed_meanwhile(&self) -> Option<Diagnostic> {
        let now = Digest::of_file(&self.hook.input).ok();
        (now != self.input.sha256).then(|| batch::changed(&self.input.path))
    }

    /// Keeps what the post is to get.
    fn keep(&self, source: &Arc<Source>) -> io::Result<Option<Diagnostic>> {
        let Some(target) = self.hook.kept_at() else { return Ok(None) };
        if let Some(hit) = self.read_files().into_iter().find(|path| same_file(path, &target)) {
            let message = format!("keeping {} would overwrite {}", target.display(), hit.display());
            return Ok(Some(Diagnostic::new(codes::OUTPUT_IS_INPUT, message)));
        }
        if let Some(folder) = self.hook.kept_in()
            && let Err(error) = std::fs::create_dir_all(folder)
        {
            return Ok(Some(unwritable(folder, &error)));
        }
        let written = self.outputs.write_held(&target, |out| {
            self.correction.pieces(source).try_for_each(|piece| out.write_all(piece))
        });
        match written {
            // The wish to stop is looked at again before the post runs.
            Err(error) if is_interrupt(&error) => Ok(None),
            written => written,
        }
    }

    /// Files of this run that nothing may overwrite.
    fn read_files(&self) -> Vec<PathBuf> {
        let given = self.hook.recipe.files().chain([&self.hook.input]).chain(&self.hook.log).cloned();
        let print = self.correction.recipe.iter().flat_map(|recipe| &recipe.print.files);
        given.chain(print.map(|file| PathBuf::from(&file.path))).collect()
    }

    /// Runs the post; the exit code.
    fn post(&mut self, source: &Arc<Source>) -> io::Result<i32> {
        let desk = match Desk::with(self.hook.name(), self.correction.pieces(source)) {
            Ok(desk) => desk,
            Err(found) => {
                self.found(vec![*found])?;
                self.correction.outcome = Outcome::Refused;
                return Ok(REFUSED);
            }
        };
        if !self.hook.quiet {
            unless_nobody_reads(self.summary())?;
        }
        self.output = Some(OutputRecord {
            path: self.hook.kept_at().map(|path| path.to_string_lossy().into_owned()),
            sha256: Digest::of_chunks(self.correction.pieces(source)),
        });
        let (program, arguments) = match self.hook.post.split_first() {
            Some((program, arguments)) => (program.as_os_str(), arguments),
            None => (OsStr::new(""), Default::default()),
        };
        let path = desk.file().as_os_str();
        let arguments: Vec<OsString> =
            arguments.iter().map(|argument| post::filled(argument, path)).collect();
        let begun = Instant::now();
        let ended = post::run(program, &arguments, self.hook.timeout, self.outputs.interrupt())?;
        let mut record = PostRecord::new(&self.hook.post, &ended, begun.elapsed().as_secs_f64());
        let (mut exit, found) = judge(&program.to_string_lossy(), self.hook.timeout, &ended);
        let mut found: Vec<Diagnostic> = found.into_iter().collect();
        if matches!(ended, Ended::Exit(_)) {
            let mut protected = self.read_files();
            protected.extend(self.hook.kept_at());
            let folder = self.hook.input.parent().unwrap_or(Path::new(""));
            let (put, faults) = desk.hand_over(folder, &protected, self.outputs.interrupt());
            if !self.hook.quiet {
                put.iter().for_each(|path| eprintln!("{}: from the post", plain(&path.to_string_lossy())));
            }
            record.left = put.iter().map(|path| path.to_string_lossy().into_owned()).collect();
            // Who looks at the code alone must not take an older NC program for the new one.
            if exit == 0 && faults.iter().any(Diagnostic::is_error) {
                exit = REFUSED;
            }
            found.extend(faults);
        }
        found.extend(desk.clear().err().map(|found| *found));
        self.post = Some(record);
        self.found(found)?;
        Ok(exit)
    }

    /// What the recipe did, for who looks on.
    fn summary(&self) -> io::Result<()> {
        let mut err = io::stderr().lock();
        let name = plain(&self.input.path);
        let recipe = self.correction.recipe.as_ref();
        let by = recipe.map(|recipe| format!("{} ({})", recipe.path, recipe.chosen_by)).unwrap_or_default();
        match self.correction.outcome {
            Outcome::Corrected => {
                writeln!(err, "{name}: corrected by {by}")?;
                err.write_all(changes::steps_to_text(&self.correction.steps).as_bytes())?;
            }
            Outcome::Unchanged => writeln!(err, "{name}: {by} found nothing to change")?,
            Outcome::Passed => writeln!(err, "{name}: no rule fits, so it goes to the post as it is")?,
            Outcome::PassedOriginal | Outcome::Refused | Outcome::Stopped => {}
        }
        let mut reports = self.correction.reports.iter();
        reports.try_for_each(|report| err.write_all(step_report::to_text(report).as_bytes()))
    }

    /// The last word, and the line in the log.
    fn end(mut self, exit: i32) -> io::Result<Exit> {
        let stopped = self.outputs.interrupt().is_raised()
            && self.post.as_ref().is_none_or(|post| matches!(post.ended, "stopped"));
        let exit = if stopped { STOPPED } else { exit };
        if stopped {
            self.correction.outcome = Outcome::Stopped;
            eprintln!("clsmith: stopped");
        } else if self.correction.outcome == Outcome::Refused {
            eprintln!("{}: nothing was posted", plain(&self.input.path));
        }
        let Some(mut log) = self.log.take() else { return Ok(Exit::Posted(exit)) };
        let more = More { post: self.post.as_ref(), exit };
        let when = (self.time.as_str(), self.started);
        let output = self.output.as_ref();
        let record = Record::of("hook", when, &self.input, &self.correction, output, more);
        if let Err(found) = log.add(&record) {
            self.hook.show(&[*found])?;
        }
        Ok(Exit::Posted(exit))
    }
}

impl PostRecord {
    fn new(command: &[OsString], ended: &Ended, seconds: f64) -> Self {
        let (ended, code) = match ended {
            Ended::Exit(code) => ("exit", Some(*code)),
            Ended::Signal(signal) => ("signal", Some(*signal)),
            Ended::TimedOut => ("timed_out", None),
            Ended::Stopped => ("stopped", None),
            Ended::Missing(_) => ("missing", None),
            Ended::NotStarted(_) => ("not_started", None),
        };
        let command = command.iter().map(|part| part.to_string_lossy().into_owned()).collect();
        Self { command, ended, code, seconds, left: Vec::new() }
    }
}

//! This module runs the hook once, from the export to the line in the log.

use super::exit_codes::{REFUSED, STOPPED, judge_post_outcome};
use super::older_results;
use super::post_process::{self, PostOutcome};
use super::post_workspace::{PostWorkspace, refuse_link_out};
use super::{HookArgs, OnError};
use crate::cli::closed_pipe::ignore_closed_pipe;
use crate::cli::command_exit::CommandExit;
use crate::cli::command_outputs::{CommandOutputs, report_unwritable};
use crate::cli::input_files;
use crate::cli::progress::CommandProgress;
use crate::cli::stop::Stop;
use crate::cli::terminal::escape_controls;
use crate::cli::unattended::{
    self, LogLine, LoggedInput, LoggedOutput, RunLog, UnattendedCorrection, UnattendedOutcome,
};
use clsmith::batch;
use clsmith::diagnostic::{Diagnostic, Failure, codes};
use clsmith::fingerprint::Digest;
use clsmith::output_files::is_same_file;
use clsmith::report::changes;
use clsmith::report::finding_policy::FindingPolicy;
use clsmith::source::Source;
use serde::Serialize;
use std::ffi::{OsStr, OsString};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::Instant;

/// The state of a run. In the end it becomes a line of the log.
pub(super) struct HookRun<'h> {
    hook: &'h HookArgs,
    outputs: &'h CommandOutputs,
    log: Option<RunLog>,
    started: Instant,
    /// How long the run took, once it has ended.
    seconds: f64,
    time: String,
    input: LoggedInput,
    correction: UnattendedCorrection,
    output: Option<LoggedOutput>,
    post: Option<LoggedPost>,
    /// Whether the handler of Ctrl-C may write the line of the log.
    has_last_line: bool,
}

/// The post as it is logged.
#[derive(Debug, Serialize)]
struct LoggedPost {
    /// The command as it is written after `--`, including `{}`.
    command: Vec<String>,
    /// `exit`, `signal`, `timed_out`, `stopped`, `missing`, `not_started`.
    ended: &'static str,
    /// The exit code or the signal.
    code: Option<i32>,
    seconds: f64,
    /// The files that the post left beside the program, with the paths to which they were copied.
    left: Vec<String>,
}

/// The fields that only the hook logs.
#[derive(Debug, Serialize)]
struct HookLogFields<'r> {
    post: Option<&'r LoggedPost>,
    exit: i32,
}

impl<'h> HookRun<'h> {
    pub(super) fn new(hook: &'h HookArgs, outputs: &'h CommandOutputs, log: Option<RunLog>) -> Self {
        let input = LoggedInput { path: hook.input.to_string_lossy().into_owned(), sha256: None };
        Self {
            hook,
            outputs,
            log,
            started: Instant::now(),
            seconds: 0.0,
            time: unattended::utc_now(),
            input,
            correction: UnattendedCorrection::refused(Vec::new()),
            output: None,
            post: None,
            has_last_line: false,
        }
    }

    /// Corrects, keeps, posts and logs the program. `without_log` is why there is no log, if one is wanted.
    pub(super) fn run_hook(
        mut self,
        policy: &FindingPolicy,
        progress: &CommandProgress,
        without_log: Vec<Diagnostic>,
    ) -> Result<CommandExit, Stop> {
        self.keep_last_line();
        if !without_log.is_empty() {
            self.show_and_keep_findings(without_log.clone())?;
            if self.hook.on_error == OnError::Stop {
                return self.finish_and_log(REFUSED);
            }
        }
        let source = match progress.check_file(&self.hook.input).and_then(|()| self.read_export()) {
            Ok(source) => source,
            Err(failure) => {
                self.show_and_keep_findings(failure.into_findings())?;
                return self.finish_and_log(REFUSED);
            }
        };
        self.input.sha256 = Some(Digest::from_bytes(source.bytes()));
        // From here on, Ctrl-C leaves a line in the log and no file behind.
        let outputs = self.outputs;
        let _held = outputs.hold_ctrl_c();
        progress.begin_program(&self.input.path);
        self.correction = self.correct_source(policy, progress, &source);
        progress.clear_bar();
        if outputs.interrupt().is_raised() {
            return self.finish_and_log(STOPPED);
        }
        self.hook.show_findings(&self.correction.findings)?;
        self.correction.findings.splice(0..0, without_log);
        let passes_original = self.hook.on_error == OnError::PassOriginal;
        if self.correction.outcome == UnattendedOutcome::Refused {
            if !passes_original {
                return self.finish_and_log(REFUSED);
            }
            self.correction.outcome = UnattendedOutcome::PassedOriginal;
            let message = format!(
                "{} goes to the post UNTOUCHED, without the corrections of the recipe",
                self.input.path
            );
            self.show_and_keep_findings(vec![Diagnostic::new(codes::PASSED_ORIGINAL, message)])?;
        }
        match self.keep_program(&source) {
            // The request to stop is checked again before the post runs.
            Ok(()) | Err(Stop::Interrupted) => {}
            Err(Stop::Found { findings, .. }) => {
                self.show_and_keep_findings(findings)?;
                if !passes_original {
                    self.correction.outcome = UnattendedOutcome::Refused;
                    return self.finish_and_log(REFUSED);
                }
            }
            Err(stop) => return Err(stop),
        }
        // The CAM system may still be writing while the beginning of its file is corrected, so this is
        // checked as late as possible: directly before the post.
        if let Some(found) = self.check_input_unchanged() {
            self.show_and_keep_findings(vec![found])?;
            self.correction.outcome = UnattendedOutcome::Refused;
            return self.finish_and_log(REFUSED);
        }
        let exit = self.run_post(&source)?;
        self.finish_and_log(exit)
    }

    /// Prepares the line of the log that the handler of Ctrl-C writes if the work does not end by itself.
    fn keep_last_line(&mut self) {
        let Some(mut log) = self.log.as_ref().and_then(RunLog::try_clone) else { return };
        let (input, time, started) = (self.input.clone(), self.time.clone(), self.started);
        self.has_last_line = true;
        self.outputs.keep_last_words(move || {
            let more = HookLogFields { post: None, exit: STOPPED };
            let correction = UnattendedCorrection::stopped();
            let record = LogLine::from_correction(
                "hook",
                (&time, started.elapsed().as_secs_f64()),
                &input,
                &correction,
                None,
                more,
            );
            // The process ends at this moment, so an error could not be reported.
            let _ = log.add_line(&record);
        });
    }

    /// Reads the export. It is read once more before the post runs, so it must be a file.
    fn read_export(&self) -> Result<Arc<Source>, Failure> {
        let input = &self.hook.input;
        if std::fs::metadata(input).is_ok_and(|there| !there.is_file()) {
            let message = format!(
                "{} is no file; a hook corrects the file that a CAM system has written",
                input.display()
            );
            return Err(Diagnostic::new(codes::UNREADABLE, message).into());
        }
        input_files::read_source(input)
    }

    fn correct_source(
        &self,
        policy: &FindingPolicy,
        progress: &CommandProgress,
        source: &Arc<Source>,
    ) -> UnattendedCorrection {
        let args = &self.hook.recipe;
        let name = self.hook.program_file_name().to_string_lossy();
        if let Err(failure) = progress.check_size(source) {
            return UnattendedCorrection::refused(failure.into_findings());
        }
        match args.read_chooser() {
            Ok(chooser) => unattended::correct_unattended(args, &chooser, policy, progress, &name, source),
            Err(failure) => UnattendedCorrection::without_recipe(failure.into_findings()),
        }
    }

    /// Shows findings and remembers them.
    fn show_and_keep_findings(&mut self, findings: Vec<Diagnostic>) -> io::Result<()> {
        self.hook.show_findings(&findings)?;
        self.correction.findings.extend(findings);
        Ok(())
    }

    /// Returns a finding if the export has changed since it was read, because its writer was not done.
    fn check_input_unchanged(&self) -> Option<Diagnostic> {
        let now = Digest::from_file(&self.hook.input).ok();
        (now != self.input.sha256).then(|| batch::report_input_changed(&self.input.path))
    }

    /// Writes the program for the post to the path of `--keep`, if that is given.
    fn keep_program(&self, source: &Arc<Source>) -> Result<(), Stop> {
        let Some(target) = self.hook.keep_path() else { return Ok(()) };
        if let Some(hit) = self.list_read_files().into_iter().find(|path| is_same_file(path, &target)) {
            let message = format!("keeping {} would overwrite {}", target.display(), hit.display());
            return Err(Diagnostic::new(codes::OUTPUT_IS_INPUT, message).into());
        }
        if self.hook.keep.as_ref() != Some(&target)
            && let Some((folder, name)) = target.parent().zip(target.file_name())
            && let Some(found) = refuse_link_out(folder, Path::new(name))
        {
            return Err(found.into());
        }
        if let Some(folder) = self.hook.keep_folder()
            && let Err(error) = std::fs::create_dir_all(folder)
        {
            return Err(report_unwritable(folder, &error).into());
        }
        let outputs = self.outputs.for_inputs([self.hook.input.as_path()]);
        outputs.write_held_output(&target, |out| {
            self.correction.byte_chunks(source).try_for_each(|piece| out.write_all(piece))
        })
    }

    /// Returns the files of this run that must not be overwritten.
    fn list_read_files(&self) -> Vec<PathBuf> {
        let given = self.hook.recipe.input_files().chain([&self.hook.input]).chain(&self.hook.log).cloned();
        let print = self.correction.recipe.iter().flat_map(|recipe| &recipe.print.files);
        given.chain(print.map(|file| PathBuf::from(&file.path))).collect()
    }

    /// Runs the post on the program, and copies the post's outputs beside the export. Returns the exit code
    /// of the hook.
    fn run_post(&mut self, source: &Arc<Source>) -> io::Result<i32> {
        let desk = match PostWorkspace::create_with_program(
            self.hook.program_file_name(),
            self.correction.byte_chunks(source),
        ) {
            Ok(desk) => desk,
            Err(failure) => {
                self.show_and_keep_findings(failure.into_findings())?;
                self.correction.outcome = UnattendedOutcome::Refused;
                return Ok(REFUSED);
            }
        };
        if !self.hook.progress.quiet {
            ignore_closed_pipe(self.show_summary())?;
        }
        self.output = Some(LoggedOutput {
            path: self.hook.keep_path().map(|path| path.to_string_lossy().into_owned()),
            sha256: Digest::from_chunks(self.correction.byte_chunks(source)),
        });
        let (program, arguments) = match self.hook.post.split_first() {
            Some((program, arguments)) => (program.as_os_str(), arguments),
            None => (OsStr::new(""), Default::default()),
        };
        let path = desk.program_path().as_os_str();
        let arguments: Vec<OsString> =
            arguments.iter().map(|argument| post_process::fill_path_mark(argument, path)).collect();
        let begun = Instant::now();
        let ended = post_process::run_post(
            program,
            &arguments,
            self.hook.timeout,
            self.outputs.interrupt(),
            self.hook.json.is_standard(),
        )?;
        let mut record = LoggedPost::new(&self.hook.post, &ended, begun.elapsed().as_secs_f64());
        let (mut exit, found) = judge_post_outcome(&program.to_string_lossy(), self.hook.timeout, &ended);
        let mut found: Vec<Diagnostic> = found.into_iter().collect();
        if matches!(ended, PostOutcome::Exit(_)) {
            let mut protected = self.list_read_files();
            protected.extend(self.hook.keep_path());
            let folder = self.hook.input.parent().unwrap_or(Path::new(""));
            let (put, faults) =
                desk.copy_post_outputs(folder, &self.hook.input, &protected, self.outputs.interrupt());
            if !self.hook.progress.quiet {
                put.iter().for_each(|path| {
                    eprintln!("{}: from the post", escape_controls(&path.to_string_lossy()))
                });
            }
            record.left = put.iter().map(|path| path.to_string_lossy().into_owned()).collect();
            // A caller that only checks the code must not take an older NC program for the new one.
            if exit == 0 && faults.iter().any(Diagnostic::is_error) {
                exit = REFUSED;
            }
            found.extend(faults);
        }
        found.extend(desk.remove_folder().err());
        self.post = Some(record);
        self.show_and_keep_findings(found)?;
        Ok(exit)
    }

    /// Prints what the recipe did, for people.
    fn show_summary(&self) -> io::Result<()> {
        let mut err = io::stderr().lock();
        let name = escape_controls(&self.input.path);
        let recipe = self.correction.recipe.as_ref();
        let by = recipe.map(|recipe| format!("{} ({})", recipe.path, recipe.chosen_by)).unwrap_or_default();
        match self.correction.outcome {
            UnattendedOutcome::Corrected => {
                writeln!(err, "{name}: corrected by {by}")?;
                err.write_all(changes::steps_to_text(&self.correction.steps).as_bytes())?;
            }
            UnattendedOutcome::Unchanged => writeln!(err, "{name}: {by} found nothing to change")?,
            UnattendedOutcome::Passed => {
                writeln!(err, "{name}: no rule matches, so it goes to the post unchanged")?
            }
            UnattendedOutcome::PassedOriginal | UnattendedOutcome::Refused | UnattendedOutcome::Stopped => {}
        }
        let mut reports = self.correction.reports.iter();
        reports.try_for_each(|report| err.write_all(report.to_text(self.correction.units).as_bytes()))
    }

    /// Prints the last message, sets results of earlier runs aside if the post did not end by itself, and
    /// writes the line in the log and the JSON.
    fn finish_and_log(mut self, exit: i32) -> Result<CommandExit, Stop> {
        // Ctrl-C after the post has ended by itself changes nothing. Its NC program is complete, and the
        // caller has to see the post's own code.
        let stopped = self.outputs.interrupt().is_raised()
            && self.post.as_ref().is_none_or(|post| matches!(post.ended, "stopped"));
        let exit = if stopped { STOPPED } else { exit };
        if stopped {
            self.correction.outcome = UnattendedOutcome::Stopped;
            eprintln!("clsmith: stopped");
        } else if self.correction.outcome == UnattendedOutcome::Refused {
            eprintln!("{}: nothing was posted", escape_controls(&self.input.path));
        }
        if !stopped && exit != 0 && self.post.as_ref().is_none_or(|post| post.ended != "exit") {
            let found = self.set_older_results_aside();
            self.show_and_keep_findings(found)?;
        }
        if self.has_last_line && !self.outputs.take_last_words() {
            // The handler of Ctrl-C was faster: it writes the line and ends the process.
            return Ok(CommandExit::Posted(STOPPED));
        }
        self.seconds = self.started.elapsed().as_secs_f64();
        let exit = self.add_to_log(exit)?;
        self.write_json(exit)
    }

    /// Writes the line in the log. Returns the exit code.
    fn add_to_log(&mut self, exit: i32) -> Result<i32, Stop> {
        let Some(mut log) = self.log.take() else { return Ok(exit) };
        let added = log.add_line(&self.log_line(exit));
        let Err(found) = added else { return Ok(exit) };
        self.show_and_keep_findings(vec![found])?;
        Ok(self.exit_without_record(exit))
    }

    /// Returns the exit code if the record of the run cannot be written. A record that is asked for must be
    /// complete. So a run without it counts as failed, unless `--on-error pass-original` is given.
    fn exit_without_record(&self, exit: i32) -> i32 {
        if exit == 0 && self.hook.on_error == OnError::Stop { REFUSED } else { exit }
    }

    fn log_line(&self, exit: i32) -> LogLine<'_, HookLogFields<'_>> {
        let more = HookLogFields { post: self.post.as_ref(), exit };
        let when = (self.time.as_str(), self.seconds);
        LogLine::from_correction("hook", when, &self.input, &self.correction, self.output.as_ref(), more)
    }

    /// Writes the JSON of the run, if it is wanted. Returns the exit code.
    fn write_json(&self, exit: i32) -> Result<CommandExit, Stop> {
        let read = self.list_read_files();
        let inputs: Vec<&Path> = read.iter().map(PathBuf::as_path).collect();
        let line = self.log_line(exit);
        let written = self
            .hook
            .json
            .write_document(&inputs, || unattended::run_to_json(Some(&line), &self.correction.findings));
        match written {
            Ok(()) => Ok(CommandExit::Posted(exit)),
            Err(Stop::Found { findings, .. }) => {
                self.hook.show_findings(&findings)?;
                Ok(CommandExit::Posted(self.exit_without_record(exit)))
            }
            Err(stop) => Err(stop),
        }
    }

    /// Renames the results of earlier runs beside the export, so that nobody takes them for results of this
    /// run.
    fn set_older_results_aside(&self) -> Vec<Diagnostic> {
        let logged =
            self.log.as_ref().map(|log| older_results::list_logged_results(log.path(), &self.input.path));
        let kept = self.hook.keep_path();
        let protected = self.list_read_files();
        let all = logged.into_iter().flatten().chain(kept);
        all.filter(|path| !protected.iter().any(|read| is_same_file(read, path)))
            .filter_map(|path| batch::set_older_output_aside(&path, &path.to_string_lossy()))
            .collect()
    }
}

impl LoggedPost {
    fn new(command: &[OsString], ended: &PostOutcome, seconds: f64) -> Self {
        let (ended, code) = match ended {
            PostOutcome::Exit(code) => ("exit", Some(*code)),
            PostOutcome::Signal(signal) => ("signal", Some(*signal)),
            PostOutcome::TimedOut => ("timed_out", None),
            PostOutcome::Stopped => ("stopped", None),
            PostOutcome::Missing(_) => ("missing", None),
            PostOutcome::NotStarted(_) => ("not_started", None),
        };
        let command = command.iter().map(|part| part.to_string_lossy().into_owned()).collect();
        Self { command, ended, code, seconds, left: Vec::new() }
    }
}

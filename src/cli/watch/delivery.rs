//! This module finishes a program after its recipe: it is written or moved aside, reported, remembered and
//! logged.

use super::folder_scan::ExportedFile;
use super::refused_programs::{RefusedMove, move_aside};
use super::watch_folders::LOCK;
use super::watch_run::{ExportStatus, WatchRun};
use crate::cli::command_exit::CommandExit;
use crate::cli::command_outputs::report_unwritable;
use crate::cli::stop::Stop;
use crate::cli::terminal::escape_controls;
use crate::cli::unattended::{LogLine, LoggedInput, LoggedOutput, UnattendedCorrection, UnattendedOutcome};
use clsmith::batch;
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::fingerprint::Digest;
use clsmith::output_files::is_same_file;
use clsmith::report::render::human;
use clsmith::source::Source;
use serde::Serialize;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// The fields that only a watch logs.
#[derive(Debug, Serialize)]
struct WatchLogFields<'r> {
    /// The path to which a refused program was moved.
    refused_to: Option<&'r str>,
}

impl WatchRun<'_> {
    /// Writes the result of a program and remembers it.
    pub(super) fn write_corrected(
        &mut self,
        export: &ExportedFile,
        digest: Digest,
        source: &Source,
        correction: UnattendedCorrection,
        when: (String, Instant),
    ) -> Result<ExportStatus, Stop> {
        let target = self.folders.out.join(&export.name);
        let print = correction.recipe.iter().flat_map(|recipe| &recipe.print.files);
        let mut inputs =
            print.map(|file| PathBuf::from(&file.path)).chain(self.watch.recipe.input_files().cloned());
        if is_same_file(&target, &export.path) || inputs.any(|input| is_same_file(&target, &input)) {
            let message = format!("writing {} would overwrite an input", target.display());
            return Err(Diagnostic::new(codes::OUTPUT_IS_INPUT, message).into());
        }
        if let Some(found) = self.find_write_conflict(export, &target) {
            return Err(found.into());
        }
        let new = Digest::from_chunks(correction.byte_chunks(source));
        // After a crash between output and state, the output exists already, and nobody must see it change.
        if Digest::from_file(&target).ok() != Some(new) {
            if let Some(folder) = target.parent()
                && let Err(error) = fs::create_dir_all(folder)
            {
                return Err(report_unwritable(folder, &error).into());
            }
            let pieces = |out: &mut dyn io::Write| {
                correction.byte_chunks(source).try_for_each(|piece| out.write_all(piece))
            };
            self.outputs.for_inputs([export.path.as_path()]).write_output(&target, pieces)?;
        }
        let name = export.name.to_string_lossy();
        if !correction.findings.is_empty() {
            self.watch.show_findings(&correction.findings, &name)?;
        }
        self.print_outcome(&name, &correction, &target);
        self.remember_done(export, digest, correction.outcome)?;
        let output = LoggedOutput { path: Some(target.to_string_lossy().into_owned()), sha256: new };
        self.add_to_log(export, digest, &correction, (Some(output), None), when)?;
        Ok(ExportStatus::Done)
    }

    /// Returns a finding if a corrected program must not be written: if its path is in the folder of refused
    /// programs, is a file of the watch itself, or leads through a link.
    fn find_write_conflict(&self, export: &ExportedFile, target: &Path) -> Option<Diagnostic> {
        let folders = self.folders;
        let kept = [Some(folders.state.as_path()), self.watch.log.as_deref(), self.watch.json.file()];
        let is_kept = kept.into_iter().flatten().any(|kept| is_same_file(target, kept) || target == kept);
        let is_lock = export.name.as_os_str() == LOCK;
        if is_kept || is_lock || target.starts_with(&folders.refused) {
            let message = format!(
                "writing {} would overwrite what this watch keeps: refused programs, state, log or lock",
                target.display()
            );
            return Some(Diagnostic::new(codes::OUTPUT_IS_INPUT, message));
        }
        let mut parts = export.name.ancestors().filter(|part| !part.as_os_str().is_empty());
        let link = parts.find(|part| {
            fs::symlink_metadata(folders.out.join(part)).is_ok_and(|there| there.file_type().is_symlink())
        })?;
        Some(batch::report_outside_link(&folders.out.join(link)))
    }

    /// Moves a program that cannot be corrected out of the watched folder, with its findings beside it.
    pub(super) fn move_refused(
        &mut self,
        export: &ExportedFile,
        digest: Digest,
        mut correction: UnattendedCorrection,
        when: (String, Instant),
    ) -> Result<ExportStatus, Stop> {
        let name = export.name.to_string_lossy();
        let mut text = Vec::new();
        human::render_human(
            &mut text,
            &correction.findings,
            Some(&name),
            &human::HumanRenderOptions::default(),
        )?;
        let text = String::from_utf8_lossy(&text);
        let moved = move_aside(export, digest, &text, &self.folders.refused)?;
        let (to, stays) = match moved {
            RefusedMove::Changed => return Ok(ExportStatus::Settling(Instant::now())),
            RefusedMove::To(to) => (to, None),
            RefusedMove::Copied(to, found) => (to, Some(found)),
        };
        self.worst = self.worst.max(CommandExit::Errors);
        self.watch.show_findings(&correction.findings, &name)?;
        eprintln!("{}: refused -> {}", escape_controls(&name), escape_controls(&to.to_string_lossy()));
        let older = self.folders.out.join(&export.name);
        // Somebody might take the older output for the result of this export, and machine a part with it.
        if self.find_write_conflict(export, &older).is_none()
            && let Some(found) = batch::set_older_output_aside(&older, &older.to_string_lossy())
        {
            self.watch.show_findings(std::slice::from_ref(&found), &name)?;
            correction.findings.push(found);
        }
        if let Some(found) = stays {
            self.watch.show_findings(std::slice::from_ref(&*found), &name)?;
            correction.findings.push(*found);
            // The program stays among the exports, and must not be refused again and again.
            self.remember_done(export, digest, UnattendedOutcome::Refused)?;
        }
        let to = to.to_string_lossy().into_owned();
        self.add_to_log(export, digest, &correction, (None, Some(&to)), when)?;
        Ok(ExportStatus::Done)
    }

    fn print_outcome(&self, name: &str, correction: &UnattendedCorrection, target: &Path) {
        if self.watch.progress.quiet {
            return;
        }
        let what = match (correction.outcome, &correction.recipe) {
            (UnattendedOutcome::Corrected, Some(recipe)) => {
                format!("corrected by {} ({})", recipe.path, recipe.chosen_by)
            }
            (UnattendedOutcome::Unchanged, Some(recipe)) => {
                format!("nothing to change for {} ({})", recipe.path, recipe.chosen_by)
            }
            _ => "no rule matches, passed unchanged".to_owned(),
        };
        eprintln!("{}: {what} -> {}", escape_controls(name), escape_controls(&target.to_string_lossy()));
    }

    fn remember_done(
        &mut self,
        export: &ExportedFile,
        digest: Digest,
        outcome: UnattendedOutcome,
    ) -> io::Result<()> {
        match self.state.remember_program(&export.name, digest, outcome) {
            Ok(()) => Ok(()),
            Err(found) => self.tell_once(found),
        }
    }

    fn add_to_log(
        &mut self,
        export: &ExportedFile,
        digest: Digest,
        correction: &UnattendedCorrection,
        (output, refused_to): (Option<LoggedOutput>, Option<&str>),
        (time, started): (String, Instant),
    ) -> io::Result<()> {
        let path = export.path.to_string_lossy().into_owned();
        let input = LoggedInput { path, sha256: Some(digest) };
        let more = WatchLogFields { refused_to };
        let record = LogLine::from_correction(
            "watch",
            (&time, started.elapsed().as_secs_f64()),
            &input,
            correction,
            output.as_ref(),
            more,
        );
        let lost = self.log.as_mut().and_then(|log| log.add_line(&record).err());
        self.add_json(Some(&record), &correction.findings)?;
        lost.map_or(Ok(()), |found| self.tell_once(found))
    }
}

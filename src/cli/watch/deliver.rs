//! What a watch does with a program once its recipe is through: write it or move it aside, tell, remember, log.

use super::folders::LOCK;
use super::look::Export;
use super::refused::{Moved, aside};
use super::run::{Status, Taken, Watching};
use crate::cli::exit::Exit;
use crate::cli::output::unwritable;
use crate::cli::shop::{Correction, InputRecord, Outcome, OutputRecord, Record};
use crate::cli::terminal::plain;
use clsmith::batch;
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::fingerprint::Digest;
use clsmith::report::render::human;
use clsmith::source::Source;
use clsmith::write::same_file;
use serde::Serialize;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// What only the lines of a watch say.
#[derive(Debug, Serialize)]
struct More<'r> {
    /// Where a refused program is now.
    refused_to: Option<&'r str>,
}

impl Watching<'_> {
    /// Writes what came of a program and remembers it.
    pub fn write(
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
        if let Some(found) = self.must_not(export, &target) {
            return Ok(Err(vec![found]));
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

    /// Why a corrected program must not be written: where refused ones lie, over what the watch keeps, or through a link.
    fn must_not(&self, export: &Export, target: &Path) -> Option<Diagnostic> {
        let folders = self.folders;
        let kept = [Some(&folders.state), self.watch.log.as_ref()];
        let is_kept = kept.into_iter().flatten().any(|kept| same_file(target, kept) || target == kept);
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
        Some(batch::outside(&folders.out.join(link)))
    }

    /// Moves a program that cannot be corrected aside.
    pub fn refuse(
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
        let before = self.folders.out.join(&export.name);
        if before.is_file() {
            let before = before.to_string_lossy();
            eprintln!("{}: {} is of an earlier export", plain(&name), plain(&before));
        }
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
}

//! This module holds the private folder in which the post finds the program and leaves its outputs.
//!
//! The program keeps the name of its file, because many posts derive the names of their outputs from it and
//! write them beside it. When the post has ended, its outputs are moved to where they would have been without
//! the hook: beside the export.

use crate::cli::command_outputs::report_unwritable;
use clsmith::diagnostic::{Diagnostic, Failure, codes};
use clsmith::output_files::{Interrupt, OutputAccess, TemporaryFiles, WriteError, is_same_file};
use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};
use tempfile::TempDir;

/// How the names of private folders begin.
const PREFIX: &str = "clsmith-hook-";

/// The private folder. It is removed when this value is dropped.
pub(super) struct PostWorkspace {
    folder: TempDir,
    file: PathBuf,
}

impl PostWorkspace {
    /// Makes a folder that only this user can read, with one file in it.
    ///
    /// # Errors
    /// Returns a finding if the folder or the file cannot be written.
    pub(super) fn create_with_program<'b>(
        name: &OsStr,
        pieces: impl Iterator<Item = &'b [u8]>,
    ) -> Result<Self, Failure> {
        remove_abandoned_folders();
        let mut builder = tempfile::Builder::new();
        builder.prefix(PREFIX);
        #[cfg(unix)]
        {
            use std::os::unix::fs::PermissionsExt;
            // Programs are confidential. By default, the umask would decide who may read them.
            builder.permissions(fs::Permissions::from_mode(0o700));
        }
        let folder = builder.tempdir().map_err(|error| {
            let message = format!("the private folder for the post cannot be made: {error}");
            Diagnostic::new(codes::UNWRITABLE, message)
        })?;
        let file = folder.path().join(name);
        let fill = || {
            let mut out = io::BufWriter::new(File::create_new(&file)?);
            for piece in pieces {
                out.write_all(piece)?;
            }
            out.flush()
        };
        fill().map_err(|error| report_unwritable(&file, &error))?;
        Ok(Self { folder, file })
    }

    /// Returns the path of the program for the post.
    pub(super) fn program_path(&self) -> &Path {
        &self.file
    }

    /// Copies what the post left beside the program into a folder. It replaces outputs of earlier runs, but
    /// no protected file. Whoever may not read the `export` may not read the copies. Returns the paths of the
    /// copies, and findings about what could not be copied.
    pub(super) fn copy_post_outputs(
        &self,
        to: &Path,
        export: &Path,
        protected: &[PathBuf],
        interrupt: &Interrupt,
    ) -> (Vec<PathBuf>, Vec<Diagnostic>) {
        let (mut put, mut found) = (Vec::new(), Vec::new());
        let (left, others) = match self.list_post_outputs() {
            Ok(left) => left,
            Err(error) => {
                let message = format!("what the post left cannot be read: {error}");
                return (put, vec![Diagnostic::new(codes::UNREADABLE, message)]);
            }
        };
        for other in others {
            let message = format!("the post left {}, which is no file and is thrown away", other.display());
            found.push(Diagnostic::new(codes::UNREADABLE, message));
        }
        for from in left {
            let Ok(name) = from.strip_prefix(self.folder.path()) else { continue };
            let target = to.join(name);
            if let Some(input) = protected.iter().find(|input| is_same_file(input, &target)) {
                let message = format!("the post's {} would overwrite {}", name.display(), input.display());
                found.push(Diagnostic::new(codes::OUTPUT_IS_INPUT, message));
                continue;
            }
            if let Some(outside) = refuse_link_out(to, name) {
                found.push(outside);
                continue;
            }
            match copy_file(&from, &target, OutputAccess::of_inputs([export, from.as_path()]), interrupt) {
                Ok(()) => put.push(target),
                // An interruption is reported as well, because the post has ended and one of its outputs is
                // missing.
                Err(WriteError::Interrupted) => {
                    found.push(report_unwritable(&target, &io::Error::other(WriteError::Interrupted)));
                }
                Err(WriteError::Io(error)) => found.push(report_unwritable(&target, &error)),
            }
        }
        (put, found)
    }

    /// Returns the files in the folder besides the program in order, and entries that are neither file nor
    /// folder. Links are not followed.
    fn list_post_outputs(&self) -> io::Result<(Vec<PathBuf>, Vec<PathBuf>)> {
        let (mut left, mut others) = (Vec::new(), Vec::new());
        let mut folders = vec![self.folder.path().to_path_buf()];
        while let Some(folder) = folders.pop() {
            for entry in fs::read_dir(folder)? {
                let entry = entry?;
                let kind = entry.file_type()?;
                if kind.is_dir() {
                    folders.push(entry.path());
                } else if !kind.is_file() {
                    others.push(entry.path());
                } else if entry.path() != self.file {
                    left.push(entry.path());
                }
            }
        }
        left.sort();
        others.sort();
        Ok((left, others))
    }

    /// Removes the folder.
    ///
    /// # Errors
    /// Returns a finding if it cannot be removed.
    pub(super) fn remove_folder(self) -> Result<(), Diagnostic> {
        let path = self.folder.path().to_path_buf();
        self.folder.close().map_err(|error| {
            let message = format!("{} cannot be taken away: {error}", path.display());
            Diagnostic::new(codes::UNWRITABLE, message)
        })
    }
}

fn copy_file(from: &Path, to: &Path, access: OutputAccess, interrupt: &Interrupt) -> Result<(), WriteError> {
    if let Some(folder) = to.parent().filter(|folder| !folder.as_os_str().is_empty()) {
        fs::create_dir_all(folder)?;
    }
    let mut file = File::open(from)?;
    let temporaries = TemporaryFiles::default().with_access(access);
    temporaries.write_file(to, interrupt, |out| io::copy(&mut file, out).map(drop))
}

/// Returns a finding if a link on the way to `name` in `folder` leads out of the folder. Nobody who writes a
/// file beside an export expects that a file elsewhere changes.
pub(super) fn refuse_link_out(folder: &Path, name: &Path) -> Option<Diagnostic> {
    let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
    // A folder that does not exist yet contains no link.
    let root = fs::canonicalize(folder).ok()?;
    let mut parts =
        name.ancestors().filter(|part| !part.as_os_str().is_empty()).map(|part| folder.join(part));
    let link = parts.find(|path| {
        fs::symlink_metadata(path).is_ok_and(|there| there.is_symlink())
            && !fs::canonicalize(path).is_ok_and(|real| real.starts_with(&root))
    })?;
    let message =
        format!("{} is a link that leads out of {}, and is not followed", link.display(), folder.display());
    Some(Diagnostic::new(codes::OUTSIDE_OUTPUT, message))
}

/// A private folder of this age was left behind by a killed hook, because no post runs for a day.
const ABANDONED: Duration = Duration::from_secs(24 * 60 * 60);

/// Removes private folders that killed hooks left behind, because the programs in them are confidential.
fn remove_abandoned_folders() {
    let Some(oldest) = SystemTime::now().checked_sub(ABANDONED) else { return };
    let Ok(entries) = fs::read_dir(std::env::temp_dir()) else { return };
    let is_abandoned = |entry: &fs::DirEntry| {
        entry.file_name().as_encoded_bytes().starts_with(PREFIX.as_bytes())
            && entry
                .metadata()
                .is_ok_and(|there| there.is_dir() && there.modified().is_ok_and(|modified| modified < oldest))
    };
    for entry in entries.flatten().filter(is_abandoned) {
        // Folders of other users cannot be removed, which is no error.
        let _ = fs::remove_dir_all(entry.path());
    }
}

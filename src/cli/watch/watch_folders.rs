//! This module holds the folders of a watch. Outputs are outside of the watched folder, and locks ensure that
//! no other watch uses the same folders.

use super::WatchArgs;
use crate::cli::command_outputs::report_unwritable;
use clsmith::diagnostic::{Diagnostic, Failure, codes};
use std::fs::{self, File, TryLockError};
use std::path::{Path, PathBuf};

/// The name of the lock in the watched folder and in the one for corrected programs.
pub(super) const LOCK: &str = ".clsmith-watch.lock";

/// The folders, with links resolved, and locked.
pub(super) struct WatchFolders {
    /// The folder of exports, with every link followed.
    pub watched: PathBuf,
    /// The folder for corrected programs.
    pub out: PathBuf,
    /// The folder for refused programs.
    pub refused: PathBuf,
    /// The file that remembers finished programs.
    pub state: PathBuf,
    /// The locks, held as long as the watch runs. The operating system releases them however it ends.
    _locks: Vec<File>,
}

impl WatchFolders {
    /// Checks the folders, makes those for outputs, and locks them.
    ///
    /// # Errors
    /// Returns a finding if a folder cannot be read, made or locked, or if folders contain each other.
    pub(super) fn open_and_lock(watch: &WatchArgs) -> Result<Self, Failure> {
        let watched = fs::canonicalize(&watch.folder).map_err(|error| {
            let message = format!("{} cannot be read: {error}", watch.folder.display());
            Diagnostic::new(codes::UNREADABLE, message)
        })?;
        if !watched.is_dir() {
            let message = format!("{} is no folder", watch.folder.display());
            return Err(Diagnostic::new(codes::UNREADABLE, message).into());
        }
        let refused = watch.refused.clone().unwrap_or_else(|| watch.output.join("refused"));
        let state = watch.state.clone().unwrap_or_else(|| watch.output.join(".clsmith-watch.jsonl"));
        // This comes before anything is made, so a refused command line leaves no folder behind.
        let folders = [(watch.output.as_path(), true), (refused.as_path(), true)];
        let files = [Some(state.as_path()), watch.log.as_deref(), watch.json.file()];
        let files = files.into_iter().flatten().map(|file| (file, false));
        for (path, is_folder) in folders.into_iter().chain(files) {
            let real = resolve_future_path(path);
            // Outputs below the watched folder would be taken for new exports, and corrected again and again.
            if real.starts_with(&watched) || (is_folder && watched.starts_with(&real)) {
                let message = format!(
                    "{} and the watched folder {} lie in each other",
                    path.display(),
                    watched.display()
                );
                return Err(Diagnostic::new(codes::WATCHED_FOLDERS, message).into());
            }
        }
        for folder in [&watch.output, &refused] {
            fs::create_dir_all(folder).map_err(|error| report_unwritable(folder, &error))?;
        }
        let mut locks = vec![lock_folder(&watch.output)?];
        match lock_folder(&watched) {
            Ok(held) => locks.push(held),
            // A folder of exports that is write-protected cannot be locked, but the one for outputs is.
            Err(found) if found.code == codes::UNWRITABLE => {}
            Err(found) => return Err(found.into()),
        }
        Ok(Self { watched, out: watch.output.clone(), refused, state, _locks: locks })
    }
}

/// Returns where a path will lead. Links are followed as far as it exists.
fn resolve_future_path(path: &Path) -> PathBuf {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    for above in path.ancestors() {
        if let (Ok(real), Ok(rest)) = (fs::canonicalize(above), path.strip_prefix(above)) {
            return if rest.as_os_str().is_empty() { real } else { real.join(rest) };
        }
    }
    path
}

fn lock_folder(folder: &Path) -> Result<File, Diagnostic> {
    let path = folder.join(LOCK);
    let file = File::options().write(true).create(true).truncate(false).open(&path);
    let file = file.map_err(|error| report_unwritable(&path, &error))?;
    match file.try_lock() {
        Ok(()) => Ok(file),
        Err(TryLockError::WouldBlock) => {
            let message = format!("another watch is at work in {}", folder.display());
            Err(Diagnostic::new(codes::WATCHED_ALREADY, message))
        }
        Err(TryLockError::Error(error)) => Err(report_unwritable(&path, &error)),
    }
}

//! This module lists the files of a folder and their state.

use super::watch_folders::LOCK;
use clsmith::diagnostic::{Diagnostic, codes};
use globset::GlobMatcher;
use std::fs::{self, DirEntry, Metadata};
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// An exported file in the watched folder.
pub(super) struct ExportedFile {
    /// Its path below the watched folder. Names are bytes, not text.
    pub name: PathBuf,
    /// Where it is.
    pub path: PathBuf,
    /// Its state.
    pub stamp: ExportStamp,
}

/// The state of a file. If two are equal, nobody has written to the file between them.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct ExportStamp {
    /// The size in bytes.
    pub size: u64,
    modified: Option<SystemTime>,
    // A copy may keep the time of its original, but never that of its own directory entry.
    #[cfg(unix)]
    entry: (u64, i64, i64),
}

impl ExportStamp {
    /// Reads the current state of a file.
    pub(super) fn read_stamp(path: &Path) -> io::Result<Self> {
        fs::metadata(path).map(|metadata| Self::from(&metadata))
    }
}

impl From<&Metadata> for ExportStamp {
    fn from(metadata: &Metadata) -> Self {
        #[cfg(unix)]
        let entry = {
            use std::os::unix::fs::MetadataExt;
            (metadata.ino(), metadata.ctime(), metadata.ctime_nsec())
        };
        Self {
            size: metadata.len(),
            modified: metadata.modified().ok(),
            #[cfg(unix)]
            entry,
        }
    }
}

/// Returns all files in a folder that match a pattern, in the order of their names, and findings about
/// entries that cannot be read or must not be followed.
pub(super) fn scan_exports(watched: &Path, glob: &GlobMatcher) -> (Vec<ExportedFile>, Vec<Diagnostic>) {
    let (mut found, mut faults) = (Vec::new(), Vec::new());
    // A pattern without a slash or two stars can only match the folder's own files.
    let pattern = glob.glob().glob();
    let is_deep = pattern.contains('/') || pattern.contains("**");
    let mut folders = vec![watched.to_path_buf()];
    while let Some(folder) = folders.pop() {
        let entries = fs::read_dir(&folder).and_then(|entries| entries.collect::<io::Result<Vec<_>>>());
        let entries = match entries {
            Ok(entries) => entries,
            Err(error) => {
                faults.push(report_unreadable(&folder, &error));
                continue;
            }
        };
        for entry in entries {
            match classify_entry(watched, glob, &entry) {
                Ok(Some(WatchedEntry::Folder)) if is_deep => folders.push(entry.path()),
                Ok(Some(WatchedEntry::Export(export))) => found.push(export),
                Ok(_) => {}
                Err(fault) => faults.push(fault),
            }
        }
    }
    // The order in a folder depends on its file system. In the order of names every watch does the same, and
    // a name is found by bisection.
    found.sort_by(|a, b| a.name.cmp(&b.name));
    (found, faults)
}

enum WatchedEntry {
    Folder,
    Export(ExportedFile),
}

fn classify_entry(
    watched: &Path,
    glob: &GlobMatcher,
    entry: &DirEntry,
) -> Result<Option<WatchedEntry>, Diagnostic> {
    let path = entry.path();
    let failed = |error: io::Error| match error.kind() {
        // It was removed since the folder was read.
        io::ErrorKind::NotFound => None,
        _ => Some(report_unreadable(&path, &error)),
    };
    let kind = match entry.file_type() {
        Ok(kind) => kind,
        Err(error) => return failed(error).map_or(Ok(None), Err),
    };
    if kind.is_dir() {
        return Ok(Some(WatchedEntry::Folder));
    }
    let Ok(name) = path.strip_prefix(watched).map(Path::to_path_buf) else { return Ok(None) };
    if !glob.is_match(&name) || entry.file_name() == LOCK {
        return Ok(None);
    }
    if kind.is_symlink() && fs::canonicalize(&path).is_ok_and(|real| !real.starts_with(watched)) {
        let message = format!("{} leads out of the watched folder and is left alone", name.display());
        return Err(Diagnostic::new(codes::LEAVES_FOLDER, message));
    }
    match fs::metadata(&path) {
        Ok(metadata) if metadata.is_file() => {
            let stamp = ExportStamp::from(&metadata);
            Ok(Some(WatchedEntry::Export(ExportedFile { name, path, stamp })))
        }
        Ok(metadata) if metadata.is_dir() => Ok(None),
        // Reading a pipe would wait for ever.
        Ok(_) => {
            let message = format!("{} is no file (a pipe or device) and is left alone", name.display());
            Err(Diagnostic::new(codes::UNREADABLE, message))
        }
        Err(error) => failed(error).map_or(Ok(None), Err),
    }
}

/// Reports a file or folder that cannot be read.
pub(super) fn report_unreadable(path: &Path, error: &io::Error) -> Diagnostic {
    Diagnostic::new(codes::UNREADABLE, format!("{} cannot be read: {error}", path.display()))
}

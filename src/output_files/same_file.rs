//! This module decides whether two paths lead to the same file.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// Returns whether writing to one path would change what the other one reads.
///
/// Paths are compared after all links have been followed; on Unix two hard links to one file are recognized
/// too. A file that does not exist yet is identified by its folder and name, so two outputs with the same
/// name are found before either is written.
pub fn is_same_file(a: &Path, b: &Path) -> bool {
    match (real_path(a), real_path(b)) {
        (Some(real_a), Some(real_b)) if real_a == real_b => true,
        _ => has_same_inode(a, b),
    }
}

/// A set of files, to test [`is_same_file`] with any of them.
#[derive(Debug, Clone, Default)]
pub(crate) struct FileSet {
    paths: BTreeSet<PathBuf>,
    inodes: BTreeSet<(u64, u64)>,
}

impl FileSet {
    /// Adds a file, which need not exist yet.
    pub(crate) fn insert(&mut self, path: &Path) {
        self.paths.extend(real_path(path));
        self.inodes.extend(file_inode(path));
    }

    /// Returns whether writing to a path would change one of the files.
    pub(crate) fn contains(&self, path: &Path) -> bool {
        real_path(path).is_some_and(|path| self.paths.contains(&path))
            || file_inode(path).is_some_and(|inode| self.inodes.contains(&inode))
    }
}

/// Returns a path without links. The file need not exist, but its folder must.
fn real_path(path: &Path) -> Option<PathBuf> {
    if let Ok(path) = fs::canonicalize(path) {
        return Some(path);
    }
    let path = super::atomic_write::follow_links(path).ok()?;
    let folder = fs::canonicalize(super::atomic_write::parent_folder(&path)).ok()?;
    Some(folder.join(path.file_name()?))
}

/// Returns whether both paths are hard links to the same file.
fn has_same_inode(a: &Path, b: &Path) -> bool {
    file_inode(a).is_some_and(|a| file_inode(b) == Some(a))
}

#[cfg(unix)]
fn file_inode(path: &Path) -> Option<(u64, u64)> {
    use std::os::unix::fs::MetadataExt;
    fs::metadata(path).ok().map(|there| (there.dev(), there.ino()))
}

#[cfg(not(unix))]
fn file_inode(_: &Path) -> Option<(u64, u64)> {
    None
}

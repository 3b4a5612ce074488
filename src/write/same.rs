//! Whether two paths lead to one file.

use std::fs;
use std::path::{Path, PathBuf};

/// Whether writing to one path would change what the other reads.
///
/// Paths are compared after following every link; on Unix two hard links to one file are recognized too. A file that does
/// not exist yet is known by its folder and name, so two outputs of one name are found before either is written.
pub fn same_file(a: &Path, b: &Path) -> bool {
    match (real(a), real(b)) {
        (Some(real_a), Some(real_b)) if real_a == real_b => true,
        _ => same_inode(a, b),
    }
}

fn real(path: &Path) -> Option<PathBuf> {
    if let Ok(path) = fs::canonicalize(path) {
        return Some(path);
    }
    let path = super::atomic::follow_links(path).ok()?;
    let folder = fs::canonicalize(super::atomic::folder_of(&path)).ok()?;
    Some(folder.join(path.file_name()?))
}

#[cfg(unix)]
fn same_inode(a: &Path, b: &Path) -> bool {
    use std::os::unix::fs::MetadataExt;
    match (fs::metadata(a), fs::metadata(b)) {
        (Ok(a), Ok(b)) => a.dev() == b.dev() && a.ino() == b.ino(),
        _ => false,
    }
}

#[cfg(not(unix))]
fn same_inode(_: &Path, _: &Path) -> bool {
    false
}

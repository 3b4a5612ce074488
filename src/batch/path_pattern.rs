//! This module expands patterns for files: `programs/**/*.cls`.
//!
//! They are expanded here and not by a shell. So the result is the same on every system, the length of
//! command lines does not matter, and the folders below the pattern's fixed part can be kept. globset matches
//! bytes, so names need not be UTF-8.

use globset::{GlobBuilder, GlobMatcher};
use std::ffi::OsStr;
use std::io;
use std::path::{Component, Path, PathBuf};
use walkdir::WalkDir;

/// The matches of a pattern.
#[derive(Debug, Default)]
pub(super) struct PatternMatches {
    pub files: Vec<MatchedFile>,
    /// Links that lead back to a folder above them, with that folder.
    pub loops: Vec<(PathBuf, PathBuf)>,
}

/// A file that matches a pattern.
#[derive(Debug)]
pub(super) struct MatchedFile {
    /// Its path, which begins like the pattern.
    pub path: PathBuf,
    /// Its path below the pattern's fixed part.
    pub below: PathBuf,
}

/// The reason why a pattern matches nothing.
#[derive(Debug)]
pub(super) enum NoMatchReason {
    /// It is no pattern.
    Bad(PathPatternError),
    /// Nothing matches it.
    Nothing,
    /// It is a folder.
    Folder,
    /// A folder cannot be read.
    Unreadable(PathBuf, io::Error),
}

/// The reason why a text is no pattern.
#[derive(Debug, thiserror::Error)]
pub(super) enum PathPatternError {
    /// The path goes back after a wildcard.
    #[error("`.` and `..` may only stand in front of the first wildcard")]
    DotsAfterWildcard,
    /// The wildcards are not valid.
    #[error("{}", .0.kind())]
    Glob(#[from] globset::Error),
}

/// Returns the files that match a pattern, relative to the folder `base`. The folder `not_in` is skipped.
///
/// If a file has the pattern itself as its name, the pattern is that file, whatever characters it contains.
/// `*` and `?` stay within a folder, and `**` goes through all folders below. Hidden files and folders are
/// only found if the pattern names their dot. Links are followed, except in a circle.
pub(super) fn find_files(
    base: &Path,
    written: &OsStr,
    not_in: Option<&Path>,
) -> Result<PatternMatches, NoMatchReason> {
    let whole = base.join(written);
    if let Ok(there) = std::fs::symlink_metadata(&whole) {
        if there.is_dir() || whole.is_dir() {
            return Err(NoMatchReason::Folder);
        }
        let below = whole.file_name().map(PathBuf::from).unwrap_or_default();
        return Ok(PatternMatches {
            files: vec![MatchedFile { path: written.into(), below }],
            loops: Vec::new(),
        });
    }
    let text = written.to_str().ok_or(NoMatchReason::Nothing)?;
    let (fixed, rest) = split_at_wildcard(text);
    if rest.is_empty() {
        return Err(NoMatchReason::Nothing);
    }
    let pattern = PathPattern::new(rest).map_err(NoMatchReason::Bad)?;
    // Taking the components removes the separator at the end.
    let fixed: PathBuf = Path::new(fixed).components().collect();
    let root: PathBuf = base.join(&fixed).components().collect();
    let found = walk_folder(&root, &fixed, &pattern, not_in)?;
    if found.files.is_empty() { Err(NoMatchReason::Nothing) } else { Ok(found) }
}

/// Returns the folders before the first wildcard, and the rest.
fn split_at_wildcard(text: &str) -> (&str, &str) {
    let Some(wild) = text.find(['*', '?', '[', '{']) else { return (text, "") };
    let start = text.get(..wild).and_then(|head| head.rfind(std::path::is_separator)).map_or(0, |at| at + 1);
    text.split_at_checked(start).unwrap_or(("", text))
}

struct PathPattern {
    whole: GlobMatcher,
    /// The parts of the pattern that begin with a dot.
    hidden: Vec<GlobMatcher>,
    depth: usize,
}

impl PathPattern {
    fn new(text: &str) -> Result<Self, PathPatternError> {
        let glob = |text: &str| {
            GlobBuilder::new(text).literal_separator(true).build().map(|glob| glob.compile_matcher())
        };
        let parts: Vec<&str> = text.split(std::path::is_separator).collect();
        if parts.contains(&"..") || parts.contains(&".") {
            return Err(PathPatternError::DotsAfterWildcard);
        }
        let whole = glob(text)?;
        let hidden =
            parts.iter().filter(|part| part.starts_with('.')).filter_map(|part| glob(part).ok()).collect();
        let depth = if text.contains("**") { usize::MAX } else { parts.len() };
        Ok(Self { whole, hidden, depth })
    }

    /// Returns whether the pattern names every hidden part of a path.
    fn allows_hidden(&self, below: &Path) -> bool {
        below.components().all(|part| match part {
            Component::Normal(name) if name.as_encoded_bytes().starts_with(b".") => {
                self.hidden.iter().any(|hidden| hidden.is_match(name))
            }
            _ => true,
        })
    }

    fn matches_path(&self, below: &Path) -> bool {
        self.allows_hidden(below) && self.whole.is_match(below)
    }
}

fn walk_folder(
    root: &Path,
    fixed: &Path,
    pattern: &PathPattern,
    not_in: Option<&Path>,
) -> Result<PatternMatches, NoMatchReason> {
    // The paths of the walk begin with this.
    let root = if root.as_os_str().is_empty() { Path::new(".") } else { root };
    let mut found = PatternMatches::default();
    let walk = WalkDir::new(root).follow_links(true).min_depth(1).max_depth(pattern.depth);
    let is_searched = |entry: &walkdir::DirEntry| {
        let Ok(below) = entry.path().strip_prefix(root) else { return true };
        let is_output = || {
            not_in.is_some_and(|folder| std::fs::canonicalize(entry.path()).is_ok_and(|path| path == folder))
        };
        pattern.allows_hidden(below) && !(entry.file_type().is_dir() && is_output())
    };
    for entry in walk.into_iter().filter_entry(is_searched) {
        let path = match &entry {
            Ok(entry) if entry.file_type().is_dir() => continue,
            Ok(entry) => entry.path(),
            Err(error) => match classify_walk_error(error, root, pattern)? {
                WalkFailure::Loop(link, folder) => {
                    found.loops.push((link, folder));
                    continue;
                }
                WalkFailure::Passed => continue,
                WalkFailure::File(path) => path,
            },
        };
        let Ok(below) = path.strip_prefix(root) else { continue };
        if pattern.matches_path(below) {
            found.files.push(MatchedFile { path: fixed.join(below), below: below.to_path_buf() });
        }
    }
    Ok(found)
}

enum WalkFailure<'e> {
    Loop(PathBuf, PathBuf),
    /// A link without a target. Reading it will report the error.
    File(&'e Path),
    /// An entry that does not matter.
    Passed,
}

fn classify_walk_error<'e>(
    error: &'e walkdir::Error,
    root: &Path,
    pattern: &PathPattern,
) -> Result<WalkFailure<'e>, NoMatchReason> {
    let Some(path) = error.path() else { return Ok(WalkFailure::Passed) };
    let below = path.strip_prefix(root).unwrap_or(path);
    if !pattern.allows_hidden(below) {
        return Ok(WalkFailure::Passed);
    }
    if let Some(folder) = error.loop_ancestor() {
        return Ok(WalkFailure::Loop(path.to_path_buf(), folder.to_path_buf()));
    }
    if std::fs::symlink_metadata(path).is_ok_and(|there| there.is_symlink()) {
        return Ok(WalkFailure::File(path));
    }
    match error.io_error().map(|error| io::Error::new(error.kind(), error.to_string())) {
        // This is the fixed part, or a folder that was removed meanwhile.
        Some(error) if error.kind() == io::ErrorKind::NotFound => Ok(WalkFailure::Passed),
        Some(error) if matches!(error.kind(), io::ErrorKind::NotADirectory) => Ok(WalkFailure::Passed),
        Some(error) => Err(NoMatchReason::Unreadable(path.to_path_buf(), error)),
        None => Ok(WalkFailure::Passed),
    }
}

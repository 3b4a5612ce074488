//! Patterns for files: `programs/**/*.cls`.
//!
//! Expanded here and not by a shell, so that it is the same on every system, the length of command lines is no limit, and
//! the folders below the pattern's fixed part can be kept. globset matches bytes, so names need not be UTF-8.

use globset::{GlobBuilder, GlobMatcher};
use std::ffi::OsStr;
use std::io;
use std::path::{Component, Path, PathBuf};
use walkdir::WalkDir;

/// What a pattern led to.
#[derive(Debug, Default)]
pub(super) struct PatternMatches {
    pub files: Vec<MatchedFile>,
    /// Links that lead back to a folder they are in, and that folder.
    pub loops: Vec<(PathBuf, PathBuf)>,
}

/// A file that a pattern fits.
#[derive(Debug)]
pub(super) struct MatchedFile {
    /// Its path, as the pattern begins.
    pub path: PathBuf,
    /// Its path below the pattern's fixed part.
    pub below: PathBuf,
}

/// Why a pattern leads to nothing.
#[derive(Debug)]
pub(super) enum NoMatchReason {
    /// It is no pattern.
    Bad(PathPatternError),
    /// Nothing fits it.
    Nothing,
    /// It is a folder.
    Folder,
    /// A folder cannot be looked into.
    Unreadable(PathBuf, io::Error),
}

/// Why a text is no pattern.
#[derive(Debug, thiserror::Error)]
pub(super) enum PathPatternError {
    /// The path goes back behind a wildcard.
    #[error("`.` and `..` may only stand in front of the first wildcard")]
    DotsAfterWildcard,
    /// The wildcards are written wrongly.
    #[error("{}", .0.kind())]
    Glob(#[from] globset::Error),
}

/// The files that a pattern fits, seen from the folder `base`; the folder `not_in` is not looked into.
///
/// What exists under the pattern's own name is that file, whatever characters it has. `*` and `?` stay within a folder, `**`
/// goes through all below; hidden files and folders are found where the pattern names their dot. Links are followed, except
/// in a circle.
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
    // By its parts: without the separator at its end.
    let fixed: PathBuf = Path::new(fixed).components().collect();
    let root: PathBuf = base.join(&fixed).components().collect();
    let found = walk_folder(&root, &fixed, &pattern, not_in)?;
    if found.files.is_empty() { Err(NoMatchReason::Nothing) } else { Ok(found) }
}

/// The folders in front of the first wildcard, and the rest.
fn split_at_wildcard(text: &str) -> (&str, &str) {
    let Some(wild) = text.find(['*', '?', '[', '{']) else { return (text, "") };
    let start = text.get(..wild).and_then(|head| head.rfind(std::path::is_separator)).map_or(0, |at| at + 1);
    text.split_at_checked(start).unwrap_or(("", text))
}

struct PathPattern {
    whole: GlobMatcher,
    /// Parts of the pattern that begin with a dot.
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

    /// Whether every hidden part of a path is one that the pattern names.
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
    // The walk's own paths begin with this.
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
    /// A link to nothing: reading it will say so.
    File(&'e Path),
    /// Nothing of ours.
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
        // The fixed part, or a folder that went away meanwhile.
        Some(error) if error.kind() == io::ErrorKind::NotFound => Ok(WalkFailure::Passed),
        Some(error) if matches!(error.kind(), io::ErrorKind::NotADirectory) => Ok(WalkFailure::Passed),
        Some(error) => Err(NoMatchReason::Unreadable(path.to_path_buf(), error)),
        None => Ok(WalkFailure::Passed),
    }
}

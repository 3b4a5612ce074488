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
pub(super) struct Matches {
    pub files: Vec<Match>,
    /// Links that lead back to a folder they are in, and that folder.
    pub loops: Vec<(PathBuf, PathBuf)>,
}

/// A file that a pattern fits.
#[derive(Debug)]
pub(super) struct Match {
    /// Its path, as the pattern begins.
    pub path: PathBuf,
    /// Its path below the pattern's fixed part.
    pub below: PathBuf,
}

/// Why a pattern leads to nothing.
#[derive(Debug)]
pub(super) enum NoMatch {
    /// It is no pattern: why.
    Bad(String),
    /// Nothing fits it.
    Nothing,
    /// It is a folder.
    Folder,
    /// A folder cannot be looked into.
    Unreadable(PathBuf, io::Error),
}

/// The files that a pattern fits, seen from the folder `base`; the folder `not_in` is not looked into.
///
/// What exists under the pattern's own name is that file, whatever characters it has. `*` and `?` stay within a folder, `**`
/// goes through all below; hidden files and folders are found where the pattern names their dot. Links are followed, except
/// in a circle.
pub(super) fn find(base: &Path, written: &OsStr, not_in: Option<&Path>) -> Result<Matches, NoMatch> {
    let whole = base.join(written);
    if let Ok(there) = std::fs::symlink_metadata(&whole) {
        if there.is_dir() || whole.is_dir() {
            return Err(NoMatch::Folder);
        }
        let below = whole.file_name().map(PathBuf::from).unwrap_or_default();
        return Ok(Matches { files: vec![Match { path: written.into(), below }], loops: Vec::new() });
    }
    let text = written.to_str().ok_or(NoMatch::Nothing)?;
    let (fixed, rest) = split(text);
    if rest.is_empty() {
        return Err(NoMatch::Nothing);
    }
    let pattern = Pattern::new(rest).map_err(NoMatch::Bad)?;
    // By its parts: without the separator at its end.
    let fixed: PathBuf = Path::new(fixed).components().collect();
    let root: PathBuf = base.join(&fixed).components().collect();
    let found = walk(&root, &fixed, &pattern, not_in)?;
    if found.files.is_empty() { Err(NoMatch::Nothing) } else { Ok(found) }
}

/// The folders in front of the first wildcard, and the rest.
fn split(text: &str) -> (&str, &str) {
    let Some(wild) = text.find(['*', '?', '[', '{']) else { return (text, "") };
    let start = text.get(..wild).and_then(|head| head.rfind(std::path::is_separator)).map_or(0, |at| at + 1);
    text.split_at_checked(start).unwrap_or(("", text))
}

struct Pattern {
    whole: GlobMatcher,
    /// Parts of the pattern that begin with a dot.
    hidden: Vec<GlobMatcher>,
    depth: usize,
}

impl Pattern {
    fn new(text: &str) -> Result<Self, String> {
        let glob = |text: &str| {
            GlobBuilder::new(text).literal_separator(true).build().map(|glob| glob.compile_matcher())
        };
        let parts: Vec<&str> = text.split(std::path::is_separator).collect();
        if parts.contains(&"..") || parts.contains(&".") {
            return Err("`.` and `..` may only stand in front of the first wildcard".into());
        }
        let whole = glob(text).map_err(|error| error.kind().to_string())?;
        let hidden =
            parts.iter().filter(|part| part.starts_with('.')).filter_map(|part| glob(part).ok()).collect();
        let depth = if text.contains("**") { usize::MAX } else { parts.len() };
        Ok(Self { whole, hidden, depth })
    }

    /// Whether every hidden part of a path is one that the pattern names.
    fn allows(&self, below: &Path) -> bool {
        below.components().all(|part| match part {
            Component::Normal(name) if name.as_encoded_bytes().starts_with(b".") => {
                self.hidden.iter().any(|hidden| hidden.is_match(name))
            }
            _ => true,
        })
    }

    fn fits(&self, below: &Path) -> bool {
        self.allows(below) && self.whole.is_match(below)
    }
}

fn walk(root: &Path, fixed: &Path, pattern: &Pattern, not_in: Option<&Path>) -> Result<Matches, NoMatch> {
    // The walk's own paths begin with this.
    let root = if root.as_os_str().is_empty() { Path::new(".") } else { root };
    let mut found = Matches::default();
    let walk = WalkDir::new(root).follow_links(true).min_depth(1).max_depth(pattern.depth);
    let is_searched = |entry: &walkdir::DirEntry| {
        let Ok(below) = entry.path().strip_prefix(root) else { return true };
        let is_output = || {
            not_in.is_some_and(|folder| std::fs::canonicalize(entry.path()).is_ok_and(|path| path == folder))
        };
        pattern.allows(below) && !(entry.file_type().is_dir() && is_output())
    };
    for entry in walk.into_iter().filter_entry(is_searched) {
        let path = match &entry {
            Ok(entry) if entry.file_type().is_dir() => continue,
            Ok(entry) => entry.path(),
            Err(error) => match failed(error, root, pattern)? {
                Failed::Loop(link, folder) => {
                    found.loops.push((link, folder));
                    continue;
                }
                Failed::Passed => continue,
                Failed::File(path) => path,
            },
        };
        let Ok(below) = path.strip_prefix(root) else { continue };
        if pattern.fits(below) {
            found.files.push(Match { path: fixed.join(below), below: below.to_path_buf() });
        }
    }
    Ok(found)
}

enum Failed<'e> {
    Loop(PathBuf, PathBuf),
    /// A link to nothing: reading it will say so.
    File(&'e Path),
    /// Nothing of ours.
    Passed,
}

fn failed<'e>(error: &'e walkdir::Error, root: &Path, pattern: &Pattern) -> Result<Failed<'e>, NoMatch> {
    let Some(path) = error.path() else { return Ok(Failed::Passed) };
    let below = path.strip_prefix(root).unwrap_or(path);
    if !pattern.allows(below) {
        return Ok(Failed::Passed);
    }
    if let Some(folder) = error.loop_ancestor() {
        return Ok(Failed::Loop(path.to_path_buf(), folder.to_path_buf()));
    }
    if std::fs::symlink_metadata(path).is_ok_and(|there| there.is_symlink()) {
        return Ok(Failed::File(path));
    }
    match error.io_error().map(|error| io::Error::new(error.kind(), error.to_string())) {
        // The fixed part, or a folder that went away meanwhile.
        Some(error) if error.kind() == io::ErrorKind::NotFound => Ok(Failed::Passed),
        Some(error) if matches!(error.kind(), io::ErrorKind::NotADirectory) => Ok(Failed::Passed),
        Some(error) => Err(NoMatch::Unreadable(path.to_path_buf(), error)),
        None => Ok(Failed::Passed),
    }
}

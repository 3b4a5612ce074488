//! What a test needs beside the project's own files: one way to ask for it, and one to say that it is absent.
//!
//! A test that finds something missing is skipped, and says so: a line `SKIPPED name: what is missing` goes past the
//! harness to standard error, and into a file that `tests/skipped.rs` shows when all tests have ended. Where the
//! environment variable `CI` is set, the test fails instead.

use std::fs::File;
use std::io::Write;
use std::panic::Location;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

/// Set where `../shared` is knowingly absent, as for everybody who has the project alone: then `CI` does not ask for it.
const WITHOUT_SHARED: &str = "CLSMITH_WITHOUT_SHARED";

/// The real CL files beside the project, APT part programs left out.
#[track_caller]
pub fn require_corpus() -> Option<Vec<PathBuf>> {
    let mut files = require_corpus_with_part_programs()?;
    files.retain(|path| !path.to_string_lossy().contains("apt360"));
    Some(files)
}

/// All files of the corpus.
#[track_caller]
pub fn require_corpus_with_part_programs() -> Option<Vec<PathBuf>> {
    let root = require_shared_folder("corpus")?;
    let mut files = Vec::new();
    for folder in std::fs::read_dir(root).unwrap().flatten().filter(|entry| entry.path().is_dir()) {
        files.extend(std::fs::read_dir(folder.path()).unwrap().flatten().map(|entry| entry.path()));
    }
    files.sort();
    Some(files)
}

/// A file of the corpus by the end of its path; a corpus without it is a mistake of the test.
#[track_caller]
pub fn require_corpus_file(end: &str) -> Option<PathBuf> {
    let files = require_corpus_with_part_programs()?;
    let found = files.into_iter().find(|path| path.to_string_lossy().ends_with(end));
    Some(found.unwrap_or_else(|| panic!("../shared/corpus has no {end}")))
}

/// A folder of `../shared`, the read-only material beside the project, which nothing is copied from.
#[track_caller]
pub fn require_shared_folder(name: &str) -> Option<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared").join(name);
    let found = folder.read_dir().is_ok_and(|mut entries| entries.next().is_some());
    require(found.then_some(folder), &format!("../shared/{name}"), is_set(WITHOUT_SHARED))
}

/// Another program that a test runs, by any of its names.
#[track_caller]
pub fn require_program(names: &[&str]) -> Option<PathBuf> {
    let folders = std::env::var_os("PATH").unwrap_or_default();
    let found = std::env::split_paths(&folders)
        .flat_map(|folder| names.iter().map(move |name| folder.join(name)))
        .find(|path| path.is_file());
    require(found, names[0], false)
}

/// The viewer for browsers, which `scripts/web --test` makes.
#[track_caller]
pub fn require_viewer() -> Option<PathBuf> {
    let page = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/web/viewer.html");
    require(page.is_file().then_some(page), "target/web/viewer.html (scripts/web --test makes it)", false)
}

/// A file or folder of the system.
#[cfg(unix)]
#[track_caller]
pub fn require_path(path: &str) -> Option<PathBuf> {
    let path = Path::new(path);
    require(path.exists().then(|| path.to_path_buf()), &path.to_string_lossy(), false)
}

/// Hands on what was found. What was not is said, and is a failure under `CI` unless it is `excused`.
#[track_caller]
fn require<T>(found: Option<T>, what: &str, excused: bool) -> Option<T> {
    let place = Location::caller();
    // A test runs in a thread of its name, but for those that share the main thread or start threads themselves.
    let name = std::thread::current().name().filter(|name| *name != "main").map(str::to_owned);
    let name = name.unwrap_or_else(|| format!("{}:{}", place.file(), place.line()));
    let line = found.is_none().then(|| format!("SKIPPED {name}: {what} is missing\n"));
    write_log(line.as_deref());
    if let Some(line) = line {
        assert!(excused || !is_set("CI"), "CI is set, and {what} is missing: {name} would test nothing");
        let _ = std::io::stderr().write_all(line.as_bytes());
    }
    found
}

/// Adds a line to the list of skipped tests; the first call of a run begins the list, so that it never tells of another run.
fn write_log(line: Option<&str>) {
    static LOG: Mutex<Option<File>> = Mutex::new(None);
    let mut log = LOG.lock().unwrap_or_else(PoisonError::into_inner);
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("skipped-tests.txt");
    let log = log.get_or_insert_with(|| File::create(path).unwrap());
    if let Some(line) = line {
        log.write_all(line.as_bytes()).unwrap();
    }
}

/// Whether an environment variable says yes.
fn is_set(variable: &str) -> bool {
    std::env::var_os(variable).is_some_and(|value| !["", "0", "false"].iter().any(|no| value == *no))
}

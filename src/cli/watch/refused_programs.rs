//! This module moves refused programs aside with their findings, without overwriting anything.
//!
//! The diagnostics are written first and the original is removed last. So nothing is lost if the process is
//! killed, and the next try continues from there.

use super::folder_scan::{ExportStamp, ExportedFile, report_unreadable};
use crate::cli::command_outputs::report_unwritable;
use clsmith::diagnostic::{Diagnostic, Failure};
use clsmith::fingerprint::Digest;
use clsmith::output_files::{OutputAccess, write_new_atomically};
use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// What happened to a refused program.
pub(super) enum RefusedMove {
    /// It is aside, and no longer among the exports.
    To(PathBuf),
    /// It is aside and still among the exports, because it cannot be removed there.
    Copied(PathBuf, Box<Diagnostic>),
    /// It has changed since it was read.
    Changed,
}

/// The largest number of refused programs with the same name. If there are more, something else is wrong.
const MOST_OF_ONE_NAME: usize = 10_000;

/// Moves a program with the content `digest` into `folder`, and writes `diagnostics` beside it. If its name
/// is taken by another content, it gets a number.
///
/// # Errors
/// Returns a finding if a file cannot be read or written.
pub(super) fn move_aside(
    export: &ExportedFile,
    digest: Digest,
    diagnostics: &str,
    folder: &Path,
) -> Result<RefusedMove, Failure> {
    let text = Digest::from_bytes(diagnostics.as_bytes());
    for number in 0..MOST_OF_ONE_NAME {
        let target = numbered_path(&folder.join(&export.name), number);
        let beside = path_with_suffix(&target, ".diagnostics.txt");
        // A file with the same content comes from a try that was interrupted.
        if !is_free_or_same(&target, digest)? || !is_free_or_same(&beside, text)? {
            continue;
        }
        let access = OutputAccess::of_inputs([export.path.as_path()]);
        write_new_file(&beside, access, |out| out.write_all(diagnostics.as_bytes()))?;
        let is_new =
            write_new_file(&target, access, |out| io::copy(&mut File::open(&export.path)?, out).map(drop))?;
        if !is_free_or_same(&target, digest)? {
            // A new export is being written, so the copy is a part of it and of no use.
            if is_new {
                let _ = fs::remove_file(&target);
                let _ = fs::remove_file(&beside);
            }
            return Ok(RefusedMove::Changed);
        }
        // This is checked directly before the export is removed, so that a newer one of the same name is not
        // removed in its place.
        if ExportStamp::read_stamp(&export.path).ok() != Some(export.stamp) {
            return Ok(RefusedMove::Changed);
        }
        return Ok(match fs::remove_file(&export.path) {
            Ok(()) => RefusedMove::To(target),
            Err(error) => RefusedMove::Copied(target, Box::new(report_unwritable(&export.path, &error))),
        });
    }
    let full = io::Error::other(format!("there are {MOST_OF_ONE_NAME} refused programs of this name"));
    Err(report_unwritable(&folder.join(&export.name), &full).into())
}

/// Returns whether a path is free, or has this content.
fn is_free_or_same(path: &Path, digest: Digest) -> Result<bool, Failure> {
    match Digest::from_file(path) {
        Ok(found) => Ok(found == digest),
        Err(error) if error.kind() == io::ErrorKind::NotFound => Ok(true),
        // There may be a folder of this name.
        Err(_) if fs::symlink_metadata(path).is_ok() => Ok(false),
        Err(error) => Err(report_unreadable(path, &error).into()),
    }
}

/// Writes a file if it does not exist. Returns whether it was written.
fn write_new_file(
    path: &Path,
    access: OutputAccess,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<bool, Failure> {
    let make = || {
        if let Some(folder) = path.parent() {
            fs::create_dir_all(folder)?;
        }
        match write_new_atomically(path, access, write) {
            Err(error) if error.kind() == io::ErrorKind::AlreadyExists => Ok(false),
            written => written.map(|()| true),
        }
    };
    Ok(make().map_err(|error| report_unwritable(path, &error))?)
}

/// Numbers a path: `part.cls`, `part.1.cls`, `part.2.cls`.
fn numbered_path(path: &Path, number: usize) -> PathBuf {
    if number == 0 {
        return path.to_path_buf();
    }
    let mut name = path.file_stem().unwrap_or_default().to_owned();
    name.push(format!(".{number}"));
    if let Some(end) = path.extension() {
        name.push(".");
        name.push(end);
    }
    path.with_file_name(name)
}

fn path_with_suffix(path: &Path, end: &str) -> PathBuf {
    let mut name: OsString = path.as_os_str().to_owned();
    name.push(end);
    PathBuf::from(name)
}

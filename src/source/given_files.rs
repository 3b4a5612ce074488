//! This module holds files in memory, where there is no file system: what a page in a browser was given.

use super::read_stream_bytes;
use std::io;
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// The files by name.
static GIVEN: Mutex<Vec<(String, Vec<u8>)>> = Mutex::new(Vec::new());

/// Hands over a file, which is found by its name from now on, in whatever folder a recipe or a setup looks for it.
pub fn give_file(name: impl Into<String>, bytes: Vec<u8>) {
    let name = name.into();
    let mut given = GIVEN.lock().unwrap_or_else(PoisonError::into_inner);
    given.retain(|(known, _)| *known != name);
    given.push((name, bytes));
}

/// Reads a given file of at most `most` bytes. The folders of the path do not count: a browser tells names alone.
pub(super) fn read_given_file(path: &Path, most: u64) -> io::Result<Vec<u8>> {
    let wanted = path.to_string_lossy();
    let wanted = wanted.rsplit(['/', '\\']).next().unwrap_or_default();
    let given = GIVEN.lock().unwrap_or_else(PoisonError::into_inner);
    let found = given.iter().find(|(name, _)| name == wanted);
    match found {
        Some((_, bytes)) => read_stream_bytes(bytes.as_slice(), most),
        None => Err(io::Error::new(io::ErrorKind::NotFound, format!("no file `{wanted}` was given"))),
    }
}

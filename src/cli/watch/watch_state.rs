//! This module remembers finished programs by content, with a line of JSON for each, added after its output
//! exists.
//!
//! If the process is killed between the two, a program is processed again, to the same bytes. A line that a
//! crash has cut is skipped, and the next one starts on a line of its own.

use crate::cli::command_outputs::report_unwritable;
use crate::cli::unattended::{UnattendedOutcome, utc_now};
use clsmith::diagnostic::{Diagnostic, Failure, codes};
use clsmith::fingerprint::Digest;
use clsmith::report::safe_json::to_json_line;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fmt::Write as _;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A line of the file that remembers finished programs.
#[derive(Debug, Serialize)]
struct WatchStateLine<'l> {
    version: u32,
    time: String,
    path: &'l str,
    sha256: Digest,
    outcome: UnattendedOutcome,
}

/// The fields of a line that are needed when it is read.
#[derive(Debug, Deserialize)]
struct WatchStateEntry {
    path: String,
    sha256: Digest,
}

/// The finished programs.
pub(super) struct WatchState {
    path: PathBuf,
    file: File,
    /// The content that was processed last, by name.
    done: BTreeMap<String, Digest>,
}

impl WatchState {
    /// Reads the finished programs of earlier runs. Also returns the number of lines that could not be read.
    ///
    /// # Errors
    /// Returns a finding if the file cannot be read or opened for writing.
    pub(super) fn open(path: &Path) -> Result<(Self, usize), Failure> {
        let bytes = match fs::read(path) {
            Ok(bytes) => bytes,
            Err(error) if error.kind() == io::ErrorKind::NotFound => Vec::new(),
            Err(error) => {
                let message = format!("{} cannot be read: {error}", path.display());
                return Err(Diagnostic::new(codes::UNREADABLE, message).into());
            }
        };
        let (mut done, mut bad) = (BTreeMap::new(), 0);
        for line in bytes.split(|&byte| byte == b'\n').filter(|line| !line.trim_ascii().is_empty()) {
            match serde_json::from_slice(line) {
                Ok(WatchStateEntry { path, sha256 }) => drop(done.insert(path, sha256)),
                Err(_) => bad += 1,
            }
        }
        let open = || {
            let mut file = File::options().append(true).create(true).open(path)?;
            if bytes.last().is_some_and(|&last| last != b'\n') {
                file.write_all(b"\n")?;
            }
            Ok(file)
        };
        let file = open().map_err(|error: io::Error| report_unwritable(path, &error))?;
        Ok((Self { path: path.to_path_buf(), file, done }, bad))
    }

    /// Returns whether this content was the last one processed under this name.
    pub(super) fn is_done(&self, name: &Path, digest: Digest) -> bool {
        self.done.get(&encode_name(name)) == Some(&digest)
    }

    /// Remembers a program. The line is on the disk before this returns.
    ///
    /// # Errors
    /// Returns a finding if the line cannot be written.
    pub(super) fn remember_program(
        &mut self,
        name: &Path,
        digest: Digest,
        outcome: UnattendedOutcome,
    ) -> Result<(), Diagnostic> {
        let key = encode_name(name);
        let line = WatchStateLine { version: 1, time: utc_now(), path: &key, sha256: digest, outcome };
        let written = to_json_line(&line).and_then(|line| {
            self.file.write_all(&line)?;
            self.file.sync_data()
        });
        // It counts as done in this run even if the line could not be written. Otherwise a full disk would
        // have it done again at every look.
        self.done.insert(key, digest);
        written.map_err(|error| report_unwritable(&self.path, &error))
    }
}

/// Encodes a name as text, so that different names stay different: `%` and bytes that are not UTF-8 become
/// `%25`, `%FF`.
fn encode_name(name: &Path) -> String {
    let mut key = String::new();
    for chunk in name.as_os_str().as_encoded_bytes().utf8_chunks() {
        key.push_str(&chunk.valid().replace('%', "%25"));
        for byte in chunk.invalid() {
            let _ = write!(key, "%{byte:02X}");
        }
    }
    key
}

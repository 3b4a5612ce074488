//! This module writes a journal of what a batch has done, so that a batch that was killed can be resumed.

use super::{BatchRecord, LockedFolder, PortablePath};
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::fingerprint::Digest;
use crate::presentation::safe_json::to_json_line;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Write};
use std::path::Path;
use std::sync::{Mutex, PoisonError};

/// A file that was processed, and everything on which its result depends.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct JournalEntry {
    /// The digest of the input, the recipe with its files, the options and the version:
    /// [`RecipeFingerprint::result_key`](crate::fingerprint::RecipeFingerprint::result_key).
    pub key: Digest,
    /// What happened to it.
    pub record: BatchRecord,
}

#[derive(Serialize, Deserialize)]
struct JournalHead {
    clsmith_journal: u32,
    batch: Digest,
}

/// The journal of a run: a line of JSON for every file, which is written after its output.
///
/// A line is only written when its output is on the disk, so it never claims too much. A power cut may lose
/// or damage it; then its file is processed again.
#[derive(Debug)]
pub(crate) struct BatchJournal {
    file: Mutex<Option<File>>,
}

impl BatchJournal {
    /// Returns the newest entry of each file that was processed in a folder, by this shard or any other.
    pub(crate) fn read_entries(
        folder: &LockedFolder,
    ) -> BTreeMap<(PortablePath, PortablePath), JournalEntry> {
        let mut done = BTreeMap::new();
        for path in folder.folder().list_journals() {
            let Ok(file) = File::open(path) else { continue };
            for line in BufReader::new(file).split(b'\n').map_while(Result::ok) {
                // A line that is not complete was not finished.
                if let Ok(entry) = serde_json::from_slice::<JournalEntry>(&line) {
                    done.insert((entry.record.input.clone(), entry.record.output.clone()), entry);
                }
            }
        }
        done
    }

    /// Begins the journal of a run with the entries of earlier runs.
    ///
    /// # Errors
    /// Returns the error of the operating system.
    pub(crate) fn begin_journal<'d>(
        folder: &LockedFolder,
        batch: Digest,
        known: impl IntoIterator<Item = &'d JournalEntry>,
    ) -> io::Result<Self> {
        let path = folder.folder().journal_path();
        let mut text = json_line(&JournalHead { clsmith_journal: 1, batch })?;
        // The new journal replaces the old one, so what earlier runs have done must be in it, or a second
        // --resume would repeat that.
        for done in known {
            text.extend(json_line(done)?);
        }
        // The file is replaced in one operation, so a process that is killed here leaves the old journal or
        // the new one.
        folder.folder().temporary_files().write_file_to_end(&path, |out| out.write_all(&text))?;
        Ok(Self { file: Mutex::new(Some(File::options().append(true).open(path)?)) })
    }

    /// Adds a file.
    ///
    /// # Errors
    /// Returns the error of the operating system once. After that nothing more is written.
    pub(crate) fn add_entry(&self, done: &JournalEntry) -> io::Result<()> {
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(open) = file.as_mut() else { return Ok(()) };
        let written = json_line(done).and_then(|line| open.write_all(&line));
        // The end of the file may be half a line now, and the next line would be lost in it. A full disk
        // would also fail again for every file.
        if written.is_err() {
            *file = None;
        }
        written
    }
}

impl LockedFolder {
    /// Checks that other shards that are running belong to the same batch. The journal of each shard states
    /// its batch.
    ///
    /// # Errors
    /// Returns [`codes::OUTPUT_IN_USE`] if one belongs to another batch.
    pub(crate) fn check_same_batch(&self, id: Digest) -> Result<(), Failure> {
        for journal in self.list_running_journals() {
            if read_batch_id(&journal).is_some_and(|other| other != id) {
                let message = format!(
                    "shards of another batch are writing to {} at this moment ({})",
                    self.folder().root().display(),
                    journal.display()
                );
                return Err(Diagnostic::new(codes::OUTPUT_IN_USE, message).into());
            }
        }
        Ok(())
    }
}

/// Returns the id of the batch to which a journal belongs.
fn read_batch_id(path: &Path) -> Option<Digest> {
    let first = BufReader::new(File::open(path).ok()?).split(b'\n').next()?.ok()?;
    serde_json::from_slice::<JournalHead>(&first).ok().map(|head| head.batch)
}

fn json_line(value: &impl Serialize) -> io::Result<Vec<u8>> {
    to_json_line(value)
}

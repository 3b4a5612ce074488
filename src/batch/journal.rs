//! What a batch has done, written down as it goes, so that one that was killed can go on.

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

/// A file that was done, and all that its result depends on.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct JournalEntry {
    /// Of input, recipe with its files, options and version: [`RecipeFingerprint::result_key`](crate::fingerprint::RecipeFingerprint::result_key).
    pub key: Digest,
    /// What became of it.
    pub record: BatchRecord,
}

#[derive(Serialize, Deserialize)]
struct JournalHead {
    clsmith_journal: u32,
    batch: Digest,
}

/// The journal of a run: a line of JSON for every file, written when its output is.
///
/// A line comes after its output is on the disk, so it never promises too much. It may be lost or torn by a power cut: then
/// its file is done again.
#[derive(Debug)]
pub struct BatchJournal {
    file: Mutex<Option<File>>,
}

impl BatchJournal {
    /// What was done in a folder before, by this shard or any other: the last word on each file.
    pub fn read_entries(folder: &LockedFolder) -> BTreeMap<(PortablePath, PortablePath), JournalEntry> {
        let mut done = BTreeMap::new();
        for path in folder.folder().list_journals() {
            let Ok(file) = File::open(path) else { continue };
            for line in BufReader::new(file).split(b'\n').map_while(Result::ok) {
                // What is no whole line was not finished.
                if let Ok(entry) = serde_json::from_slice::<JournalEntry>(&line) {
                    done.insert((entry.record.input.clone(), entry.record.output.clone()), entry);
                }
            }
        }
        done
    }

    /// Begins the journal of a run with what is known to be done.
    ///
    /// # Errors
    /// What the operating system says.
    pub fn begin_journal<'d>(
        folder: &LockedFolder,
        batch: Digest,
        known: impl IntoIterator<Item = &'d JournalEntry>,
    ) -> io::Result<Self> {
        let path = folder.folder().journal_path();
        let mut text = json_line(&JournalHead { clsmith_journal: 1, batch })?;
        for done in known {
            text.extend(json_line(done)?);
        }
        // At once: whoever is killed here has the old journal or the new one.
        folder.folder().temporary_files().write_file_to_end(&path, |out| out.write_all(&text))?;
        Ok(Self { file: Mutex::new(Some(File::options().append(true).open(path)?)) })
    }

    /// Adds a file.
    ///
    /// # Errors
    /// What the operating system says, once: after that nothing more is written.
    pub fn add_entry(&self, done: &JournalEntry) -> io::Result<()> {
        let mut file = self.file.lock().unwrap_or_else(PoisonError::into_inner);
        let Some(open) = file.as_mut() else { return Ok(()) };
        let written = json_line(done).and_then(|line| open.write_all(&line));
        if written.is_err() {
            *file = None;
        }
        written
    }
}

impl LockedFolder {
    /// Whether other shards that run now are of the same batch; each says in its journal which it is of.
    ///
    /// # Errors
    /// [`codes::OUTPUT_IN_USE`] if one is of another.
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

/// The batch that a journal is of.
fn read_batch_id(path: &Path) -> Option<Digest> {
    let first = BufReader::new(File::open(path).ok()?).split(b'\n').next()?.ok()?;
    serde_json::from_slice::<JournalHead>(&first).ok().map(|head| head.batch)
}

fn json_line(value: &impl Serialize) -> io::Result<Vec<u8>> {
    to_json_line(value)
}

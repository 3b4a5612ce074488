//! This module holds the output folder with the batch's own files, and makes sure that nobody else writes to
//! it meanwhile.

use super::Shard;
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::output_files::TemporaryFiles;
use std::collections::BTreeSet;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

/// An output folder, and the shard that is processed.
///
/// The batch keeps a lock (`.clsmith-batch.lock`) and a journal (`.clsmith-batch.journal`) in it. A shard has
/// its own (`.clsmith-batch-2-of-8.lock`), so several shards of a batch can use the same folder.
#[derive(Debug, Clone)]
pub struct OutputFolder {
    root: PathBuf,
    shard: Option<Shard>,
}

/// An output folder that is locked until this is dropped or the process ends, in whatever way.
#[derive(Debug)]
pub struct LockedFolder {
    folder: OutputFolder,
    // Closing a file releases its lock.
    _locks: Vec<File>,
}

impl OutputFolder {
    /// Makes an output folder, which need not exist yet.
    pub fn new(root: impl Into<PathBuf>, shard: Option<Shard>) -> Self {
        Self { root: root.into(), shard }
    }

    /// Returns its path.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// Returns the shard.
    pub fn shard(&self) -> Option<Shard> {
        self.shard
    }

    /// Returns the default path of results: `results.jsonl`, `results-2-of-8.jsonl`.
    pub fn results_path(&self) -> PathBuf {
        self.root.join(match self.shard {
            None => "results.jsonl".to_owned(),
            Some(shard) => format!("results-{}.jsonl", shard.file_name_part()),
        })
    }

    /// Returns the path of results with a given name. Every shard gets a file of its own beside it, such as
    /// `all-2-of-8.jsonl`, because all shards have the same command line.
    pub fn shard_results_path(&self, path: &Path) -> PathBuf {
        let Some(shard) = self.shard else { return path.to_path_buf() };
        let mut name = path.file_stem().unwrap_or_default().to_os_string();
        name.push(format!("-{}", shard.file_name_part()));
        if let Some(end) = path.extension() {
            name.push(".");
            name.push(end);
        }
        path.with_file_name(name)
    }

    /// Returns how this batch names its temporary files.
    pub fn temporary_files(&self) -> TemporaryFiles {
        TemporaryFiles::for_owner(&match self.shard {
            None => "batch".to_owned(),
            Some(shard) => format!("batch-{}", shard.file_name_part()),
        })
    }

    /// Returns whether a path below the folder is a symbolic link.
    pub(super) fn is_link(&self, below: &Path) -> bool {
        fs::symlink_metadata(self.root.join(below)).is_ok_and(|there| there.is_symlink())
    }

    /// Returns the files that must not be outputs.
    pub(super) fn reserved_paths(&self) -> Vec<PathBuf> {
        let whole = Self::new(&self.root, None);
        vec![self.journal_path(), self.lock_path(), whole.lock_path()]
    }

    pub(super) fn journal_path(&self) -> PathBuf {
        self.own_path("journal")
    }

    /// Returns the journals of all shards, of any split, because each of them records what it did.
    pub(super) fn list_journals(&self) -> Vec<PathBuf> {
        let names = fs::read_dir(&self.root).into_iter().flatten().flatten().map(|entry| entry.file_name());
        let is_one = |name: &std::ffi::OsString| {
            let name = name.as_encoded_bytes();
            name.starts_with(OWN_FILE_PREFIX.as_bytes()) && name.ends_with(b".journal")
        };
        let mut found: Vec<PathBuf> = names.filter(is_one).map(|name| self.root.join(name)).collect();
        // The journal of this shard comes last, because it has priority.
        let own = self.journal_path();
        found.sort_by(|a, b| (*a == own, a).cmp(&(*b == own, b)));
        found
    }

    fn lock_path(&self) -> PathBuf {
        self.own_path("lock")
    }

    fn own_path(&self, kind: &str) -> PathBuf {
        self.root.join(match self.shard {
            None => format!("{OWN_FILE_PREFIX}.{kind}"),
            Some(shard) => format!("{OWN_FILE_PREFIX}-{}.{kind}", shard.file_name_part()),
        })
    }

    /// Creates the folder if it does not exist, and locks it.
    ///
    /// # Errors
    /// Returns [`codes::OUTPUT_IN_USE`] while another batch, or this shard, runs there, and
    /// [`codes::UNWRITABLE`] if the folder cannot be created, written to or locked.
    pub fn lock_folder(self) -> Result<LockedFolder, Failure> {
        fs::create_dir_all(&self.root).map_err(|error| report_unwritable(&self.root, &error))?;
        let whole = Self::new(&self.root, None).lock_path();
        let mut locks = Vec::new();
        match self.shard {
            None => locks.push(self.lock_one_file(&whole, File::try_lock)?),
            Some(_) => {
                // The lock is shared among shards, but not with a batch that processes everything.
                locks.push(self.lock_one_file(&whole, File::try_lock_shared)?);
                locks.push(self.lock_one_file(&self.lock_path(), File::try_lock)?);
            }
        }
        Ok(LockedFolder { folder: self, _locks: locks })
    }

    fn lock_one_file(
        &self,
        path: &Path,
        lock: impl FnOnce(&File) -> Result<(), TryLockError>,
    ) -> Result<File, Failure> {
        // Another process may hold the lock of this file, so the file is opened without any change to it.
        let open = File::options().create(true).truncate(false).read(true).write(true).open(path);
        let file = open.map_err(|error| report_unwritable(path, &error))?;
        match lock(&file) {
            Ok(()) => Ok(file),
            Err(TryLockError::WouldBlock) => {
                let who = match self.shard {
                    Some(shard) if path == self.lock_path() => format!("shard {shard}"),
                    _ => "another batch".to_owned(),
                };
                let message = format!("{who} is writing to {} at this moment", self.root.display());
                Err(Diagnostic::new(codes::OUTPUT_IN_USE, message).into())
            }
            Err(TryLockError::Error(error)) => Err(Diagnostic::new(codes::UNWRITABLE, format!("{} cannot be locked: {error}", path.display()))
                    .with_help("The file system must support locks (flock), which some network drives do not. Choose another output folder.").into()),
        }
    }
}

/// The beginning of the names of the batch's own files.
const OWN_FILE_PREFIX: &str = ".clsmith-batch";

fn report_unwritable(path: &Path, error: &io::Error) -> Failure {
    Diagnostic::new(codes::UNWRITABLE, format!("{} cannot be written: {error}", path.display())).into()
}

impl LockedFolder {
    /// Returns the folder.
    pub fn folder(&self) -> &OutputFolder {
        &self.folder
    }

    /// Returns the journals of other shards that are running.
    pub(super) fn list_running_journals(&self) -> Vec<PathBuf> {
        let whole = OutputFolder::new(self.folder.root.clone(), None).lock_path();
        let runs = |journal: &PathBuf| {
            let lock = journal.with_extension("lock");
            if *journal == self.folder.journal_path() || lock == whole {
                return false;
            }
            // The file of a lock stays when its run has ended. Only an attempt to lock it tells whether
            // somebody holds it.
            File::open(&lock)
                .is_ok_and(|file| matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock)))
        };
        self.folder.list_journals().into_iter().filter(runs).collect()
    }

    /// Returns how this batch names its temporary files.
    pub fn temporary_files(&self) -> TemporaryFiles {
        self.folder.temporary_files()
    }

    /// Removes temporary files that this batch left beside its outputs (below the folder) when it was killed.
    /// Returns their number. Those of other shards stay, because they may be in use.
    pub fn remove_leftovers<'o>(&self, outputs: impl Iterator<Item = &'o Path>) -> usize {
        let temporaries = self.folder.temporary_files();
        let below = outputs.filter_map(Path::parent);
        let folders: BTreeSet<&Path> = below.chain([Path::new("")]).collect();
        let entries = folders.iter().filter_map(|below| fs::read_dir(self.folder.root.join(below)).ok());
        let stale = entries.flatten().flatten().filter(|entry| {
            temporaries.is_leftover(&entry.file_name()) && entry.file_type().is_ok_and(|kind| kind.is_file())
        });
        stale.filter(|entry| fs::remove_file(entry.path()).is_ok()).count()
    }
}

//! The output folder: what the batch keeps there for itself, and that nobody else writes to it meanwhile.

use super::Shard;
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::output_files::TemporaryFiles;
use std::collections::BTreeSet;
use std::fs::{self, File, TryLockError};
use std::io;
use std::path::{Path, PathBuf};

/// An output folder, and the shard that is to be done.
///
/// The batch keeps a lock (`.clsmith-batch.lock`) and a journal (`.clsmith-batch.journal`) in it; a shard has its own
/// (`.clsmith-batch-2-of-8.lock`), so shards of one batch may share a folder.
#[derive(Debug, Clone)]
pub struct OutputFolder {
    root: PathBuf,
    shard: Option<Shard>,
}

/// An output folder that is ours until this is dropped, or the process ends, however it ends.
#[derive(Debug)]
pub struct LockedFolder {
    folder: OutputFolder,
    // Closing a file gives its lock back.
    _locks: Vec<File>,
}

impl OutputFolder {
    /// A folder, which need not exist yet.
    pub fn new(root: impl Into<PathBuf>, shard: Option<Shard>) -> Self {
        Self { root: root.into(), shard }
    }

    /// Its path.
    pub fn root(&self) -> &Path {
        &self.root
    }

    /// The shard.
    pub fn shard(&self) -> Option<Shard> {
        self.shard
    }

    /// Where results go if nobody says otherwise: `results.jsonl`, `results-2-of-8.jsonl`.
    pub fn results_path(&self) -> PathBuf {
        self.root.join(match self.shard {
            None => "results.jsonl".to_owned(),
            Some(shard) => format!("results-{}.jsonl", shard.file_name_part()),
        })
    }

    /// Where results go that somebody wants in a file of this name: each shard's in one of its own beside it, `all-2-of-8.jsonl`,
    /// for shards are given the same command line.
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

    /// How this batch calls its temporary files.
    pub(crate) fn temporary_files(&self) -> TemporaryFiles {
        TemporaryFiles::for_owner(&match self.shard {
            None => "batch".to_owned(),
            Some(shard) => format!("batch-{}", shard.file_name_part()),
        })
    }

    /// Whether a path below the folder is a symbolic link.
    pub(super) fn is_link(&self, below: &Path) -> bool {
        fs::symlink_metadata(self.root.join(below)).is_ok_and(|there| there.is_symlink())
    }

    /// Files that no output may be.
    pub(super) fn reserved_paths(&self) -> Vec<PathBuf> {
        let whole = Self::new(&self.root, None);
        vec![self.journal_path(), self.lock_path(), whole.lock_path()]
    }

    pub(super) fn journal_path(&self) -> PathBuf {
        self.own_path("journal")
    }

    /// Journals of all shards, of whatever splits: each tells what it did.
    pub(super) fn list_journals(&self) -> Vec<PathBuf> {
        let names = fs::read_dir(&self.root).into_iter().flatten().flatten().map(|entry| entry.file_name());
        let is_one = |name: &std::ffi::OsString| {
            let name = name.as_encoded_bytes();
            name.starts_with(OWN.as_bytes()) && name.ends_with(b".journal")
        };
        let mut found: Vec<PathBuf> = names.filter(is_one).map(|name| self.root.join(name)).collect();
        // One's own last: it is the one that counts.
        let own = self.journal_path();
        found.sort_by(|a, b| (*a == own, a).cmp(&(*b == own, b)));
        found
    }

    fn lock_path(&self) -> PathBuf {
        self.own_path("lock")
    }

    fn own_path(&self, kind: &str) -> PathBuf {
        self.root.join(match self.shard {
            None => format!("{OWN}.{kind}"),
            Some(shard) => format!("{OWN}-{}.{kind}", shard.file_name_part()),
        })
    }

    /// Makes the folder, if it is not there, and takes it.
    ///
    /// # Errors
    /// [`codes::OUTPUT_IN_USE`] while another batch, or this shard, runs there; [`codes::UNWRITABLE`] if it cannot be made,
    /// written to or locked.
    pub fn lock_folder(self) -> Result<LockedFolder, Failure> {
        fs::create_dir_all(&self.root).map_err(|error| report_unwritable(&self.root, &error))?;
        let whole = Self::new(&self.root, None).lock_path();
        let mut locks = Vec::new();
        match self.shard {
            None => locks.push(self.lock_one_file(&whole, File::try_lock)?),
            Some(_) => {
                // Shards share the folder with each other, but not with a batch that does all of it.
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
                    .with_help("The file system must know locks (flock); some network shares are mounted without. Choose another output folder.").into()),
        }
    }
}

/// What the batch's own files begin with.
const OWN: &str = ".clsmith-batch";

fn report_unwritable(path: &Path, error: &io::Error) -> Failure {
    Diagnostic::new(codes::UNWRITABLE, format!("{} cannot be written: {error}", path.display())).into()
}

impl LockedFolder {
    /// The folder.
    pub fn folder(&self) -> &OutputFolder {
        &self.folder
    }

    /// Journals of other shards that run now.
    pub(super) fn list_running_journals(&self) -> Vec<PathBuf> {
        let whole = OutputFolder::new(self.folder.root.clone(), None).lock_path();
        let runs = |journal: &PathBuf| {
            let lock = journal.with_extension("lock");
            if *journal == self.folder.journal_path() || lock == whole {
                return false;
            }
            File::open(&lock)
                .is_ok_and(|file| matches!(file.try_lock_shared(), Err(TryLockError::WouldBlock)))
        };
        self.folder.list_journals().into_iter().filter(runs).collect()
    }

    /// Removes temporary files that this batch left beside its outputs (below the folder) when it was killed; how many. Those of other shards stay: they may be in
    /// use.
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

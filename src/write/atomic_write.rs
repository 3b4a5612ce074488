//! An output appears whole or not at all.

use super::interrupt::{Interrupt, InterruptibleWriter};
use std::fs::{self, File, Metadata};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

const CHUNK: usize = 256 * 1024;
const SUFFIX: &str = ".tmp";

/// A temporary file that nobody wrote to for so long, and that nobody has locked, was left over by a killed process.
const LEFTOVER_AGE: Duration = Duration::from_secs(60);

/// Writes a file so that every reader sees either all of the old one or all of the new one.
///
/// The bytes go to a temporary file in the target's folder, which is flushed, synced and renamed. The permissions of an
/// existing target are kept; its owner and the other names of a hard-linked file are not: those go on naming the old bytes.
/// A symbolic link stays, and the file it points at is replaced. What is no file (a pipe, `/dev/stdout`) has no old content
/// to protect and is written directly.
///
/// # Errors
/// What `write` returns, or what the operating system says. The target is then as it was, and the temporary file is gone.
/// A write-protected target is refused, although a rename could replace it.
pub fn write_atomically(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    write_atomically_unless(path, &Interrupt::new(), write)
}

/// [`write_atomically`], which gives up between two chunks once `interrupt` is raised.
///
/// # Errors
/// As [`write_atomically`]; after an interrupt, one that [`is_interrupt`](super::is_interrupt) recognizes.
pub fn write_atomically_unless(
    path: &Path,
    interrupt: &Interrupt,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    TemporaryFiles::default().write_file(path, interrupt, write)
}

/// How temporary files are called. Whoever has a name of their own can tell theirs after a power cut.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TemporaryFiles {
    prefix: String,
}

impl Default for TemporaryFiles {
    fn default() -> Self {
        Self { prefix: ".clsmith-".to_owned() }
    }
}

impl TemporaryFiles {
    /// Temporary files called `.clsmith-<owner>-*.tmp`.
    pub fn for_owner(owner: &str) -> Self {
        Self { prefix: format!(".clsmith-{owner}-") }
    }

    /// Whether a file is, by its name, one of these that a process left behind when it was killed.
    pub fn is_leftover(&self, name: &std::ffi::OsStr) -> bool {
        let name = name.as_encoded_bytes();
        name.starts_with(self.prefix.as_bytes()) && name.ends_with(SUFFIX.as_bytes())
    }

    /// Removes what killed processes left behind in a folder, and gives the number of files removed.
    ///
    /// A process holds a lock on the temporary file that it writes, and loses it when it ends, however it ends. A file without
    /// a lock that nobody wrote to for a minute is therefore left over; younger ones may not be locked yet. What cannot be
    /// read, locked or removed stays.
    pub fn remove_leftovers(&self, folder: &Path) -> usize {
        let Some(oldest) = SystemTime::now().checked_sub(LEFTOVER_AGE) else { return 0 };
        let Ok(entries) = fs::read_dir(folder) else { return 0 };
        entries
            .flatten()
            .filter(|entry| self.is_leftover(&entry.file_name()) && is_abandoned(&entry.path(), oldest))
            .filter(|entry| fs::remove_file(entry.path()).is_ok())
            .count()
    }

    /// As [`write_atomically_unless`].
    ///
    /// # Errors
    /// As [`write_atomically_unless`].
    pub fn write_file(
        &self,
        path: &Path,
        interrupt: &Interrupt,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> io::Result<()> {
        let old = match fs::metadata(path) {
            Ok(old) if old.is_dir() => return Err(io::Error::from(io::ErrorKind::IsADirectory)),
            Ok(old) if !old.is_file() => {
                let file = File::options().write(true).open(path)?;
                return fill_file(&file, interrupt, write);
            }
            Ok(old) if old.permissions().readonly() => {
                return Err(io::Error::new(io::ErrorKind::PermissionDenied, "the file is write-protected"));
            }
            Ok(old) => Some(old),
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Err(error) => return Err(error),
        };
        replace_file(self, &follow_links(path)?, old.as_ref(), interrupt, write)
    }
}

/// [`write_atomically`] for a file that is not there yet.
///
/// # Errors
/// [`io::ErrorKind::AlreadyExists`] when something has that name, also if it came meanwhile; it stays as it is.
pub fn write_new_atomically(
    path: &Path,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    if fs::symlink_metadata(path).is_ok() {
        return Err(io::Error::from(io::ErrorKind::AlreadyExists));
    }
    let folder = parent_folder(path);
    let temporary = create_temporary(folder, &TemporaryFiles::default().prefix, None)?;
    fill_file(temporary.as_file(), &Interrupt::new(), write)?;
    temporary.as_file().sync_all()?;
    temporary.persist_noclobber(path).map_err(|failed| failed.error)?;
    sync_folder(folder);
    Ok(())
}

fn replace_file(
    temporaries: &TemporaryFiles,
    target: &Path,
    old: Option<&Metadata>,
    interrupt: &Interrupt,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    // The same folder, because a rename is only atomic within one file system.
    let folder = parent_folder(target);
    // Nobody who may not read the old file may read the new one, not even while it is being written.
    let temporary = create_temporary(folder, &temporaries.prefix, old.map(Metadata::permissions))?;
    fill_file(temporary.as_file(), interrupt, write)?;
    // The umask may have taken away what the old file allows.
    if let Some(old) = old {
        temporary.as_file().set_permissions(old.permissions())?;
    }
    temporary.as_file().sync_all()?;
    interrupt.check()?;
    temporary.persist(target).map_err(|failed| failed.error)?;
    sync_folder(folder);
    Ok(())
}

fn fill_file(
    file: &File,
    interrupt: &Interrupt,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut out = BufWriter::with_capacity(CHUNK, InterruptibleWriter { inner: file, interrupt });
    write(&mut out)?;
    out.flush()
}

/// Creates a temporary file that its process holds a lock on, with the permissions of the file that it replaces.
fn create_temporary(
    folder: &Path,
    prefix: &str,
    permissions: Option<fs::Permissions>,
) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    // A fixed prefix: the target's own name in front could pass the length a file name may have.
    builder.prefix(prefix).suffix(SUFFIX);
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        // What any new file asks for; the user's umask takes away what they do not want to share. The default of
        // tempfile, 0600, would hide the output from the colleague at the machine.
        builder.permissions(permissions.unwrap_or_else(|| fs::Permissions::from_mode(0o666)));
    }
    #[cfg(not(unix))]
    let _ = permissions;
    let temporary = builder.tempfile_in(folder)?;
    // A file system without locks still writes; then only no other run will clear the file away.
    let _ = temporary.as_file().try_lock();
    Ok(temporary)
}

/// Whether a temporary file is one whose process was killed: nobody holds its lock, and it is no newer than `oldest`.
fn is_abandoned(path: &Path, oldest: SystemTime) -> bool {
    let rests = fs::symlink_metadata(path)
        .and_then(|there| if there.is_file() { there.modified() } else { Ok(SystemTime::now()) })
        .is_ok_and(|modified| modified < oldest);
    rests && File::open(path).is_ok_and(|file| file.try_lock().is_ok())
}

/// Follows symbolic links at the end of a path, also to a file that does not exist yet.
pub(super) fn follow_links(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_path_buf();
    // As many as Linux follows.
    for _ in 0..40 {
        let Ok(next) = fs::read_link(&path) else { return Ok(path) };
        path = parent_folder(&path).join(next);
    }
    Err(io::Error::other("too many symbolic links"))
}

pub(super) fn parent_folder(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

// After the rename the new file stands; some file systems cannot sync a folder, and "failed" would now be wrong.
#[cfg(unix)]
fn sync_folder(folder: &Path) {
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
}

#[cfg(not(unix))]
fn sync_folder(_: &Path) {}

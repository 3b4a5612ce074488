//! This module writes files so that an output appears whole or not at all.

use super::interrupt::{Interrupt, InterruptibleWriter, WriteError};
use super::output_access::OutputAccess;
use super::windows_path::{check_device_name, lift_length_limit};
use std::fs::{self, File, Metadata};
use std::io::{self, BufWriter, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, SystemTime};

/// The size of the write buffer in bytes.
const CHUNK: usize = 256 * 1024;
/// The end of the name of temporary files.
const SUFFIX: &str = ".tmp";

/// The age from which an unlocked temporary file counts as left over by a killed process.
const LEFTOVER_AGE: Duration = Duration::from_secs(60);

/// Writes a file so that every reader sees either all of the old file or all of the new one.
///
/// The bytes go to a temporary file in the target's folder, which is flushed, synced and renamed. The
/// permissions of an existing target are kept. Its owner is not kept, and neither are the other names of a
/// hard-linked file, which keep naming the old bytes. A symbolic link stays, and the file that it points at
/// is replaced. A target that is not a file (a pipe, `/dev/stdout`) has no old content to protect and is
/// written directly.
///
/// ```
/// use clsmith::output_files::write_atomically;
///
/// let path = std::env::temp_dir().join(format!("clsmith-example-{}.cls", std::process::id()));
/// write_atomically(&path, |out| out.write_all(b"GOTO/1,2,3\n"))?;
/// // A write that fails leaves what was there.
/// let failed = write_atomically(&path, |_| Err(std::io::Error::other("no more data")));
/// assert!(failed.is_err());
/// assert_eq!(std::fs::read(&path)?, b"GOTO/1,2,3\n");
/// std::fs::remove_file(&path)?;
/// # Ok::<(), std::io::Error>(())
/// ```
///
/// # Errors
/// Returns the errors of `write` and of the operating system. The target is then unchanged, and the temporary
/// file is removed. A write-protected target is refused, although a rename could replace it. On Windows a name
/// of a device other than `NUL` is refused, with any ending.
pub fn write_atomically(path: &Path, write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> io::Result<()> {
    TemporaryFiles::default().write_file_to_end(path, write)
}

/// Writes a file as [`write_atomically`] does, but stops between two chunks once `interrupt` is raised.
///
/// # Errors
/// Returns the errors of [`write_atomically`], and [`WriteError::Interrupted`] after an interrupt.
pub fn write_atomically_unless(
    path: &Path,
    interrupt: &Interrupt,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> Result<(), WriteError> {
    TemporaryFiles::default().write_file(path, interrupt, write)
}

/// The names of temporary files, and who may read them. A caller with names of its own can recognize its files after a
/// power cut.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct TemporaryFiles {
    prefix: String,
    access: OutputAccess,
}

impl Default for TemporaryFiles {
    fn default() -> Self {
        Self { prefix: ".clsmith-".to_owned(), access: OutputAccess::default() }
    }
}

impl TemporaryFiles {
    /// Makes names of the form `.clsmith-<owner>-*.tmp`.
    pub(crate) fn for_owner(owner: &str) -> Self {
        Self { prefix: format!(".clsmith-{owner}-"), access: OutputAccess::default() }
    }

    /// Returns the same names for files that only those may read who have this access.
    #[must_use]
    pub fn with_access(mut self, access: OutputAccess) -> Self {
        self.access = access;
        self
    }

    /// Returns whether a file is, by its name, a temporary file that a killed process may have left behind.
    pub(crate) fn is_leftover(&self, name: &std::ffi::OsStr) -> bool {
        let name = name.as_encoded_bytes();
        name.starts_with(self.prefix.as_bytes()) && name.ends_with(SUFFIX.as_bytes())
    }

    /// Removes the temporary files in a folder that killed processes left behind, and returns their number.
    ///
    /// A process holds a lock on the temporary file that it writes, and loses it when it ends, however it
    /// ends. So a file without a lock that was not written for a minute is left over; younger files may not
    /// be locked yet. Files that cannot be read, locked or removed stay.
    pub fn remove_leftovers(&self, folder: &Path) -> usize {
        let Some(oldest) = SystemTime::now().checked_sub(LEFTOVER_AGE) else { return 0 };
        let Ok(entries) = fs::read_dir(folder) else { return 0 };
        entries
            .flatten()
            .filter(|entry| self.is_leftover(&entry.file_name()) && is_abandoned(&entry.path(), oldest))
            .filter(|entry| fs::remove_file(entry.path()).is_ok())
            .count()
    }

    /// Writes a file as [`write_atomically`] does.
    ///
    /// # Errors
    /// Returns the errors of [`write_atomically`].
    pub(crate) fn write_file_to_end(
        &self,
        path: &Path,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> io::Result<()> {
        self.write_file(path, &Interrupt::new(), write).map_err(|error| match error {
            WriteError::Io(error) => error,
            WriteError::Interrupted => {
                debug_assert!(false, "nobody else has this flag");
                io::Error::other(error)
            }
        })
    }

    /// Writes a file as [`write_atomically_unless`] does.
    ///
    /// # Errors
    /// Returns the errors of [`write_atomically_unless`].
    pub fn write_file(
        &self,
        path: &Path,
        interrupt: &Interrupt,
        write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
    ) -> Result<(), WriteError> {
        if check_device_name(path)? {
            return Ok(fill_file(&File::options().write(true).open(path)?, interrupt, write)?);
        }
        let path = &lift_length_limit(path);
        let old = match fs::metadata(path) {
            Ok(old) if old.is_dir() => return Err(io::Error::from(io::ErrorKind::IsADirectory).into()),
            Ok(old) if !old.is_file() => {
                let file = File::options().write(true).open(path)?;
                return Ok(fill_file(&file, interrupt, write)?);
            }
            Ok(old) if old.permissions().readonly() => {
                let reason = "the file is write-protected";
                return Err(io::Error::new(io::ErrorKind::PermissionDenied, reason).into());
            }
            Ok(old) => Some(old),
            Err(error) if error.kind() == io::ErrorKind::NotFound => None,
            Err(error) => return Err(error.into()),
        };
        Ok(replace_file(self, &follow_links(path)?, old.as_ref(), interrupt, write)?)
    }
}

/// Writes a file as [`write_atomically`] does if it does not exist yet.
///
/// # Errors
/// Returns [`io::ErrorKind::AlreadyExists`] if the name exists, even if it was created in the meantime; that
/// file stays unchanged.
pub fn write_new_atomically(
    path: &Path,
    access: OutputAccess,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    if check_device_name(path)? || fs::symlink_metadata(path).is_ok() {
        return Err(io::Error::from(io::ErrorKind::AlreadyExists));
    }
    let path = &lift_length_limit(path);
    let folder = parent_folder(path);
    let temporary = create_temporary(folder, &TemporaryFiles::default().with_access(access), None)?;
    fill_file(temporary.as_file(), &Interrupt::new(), write)?;
    temporary.as_file().sync_all()?;
    temporary.persist_noclobber(path).map_err(|failed| failed.error)?;
    sync_folder(folder);
    Ok(())
}

/// Replaces a file, or creates it if `old` is `None`.
fn replace_file(
    temporaries: &TemporaryFiles,
    target: &Path,
    old: Option<&Metadata>,
    interrupt: &Interrupt,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    // The temporary file is in the same folder, because a rename is only atomic within one file system.
    let folder = parent_folder(target);
    // A user who may not read the old file must not be able to read the new one, not even while it is
    // written.
    let temporary = create_temporary(folder, temporaries, old.map(Metadata::permissions))?;
    fill_file(temporary.as_file(), interrupt, write)?;
    // The umask may have removed permissions that the old file has.
    if let Some(old) = old {
        temporary.as_file().set_permissions(old.permissions())?;
    }
    temporary.as_file().sync_all()?;
    // This is the last moment at which an interrupt leaves the old file in place.
    interrupt.check()?;
    temporary.persist(target).map_err(|failed| failed.error)?;
    sync_folder(folder);
    Ok(())
}

/// Writes the content through a buffer that checks for interrupts.
fn fill_file(
    file: &File,
    interrupt: &Interrupt,
    write: impl FnOnce(&mut dyn Write) -> io::Result<()>,
) -> io::Result<()> {
    let mut out = BufWriter::with_capacity(CHUNK, InterruptibleWriter { inner: file, interrupt });
    write(&mut out)?;
    out.flush()
}

/// Creates a temporary file with a lock that this process holds, and with the permissions of the file that it
/// replaces, or those of a new output.
fn create_temporary(
    folder: &Path,
    temporaries: &TemporaryFiles,
    permissions: Option<fs::Permissions>,
) -> io::Result<tempfile::NamedTempFile> {
    let mut builder = tempfile::Builder::new();
    // The prefix is fixed, because the target's own name before it could exceed the longest file name.
    builder.prefix(&temporaries.prefix).suffix(SUFFIX);
    #[cfg(unix)]
    {
        // The user's umask removes permissions of a new file that are not wanted. The default of tempfile, 0600,
        // would hide the output from the colleague at the machine.
        builder.permissions(permissions.unwrap_or_else(|| temporaries.access.permissions_of_new_file()));
    }
    #[cfg(not(unix))]
    let _ = permissions;
    let temporary = builder.tempfile_in(folder)?;
    // A file system without locks can still be written; then only no other run will remove the file.
    let _ = temporary.as_file().try_lock();
    Ok(temporary)
}

/// Returns whether the process of a temporary file was killed: nobody holds its lock, and it is older than
/// `oldest`.
fn is_abandoned(path: &Path, oldest: SystemTime) -> bool {
    let rests = fs::symlink_metadata(path)
        .and_then(|there| if there.is_file() { there.modified() } else { Ok(SystemTime::now()) })
        .is_ok_and(|modified| modified < oldest);
    rests && File::open(path).is_ok_and(|file| file.try_lock().is_ok())
}

/// Follows symbolic links at the end of a path, also to a file that does not exist yet.
pub(super) fn follow_links(path: &Path) -> io::Result<PathBuf> {
    let mut path = path.to_path_buf();
    // Linux follows as many links.
    for _ in 0..40 {
        let Ok(next) = fs::read_link(&path) else { return Ok(path) };
        path = parent_folder(&path).join(next);
    }
    Err(io::Error::other("too many symbolic links"))
}

/// Returns the folder of a path, which is `.` for a bare name.
pub(super) fn parent_folder(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

// After the rename the new file is in place. Some file systems cannot sync a folder, and an error would now
// be wrong.
#[cfg(unix)]
fn sync_folder(folder: &Path) {
    if let Ok(folder) = File::open(folder) {
        let _ = folder.sync_all();
    }
}

#[cfg(not(unix))]
fn sync_folder(_: &Path) {}

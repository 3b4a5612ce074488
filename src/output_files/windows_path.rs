//! This module knows what is particular about paths of Windows: names that belong to devices, and long paths.

use std::ffi::OsStr;
use std::io;
use std::path::{Path, PathBuf};

/// The length in characters from which a path is given to Windows in the form that has no limit. The limit of
/// the plain form is 260 with the 0 at its end; the name of a temporary file, which may be longer than that of
/// its target, has to fit as well.
const LONG_PATH_N: usize = 200;

/// What Windows makes of the last name of a path.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum WindowsName {
    /// A file.
    File,
    /// `NUL`, the device that takes everything and keeps nothing.
    Nothing,
    /// Another device: a console, a printer or a port.
    Device,
}

impl WindowsName {
    /// Reads the name at the end of a path.
    ///
    /// Devices are CON, PRN, AUX, NUL, COM1 to COM9 and LPT1 to LPT9 (also with the digits ¹, ² and ³), CONIN$
    /// and CONOUT$, in upper or lower case. Most versions of Windows take a device for meant also where an ending or
    /// blanks follow: `aux.cls`. Source: Microsoft, "Naming Files, Paths, and Namespaces".
    #[must_use]
    pub fn of_path(path: &Path) -> Self {
        let name = path.file_name().unwrap_or_default().to_string_lossy().to_uppercase();
        let stem = name.split(['.', ':']).next().unwrap_or_default().trim_end_matches(' ');
        let is_port = ["COM", "LPT"].iter().any(|port| {
            stem.strip_prefix(port).is_some_and(|number| {
                let mut digits = number.chars();
                matches!(digits.next(), Some('1'..='9' | '¹' | '²' | '³')) && digits.next().is_none()
            })
        });
        match stem {
            "NUL" if name == "NUL" => Self::Nothing,
            "CON" | "PRN" | "AUX" | "NUL" | "CONIN$" | "CONOUT$" => Self::Device,
            _ if is_port => Self::Device,
            _ => Self::File,
        }
    }
}

/// Returns whether a path is `NUL` on Windows, which is written without looking what was there.
///
/// # Errors
/// Returns [`io::ErrorKind::InvalidInput`] on Windows if the name belongs to another device: what was written
/// there would be no file, or a file that other programs cannot open.
pub(super) fn check_device_name(path: &Path) -> io::Result<bool> {
    match WindowsName::of_path(path) {
        _ if !cfg!(windows) => Ok(false),
        WindowsName::File => Ok(false),
        WindowsName::Nothing => Ok(true),
        WindowsName::Device => {
            let reason = "Windows keeps this name for a device, so no file can have it";
            Err(io::Error::new(io::ErrorKind::InvalidInput, reason))
        }
    }
}

/// Returns the path in the form that has no limit of 260 characters, if it is long and this is Windows. Its
/// folder must exist.
pub(super) fn lift_length_limit(path: &Path) -> PathBuf {
    if !cfg!(windows) {
        return path.to_path_buf();
    }
    let length_n = |path: &Path| path.as_os_str().to_string_lossy().chars().count();
    let whole = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    if length_n(&whole) < LONG_PATH_N {
        return path.to_path_buf();
    }
    // On Windows the canonical form is the one without a limit. Where a drive has none, the plain one stays.
    let folder = std::fs::canonicalize(super::atomic_write::parent_folder(&whole));
    match (folder, whole.file_name().map(OsStr::to_owned)) {
        (Ok(folder), Some(name)) => folder.join(name),
        _ => path.to_path_buf(),
    }
}

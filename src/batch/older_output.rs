//! This module sets aside an output of an earlier run, if this run refuses to write it anew.

use crate::diagnostic::{Diagnostic, codes};
use std::ffi::OsString;
use std::fs;
use std::path::Path;

/// Renames an output of an earlier run to `NAME.outdated`: under its own name it would look like the result of this
/// run, and could go to the machine. `name` is what messages call it. Returns a finding that says so, or why it
/// cannot be renamed, and `None` if there is no such file.
///
/// ```
/// use clsmith::batch::set_older_output_aside;
///
/// let folder = tempfile::tempdir()?;
/// let output = folder.path().join("part.cls");
/// assert!(set_older_output_aside(&output, "part.cls").is_none());
/// std::fs::write(&output, "GOTO/1,2,3\n")?;
/// let said = set_older_output_aside(&output, "part.cls").expect("there is one");
/// assert!(said.message.contains("part.cls.outdated") && !output.exists());
/// # Ok::<(), std::io::Error>(())
/// ```
pub fn set_older_output_aside(output: &Path, name: &str) -> Option<Diagnostic> {
    // A link is not followed: it is no file that an earlier run has written.
    if !fs::symlink_metadata(output).is_ok_and(|there| there.is_file()) {
        return None;
    }
    let mut aside = OsString::from(output.file_name()?);
    aside.push(".outdated");
    Some(match fs::rename(output, output.with_file_name(aside)) {
        Ok(()) => {
            let message = format!("{name} is of an earlier run and was renamed to {name}.outdated");
            Diagnostic::new(codes::OLDER_RESULT, message)
        }
        Err(error) => {
            let message = format!("{name} is of an earlier run and cannot be renamed: {error}");
            Diagnostic::new(codes::UNWRITABLE, message)
        }
    })
}

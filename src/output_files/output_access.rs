//! This module decides who may read a new output: nobody who may not read the files that it is made of.

use std::path::Path;

/// The permissions of new files that are made of other files.
///
/// On Unix a new file gets the permissions that the user's umask leaves, less those of the group or of others where one
/// of the inputs hides its content from them. Elsewhere the folder decides.
///
/// ```
/// use clsmith::output_files::OutputAccess;
///
/// // Without inputs nothing is hidden.
/// let access = OutputAccess::of_inputs(std::iter::empty());
/// assert_eq!(access, OutputAccess::default());
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct OutputAccess {
    /// The permission bits that new files do not get.
    hidden: u32,
}

#[cfg(unix)]
impl OutputAccess {
    /// Returns the access to files that are made of these inputs. An input that is no file, or cannot be looked at, hides
    /// nothing.
    pub fn of_inputs<'a>(inputs: impl IntoIterator<Item = &'a Path>) -> Self {
        use std::os::unix::fs::PermissionsExt;
        let files = inputs.into_iter().filter_map(|path| std::fs::metadata(path).ok());
        let modes = files.filter(std::fs::Metadata::is_file).map(|there| there.permissions().mode());
        Self { hidden: modes.map(find_hidden_bits).fold(0, |all, bits| all | bits) }
    }

    /// Returns the permissions of a new file, from which the umask takes more away.
    pub(super) fn permissions_of_new_file(self) -> std::fs::Permissions {
        use std::os::unix::fs::PermissionsExt;
        std::fs::Permissions::from_mode(0o666 & !self.hidden)
    }
}

#[cfg(not(unix))]
impl OutputAccess {
    /// Returns the access to files that are made of these inputs.
    pub fn of_inputs<'a>(_: impl IntoIterator<Item = &'a Path>) -> Self {
        Self::default()
    }
}

/// Returns the bits of the group and of others, for those of the two who may not read a file of this mode.
#[cfg(unix)]
fn find_hidden_bits(mode: u32) -> u32 {
    [0o060, 0o006].into_iter().filter(|class| mode & class & 0o044 == 0).sum()
}

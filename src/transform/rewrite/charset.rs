//! Letters beyond ASCII: recipes are UTF-8, CL files are that or an 8-bit code page.

use crate::program::Program;

/// A letter of the recipe that the character set of a file does not have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the file is not written in UTF-8, and `{0}` does not exist in its 8-bit code page")]
pub(super) struct MissingLetter(char);

/// The character set of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Charset {
    /// UTF-8, and plain ASCII.
    Utf8,
    /// An 8-bit code page, taken for Latin-1.
    Latin1,
}

impl Charset {
    /// What a program's file is written in.
    pub fn from_program(program: &Program) -> Self {
        match std::str::from_utf8(program.source().bytes()) {
            Ok(_) => Self::Utf8,
            Err(_) => Self::Latin1,
        }
    }

    /// A text of the recipe as it stands in such a file.
    ///
    /// # Errors
    /// Returns the first letter that the file cannot hold.
    pub fn encode(self, text: &str) -> Result<Vec<u8>, MissingLetter> {
        if self == Self::Utf8 {
            return Ok(text.as_bytes().to_vec());
        }
        text.chars()
            .map(|letter| u8::try_from(u32::from(letter)).map_err(|_| MissingLetter(letter)))
            .collect()
    }
}

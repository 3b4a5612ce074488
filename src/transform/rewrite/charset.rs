//! This module handles letters beyond ASCII. Recipes are UTF-8, while CL files are UTF-8 or an 8-bit code
//! page.

use crate::program::Program;

/// The error for a letter of the recipe that the character set of a file does not have.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the file is not written in UTF-8, and `{0}` does not exist in its 8-bit code page")]
pub(super) struct MissingLetter(char);

/// The character set of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Charset {
    /// UTF-8, which includes plain ASCII.
    Utf8,
    /// An 8-bit code page, which is treated as Latin-1.
    Latin1,
}

impl Charset {
    /// Returns the character set of a program's file.
    pub(super) fn from_program(program: &Program) -> Self {
        match std::str::from_utf8(program.source().bytes()) {
            Ok(_) => Self::Utf8,
            Err(_) => Self::Latin1,
        }
    }

    /// Encodes a text of the recipe in the character set of the file.
    ///
    /// # Errors
    /// Returns the first letter that the file cannot hold.
    pub(super) fn encode(self, text: &str) -> Result<Vec<u8>, MissingLetter> {
        if self == Self::Utf8 {
            return Ok(text.as_bytes().to_vec());
        }
        text.chars()
            .map(|letter| u8::try_from(u32::from(letter)).map_err(|_| MissingLetter(letter)))
            .collect()
    }
}

//! This module lists the files of a comparison with names and hashes. They show from which program, recipe
//! and setup a page was made.

use super::ComparisonSubject;
use crate::source::Source;
use sha2::{Digest, Sha256};
use std::path::Path;

/// The role of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ComparedFileRole {
    /// The program as it was read.
    Input,
    /// The program in its current state.
    Output,
    /// The first of two files that are compared.
    First,
    /// The second of them.
    Second,
    /// The recipe.
    Recipe,
    /// A setup file.
    Setup,
}

impl ComparedFileRole {
    /// Returns the name of the role.
    pub fn display_name(self) -> &'static str {
        match self {
            Self::Input => "input",
            Self::First => "before",
            Self::Second => "after",
            Self::Output => "corrected program",
            Self::Recipe => "recipe",
            Self::Setup => "setup",
        }
    }
}

/// A file that a comparison describes.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ComparedFile {
    /// Its role.
    pub what: ComparedFileRole,
    /// The name of the file. The output is called `(of part.cls)` after the input `part.cls`, because this
    /// module does not know where it is written.
    pub name: String,
    /// The SHA-256 of its bytes, in hexadecimal digits.
    pub sha256: String,
    /// Its number of bytes.
    pub bytes: u64,
}

pub(super) fn hash_compared_files(subject: &ComparisonSubject<'_>) -> Vec<ComparedFile> {
    let file = |what, source: &Source| ComparedFile {
        what,
        name: source.name().to_owned(),
        sha256: format_hex(digest_in_pieces(source.bytes()).as_ref()),
        bytes: source.bytes().len() as u64,
    };
    let source = subject.program.source();
    let mut parts = match subject.other_file() {
        Some(other) => {
            vec![file(ComparedFileRole::First, other.source()), file(ComparedFileRole::Second, source)]
        }
        None => vec![file(ComparedFileRole::Input, source)],
    };
    // A refused program is no file, so it has no digest that anybody could compare.
    if subject.before.is_some() && subject.other_file().is_none() && !subject.is_refused() {
        let mut hash = Sha256::new();
        let mut bytes = 0;
        for piece in subject.program.byte_chunks() {
            hash.update(piece);
            bytes += piece.len() as u64;
        }
        let sha256 = format_hex(hash.finalize().as_slice());
        let input = Path::new(source.name()).file_name().map(|name| name.to_string_lossy().into_owned());
        let name = format!("(of {})", input.as_deref().unwrap_or(source.name()));
        parts.push(ComparedFile { what: ComparedFileRole::Output, name, sha256, bytes });
    }
    parts.extend(subject.recipe.map(|recipe| file(ComparedFileRole::Recipe, &recipe.source)));
    parts.extend(subject.setup_files.iter().map(|source| file(ComparedFileRole::Setup, source)));
    parts
}

/// Computes the SHA-256 of bytes piece by piece. In a browser one call over all of them runs to its end as it was compiled
/// first, which is ten times slower than what the browser makes of a function that is called often.
fn digest_in_pieces(bytes: &[u8]) -> impl AsRef<[u8]> + use<> {
    let mut hash = Sha256::new();
    bytes.chunks(1 << 14).for_each(|piece| hash.update(piece));
    hash.finalize()
}

fn format_hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

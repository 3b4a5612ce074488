//! What a comparison was made of: names and hashes, so that a page in a file can be told from another.

use super::ComparisonSubject;
use crate::source::Source;
use sha2::{Digest, Sha256};
use std::path::Path;

/// What a part is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum ComparedFileRole {
    /// The program as it was read.
    Input,
    /// The program as it stands.
    Output,
    /// The recipe.
    Recipe,
    /// A setup file.
    Setup,
}

impl ComparedFileRole {
    /// Its name.
    pub fn display_name(self) -> &'static str {
        match self {
            Self::Input => "input",
            Self::Output => "corrected program",
            Self::Recipe => "recipe",
            Self::Setup => "setup",
        }
    }
}

/// One of the files that a comparison tells of.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ComparedFile {
    /// What it is.
    pub what: ComparedFileRole,
    /// The file's name; of [`ComparedFileRole::Output`], which stands for the bytes wherever they go, the input's without folders.
    pub name: String,
    /// SHA-256 of its bytes, in hexadecimal digits.
    pub sha256: String,
    /// Bytes.
    pub bytes: u64,
}

pub(super) fn hash_compared_files(subject: &ComparisonSubject<'_>) -> Vec<ComparedFile> {
    let file = |what, source: &Source| ComparedFile {
        what,
        name: source.name().to_owned(),
        sha256: format_hex(Sha256::digest(source.bytes()).as_slice()),
        bytes: source.bytes().len() as u64,
    };
    let source = subject.program.source();
    let mut parts = vec![file(ComparedFileRole::Input, source)];
    if subject.before.is_some() {
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

fn format_hex(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

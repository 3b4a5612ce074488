//! This module computes SHA-256 digests of everything that a run reads, so that a log can prove, and a batch
//! can skip, what was done with the same files.
//!
//! [`Digest`] is the digest of bytes. [`RecipeFingerprint`] is that of a recipe and every file on which it
//! depends, by content and not by name.

use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::setup::Setup;
use crate::source::Source;
use crate::transform::Recipe;
use serde::de::{self, Deserialize, Deserializer};
use serde::{Serialize, Serializer};
use sha2::{Digest as _, Sha256};
use std::fmt;
use std::io::{self, Read};
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::Arc;

/// The version of clsmith that makes the results. Another version may make other results from the same files.
pub const VERSION: &str = env!("CARGO_PKG_VERSION");

/// A SHA-256 digest. It is written as 64 hexadecimal digits, as `sha256sum` prints it.
///
/// ```
/// use clsmith::fingerprint::Digest;
///
/// let digest = Digest::from_bytes(b"abc");
/// assert!(digest.to_string().starts_with("ba7816bf"));
/// assert_eq!(Digest::from_chunks([&b"a"[..], b"bc"]), digest);
/// ```
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Digest([u8; 32]);

impl Digest {
    /// Computes the digest of bytes.
    pub fn from_bytes(bytes: &[u8]) -> Self {
        Self(Sha256::digest(bytes).into())
    }

    /// Computes the digest of everything that a reader returns, without holding it in memory.
    ///
    /// # Errors
    /// Returns the error of the reader.
    pub fn from_reader(mut reader: impl Read) -> io::Result<Self> {
        let mut hasher = Sha256::new();
        let mut chunk = vec![0; 256 * 1024];
        loop {
            match reader.read(&mut chunk) {
                Ok(0) => return Ok(Self(hasher.finalize().into())),
                Ok(count) => hasher.update(chunk.get(..count).unwrap_or_default()),
                Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
                Err(error) => return Err(error),
            }
        }
    }

    /// Computes the digest of a file.
    ///
    /// # Errors
    /// Returns the error of the operating system.
    pub fn from_file(path: &Path) -> io::Result<Self> {
        #[cfg(all(target_family = "wasm", target_os = "unknown"))]
        return Ok(Self::from_bytes(&crate::source::read_file_bytes(path)?));
        #[cfg(not(all(target_family = "wasm", target_os = "unknown")))]
        Self::from_reader(std::fs::File::open(path)?)
    }

    /// Computes the digest of bytes that come in chunks. The sizes of the chunks do not matter.
    pub fn from_chunks<'a>(chunks: impl IntoIterator<Item = &'a [u8]>) -> Self {
        let mut hasher = Sha256::new();
        chunks.into_iter().for_each(|chunk| hasher.update(chunk));
        Self(hasher.finalize().into())
    }

    /// Computes the digest of a list. Each part counts with its length, so moving a byte from one part to the
    /// next changes it.
    pub fn from_parts<'a>(parts: impl IntoIterator<Item = &'a [u8]>) -> Self {
        let mut hasher = Sha256::new();
        for part in parts {
            hasher.update((part.len() as u64).to_le_bytes());
            hasher.update(part);
        }
        Self(hasher.finalize().into())
    }

    /// Returns the 32 bytes, for [`Digest::from_parts`].
    pub fn bytes(&self) -> &[u8] {
        &self.0
    }
}

impl fmt::Display for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.0.iter().try_for_each(|byte| write!(f, "{byte:02x}"))
    }
}

impl fmt::Debug for Digest {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self, f)
    }
}

/// The error for a text that is no SHA-256 digest.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("a SHA-256 digest has 64 hexadecimal digits")]
pub struct DigestParseError;

impl FromStr for Digest {
    type Err = DigestParseError;
    fn from_str(text: &str) -> Result<Self, DigestParseError> {
        let digits: Option<Vec<u8>> =
            text.chars().map(|digit| digit.to_digit(16).and_then(|digit| u8::try_from(digit).ok())).collect();
        let digits = digits.filter(|digits| digits.len() == 64).ok_or(DigestParseError)?;
        let mut bytes = [0; 32];
        for (byte, pair) in bytes.iter_mut().zip(digits.chunks_exact(2)) {
            *byte = pair.iter().fold(0, |value, digit| value << 4 | digit);
        }
        Ok(Self(bytes))
    }
}

impl Serialize for Digest {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_str(self)
    }
}

impl<'de> Deserialize<'de> for Digest {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let text = String::deserialize(deserializer)?;
        text.parse().map_err(de::Error::custom)
    }
}

/// A file on which a recipe depends.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, serde::Deserialize)]
pub struct FileFingerprint {
    /// Its path as it was opened.
    pub path: String,
    /// The digest of its content.
    pub sha256: Digest,
}

/// A recipe and all files on which it depends.
///
/// ```
/// use clsmith::fingerprint::{Digest, RecipeFingerprint};
/// use clsmith::setup::Setup;
/// use clsmith::source::Source;
/// use clsmith::transform::Recipe;
///
/// let source = Source::new("recipe.yaml", b"version: 1\nsteps: []\n".to_vec())?;
/// let recipe = Recipe::load(&source)?;
/// let print = RecipeFingerprint::read_files(&[source], &recipe, &Setup::default())?;
/// let input = Digest::from_bytes(b"GOTO/0,0,0\n");
/// // What was done with the same input, recipe and options need not be done again.
/// assert_eq!(print.result_key(input, "--notes"), print.result_key(input, "--notes"));
/// assert_ne!(print.result_key(input, "--notes"), print.result_key(input, ""));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Serialize, serde::Deserialize)]
pub struct RecipeFingerprint {
    /// The digest of all of them, in their order. Names do not count, so a recipe that was moved is the same
    /// recipe.
    pub sha256: Digest,
    /// The recipe, its setup files, its material, its models and its stock.
    pub files: Vec<FileFingerprint>,
}

impl RecipeFingerprint {
    /// Computes the fingerprint of a recipe. `texts` are the files that were read for it and its setup, with
    /// the recipe first. Models and stock that recipe and setup name are read here.
    ///
    /// # Errors
    /// Returns [`codes::UNREADABLE`] for a model or stock file that cannot be read.
    pub fn read_files(texts: &[Arc<Source>], recipe: &Recipe, setup: &Setup) -> Result<Self, Failure> {
        let read = |source: &Arc<Source>| FileFingerprint {
            path: source.name().to_owned(),
            sha256: Digest::from_bytes(source.bytes()),
        };
        let mut files: Vec<FileFingerprint> = texts.iter().map(read).collect();
        for path in list_binary_files(recipe, setup) {
            let name = path.to_string_lossy().into_owned();
            let sha256 = Digest::from_file(&path).map_err(|error| {
                Diagnostic::new(codes::UNREADABLE, format!("{name} cannot be read: {error}"))
            })?;
            files.push(FileFingerprint { path: name, sha256 });
        }
        let sha256 = Digest::from_parts(files.iter().map(|file| file.sha256.bytes()));
        Ok(Self { sha256, files })
    }

    /// Computes the key that decides the result of a file: its content, this recipe, what the command line
    /// adds (dialect, denied codes), and the version of clsmith.
    pub fn result_key(&self, input: Digest, options: &str) -> Digest {
        Digest::from_parts([input.bytes(), self.sha256.bytes(), options.as_bytes(), VERSION.as_bytes()])
    }
}

/// Returns files that are no text: models of steps, and the stock.
fn list_binary_files(recipe: &Recipe, setup: &Setup) -> Vec<PathBuf> {
    let recipe_file = Path::new(recipe.source.name());
    let read = recipe.steps.iter().flat_map(|step| step.transform().reads());
    let models = read.map(|file| file.resolve_beside(recipe_file));
    models.chain(setup.stock_files().map(Path::to_path_buf)).collect()
}

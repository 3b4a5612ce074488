//! This module writes what a run did as JSON, for other programs and for undo.

use super::{BlockChecksums, UndoPatch};
use crate::diagnostic::Diagnostic;
use crate::fingerprint::{Digest, RecipeFingerprint, VERSION};
use crate::presentation::safe_json::write_json;
use crate::program::Program;
use crate::recipe::Provenance;
use crate::report::changes::RecipeChanges;
use crate::report::render::json::FindingsJson;
use serde::{Deserialize, Serialize};
use std::io::{self, Write};

/// The name of the format.
pub(crate) const FORMAT: &str = "clsmith run";

/// The version of the format. It changes when readers have to change. New keys may be added without that.
pub(crate) const FORMAT_VERSION: u32 = 1;

/// The report of a run on one file.
#[derive(Debug, Serialize)]
pub struct RunReport<'r> {
    /// What the file is, `clsmith run`.
    pub format: &'static str,
    /// The version of the format.
    pub version: u32,
    /// The version of clsmith.
    pub clsmith: &'static str,
    /// The file as it was read.
    pub input: FileIdentity,
    /// The file as it was written. It is `None` if the program was refused, so that there is no such file.
    pub output: Option<CorrectedFile>,
    /// The recipe and all files that it depends on.
    pub recipe: &'r RecipeFingerprint,
    /// What the output states about the run.
    pub provenance: Provenance,
    /// The changes of each step, with lengths and times.
    pub changes: &'r RecipeChanges,
    /// What was found, as every other output of the run has it.
    pub findings: FindingsJson<'r>,
    /// The way back.
    pub undo: UndoPatch,
}

/// A file: its name in the run, its size and its digest.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct FileIdentity {
    /// The path as it was opened.
    pub file: String,
    /// Its size in bytes.
    pub bytes: usize,
    /// Its digest.
    pub sha256: Digest,
}

/// The corrected file.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct CorrectedFile {
    /// The path where it was written. It is `None` if it was not written (`--dry-run`), or went to standard
    /// output.
    pub file: Option<String>,
    /// Its size in bytes.
    pub bytes: usize,
    /// Its digest.
    pub sha256: Digest,
    /// The checksums of each 1024 bytes.
    pub crc32: BlockChecksums,
}

impl<'r> RunReport<'r> {
    /// Makes the report of what steps have made of a program that is written to `file`.
    pub fn from_program(
        program: &Program,
        file: Option<String>,
        recipe: &'r RecipeFingerprint,
        provenance: Provenance,
        changes: &'r RecipeChanges,
    ) -> Self {
        let source = program.source();
        Self {
            format: FORMAT,
            version: FORMAT_VERSION,
            clsmith: VERSION,
            input: FileIdentity {
                file: source.name().to_owned(),
                bytes: source.bytes().len(),
                sha256: Digest::from_bytes(source.bytes()),
            },
            output: Some(CorrectedFile {
                file,
                bytes: program.byte_chunks().map(<[u8]>::len).sum(),
                sha256: Digest::from_chunks(program.byte_chunks()),
                crc32: BlockChecksums::from_chunks(program.byte_chunks()),
            }),
            recipe,
            provenance,
            changes,
            findings: FindingsJson::from_findings(&[]),
            undo: UndoPatch::from_program(program),
        }
    }

    /// Adds what was found in the run, as the policy left it. With an error among it the program was refused, so the
    /// report has no output and nothing to undo.
    #[must_use]
    pub fn with_findings(mut self, findings: &'r [Diagnostic]) -> Self {
        self.findings = FindingsJson::from_findings(findings);
        if findings.iter().any(Diagnostic::is_error) {
            self.output = None;
            self.undo = UndoPatch::default();
        }
        self
    }

    /// Writes it as one line of JSON.
    ///
    /// # Errors
    /// Returns the error of the writer.
    pub fn write_json(&self, out: &mut dyn Write) -> io::Result<()> {
        write_json(&mut *out, self)?;
        out.write_all(b"\n")
    }
}

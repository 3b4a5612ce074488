//! This module is the catalogue: every code that clsmith can report, each with a line of meaning, a help and
//! a long explanation.
//!
//! A new code is a row in the file of its area. Codes are stable: a retired one is never used again.

mod checking;
mod files;
mod forces;
mod machines;
mod reading;
mod recipe;
mod running;
mod simulating;
mod surfaces;

use super::Severity;
use std::fmt;

/// A row of the catalogue.
#[derive(Debug)]
pub(super) struct CatalogueEntry {
    /// The id of the code: `CL0001`.
    pub id: &'static str,
    /// The severity, unless it is changed on the command line.
    pub severity: Severity,
    /// The meaning of the code, in one line.
    pub meaning: &'static str,
    /// What to do about it, in a sentence. It may be empty.
    pub help: &'static str,
    /// An explanation of a few paragraphs for `clsmith explain`.
    pub explanation: &'static str,
}

/// A code of the catalogue. It is cheap to copy and compare.
#[derive(Clone, Copy)]
pub struct DiagnosticCode(&'static CatalogueEntry);

impl DiagnosticCode {
    /// Returns the id: `CL0001`.
    pub fn id(self) -> &'static str {
        self.0.id
    }
    /// Returns the severity, unless it is changed on the command line.
    pub fn severity(self) -> Severity {
        self.0.severity
    }
    /// Returns the meaning of the code, in one line.
    pub fn meaning(self) -> &'static str {
        self.0.meaning
    }
    /// Returns what to do about it. It may be empty.
    pub fn help(self) -> &'static str {
        self.0.help
    }
    /// Returns an explanation of a few paragraphs for `clsmith explain`.
    pub fn explanation(self) -> &'static str {
        self.0.explanation
    }
}

impl PartialEq for DiagnosticCode {
    fn eq(&self, other: &Self) -> bool {
        self.0.id == other.0.id
    }
}
impl Eq for DiagnosticCode {}
impl std::hash::Hash for DiagnosticCode {
    fn hash<H: std::hash::Hasher>(&self, state: &mut H) {
        self.0.id.hash(state);
    }
}
impl PartialOrd for DiagnosticCode {
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }
}
impl Ord for DiagnosticCode {
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        self.0.id.cmp(other.0.id)
    }
}
impl fmt::Debug for DiagnosticCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0.id)
    }
}
impl fmt::Display for DiagnosticCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0.id)
    }
}

/// Writes an area of the catalogue: the constants to report with, and the rows to list.
macro_rules! area {
    ($($name:ident = $id:literal, $severity:ident, $meaning:literal, $help:literal, $explanation:literal;)*) => {
        $(
            #[doc = concat!("`", $id, "`: ", $meaning, ".")]
            pub const $name: $crate::diagnostic::DiagnosticCode = $crate::diagnostic::catalogue::code_of_entry(&$crate::diagnostic::catalogue::CatalogueEntry {
                id: $id,
                severity: $crate::diagnostic::Severity::$severity,
                meaning: $meaning,
                help: $help,
                explanation: $explanation,
            });
        )*
        pub(super) const ROWS: &[$crate::diagnostic::DiagnosticCode] = &[$($name),*];
    };
}
pub(crate) use area;

pub(crate) const fn code_of_entry(entry: &'static CatalogueEntry) -> DiagnosticCode {
    DiagnosticCode(entry)
}

/// The constants for all codes, by name.
pub mod codes {
    pub use super::checking::*;
    pub use super::files::*;
    pub use super::forces::*;
    pub use super::machines::*;
    pub use super::reading::*;
    pub use super::recipe::*;
    pub use super::running::*;
    pub use super::simulating::*;
    pub use super::surfaces::*;
}

/// All codes, area by area, in the order of their ids.
pub const CATALOGUE: &[&[DiagnosticCode]] = &[
    reading::ROWS,
    checking::ROWS,
    recipe::ROWS,
    running::ROWS,
    files::ROWS,
    simulating::ROWS,
    surfaces::ROWS,
    machines::ROWS,
    forces::ROWS,
];

/// Returns the code with an id, in upper or lower case.
///
/// ```
/// use clsmith::diagnostic::{Severity, find_code};
///
/// let code = find_code("CL0003").expect("the code is in the catalogue");
/// assert_eq!(code.severity(), Severity::Error);
/// assert_eq!(find_code("CL9999"), None);
/// ```
pub fn find_code(id: &str) -> Option<DiagnosticCode> {
    CATALOGUE.iter().flat_map(|rows| rows.iter()).copied().find(|code| code.id().eq_ignore_ascii_case(id))
}

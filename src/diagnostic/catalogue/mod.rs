//! The catalogue: every code clsmith can report, each with one line of meaning, help and a long explanation.
//!
//! A new code is one row in the file of its area. Codes are stable: a retired one is never used again.

mod checking;
mod files;
mod reading;
mod recipe;
mod running;
mod simulating;
mod surfaces;

use super::Severity;
use std::fmt;

/// A row of the catalogue.
#[derive(Debug)]
pub struct CatalogueEntry {
    /// `CL0001`.
    pub id: &'static str,
    /// Severity unless changed on the command line.
    pub severity: Severity,
    /// One line: what the code says.
    pub meaning: &'static str,
    /// What to do about it, in a sentence; may be empty.
    pub help: &'static str,
    /// A few paragraphs for `clsmith explain`.
    pub explanation: &'static str,
}

/// A code of the catalogue; cheap to copy and compare.
#[derive(Clone, Copy)]
pub struct DiagnosticCode(&'static CatalogueEntry);

impl DiagnosticCode {
    /// `CL0001`.
    pub fn id(self) -> &'static str {
        self.0.id
    }
    /// Severity unless changed on the command line.
    pub fn severity(self) -> Severity {
        self.0.severity
    }
    /// One line: what the code says.
    pub fn meaning(self) -> &'static str {
        self.0.meaning
    }
    /// What to do about it; may be empty.
    pub fn help(self) -> &'static str {
        self.0.help
    }
    /// A few paragraphs for `clsmith explain`.
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

/// Writes one area of the catalogue: constants to report with, and the rows to list.
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

/// Constants for all codes, by name.
pub mod codes {
    pub use super::checking::*;
    pub use super::files::*;
    pub use super::reading::*;
    pub use super::recipe::*;
    pub use super::running::*;
    pub use super::simulating::*;
    pub use super::surfaces::*;
}

/// Every code, area by area, in the order of their ids.
pub const CATALOGUE: &[&[DiagnosticCode]] = &[
    reading::ROWS,
    checking::ROWS,
    recipe::ROWS,
    running::ROWS,
    files::ROWS,
    simulating::ROWS,
    surfaces::ROWS,
];

/// Looks a code up by its id, in any case.
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

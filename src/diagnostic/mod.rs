//! This module holds diagnostics as plain data: a code from the catalogue, a message, and labels that point
//! into files.
//!
//! Nothing here prints. `report::render` turns diagnostics into text for people, JSON or SARIF.

mod catalogue;
mod failure;
mod short_text;

pub use catalogue::codes;
pub use catalogue::{CATALOGUE, DiagnosticCode, find_code};
pub use failure::Failure;

use crate::source::{Source, Span};
use short_text::shorten_text;
use std::fmt;
use std::sync::Arc;

/// The severity of a finding. Nothing is written while there is an [`Severity::Error`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// It is worth knowing. Notes are only shown on request.
    Note,
    /// The program may do something that its author did not intend.
    Warning,
    /// The program or the recipe is wrong, and nothing is written.
    Error,
}

impl fmt::Display for Severity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Note => "note",
            Self::Warning => "warning",
            Self::Error => "error",
        })
    }
}

/// A place in a file, with a text about it.
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct DiagnosticLabel {
    /// The file: a CL file, a recipe or a setup file.
    pub source: Arc<Source>,
    /// The bytes that are meant.
    pub span: Span,
    /// The text about the place, which may be empty.
    pub message: String,
}

/// A finding with its places. The first label is the primary one.
///
/// ```
/// use clsmith::diagnostic::{Diagnostic, codes};
/// use clsmith::source::{Source, Span};
///
/// let source = Source::new("part.cls", b"GOTO/1,2,3O\n".to_vec())?;
/// let found = Diagnostic::new(codes::BAD_NUMBER, "`3O` is not a number")
///     .with_label(&source, Span::new(9, 11), "a letter O?");
/// assert!(found.is_error());
/// assert_eq!(found.code.id(), "CL0003");
/// let label = &found.labels[0];
/// assert_eq!(label.source.line_column(label.span.start), (1, 10));
/// # Ok::<(), clsmith::source::SourceTooLarge>(())
/// ```
#[derive(Debug, Clone)]
#[non_exhaustive]
pub struct Diagnostic {
    /// Its entry in the catalogue.
    pub code: DiagnosticCode,
    /// The severity of the catalogue, unless `--deny` or `--allow` has changed it.
    pub severity: Severity,
    /// A sentence about this particular finding.
    pub message: String,
    /// The places. They are empty for findings about a whole file or run.
    pub labels: Vec<DiagnosticLabel>,
    /// What to do. It is the help of the catalogue, unless the finding has a better one.
    pub help: Option<String>,
    /// Whether `--allow` named its code. It is then counted and shown as allowed by hand, and stops nothing.
    pub is_allowed: bool,
    /// The step of the recipe that found it, from 1. It is `None` for findings about the input or the whole
    /// run.
    pub step: Option<usize>,
    /// How bad it is beside others of its code, in the unit of its message (a depth, a load); the largest is
    /// shown first. `None` where they are alike.
    pub magnitude: Option<f64>,
}

impl Diagnostic {
    /// A finding with the catalogue's severity and help. A message of more than some hundred characters, as one with a
    /// word of 70,000, is cut in its middle; so are labels and helps.
    pub fn new(code: DiagnosticCode, message: impl Into<String>) -> Self {
        let help = (!code.help().is_empty()).then(|| code.help().to_owned());
        Self {
            code,
            severity: code.severity(),
            message: shorten_text(message.into()),
            labels: Vec::new(),
            help,
            is_allowed: false,
            step: None,
            magnitude: None,
        }
    }

    /// Adds a place. The first one that is added is the primary one.
    #[must_use]
    pub fn with_label(mut self, source: &Arc<Source>, span: Span, message: impl Into<String>) -> Self {
        self.labels.push(DiagnosticLabel {
            source: Arc::clone(source),
            span,
            message: shorten_text(message.into()),
        });
        self
    }

    /// Replaces the help of the catalogue by a help for this finding.
    #[must_use]
    pub fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(shorten_text(help.into()));
        self
    }

    /// Says how bad the finding is beside others of its code.
    #[must_use]
    pub fn with_magnitude(mut self, magnitude: f64) -> Self {
        self.magnitude = Some(magnitude);
        self
    }

    /// Returns whether no program may be written while the finding stands: it is an error that nobody
    /// allowed.
    pub fn is_error(&self) -> bool {
        self.severity == Severity::Error && !self.is_allowed
    }
}

//! Why a command ended before its end.

use clsmith::diagnostic::{Diagnostic, Failure};

/// Why a run ended before its end.
pub enum CommandStop {
    /// What stands in its way; nothing more where that was told already.
    Found(Vec<Diagnostic>),
    /// Ctrl-C.
    Interrupted,
}

impl From<Failure> for CommandStop {
    fn from(failure: Failure) -> Self {
        match failure {
            Failure::Found(found) => Self::Found(found),
            Failure::Interrupted => Self::Interrupted,
        }
    }
}

impl From<Vec<Diagnostic>> for CommandStop {
    fn from(found: Vec<Diagnostic>) -> Self {
        Self::Found(found)
    }
}

impl From<Diagnostic> for CommandStop {
    fn from(found: Diagnostic) -> Self {
        Self::Found(vec![found])
    }
}

//! An argument of the command line that means nothing.

use std::borrow::Cow;

/// Why an argument means nothing, as a sentence without its full stop; clap shows it beside the argument.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct BadArgument(Cow<'static, str>);

impl BadArgument {
    /// Makes the error.
    pub fn new(reason: impl Into<Cow<'static, str>>) -> Self {
        Self(reason.into())
    }
}

//! This module holds the error for an argument of the command line that is not valid.

use std::borrow::Cow;

/// The reason why an argument is not valid, as a sentence without a full stop. clap shows it beside the
/// argument.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub(super) struct BadArgument(Cow<'static, str>);

impl BadArgument {
    /// Makes the error.
    pub(super) fn new(reason: impl Into<Cow<'static, str>>) -> Self {
        Self(reason.into())
    }
}

//! This module describes the fault of a text in a rule.

use std::fmt;

/// The fault of a text in a rule, and what to do about it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RuleFault {
    /// The fault, worded as a sentence without a full stop.
    message: String,
    /// What to do. It is empty if the message says so already.
    help: String,
}

impl RuleFault {
    /// Makes a fault with its help.
    pub fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: help.into() }
    }

    /// Makes a fault whose message needs no help.
    pub fn without_help(message: impl Into<String>) -> Self {
        Self::new(message, "")
    }
}

/// The reader of recipes takes what follows a line break as the help, because serde passes errors on as a
/// single text.
impl fmt::Display for RuleFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        if self.help.is_empty() { Ok(()) } else { write!(f, "\n{}", self.help) }
    }
}

impl std::error::Error for RuleFault {}

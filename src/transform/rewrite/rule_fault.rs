//! What is wrong with a text of a rule.

use std::fmt;

/// What is wrong with a text of a rule, and what to do about it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RuleFault {
    /// The fault, as a sentence without its full stop.
    message: String,
    /// What to do; empty where the message says it.
    help: String,
}

impl RuleFault {
    /// Makes a fault with its help.
    pub fn new(message: impl Into<String>, help: impl Into<String>) -> Self {
        Self { message: message.into(), help: help.into() }
    }

    /// Makes a fault whose message says all.
    pub fn without_help(message: impl Into<String>) -> Self {
        Self::new(message, "")
    }
}

/// The reader of recipes takes what follows a line break for the help: serde hands errors on as one text.
impl fmt::Display for RuleFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)?;
        if self.help.is_empty() { Ok(()) } else { write!(f, "\n{}", self.help) }
    }
}

impl std::error::Error for RuleFault {}

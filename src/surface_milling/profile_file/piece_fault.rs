//! This module holds the faults of a profile's pieces.

/// A fault of a piece, at one of its keys and at an element of that key's list.
pub(super) struct PieceFault {
    pub message: String,
    pub label: &'static str,
    pub help: Option<String>,
    pub key: Option<&'static str>,
    pub index: Option<usize>,
}

impl PieceFault {
    pub(super) fn new(message: impl Into<String>, label: &'static str) -> Self {
        Self { message: message.into(), label, help: None, key: None, index: None }
    }

    pub(super) fn at_key(mut self, key: &'static str) -> Self {
        self.key = Some(key);
        self
    }

    pub(super) fn with_help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(help.into());
        self
    }
}

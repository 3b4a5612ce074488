//! This module holds the faults that serde finds in a value, as data that is put into words later.

use super::fault_words;
use serde::de::{self, Expected, Unexpected};
use std::fmt;

/// The kinds of fault.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum YamlFaultKind {
    /// The map has no such key.
    UnknownKey { name: String, expected: &'static [&'static str] },
    /// The name is none of the choices.
    UnknownChoice { name: String, expected: &'static [&'static str] },
    /// A required key is missing.
    Missing { name: &'static str },
    /// The type is wrong, for example text in place of a number.
    Type { found: String, expected: String },
    /// The type is right, but the value is wrong. It has the message, and a help if the type provides one.
    Value { message: String, help: Option<String> },
    /// A choice with settings is written as a single name with its settings below. Here there is no name, or
    /// there are several.
    NotOneName { names: Vec<String> },
}

/// A fault and its place: the indices of the entries on the path from the root, with the innermost first.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct YamlFault {
    pub kind: YamlFaultKind,
    pub path: Vec<usize>,
    /// Whether the key of the last entry is meant, not its value.
    pub at_key: bool,
}

impl YamlFault {
    pub(super) fn new(kind: YamlFaultKind) -> Self {
        Self { kind, path: Vec::new(), at_key: false }
    }

    /// Returns the fault as seen from the parent, when it lies in the value of entry `index`.
    pub(super) fn in_value_of(mut self, index: usize) -> Self {
        self.path.push(index);
        self
    }

    /// Returns the fault as seen from the parent, when it is the key of entry `index`.
    pub(super) fn in_key_of(mut self, index: usize) -> Self {
        self.at_key = true;
        self.path.push(index);
        self
    }
}

impl fmt::Display for YamlFault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.kind)
    }
}

impl std::error::Error for YamlFault {}

impl de::Error for YamlFault {
    /// Makes a fault from a message. Text after its first line break is the help.
    fn custom<T: fmt::Display>(message: T) -> Self {
        let text = message.to_string();
        let (message, help) = match text.split_once('\n') {
            Some((message, help)) => (message.to_owned(), Some(help.to_owned())),
            None => (text, None),
        };
        Self::new(YamlFaultKind::Value { message, help })
    }
    fn invalid_type(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::new(YamlFaultKind::Type {
            found: fault_words::describe_found(found),
            expected: fault_words::describe_expected(expected),
        })
    }
    fn invalid_value(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        let message = format!(
            "expected {}, found {}",
            fault_words::describe_expected(expected),
            fault_words::describe_found(found)
        );
        Self::new(YamlFaultKind::Value { message, help: None })
    }
    fn invalid_length(count: usize, expected: &dyn Expected) -> Self {
        let message = format!(
            "expected {}, found {}",
            fault_words::describe_expected(expected),
            fault_words::count_elements(count)
        );
        Self::new(YamlFaultKind::Value { message, help: None })
    }
    fn unknown_variant(name: &str, expected: &'static [&'static str]) -> Self {
        Self::new(YamlFaultKind::UnknownChoice { name: name.to_owned(), expected })
    }
    fn unknown_field(name: &str, expected: &'static [&'static str]) -> Self {
        Self::new(YamlFaultKind::UnknownKey { name: name.to_owned(), expected })
    }
    fn missing_field(name: &'static str) -> Self {
        Self::new(YamlFaultKind::Missing { name })
    }
    fn duplicate_field(name: &'static str) -> Self {
        Self::new(YamlFaultKind::Value {
            message: format!("`{name}` is given twice, by two of its names"),
            help: None,
        })
    }
}

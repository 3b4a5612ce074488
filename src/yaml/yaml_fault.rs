//! What serde found wrong with a value, kept as data until it is put in words.

use super::fault_words;
use serde::de::{self, Expected, Unexpected};
use std::fmt;

/// What is wrong.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum YamlFaultKind {
    /// A key that the map does not have.
    UnknownKey { name: String, expected: &'static [&'static str] },
    /// A name that is none of the choices.
    UnknownChoice { name: String, expected: &'static [&'static str] },
    /// A key that has to be there and is not.
    Missing { name: &'static str },
    /// Text where a number belongs, and the like.
    Type { found: String, expected: String },
    /// The right type with a wrong value: the message, and help if the type knows any.
    Value { message: String, help: Option<String> },
    /// A choice with settings is written as one name with its settings below; here are none, or several.
    NotOneName { names: Vec<String> },
}

/// What is wrong, and where: numbers of the entries on the way from the root, innermost first.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct YamlFault {
    pub kind: YamlFaultKind,
    pub path: Vec<usize>,
    /// Whether the key of the last entry is meant rather than its value.
    pub at_key: bool,
}

impl YamlFault {
    pub fn new(kind: YamlFaultKind) -> Self {
        Self { kind, path: Vec::new(), at_key: false }
    }

    /// The fault, seen from the parent: it lies in the value of entry `index`.
    pub fn in_value_of(mut self, index: usize) -> Self {
        self.path.push(index);
        self
    }

    /// The fault, seen from the parent: it is the key of entry `index`.
    pub fn in_key_of(mut self, index: usize) -> Self {
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
    /// A message; what follows its first line break is help.
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

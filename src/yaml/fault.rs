//! What serde found wrong with a value, kept as data until it is put in words.

use super::words;
use serde::de::{self, Expected, Unexpected};
use std::fmt;

/// What is wrong.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Kind {
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
pub(crate) struct Fault {
    pub kind: Kind,
    pub path: Vec<usize>,
    /// Whether the key of the last entry is meant rather than its value.
    pub at_key: bool,
}

impl Fault {
    pub fn new(kind: Kind) -> Self {
        Self { kind, path: Vec::new(), at_key: false }
    }

    /// The fault, seen from the parent: it lies in the value of entry `index`.
    pub fn inside(mut self, index: usize) -> Self {
        self.path.push(index);
        self
    }

    /// The fault, seen from the parent: it is the key of entry `index`.
    pub fn key(mut self, index: usize) -> Self {
        self.at_key = true;
        self.path.push(index);
        self
    }
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{:?}", self.kind)
    }
}

impl std::error::Error for Fault {}

impl de::Error for Fault {
    /// A message; what follows its first line break is help.
    fn custom<T: fmt::Display>(message: T) -> Self {
        let text = message.to_string();
        let (message, help) = match text.split_once('\n') {
            Some((message, help)) => (message.to_owned(), Some(help.to_owned())),
            None => (text, None),
        };
        Self::new(Kind::Value { message, help })
    }
    fn invalid_type(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::new(Kind::Type { found: words::found(found), expected: words::expected(expected) })
    }
    fn invalid_value(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        let message = format!("expected {}, found {}", words::expected(expected), words::found(found));
        Self::new(Kind::Value { message, help: None })
    }
    fn invalid_length(count: usize, expected: &dyn Expected) -> Self {
        let message = format!("expected {}, found {}", words::expected(expected), words::elements(count));
        Self::new(Kind::Value { message, help: None })
    }
    fn unknown_variant(name: &str, expected: &'static [&'static str]) -> Self {
        Self::new(Kind::UnknownChoice { name: name.to_owned(), expected })
    }
    fn unknown_field(name: &str, expected: &'static [&'static str]) -> Self {
        Self::new(Kind::UnknownKey { name: name.to_owned(), expected })
    }
    fn missing_field(name: &'static str) -> Self {
        Self::new(Kind::Missing { name })
    }
    fn duplicate_field(name: &'static str) -> Self {
        Self::new(Kind::Value {
            message: format!("`{name}` is given twice, by two of its names"),
            help: None,
        })
    }
}

//! This module reads arguments that have known values, so that shells can complete them.

use clap::builder::{PossibleValue, TypedValueParser};
use clap::{Arg, Command};
use std::ffi::OsStr;

/// A reader of an argument that also knows all values. clap lists them in completions, and in the help unless
/// they are hidden there. The error about a wrong value still comes from the reader.
#[derive(Clone)]
pub(super) struct ChoiceParser<P> {
    read: P,
    names: fn() -> Vec<&'static str>,
}

impl<P> ChoiceParser<P> {
    /// Makes the reader.
    pub(super) fn new(read: P, names: fn() -> Vec<&'static str>) -> Self {
        Self { read, names }
    }
}

impl<P: TypedValueParser> TypedValueParser for ChoiceParser<P> {
    type Value = P::Value;

    fn parse_ref(
        &self,
        command: &Command,
        argument: Option<&Arg>,
        value: &OsStr,
    ) -> Result<Self::Value, clap::Error> {
        self.read.parse_ref(command, argument, value)
    }

    fn possible_values(&self) -> Option<Box<dyn Iterator<Item = PossibleValue> + '_>> {
        Some(Box::new((self.names)().into_iter().map(PossibleValue::new)))
    }
}

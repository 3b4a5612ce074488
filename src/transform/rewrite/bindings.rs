//! This module holds what a pattern has bound in a statement.

use super::expression_value::{ExpressionValue, parse_value};
use super::rule_fault::RuleFault;
use crate::parse::columns::without_full_breaks;
use crate::program::join_broken;
use std::borrow::Cow;
use std::ops::Range;

/// A name that a pattern binds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct BoundName {
    /// The name without the `$`.
    pub text: String,
    /// Whether it binds all remaining arguments.
    pub rest: bool,
}

/// The places of bound arguments in the text of a statement.
#[derive(Debug, Clone, Default)]
pub(super) struct Bindings<'t> {
    text: &'t [u8],
    found: Vec<(&'t str, Range<usize>)>,
}

impl<'t> Bindings<'t> {
    /// Makes bindings without any name.
    pub(super) fn new(text: &'t [u8]) -> Self {
        Self { text, found: Vec::new() }
    }

    /// Binds a name. `None` and `_` bind nothing.
    pub(super) fn bind(&mut self, name: Option<&'t str>, at: Range<usize>) {
        if let Some(name) = name.filter(|name| *name != "_") {
            self.found.push((name, at));
        }
    }

    /// Returns whether a name that is bound several times always has the same value: equal numbers, or the
    /// same word.
    pub(super) fn is_consistent(&self) -> bool {
        self.found.iter().enumerate().all(|(index, (name, at))| {
            let earlier = self.found.iter().take(index).find(|(other, _)| other == name);
            earlier
                .is_none_or(|(_, other)| parse_value(self.bytes_at(other)) == parse_value(self.bytes_at(at)))
        })
    }

    /// Returns the place of a name's argument in the statement's text.
    pub(super) fn argument_range(&self, name: &str) -> Option<Range<usize>> {
        self.found.iter().find(|(bound, _)| *bound == name).map(|(_, at)| at.clone())
    }

    /// Returns the bytes of a name's argument as they stand, without the breaks of full lines, which belong
    /// to their columns. They are empty if the name is not bound.
    pub(super) fn argument_text(&self, name: &str) -> Cow<'t, [u8]> {
        let range = self.argument_range(name).unwrap_or_default();
        without_full_breaks(self.text, &range)
    }

    /// Returns the value of a name's argument.
    pub(super) fn argument_value(&self, name: &str) -> ExpressionValue {
        parse_value(&join_broken(&self.argument_text(name)))
    }

    fn bytes_at(&self, at: &Range<usize>) -> &'t [u8] {
        self.text.get(at.clone()).unwrap_or_default()
    }
}

/// Builds the fault for a name to which no argument is bound.
pub(super) fn unbound_name(name: &str, names: &[BoundName], usual: &str) -> RuleFault {
    let known: Vec<String> = names
        .iter()
        .map(|name| if name.rest { format!("$...{}", name.text) } else { format!("${}", name.text) })
        .collect();
    let bound = match known.as_slice() {
        [] => "Nothing is bound there.".to_owned(),
        known => format!("Bound there: {}.", known.join(", ")),
    };
    let longer =
        names.iter().filter(|known| name.starts_with(&known.text)).max_by_key(|known| known.text.len());
    let help = match longer {
        Some(known) => format!("Where letters follow a name, write ${{{}}}.", known.text),
        None => usual.to_owned(),
    };
    RuleFault::new(format!("`{name}` is not bound by `match`"), format!("{bound} {help}").trim_end())
}

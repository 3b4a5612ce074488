//! This module reads YAML files that people write by hand, checks them against a type, and reports every
//! fault at its exact place.
//!
//! [`YamlDocument::parse`] turns text into a tree, or says why it is no YAML. [`YamlDocument::deserialize_checked`]
//! turns the tree into a type and reports all faults, not only the first. [`YamlDocument::value_span`]
//! returns the place of a value at any time later. Recipes and setup files are read by this module, which
//! knows nothing of their content.

mod fault_diagnostics;
mod fault_words;
mod file_schema;
mod node_deserializer;
mod node_length;
mod node_location;
mod typed_document;
mod yaml_fault;
mod yaml_syntax;
mod yaml_tree;

pub(crate) use fault_diagnostics::{LocatedYamlFault, suggest_names};
pub(crate) use file_schema::make_file_schema;
pub(crate) use yaml_fault::YamlFaultKind;

use crate::diagnostic::Failure;
use crate::source::{Source, Span};
use node_location::KeyOrValue;
use std::fmt;
use std::sync::Arc;
use yaml_tree::YamlNode;

/// A segment of the path from the root of a document to one of its values.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum YamlPathSegment<'a> {
    /// The value of a key.
    Key(&'a str),
    /// An element of a list, counted from 0.
    Index(usize),
}

/// A file as a tree of values with their places.
pub(crate) struct YamlDocument {
    source: Arc<Source>,
    /// The length of the byte order mark.
    base: usize,
    root: YamlNode,
}

impl YamlDocument {
    /// Reads the text.
    ///
    /// # Errors
    /// Returns the reason why the bytes are not a YAML document.
    pub(crate) fn parse(source: &Arc<Source>) -> Result<Self, Failure> {
        let (text, base) = yaml_syntax::check_text(source)?;
        let root = yaml_syntax::parse_tree(source, text, base)?;
        Ok(Self { source: Arc::clone(source), base, root })
    }

    /// Returns the file from which it was read.
    pub(crate) fn source(&self) -> &Arc<Source> {
        &self.source
    }

    /// Returns the place of a value. An empty value has the place of its key. Returns `None` if there is no
    /// such value.
    pub(crate) fn value_span(&self, path: &[YamlPathSegment<'_>]) -> Option<Span> {
        self.node_span(&self.resolve_path(path)?, KeyOrValue::Value)
    }

    /// Returns the place of a value's key. List elements have no key, so the place of the value is returned.
    pub(crate) fn key_span(&self, path: &[YamlPathSegment<'_>]) -> Option<Span> {
        let numbers = self.resolve_path(path)?;
        let part = if matches!(path.last(), Some(YamlPathSegment::Key(_))) {
            KeyOrValue::Key
        } else {
            KeyOrValue::Value
        };
        self.node_span(&numbers, part)
    }

    /// Returns the keys of the map at the end of a path.
    pub(crate) fn list_keys(&self, path: &[YamlPathSegment<'_>]) -> Vec<&str> {
        match self.resolve_path(path).and_then(|numbers| self.root.node_at_path(&numbers)) {
            Some(YamlNode::Map(entries)) => entries.iter().map(|entry| entry.key.as_str()).collect(),
            _ => Vec::new(),
        }
    }

    fn yaml_text(&self) -> &str {
        let bytes = self.source.bytes().get(self.base..).unwrap_or_default();
        std::str::from_utf8(bytes).unwrap_or_default()
    }

    fn resolve_path(&self, path: &[YamlPathSegment<'_>]) -> Option<Vec<usize>> {
        let mut node = &self.root;
        let mut numbers = Vec::with_capacity(path.len());
        for segment in path {
            let index = match segment {
                YamlPathSegment::Key(key) => node.find_entry(key)?.index,
                YamlPathSegment::Index(index) => *index,
            };
            node = node.child_at(index)?;
            numbers.push(index);
        }
        Some(numbers)
    }

    fn node_span(&self, path: &[usize], part: KeyOrValue) -> Option<Span> {
        let parent =
            path.split_last().and_then(|(last, parent)| Some((self.root.node_at_path(parent)?, *last)));
        let entry = parent.and_then(|(node, last)| node.entry_at(last));
        let value = self.root.node_at_path(path);
        if part == KeyOrValue::Value && entry.is_some() && value == Some(&YamlNode::Null) {
            return self.node_span(path, KeyOrValue::Key);
        }
        let text = self.yaml_text();
        let offset = node_location::find_node_offset(text, path, part)?;
        let plain = match (part, entry, value) {
            (KeyOrValue::Key, Some(entry), _) => Some(entry.key.as_str()),
            (KeyOrValue::Value, _, Some(YamlNode::Text(text))) => Some(text.as_str()),
            _ => None,
        };
        let span = node_location::find_node_span(text, offset, plain);
        // An element `- ` without a value only shows its dash.
        let dash = text.get(..span.to_range().start).map(|before| before.trim_end().len());
        Some(match dash {
            Some(end) if span.is_empty() && end > 0 => Span::new(self.base + end - 1, self.base + end),
            _ => Span::new(self.base + span.to_range().start, self.base + span.to_range().end),
        })
    }
}

impl fmt::Debug for YamlDocument {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Document({:?})", self.source)
    }
}

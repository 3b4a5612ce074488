//! YAML files that people write by hand: read, checked against a type, every fault at its exact place.
//!
//! [`Document::read`] turns text into a tree or says why it is no YAML; [`Document::check`] turns the tree into a type
//! and reports all it finds, not only the first fault; [`Document::place`] says where a value stands, at any time later.
//! Recipes and setup files go through here; nothing here knows what is in them.

mod check;
mod de;
mod explain;
mod fault;
mod locate;
mod node;
mod syntax;
mod tokens;
mod words;

pub(crate) use explain::{Finding, suggestion};
pub(crate) use fault::Kind;

use crate::diagnostic::Diagnostic;
use crate::source::{Source, Span};
use locate::Part;
use node::Node;
use std::fmt;
use std::sync::Arc;

/// A step of the way from the root of a document to one of its values.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Segment<'a> {
    /// The value of a key.
    Key(&'a str),
    /// An element of a list, from 0.
    Index(usize),
}

/// A file as a tree of values with places.
pub(crate) struct Document {
    source: Arc<Source>,
    /// Length of the byte order mark.
    base: usize,
    root: Node,
}

impl Document {
    /// Reads the text.
    ///
    /// # Errors
    /// The one reason why the bytes are not a YAML document.
    pub fn read(source: &Arc<Source>) -> Result<Self, Box<Diagnostic>> {
        let (text, base) = syntax::text(source)?;
        let root = syntax::read(source, text, base)?;
        Ok(Self { source: Arc::clone(source), base, root })
    }

    /// The file it was read from.
    pub fn source(&self) -> &Arc<Source> {
        &self.source
    }

    /// Where a value stands; an empty value stands at its key. `None` if there is no such value.
    pub fn place(&self, path: &[Segment<'_>]) -> Option<Span> {
        self.span(&self.numbers(path)?, Part::Value)
    }

    /// Where the key of a value stands; list elements have none and stand where the value does.
    pub fn key_place(&self, path: &[Segment<'_>]) -> Option<Span> {
        let numbers = self.numbers(path)?;
        let part = if matches!(path.last(), Some(Segment::Key(_))) { Part::Key } else { Part::Value };
        self.span(&numbers, part)
    }

    /// The keys of the map at the end of a path.
    pub fn keys(&self, path: &[Segment<'_>]) -> Vec<&str> {
        match self.numbers(path).and_then(|numbers| self.root.at(&numbers)) {
            Some(Node::Map(entries)) => entries.iter().map(|entry| entry.key.as_str()).collect(),
            _ => Vec::new(),
        }
    }

    fn text(&self) -> &str {
        let bytes = self.source.bytes().get(self.base..).unwrap_or_default();
        std::str::from_utf8(bytes).unwrap_or_default()
    }

    fn numbers(&self, path: &[Segment<'_>]) -> Option<Vec<usize>> {
        let mut node = &self.root;
        let mut numbers = Vec::with_capacity(path.len());
        for segment in path {
            let index = match segment {
                Segment::Key(key) => node.get(key)?.index,
                Segment::Index(index) => *index,
            };
            node = node.child(index)?;
            numbers.push(index);
        }
        Some(numbers)
    }

    fn span(&self, path: &[usize], part: Part) -> Option<Span> {
        let parent = path.split_last().and_then(|(last, parent)| Some((self.root.at(parent)?, *last)));
        let entry = parent.and_then(|(node, last)| node.entry(last));
        let value = self.root.at(path);
        if part == Part::Value && entry.is_some() && value == Some(&Node::Null) {
            return self.span(path, Part::Key);
        }
        let text = self.text();
        let offset = locate::offset(text, path, part)?;
        let plain = match (part, entry, value) {
            (Part::Key, Some(entry), _) => Some(entry.key.as_str()),
            (Part::Value, _, Some(Node::Text(text))) => Some(text.as_str()),
            _ => None,
        };
        let span = locate::span(text, offset, plain);
        // `- ` with nothing behind it: the dash is all there is to see.
        let dash = text.get(..span.range().start).map(|before| before.trim_end().len());
        Some(match dash {
            Some(end) if span.is_empty() && end > 0 => Span::new(self.base + end - 1, self.base + end),
            _ => Span::new(self.base + span.range().start, self.base + span.range().end),
        })
    }
}

impl fmt::Debug for Document {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Document({:?})", self.source)
    }
}

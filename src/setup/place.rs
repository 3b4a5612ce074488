//! Where a setup says something.

use crate::source::{Source, Span};
use crate::yaml::{Document, Segment};
use std::sync::Arc;

/// The place of a value in the recipe or setup file that says it.
///
/// Found when it is asked for, by reading the file's text again: ask for diagnostics only. Two places are always equal,
/// so that two setups that say the same are, wherever they say it.
#[derive(Debug, Clone)]
pub struct Place {
    document: Arc<Document>,
    path: Vec<Segment<'static>>,
}

impl Place {
    pub(crate) fn new(document: &Arc<Document>, path: &[Segment<'static>]) -> Self {
        Self { document: Arc::clone(document), path: path.to_vec() }
    }

    /// The file.
    pub fn source(&self) -> &Arc<Source> {
        self.document.source()
    }

    /// The bytes of the value; of a block of lines, the first. A value that is not said stands where the nearest thing
    /// around it does.
    pub fn span(&self) -> Span {
        self.nearest(|path| self.document.place(path))
    }

    /// The bytes of the value's key; of a list element, those of the value.
    pub fn key_span(&self) -> Span {
        self.nearest(|path| self.document.key_place(path))
    }

    pub(super) fn key(&self, key: &'static str) -> Self {
        self.below(Segment::Key(key))
    }

    pub(super) fn index(&self, index: usize) -> Self {
        self.below(Segment::Index(index))
    }

    fn below(&self, segment: Segment<'static>) -> Self {
        let mut path = self.path.clone();
        path.push(segment);
        Self { document: Arc::clone(&self.document), path }
    }

    fn nearest(&self, find: impl Fn(&[Segment<'static>]) -> Option<Span>) -> Span {
        let paths = (0..=self.path.len()).rev().filter_map(|count| self.path.get(..count));
        paths.filter_map(find).next().unwrap_or_default()
    }
}

impl PartialEq for Place {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

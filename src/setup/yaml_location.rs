//! Where a setup says something.

use crate::source::{Source, Span};
use crate::yaml::{YamlDocument, YamlPathSegment};
use std::sync::Arc;

/// The place of a value in the recipe or setup file that says it.
///
/// Found when it is asked for, by reading the file's text again: ask for diagnostics only. Two places are always equal,
/// so that two setups that say the same are, wherever they say it.
#[derive(Debug, Clone)]
pub struct YamlLocation {
    document: Arc<YamlDocument>,
    path: Vec<YamlPathSegment<'static>>,
}

impl YamlLocation {
    pub(crate) fn new(document: &Arc<YamlDocument>, path: &[YamlPathSegment<'static>]) -> Self {
        Self { document: Arc::clone(document), path: path.to_vec() }
    }

    /// The file.
    pub fn source(&self) -> &Arc<Source> {
        self.document.source()
    }

    /// The bytes of the value; of a block of lines, the first. A value that is not said stands where the nearest thing
    /// around it does.
    pub fn value_span(&self) -> Span {
        self.nearest_span(|path| self.document.value_span(path))
    }

    /// The bytes of the value's key; of a list element, those of the value.
    pub fn key_span(&self) -> Span {
        self.nearest_span(|path| self.document.key_span(path))
    }

    pub(super) fn at_key(&self, key: &'static str) -> Self {
        self.at_segment(YamlPathSegment::Key(key))
    }

    pub(super) fn at_index(&self, index: usize) -> Self {
        self.at_segment(YamlPathSegment::Index(index))
    }

    fn at_segment(&self, segment: YamlPathSegment<'static>) -> Self {
        let mut path = self.path.clone();
        path.push(segment);
        Self { document: Arc::clone(&self.document), path }
    }

    fn nearest_span(&self, find: impl Fn(&[YamlPathSegment<'static>]) -> Option<Span>) -> Span {
        let paths = (0..=self.path.len()).rev().filter_map(|count| self.path.get(..count));
        paths.filter_map(find).next().unwrap_or_default()
    }
}

impl PartialEq for YamlLocation {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

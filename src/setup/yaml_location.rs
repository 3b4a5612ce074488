//! This module tells where a setup states something.

use crate::source::{Source, Span};
use crate::yaml::{YamlDocument, YamlPathSegment};
use std::sync::Arc;

/// The place of a value in the recipe or setup file that states it.
///
/// It is only found when it is asked for, by reading the text of the file again, so it is meant for
/// diagnostics. Two places always compare as equal, so that two setups with the same values are equal,
/// wherever they state them.
#[derive(Debug, Clone)]
pub struct YamlLocation {
    document: Arc<YamlDocument>,
    path: Vec<YamlPathSegment<'static>>,
}

impl YamlLocation {
    pub(crate) fn new(document: &Arc<YamlDocument>, path: &[YamlPathSegment<'static>]) -> Self {
        Self { document: Arc::clone(document), path: path.to_vec() }
    }

    /// Returns the file.
    pub fn source(&self) -> &Arc<Source> {
        self.document.source()
    }

    /// Returns the bytes of the value. For a block of lines, these are the bytes of the first line. A value
    /// that is not given is placed at the nearest key around it.
    pub fn value_span(&self) -> Span {
        self.nearest_span(|path| self.document.value_span(path))
    }

    /// Returns the bytes of the value's key. For a list element, these are the bytes of its value.
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
        // The root of a document always has a place; an empty file has nothing else to point at.
        paths.filter_map(find).next().unwrap_or_default()
    }
}

impl PartialEq for YamlLocation {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

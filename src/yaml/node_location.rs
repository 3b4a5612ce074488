//! This module finds the place of a node of the tree in the text.
//!
//! serde_yaml only gives places in errors. So a place is found by descending to the node and failing there on
//! purpose. Each search reads the text once more, but recipes are small, and places are only needed for
//! diagnostics.

use super::node_length;
use crate::source::Span;
use serde::de::{
    DeserializeSeed, Deserializer, EnumAccess, Error as _, IgnoredAny, MapAccess, SeqAccess, Visitor,
};
use std::fmt;

/// The part of a path's last entry that is meant.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum KeyOrValue {
    Key,
    Value,
}

/// Returns the offset at which the node at the end of `path` starts, including its anchor.
pub(super) fn find_node_offset(text: &str, path: &[usize], part: KeyOrValue) -> Option<usize> {
    let document = serde_yaml::Deserializer::from_str(text).next()?;
    let error = NodeSeeker { path, part }.deserialize(document).err()?;
    Some(error.location()?.index().min(text.len()))
}

/// Returns the offset at which the second document of a stream starts.
pub(super) fn find_second_document(text: &str) -> Option<usize> {
    let document = serde_yaml::Deserializer::from_str(text).nth(1)?;
    let error = NodeSeeker { path: &[], part: KeyOrValue::Value }.deserialize(document).err()?;
    Some(error.location()?.index().min(text.len()))
}

/// Returns the bytes of the key or value that starts at `offset`. `plain` is its text if it is a scalar of
/// text.
pub(super) fn find_node_span(text: &str, offset: usize, plain: Option<&str>) -> Span {
    let start = node_length::skip_anchor_and_tag(text, offset);
    let end = start + node_length::measure_node(text.get(start..).unwrap_or_default(), plain);
    Span::new(start, end)
}

struct NodeSeeker<'p> {
    path: &'p [usize],
    part: KeyOrValue,
}

const ARRIVED: &str = "arrived";

impl<'de> DeserializeSeed<'de> for NodeSeeker<'_> {
    type Value = ();
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<(), D::Error> {
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for NodeSeeker<'_> {
    type Value = ();

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(ARRIVED)
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<(), A::Error> {
        let Some((&index, rest)) = self.path.split_first() else { return Err(A::Error::custom(ARRIVED)) };
        for _ in 0..index {
            list.next_element::<IgnoredAny>()?;
        }
        list.next_element_seed(NodeSeeker { path: rest, part: self.part }).map(|_| ())
    }
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<(), A::Error> {
        let Some((&index, rest)) = self.path.split_first() else { return Err(A::Error::custom(ARRIVED)) };
        for _ in 0..index {
            map.next_entry::<IgnoredAny, IgnoredAny>()?;
        }
        if rest.is_empty() && self.part == KeyOrValue::Key {
            return map.next_key_seed(NodeSeeker { path: &[], part: KeyOrValue::Key }).map(|_| ());
        }
        if map.next_key::<IgnoredAny>()?.is_some() {
            map.next_value_seed(NodeSeeker { path: rest, part: self.part })?;
        }
        Ok(())
    }
    fn visit_enum<A: EnumAccess<'de>>(self, _: A) -> Result<(), A::Error> {
        Err(A::Error::custom(ARRIVED))
    }
}

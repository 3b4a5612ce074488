//! This module holds a YAML document as a tree whose nodes know which entry they were in the text.
//!
//! serde_yaml reads the text. The tree keeps duplicate keys, which a map type would lose, and the index of
//! every entry. So a fault that is found later can be traced to its bytes, even after faulty entries were
//! removed.

use serde::de::{DeserializeSeed, Deserializer, EnumAccess, MapAccess, SeqAccess, Visitor};
use std::cell::Cell;
use std::fmt;

/// A value of the document.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum YamlNode {
    Null,
    Bool(bool),
    Unsigned(u64),
    Signed(i64),
    Float(f64),
    Text(String),
    List(Vec<YamlListItem>),
    Map(Vec<YamlMapEntry>),
}

/// An element of a list, with its index in the text.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct YamlListItem {
    pub index: usize,
    pub value: YamlNode,
}

/// A key with its value, and the index of the entry in the text.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct YamlMapEntry {
    pub index: usize,
    pub key: String,
    pub value: YamlNode,
}

impl YamlNode {
    /// Returns the child that was entry `index` in the text.
    pub(super) fn child_at(&self, index: usize) -> Option<&YamlNode> {
        match self {
            Self::List(items) => items.iter().find(|item| item.index == index).map(|item| &item.value),
            Self::Map(entries) => entries.iter().find(|entry| entry.index == index).map(|entry| &entry.value),
            _ => None,
        }
    }

    /// Returns the entry that was number `index` of the map in the text.
    pub(super) fn entry_at(&self, index: usize) -> Option<&YamlMapEntry> {
        match self {
            Self::Map(entries) => entries.iter().find(|entry| entry.index == index),
            _ => None,
        }
    }

    /// Returns the entry with a key; the first one if there are duplicates.
    pub(super) fn find_entry(&self, key: &str) -> Option<&YamlMapEntry> {
        match self {
            Self::Map(entries) => entries.iter().find(|entry| entry.key == key),
            _ => None,
        }
    }

    /// Returns the node at the end of a path of entry indices.
    pub(super) fn node_at_path(&self, path: &[usize]) -> Option<&YamlNode> {
        path.iter().try_fold(self, |node, &index| node.child_at(index))
    }

    /// Removes the node at the end of a path from the tree. Returns whether there was one.
    pub(super) fn remove_at_path(&mut self, path: &[usize]) -> bool {
        let Some((&index, rest)) = path.split_first() else { return false };
        if rest.is_empty() {
            let before = self.child_count();
            match self {
                Self::List(items) => items.retain(|item| item.index != index),
                Self::Map(entries) => entries.retain(|entry| entry.index != index),
                _ => {}
            }
            return self.child_count() < before;
        }
        let child = match self {
            Self::List(items) => {
                items.iter_mut().find(|item| item.index == index).map(|item| &mut item.value)
            }
            Self::Map(entries) => {
                entries.iter_mut().find(|entry| entry.index == index).map(|entry| &mut entry.value)
            }
            _ => None,
        };
        child.is_some_and(|child| child.remove_at_path(rest))
    }

    fn child_count(&self) -> usize {
        match self {
            Self::List(items) => items.len(),
            Self::Map(entries) => entries.len(),
            _ => 0,
        }
    }
}

/// The reason why the tree was not built, apart from what serde_yaml itself refuses.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum YamlRefusal {
    /// A tag: `!tag value`.
    Tag,
    /// A list or a map in place of a key.
    Key,
    /// Aliases that repeat so much that the document grows past [`YamlTreeBuilder::BUDGET`].
    Bomb,
}

/// Builds the tree from a serde_yaml deserializer.
pub(super) struct YamlTreeBuilder {
    budget: Cell<usize>,
    refusal: Cell<Option<YamlRefusal>>,
}

impl YamlTreeBuilder {
    /// The largest sum of nodes and bytes of text. serde_yaml limits how often aliases are followed, but not
    /// how much each of them adds.
    pub(super) const BUDGET: usize = 2 << 20;

    pub(super) fn new() -> Self {
        Self { budget: Cell::new(Self::BUDGET), refusal: Cell::new(None) }
    }

    /// Returns the reason why building failed, unless the YAML text itself was the reason.
    pub(super) fn refusal(&self) -> Option<YamlRefusal> {
        self.refusal.get()
    }

    fn refuse<E: serde::de::Error>(&self, refusal: YamlRefusal) -> E {
        self.refusal.set(Some(refusal));
        E::custom("refused")
    }

    fn spend_budget<E: serde::de::Error>(&self, cost: usize) -> Result<(), E> {
        let left = self.budget.get().checked_sub(cost).ok_or_else(|| self.refuse(YamlRefusal::Bomb))?;
        self.budget.set(left);
        Ok(())
    }
}

impl<'de> DeserializeSeed<'de> for &YamlTreeBuilder {
    type Value = YamlNode;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<YamlNode, D::Error> {
        self.spend_budget(1)?;
        deserializer.deserialize_any(self)
    }
}

impl<'de> Visitor<'de> for &YamlTreeBuilder {
    type Value = YamlNode;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a YAML value")
    }
    fn visit_unit<E>(self) -> Result<YamlNode, E> {
        Ok(YamlNode::Null)
    }
    fn visit_none<E>(self) -> Result<YamlNode, E> {
        Ok(YamlNode::Null)
    }
    fn visit_bool<E>(self, value: bool) -> Result<YamlNode, E> {
        Ok(YamlNode::Bool(value))
    }
    fn visit_u64<E>(self, value: u64) -> Result<YamlNode, E> {
        Ok(YamlNode::Unsigned(value))
    }
    fn visit_i64<E>(self, value: i64) -> Result<YamlNode, E> {
        Ok(YamlNode::Signed(value))
    }
    fn visit_u128<E>(self, value: u128) -> Result<YamlNode, E> {
        Ok(YamlNode::Float(value as f64))
    }
    fn visit_i128<E>(self, value: i128) -> Result<YamlNode, E> {
        Ok(YamlNode::Float(value as f64))
    }
    fn visit_f64<E>(self, value: f64) -> Result<YamlNode, E> {
        Ok(YamlNode::Float(value))
    }
    fn visit_str<E: serde::de::Error>(self, value: &str) -> Result<YamlNode, E> {
        self.spend_budget(value.len())?;
        Ok(YamlNode::Text(value.to_owned()))
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut list: A) -> Result<YamlNode, A::Error> {
        let mut items = Vec::new();
        while let Some(value) = list.next_element_seed(self)? {
            items.push(YamlListItem { index: items.len(), value });
        }
        Ok(YamlNode::List(items))
    }
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<YamlNode, A::Error> {
        let mut entries = Vec::new();
        while let Some(key) = map.next_key_seed(YamlKeyBuilder(self))? {
            entries.push(YamlMapEntry { index: entries.len(), key, value: map.next_value_seed(self)? });
        }
        Ok(YamlNode::Map(entries))
    }
    fn visit_enum<A: EnumAccess<'de>>(self, _: A) -> Result<YamlNode, A::Error> {
        Err(self.refuse(YamlRefusal::Tag))
    }
}

/// Reads a key. Any scalar can be a key by its text: `1:` and `true:` are the keys `1` and `true`.
struct YamlKeyBuilder<'b>(&'b YamlTreeBuilder);

impl<'de> DeserializeSeed<'de> for YamlKeyBuilder<'_> {
    type Value = String;
    fn deserialize<D: Deserializer<'de>>(self, deserializer: D) -> Result<String, D::Error> {
        let builder = self.0;
        deserializer.deserialize_str(self).inspect_err(|_| {
            if builder.refusal().is_none() {
                builder.refusal.set(Some(YamlRefusal::Key));
            }
        })
    }
}

impl<'de> Visitor<'de> for YamlKeyBuilder<'_> {
    type Value = String;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a word as the key")
    }
    fn visit_str<E: serde::de::Error>(self, value: &str) -> Result<String, E> {
        self.0.spend_budget(value.len())?;
        Ok(value.to_owned())
    }
}

/// Returns the entries whose key occurs twice in a map: the path of the map, and the indices of the first and
/// the later entry.
pub(super) fn find_duplicate_entries(root: &YamlNode) -> Vec<(Vec<usize>, usize, usize)> {
    let mut found = Vec::new();
    collect_duplicate_entries(root, &mut Vec::new(), &mut found);
    found
}

fn collect_duplicate_entries(
    node: &YamlNode,
    path: &mut Vec<usize>,
    found: &mut Vec<(Vec<usize>, usize, usize)>,
) {
    let children: Vec<(usize, &YamlNode)> = match node {
        YamlNode::List(items) => items.iter().map(|item| (item.index, &item.value)).collect(),
        YamlNode::Map(entries) => {
            let mut first = std::collections::HashMap::new();
            for entry in entries {
                let earlier = *first.entry(entry.key.as_str()).or_insert(entry.index);
                if earlier != entry.index {
                    found.push((path.clone(), earlier, entry.index));
                }
            }
            entries.iter().map(|entry| (entry.index, &entry.value)).collect()
        }
        _ => return,
    };
    for (index, child) in children {
        path.push(index);
        collect_duplicate_entries(child, path, found);
        path.pop();
    }
}

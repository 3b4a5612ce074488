//! This module checks the tree against a type. It is a serde deserializer whose errors know the entry from
//! which they came.
//!
//! A choice (enum) with settings is a map with a single key, its name. A bare name is the choice without
//! settings.

use super::fault_words;
use super::yaml_fault::{YamlFault, YamlFaultKind};
use super::yaml_tree::{YamlListItem, YamlMapEntry, YamlNode};
use serde::Deserializer;
use serde::de::value::StrDeserializer;
use serde::de::{self, DeserializeSeed, Error as _, Expected, Unexpected, Visitor};
use std::fmt;
use std::slice::Iter;

/// A node as serde sees it.
#[derive(Clone, Copy)]
pub(super) struct NodeDeserializer<'n>(pub &'n YamlNode);

impl NodeDeserializer<'_> {
    fn describe_found(&self) -> Unexpected<'_> {
        match self.0 {
            YamlNode::Null => Unexpected::Unit,
            YamlNode::Bool(value) => Unexpected::Bool(*value),
            YamlNode::Unsigned(value) => Unexpected::Unsigned(*value),
            YamlNode::Signed(value) => Unexpected::Signed(*value),
            YamlNode::Float(value) => Unexpected::Float(*value),
            YamlNode::Text(text) => Unexpected::Str(text),
            YamlNode::List(_) => Unexpected::Seq,
            YamlNode::Map(_) => Unexpected::Map,
        }
    }
}

impl<'de> Deserializer<'de> for NodeDeserializer<'_> {
    type Error = YamlFault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, YamlFault> {
        match self.0 {
            YamlNode::Null => visitor.visit_unit(),
            YamlNode::Bool(value) => visitor.visit_bool(*value),
            YamlNode::Unsigned(value) => visitor.visit_u64(*value),
            YamlNode::Signed(value) => visitor.visit_i64(*value),
            YamlNode::Float(value) => visitor.visit_f64(*value),
            YamlNode::Text(text) => visitor.visit_str(text),
            YamlNode::Map(entries) => {
                visitor.visit_map(NodeMapAccess { entries: entries.iter(), value: None })
            }
            YamlNode::List(items) => {
                // Arrays stop reading at their length and would not notice further elements.
                let expected = fault_words::describe_expected(&visitor);
                let mut access = NodeListAccess { items: items.iter() };
                let value = visitor.visit_seq(&mut access)?;
                match access.items.len() {
                    0 => Ok(value),
                    _ => Err(YamlFault::invalid_length(items.len(), &ExpectedPhrase(&expected))),
                }
            }
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, YamlFault> {
        match self.0 {
            YamlNode::Null => visitor.visit_none(),
            _ => visitor.visit_some(self),
        }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, YamlFault> {
        visitor.visit_newtype_struct(self)
    }

    /// Returns a key such as `machine:` with all lines below it commented out is read as a struct without
    /// values.
    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, YamlFault> {
        match self.0 {
            YamlNode::Null => visitor.visit_map(NodeMapAccess { entries: [].iter(), value: None }),
            // serde would take the elements of a list for the fields in their order, and a wrong order would
            // go unnoticed.
            YamlNode::List(_) => Err(YamlFault::invalid_type(Unexpected::Seq, &visitor)),
            _ => self.deserialize_any(visitor),
        }
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, YamlFault> {
        match self.0 {
            YamlNode::Text(name) => visitor.visit_enum(NamedChoice { name, settings: None }),
            YamlNode::Map(entries) => match entries.as_slice() {
                [entry] => visitor.visit_enum(NamedChoice { name: &entry.key, settings: Some(entry) }),
                several => Err(YamlFault::new(YamlFaultKind::NotOneName {
                    names: several.iter().map(|entry| entry.key.clone()).collect(),
                })),
            },
            _ => Err(YamlFault::invalid_type(
                self.describe_found(),
                &ExpectedPhrase(&fault_words::join_choices(variants)),
            )),
        }
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, YamlFault> {
        visitor.visit_unit()
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct seq tuple
        tuple_struct map identifier
    }
}

struct ExpectedPhrase<'p>(&'p str);

impl Expected for ExpectedPhrase<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }
}

struct NodeListAccess<'n> {
    items: Iter<'n, YamlListItem>,
}

impl<'de> de::SeqAccess<'de> for NodeListAccess<'_> {
    type Error = YamlFault;
    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, YamlFault> {
        let Some(item) = self.items.next() else { return Ok(None) };
        seed.deserialize(NodeDeserializer(&item.value))
            .map(Some)
            .map_err(|fault| fault.in_value_of(item.index))
    }
    fn size_hint(&self) -> Option<usize> {
        Some(self.items.len())
    }
}

struct NodeMapAccess<'n> {
    entries: Iter<'n, YamlMapEntry>,
    value: Option<&'n YamlMapEntry>,
}

impl<'de> de::MapAccess<'de> for NodeMapAccess<'_> {
    type Error = YamlFault;
    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, YamlFault> {
        let Some(entry) = self.entries.next() else { return Ok(None) };
        self.value = Some(entry);
        let key = StrDeserializer::<YamlFault>::new(&entry.key);
        seed.deserialize(key).map(Some).map_err(|fault| fault.in_key_of(entry.index))
    }
    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, YamlFault> {
        let Some(entry) = self.value.take() else { return Err(YamlFault::custom("a value without its key")) };
        seed.deserialize(NodeDeserializer(&entry.value)).map_err(|fault| fault.in_value_of(entry.index))
    }
}

/// A choice by name, with its settings if it was a map.
struct NamedChoice<'n> {
    name: &'n str,
    settings: Option<&'n YamlMapEntry>,
}

impl<'n> NamedChoice<'n> {
    fn read_settings<T>(
        &self,
        read: impl FnOnce(NodeDeserializer<'n>) -> Result<T, YamlFault>,
    ) -> Result<T, YamlFault> {
        match self.settings {
            Some(entry) => {
                read(NodeDeserializer(&entry.value)).map_err(|fault| fault.in_value_of(entry.index))
            }
            None => read(NodeDeserializer(&YamlNode::Null)),
        }
    }
}

impl<'de, 'n> de::EnumAccess<'de> for NamedChoice<'n> {
    type Error = YamlFault;
    type Variant = NamedChoice<'n>;
    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self), YamlFault> {
        let name = StrDeserializer::<YamlFault>::new(self.name);
        let variant = seed.deserialize(name).map_err(|fault| match self.settings {
            Some(entry) => fault.in_key_of(entry.index),
            None => fault,
        })?;
        Ok((variant, self))
    }
}

impl<'de> de::VariantAccess<'de> for NamedChoice<'_> {
    type Error = YamlFault;
    fn unit_variant(self) -> Result<(), YamlFault> {
        self.read_settings(|settings| match settings.0 {
            YamlNode::Null => Ok(()),
            YamlNode::Map(entries) if entries.is_empty() => Ok(()),
            _ => Err(YamlFault::invalid_type(settings.describe_found(), &"no settings")),
        })
    }
    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, YamlFault> {
        self.read_settings(|settings| seed.deserialize(settings))
    }
    fn tuple_variant<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, YamlFault> {
        self.read_settings(|settings| settings.deserialize_any(visitor))
    }
    fn struct_variant<V: Visitor<'de>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, YamlFault> {
        self.read_settings(|settings| settings.deserialize_struct("", fields, visitor))
    }
}

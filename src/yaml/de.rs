//! Checks the tree against a type: a serde deserializer whose errors know the entry they came from.
//!
//! A choice (enum) with settings is a map of one key, its name; a bare name stands for the choice with no settings given.

use super::fault::{Fault, Kind};
use super::node::{Entry, Item, Node};
use super::words;
use serde::Deserializer;
use serde::de::value::StrDeserializer;
use serde::de::{self, DeserializeSeed, Error as _, Expected, Unexpected, Visitor};
use std::fmt;
use std::slice::Iter;

/// A node as serde sees it.
#[derive(Clone, Copy)]
pub(super) struct NodeDeserializer<'n>(pub &'n Node);

impl NodeDeserializer<'_> {
    fn unexpected(&self) -> Unexpected<'_> {
        match self.0 {
            Node::Null => Unexpected::Unit,
            Node::Bool(value) => Unexpected::Bool(*value),
            Node::Unsigned(value) => Unexpected::Unsigned(*value),
            Node::Signed(value) => Unexpected::Signed(*value),
            Node::Float(value) => Unexpected::Float(*value),
            Node::Text(text) => Unexpected::Str(text),
            Node::List(_) => Unexpected::Seq,
            Node::Map(_) => Unexpected::Map,
        }
    }
}

impl<'de> Deserializer<'de> for NodeDeserializer<'_> {
    type Error = Fault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match self.0 {
            Node::Null => visitor.visit_unit(),
            Node::Bool(value) => visitor.visit_bool(*value),
            Node::Unsigned(value) => visitor.visit_u64(*value),
            Node::Signed(value) => visitor.visit_i64(*value),
            Node::Float(value) => visitor.visit_f64(*value),
            Node::Text(text) => visitor.visit_str(text),
            Node::Map(entries) => visitor.visit_map(MapAccess { entries: entries.iter(), value: None }),
            Node::List(items) => {
                // Arrays stop reading at their length and would not notice what follows.
                let expected = words::expected(&visitor);
                let mut access = ListAccess { items: items.iter() };
                let value = visitor.visit_seq(&mut access)?;
                match access.items.len() {
                    0 => Ok(value),
                    _ => Err(Fault::invalid_length(items.len(), &Phrase(&expected))),
                }
            }
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match self.0 {
            Node::Null => visitor.visit_none(),
            _ => visitor.visit_some(self),
        }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        visitor: V,
    ) -> Result<V::Value, Fault> {
        visitor.visit_newtype_struct(self)
    }

    /// `machine:` with every line below it commented out is a machine of which nothing is said.
    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _: &'static str,
        _: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        match self.0 {
            Node::Null => visitor.visit_map(MapAccess { entries: [].iter(), value: None }),
            Node::List(_) => Err(Fault::invalid_type(Unexpected::Seq, &visitor)),
            _ => self.deserialize_any(visitor),
        }
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        match self.0 {
            Node::Text(name) => visitor.visit_enum(Choice { name, settings: None }),
            Node::Map(entries) => match entries.as_slice() {
                [entry] => visitor.visit_enum(Choice { name: &entry.key, settings: Some(entry) }),
                several => Err(Fault::new(Kind::NotOneName {
                    names: several.iter().map(|entry| entry.key.clone()).collect(),
                })),
            },
            _ => Err(Fault::invalid_type(self.unexpected(), &Phrase(&words::choices(variants)))),
        }
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_unit()
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit unit_struct seq tuple
        tuple_struct map identifier
    }
}

struct Phrase<'p>(&'p str);

impl Expected for Phrase<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.0)
    }
}

struct ListAccess<'n> {
    items: Iter<'n, Item>,
}

impl<'de> de::SeqAccess<'de> for ListAccess<'_> {
    type Error = Fault;
    fn next_element_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<Option<T::Value>, Fault> {
        let Some(item) = self.items.next() else { return Ok(None) };
        seed.deserialize(NodeDeserializer(&item.value)).map(Some).map_err(|fault| fault.inside(item.index))
    }
    fn size_hint(&self) -> Option<usize> {
        Some(self.items.len())
    }
}

struct MapAccess<'n> {
    entries: Iter<'n, Entry>,
    value: Option<&'n Entry>,
}

impl<'de> de::MapAccess<'de> for MapAccess<'_> {
    type Error = Fault;
    fn next_key_seed<K: DeserializeSeed<'de>>(&mut self, seed: K) -> Result<Option<K::Value>, Fault> {
        let Some(entry) = self.entries.next() else { return Ok(None) };
        self.value = Some(entry);
        let key = StrDeserializer::<Fault>::new(&entry.key);
        seed.deserialize(key).map(Some).map_err(|fault| fault.key(entry.index))
    }
    fn next_value_seed<V: DeserializeSeed<'de>>(&mut self, seed: V) -> Result<V::Value, Fault> {
        let Some(entry) = self.value.take() else { return Err(Fault::custom("a value without its key")) };
        seed.deserialize(NodeDeserializer(&entry.value)).map_err(|fault| fault.inside(entry.index))
    }
}

/// A choice by name, with its settings if it came as a map.
struct Choice<'n> {
    name: &'n str,
    settings: Option<&'n Entry>,
}

impl<'n> Choice<'n> {
    fn read<T>(&self, read: impl FnOnce(NodeDeserializer<'n>) -> Result<T, Fault>) -> Result<T, Fault> {
        match self.settings {
            Some(entry) => read(NodeDeserializer(&entry.value)).map_err(|fault| fault.inside(entry.index)),
            None => read(NodeDeserializer(&Node::Null)),
        }
    }
}

impl<'de, 'n> de::EnumAccess<'de> for Choice<'n> {
    type Error = Fault;
    type Variant = Choice<'n>;
    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self), Fault> {
        let name = StrDeserializer::<Fault>::new(self.name);
        let variant = seed.deserialize(name).map_err(|fault| match self.settings {
            Some(entry) => fault.key(entry.index),
            None => fault,
        })?;
        Ok((variant, self))
    }
}

impl<'de> de::VariantAccess<'de> for Choice<'_> {
    type Error = Fault;
    fn unit_variant(self) -> Result<(), Fault> {
        self.read(|settings| match settings.0 {
            Node::Null => Ok(()),
            Node::Map(entries) if entries.is_empty() => Ok(()),
            _ => Err(Fault::invalid_type(settings.unexpected(), &"no settings")),
        })
    }
    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Fault> {
        self.read(|settings| seed.deserialize(settings))
    }
    fn tuple_variant<V: Visitor<'de>>(self, _: usize, visitor: V) -> Result<V::Value, Fault> {
        self.read(|settings| settings.deserialize_any(visitor))
    }
    fn struct_variant<V: Visitor<'de>>(
        self,
        fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        self.read(|settings| settings.deserialize_struct("", fields, visitor))
    }
}

//! This module holds the paths of files that a recipe or a setup file names.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserialize, Deserializer, Visitor};
use std::borrow::Cow;
use std::fmt;
use std::path::{Path, PathBuf};

/// A path as it is written: relative to the folder of the file that names it, or absolute. It is never empty.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FilePath(String);

impl FilePath {
    /// Makes a path. Returns `None` for the empty text.
    pub fn new(text: &str) -> Option<Self> {
        (!text.trim().is_empty()).then(|| Self(text.to_owned()))
    }

    /// Returns the path as it was written.
    pub fn as_str(&self) -> &str {
        &self.0
    }

    /// Returns the path as seen from where clsmith runs. `named_in` is the path of the file that names it.
    pub fn resolve_beside(&self, named_in: &Path) -> PathBuf {
        named_in.parent().unwrap_or(Path::new("")).join(&self.0)
    }
}

impl<'de> Deserialize<'de> for FilePath {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(FilePathVisitor)
    }
}

impl serde::Serialize for FilePath {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.0)
    }
}

struct FilePathVisitor;

impl Visitor<'_> for FilePathVisitor {
    type Value = FilePath;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("the path of a file")
    }
    fn visit_str<E: de::Error>(self, text: &str) -> Result<FilePath, E> {
        FilePath::new(text)
            .ok_or_else(|| E::custom("the path of a file is empty\nName a file, or remove the key."))
    }
}

impl JsonSchema for FilePath {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "FilePath".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "string", "minLength": 1 })
    }
}

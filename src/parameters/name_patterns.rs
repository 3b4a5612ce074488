//! This module holds patterns for the names of operations and tools.

use globset::{GlobBuilder, GlobMatcher};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserialize, Deserializer, Unexpected, Visitor};
use serde::{Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;

/// A name with wildcards. `*` matches any text, `?` any character, `[AB]` one of these characters, `{A,B}`
/// either text, and `\` takes the next character literally. Upper and lower case differ. Outside ASCII, use
/// `*` rather than `?`, because globset counts bytes.
///
/// ```
/// use clsmith::parameters::Glob;
///
/// let roughing = Glob::new("ROUGH*")?;
/// assert!(roughing.matches_name("ROUGH_2") && !roughing.matches_name("FINISH"));
/// # Ok::<(), clsmith::parameters::GlobError>(())
/// ```
#[derive(Clone)]
pub struct Glob {
    text: String,
    matcher: GlobMatcher,
}

/// The reason why a text is no pattern.
#[derive(Debug, Clone, thiserror::Error)]
#[error("{0}")]
pub struct GlobError(String);

impl Glob {
    /// Compiles a pattern.
    ///
    /// Returns [`GlobError`] for an open bracket or brace and similar faults, and for the empty text, which
    /// matches no name.
    pub fn new(text: &str) -> Result<Self, GlobError> {
        if text.is_empty() {
            return Err(GlobError("an empty pattern matches no name".to_owned()));
        }
        let glob = GlobBuilder::new(text).literal_separator(false).backslash_escape(true).build();
        let glob = glob.map_err(|error| GlobError(error.kind().to_string()))?;
        Ok(Self { text: text.to_owned(), matcher: glob.compile_matcher() })
    }

    /// Returns the pattern as it was written.
    pub fn as_str(&self) -> &str {
        &self.text
    }

    /// Returns whether the pattern matches a whole name.
    pub fn matches_name(&self, name: &str) -> bool {
        self.matcher.is_match(name)
    }

    fn parse_scalar<E: de::Error>(text: &str) -> Result<Self, E> {
        Self::new(text).map_err(|error| {
            let help = "A `[`, `{` or `\\` that is part of the name needs a `\\` in front, in single quotes: '\\[1\\]'.";
            E::custom(format!("`{text}` is no name pattern: {error}\n{help}"))
        })
    }
}

impl fmt::Debug for Glob {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "Glob({:?})", self.text)
    }
}

impl fmt::Display for Glob {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl PartialEq for Glob {
    fn eq(&self, other: &Self) -> bool {
        self.text == other.text
    }
}

impl<'de> Deserialize<'de> for Glob {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(GlobVisitor)
    }
}

struct GlobVisitor;

impl Visitor<'_> for GlobVisitor {
    type Value = Glob;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a name or pattern")
    }
    fn visit_str<E: de::Error>(self, text: &str) -> Result<Glob, E> {
        Glob::parse_scalar(text)
    }
    fn visit_u64<E: de::Error>(self, value: u64) -> Result<Glob, E> {
        // The text may have been `007`, so the help cannot give the name.
        let help = "A name that looks like a number needs quotes.";
        Err(E::custom(format!("expected a name or pattern, found the number {value}\n{help}")))
    }
}

impl Serialize for Glob {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(&self.text)
    }
}

impl JsonSchema for Glob {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Glob".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "string", "minLength": 1, "description": "A name; `*` and `?` are wildcards." })
    }
}

/// A tool by its number, or by a pattern for its name.
#[derive(Debug, Clone, PartialEq)]
pub enum ToolPattern {
    /// The tool with this number.
    Number(u32),
    /// Every tool whose name matches.
    Name(Glob),
}

impl ToolPattern {
    /// Returns whether a tool matches, by its number and name in the CL file.
    pub fn matches_tool(&self, number: Option<u32>, name: Option<&str>) -> bool {
        match self {
            Self::Number(wanted) => number == Some(*wanted),
            Self::Name(glob) => name.is_some_and(|name| glob.matches_name(name)),
        }
    }
}

impl<'de> Deserialize<'de> for ToolPattern {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(ToolPatternVisitor)
    }
}

struct ToolPatternVisitor;

const TOOL: &str = "a tool number or a tool name";

impl Visitor<'_> for ToolPatternVisitor {
    type Value = ToolPattern;
    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(TOOL)
    }
    fn visit_u64<E: de::Error>(self, value: u64) -> Result<ToolPattern, E> {
        let number =
            u32::try_from(value).map_err(|_| E::invalid_value(Unexpected::Unsigned(value), &TOOL))?;
        Ok(ToolPattern::Number(number))
    }
    fn visit_i64<E: de::Error>(self, value: i64) -> Result<ToolPattern, E> {
        Err(E::invalid_value(Unexpected::Signed(value), &TOOL))
    }
    fn visit_str<E: de::Error>(self, text: &str) -> Result<ToolPattern, E> {
        Glob::parse_scalar(text).map(ToolPattern::Name)
    }
}

impl Serialize for ToolPattern {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Number(number) => serializer.serialize_u32(*number),
            Self::Name(glob) => glob.serialize(serializer),
        }
    }
}

impl JsonSchema for ToolPattern {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "ToolPattern".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "description": "A tool number, or a tool name; `*` and `?` are wildcards.",
            "anyOf": [
                { "type": "integer", "minimum": 0, "maximum": u32::MAX },
                { "type": "string", "minLength": 1 },
            ],
        })
    }
}

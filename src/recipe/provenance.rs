//! This module holds `provenance:` of a recipe.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What the corrected file states about the run that made it, in comments of its own form. A file in which
/// the recipe changes nothing stays byte for byte.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Provenance {
    /// No comments.
    #[default]
    None,
    /// A header with the version of clsmith, the name and hash of the recipe, and the name and hash of the
    /// input.
    Header,
    /// The header, and a comment before each changed record with the step and its change: `$$ clsmith
    /// scale_feed: 250.0000 -> 200.0000`.
    Comments,
}

impl Provenance {
    /// All choices, with the smallest first.
    pub const ALL: [Self; 3] = [Self::None, Self::Header, Self::Comments];

    /// Returns the name of the choice in a recipe.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Header => "header",
            Self::Comments => "comments",
        }
    }
}

//! `provenance:` of a recipe.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// What the corrected file says about the run that made it, in comments of its own form. A file in which the recipe changes
/// nothing stays as it is, byte for byte.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
#[non_exhaustive]
pub enum Provenance {
    /// Nothing.
    #[default]
    None,
    /// A header: version of clsmith, name and hash of the recipe, name and hash of the input.
    Header,
    /// The header, and before each changed record a comment with the step and what it changed:
    /// `$$ clsmith scale_feed: 250.0000 -> 200.0000`.
    Comments,
}

impl Provenance {
    /// All of them, the least first.
    pub const ALL: [Self; 3] = [Self::None, Self::Header, Self::Comments];

    /// As it stands in a recipe.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Header => "header",
            Self::Comments => "comments",
        }
    }
}

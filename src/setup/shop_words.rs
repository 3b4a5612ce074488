//! This module reads the shop's own words from a setup.

use crate::program::{ShopVocabulary, ShopWordMeaning};
use schemars::JsonSchema;
use serde::{Deserialize, Deserializer, de};
use std::collections::BTreeMap;
use std::sync::Arc;

/// Words of the standard that move the tool or say how. A post that means something else by them would not be
/// understood by any other program.
const FIXED_WORDS: &[&str] = &[
    "CIRCLE", "CNTRL", "CUTCOM", "CUTTER", "CYCLE", "FEDRAT", "FINI", "FROM", "GODLTA", "GOHOME", "GOTO",
    "HELICAL", "INDIRV", "KNOT", "MOVARC", "MULTAX", "NURBS", "RAPID", "SPINDL", "TLAXIS", "TLDATA", "TLON",
    "UNITS",
];

/// The longest word, in bytes: a line of the standard.
const LONGEST_WORD: usize = 72;

/// The words as they are written.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(transparent)]
pub(super) struct ShopWordsText(BTreeMap<ShopWord, ShopWordMeaning>);

impl ShopWordsText {
    pub(super) fn into_vocabulary(self) -> Arc<ShopVocabulary> {
        Arc::new(ShopVocabulary::new(self.0.into_iter().map(|(word, meaning)| (word.0, meaning))))
    }
}

/// A word that a setup may give a meaning.
#[derive(Debug, PartialEq, Eq, PartialOrd, Ord, JsonSchema)]
#[serde(transparent)]
struct ShopWord(String);

impl<'de> Deserialize<'de> for ShopWord {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let word = String::deserialize(deserializer)?;
        let folded = word.trim().to_ascii_uppercase();
        if folded.is_empty() || folded.len() > LONGEST_WORD || folded.contains(['\n', '\r']) {
            return Err(de::Error::custom(format!(
                "a word is the beginning of a statement, 1 to {LONGEST_WORD} letters of one line"
            )));
        }
        if FIXED_WORDS.contains(&folded.as_str()) {
            return Err(de::Error::custom(format!(
                "`{folded}` is a word of the language and cannot mean something else"
            )));
        }
        Ok(Self(word))
    }
}

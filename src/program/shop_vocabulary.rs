//! This module holds the words that a shop has taught its post-processor and that no dialect knows.

use std::collections::BTreeMap;

/// What a shop's own word means.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[cfg_attr(
    feature = "simulation",
    derive(serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "snake_case")
)]
#[non_exhaustive]
pub enum ShopWordMeaning {
    /// An operation starts; the rest of the line is its name.
    Operation,
    /// The operation ends.
    OperationEnd,
    /// A tool is loaded; the first number is its number.
    ToolChange,
    /// The frame of the points that follow: an origin (3 numbers), origin, x axis and y axis (9 numbers, as
    /// in MSYS) or three rows of axes and origin (12 numbers, as in CSYS). Names may stand among them (`G54`).
    Frame,
    /// The path of another channel or turret follows; the first number is that of the channel.
    Channel,
    /// The spindle, in the order of SPINDL.
    Spindle,
    /// The feed, in the order of FEDRAT. Its number may stand behind a letter (`F300`).
    Feed,
    /// Text for the post or for people, whatever numbers are in it.
    Text,
}

/// The words of a shop with their meanings.
///
/// A word stands for itself or, with blanks or a slash in it, for the beginning of a statement: `OP_NAME`,
/// `PPRINT/OPERATION`, `$$ SHOP-OP`. Neither case nor blanks count.
///
/// ```
/// use clsmith::parse::parse_with_vocabulary;
/// use clsmith::program::operation::find_operations;
/// use clsmith::program::{ShopVocabulary, ShopWordMeaning};
/// use clsmith::source::Source;
///
/// let words = ShopVocabulary::new([("OP_NAME".to_owned(), ShopWordMeaning::Operation)]);
/// let source = Source::new("part.apt", b"OP_NAME/ROUGH BASE\nGOTO/1,2,3\n".to_vec())?;
/// let program = parse_with_vocabulary(&source, None, &words.into()).program;
/// assert_eq!(find_operations(&program)[0].name, "ROUGH BASE");
/// # Ok::<(), clsmith::source::SourceTooLarge>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct ShopVocabulary {
    /// The words without blanks, in upper case. The longest word that fits a statement counts.
    words: BTreeMap<Vec<u8>, ShopWordMeaning>,
}

impl ShopVocabulary {
    /// Makes a vocabulary. Of two words that differ in case and blanks alone, the last one counts.
    pub fn new(words: impl IntoIterator<Item = (String, ShopWordMeaning)>) -> Self {
        let words = words.into_iter().map(|(word, meaning)| (fold_word(word.as_bytes()).collect(), meaning));
        Self { words: words.filter(|(word, _): &(Vec<u8>, _)| !word.is_empty()).collect() }
    }

    /// Returns whether there are no words.
    pub fn is_empty(&self) -> bool {
        self.words.is_empty()
    }

    /// Returns this vocabulary, with the words of `base` that it does not have.
    #[must_use]
    pub fn override_base(mut self, base: Self) -> Self {
        for (word, meaning) in base.words {
            self.words.entry(word).or_insert(meaning);
        }
        self
    }

    /// Finds the word with which a statement's text begins. Returns its meaning and the place behind it.
    pub(crate) fn find_word(&self, text: &[u8]) -> Option<(ShopWordMeaning, usize)> {
        let fits = self.words.iter().filter_map(|(word, meaning)| Some((*meaning, word_end(word, text)?)));
        fits.max_by_key(|(_, end)| *end)
    }
}

/// Returns the bytes of a word by which it is compared.
fn fold_word(word: &[u8]) -> impl Iterator<Item = u8> {
    word.iter().filter(|byte| !is_blank(**byte)).map(u8::to_ascii_uppercase)
}

/// Returns the place behind a word with which a text begins.
fn word_end(word: &[u8], text: &[u8]) -> Option<usize> {
    let mut at = 0;
    for &expected in word {
        at += text.get(at..)?.iter().take_while(|byte| is_blank(**byte)).count();
        if text.get(at)?.to_ascii_uppercase() != expected {
            return None;
        }
        at += 1;
    }
    // `OP` does not stand for `OPSTOP`. Behind a word that ends in a sign, anything may follow.
    let goes_on = |byte: Option<&u8>| byte.is_some_and(|byte| byte.is_ascii_alphanumeric() || *byte == b'_');
    let splits = goes_on(word.last()) && goes_on(text.get(at));
    (!splits).then_some(at)
}

fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_word_is_found_whatever_its_case_and_blanks() {
        let words = [
            ("OP".to_owned(), ShopWordMeaning::Text),
            ("pprint / operation:".to_owned(), ShopWordMeaning::Operation),
        ];
        let words = ShopVocabulary::new(words);
        let find = |text: &str| words.find_word(text.as_bytes());
        assert_eq!(find("PPRINT/OPERATION:ROUGH"), Some((ShopWordMeaning::Operation, 17)));
        assert_eq!(find(" Pprint  /OPERATION : X"), Some((ShopWordMeaning::Operation, 21)));
        assert_eq!(find("OP/1"), Some((ShopWordMeaning::Text, 2)));
        assert_eq!(find("OP 1"), Some((ShopWordMeaning::Text, 2)));
        assert_eq!(find("OPSTOP"), None);
        assert_eq!(find("OP_NAME/1"), None);
        assert_eq!(find("O"), None);
    }
}

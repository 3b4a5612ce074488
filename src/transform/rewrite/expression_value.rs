//! Values of expressions, and of bound arguments.

use crate::number;
use crate::program::operation;

/// What an expression gave.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum ExpressionValue {
    Number(f64),
    /// In upper case.
    Word(String),
    Truth(bool),
}

pub(super) fn parse_value(bytes: &[u8]) -> ExpressionValue {
    if let Some(number) = number::parse_number(bytes) {
        return ExpressionValue::Number(number);
    }
    let inner = bytes.strip_prefix(b"'").and_then(|bytes| bytes.strip_suffix(b"'")).unwrap_or(bytes);
    ExpressionValue::Word(fold_word(&operation::decode_text(inner)))
}

/// A word as words are compared: in upper case, runs of blanks as one.
pub(super) fn fold_word(word: &str) -> String {
    let words: Vec<String> = word.split_whitespace().map(str::to_ascii_uppercase).collect();
    words.join(" ")
}

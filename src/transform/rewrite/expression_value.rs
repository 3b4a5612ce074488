//! This module holds the values of expressions and of bound arguments.

use crate::number;
use crate::program::operation;

/// The value of an expression.
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

/// Returns a word in the form in which words are compared: in upper case, with single blanks.
pub(super) fn fold_word(word: &str) -> String {
    let words: Vec<String> = word.split_whitespace().map(str::to_ascii_uppercase).collect();
    words.join(" ")
}

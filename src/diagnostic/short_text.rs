//! This module cuts texts of findings that are too long to be read.

/// The length from which a text is cut, in bytes. No text that clsmith itself makes is so long; a word of a file may be.
const LONGEST_TEXT: usize = 1500;

/// How much is kept at the end of a text that is cut, in bytes: who writes a message often says the reason there.
const KEPT_END: usize = 500;

/// Returns a text that is at most some hundred characters long. A longer one loses its middle, and an ellipsis says how
/// much of it.
pub(super) fn shorten_text(mut text: String) -> String {
    if text.len() <= LONGEST_TEXT {
        return text;
    }
    let start = floor_to_character(&text, LONGEST_TEXT - KEPT_END);
    let end = floor_to_character(&text, text.len() - KEPT_END);
    let left_out = end - start;
    text.replace_range(start..end, &format!(" ... ({left_out} bytes left out) ... "));
    text
}

/// The last place at or before a byte at which a character begins.
fn floor_to_character(text: &str, at: usize) -> usize {
    (0..=at).rev().find(|&at| text.is_char_boundary(at)).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_texts_that_are_too_long_are_cut() {
        let usual = "x".repeat(LONGEST_TEXT);
        assert_eq!(shorten_text(usual.clone()), usual);
        let cut = shorten_text(format!("`{}` is not a number", "\u{e4}".repeat(70_000)));
        assert!(cut.len() < LONGEST_TEXT + 50, "{}", cut.len());
        assert!(cut.starts_with("`\u{e4}") && cut.ends_with("\u{e4}` is not a number"));
        assert!(cut.contains("bytes left out"), "{cut}");
    }
}

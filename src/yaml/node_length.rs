//! This module measures how far a YAML key or value extends from its start. A diagnostic underlines that
//! range.
//!
//! The text is known to be valid YAML here, and a wrong result only underlines too much or too little. So
//! these functions know only as much of YAML as they need: quotes, brackets, anchors and comments.

/// Skips `&anchor` and `!tag` before a node.
pub(super) fn skip_anchor_and_tag(text: &str, offset: usize) -> usize {
    let mut at = offset;
    while let Some(rest) = text.get(at..).filter(|rest| rest.starts_with(['&', '!'])) {
        let word = rest.find([' ', '\t', '\r', '\n', ',', ']', '}']).unwrap_or(rest.len());
        let after = rest.get(word..).unwrap_or_default();
        at += word + skip_blanks_and_comments(after);
    }
    at
}

fn skip_blanks_and_comments(text: &str) -> usize {
    let mut at = 0;
    loop {
        let rest = text.get(at..).unwrap_or_default();
        at += rest.len() - rest.trim_start().len();
        let rest = text.get(at..).unwrap_or_default();
        if !rest.starts_with('#') {
            return at;
        }
        at += rest.find('\n').unwrap_or(rest.len());
    }
}

/// Returns the length of the node at the start of `text`. It is the whole of a quoted scalar or a bracketed
/// collection, and the first line of a block collection or a block scalar. `plain` is the text of an unquoted
/// scalar.
pub(super) fn measure_node(text: &str, plain: Option<&str>) -> usize {
    match text.as_bytes().first() {
        Some(b'"') => measure_quoted(text, b'"'),
        Some(b'\'') => measure_quoted(text, b'\''),
        Some(b'{' | b'[') => measure_bracketed(text),
        _ => match plain {
            Some(plain) if text.starts_with(plain) => plain.len(),
            Some(_) => measure_first_line(text),
            None => measure_first_word(text).unwrap_or_else(|| measure_first_line(text)),
        },
    }
}

/// Returns the length of a number, `true` or `null`, which ends where YAML ends a word inside or outside of
/// brackets. Returns `None` for `key: value` and `- item`.
fn measure_first_word(text: &str) -> Option<usize> {
    let end = text.find([' ', '\t', '\r', '\n', ',', ']', '}']).unwrap_or(text.len());
    let word = text.get(..end)?;
    (!word.ends_with(':') && !matches!(word, "-" | "?")).then_some(end)
}

fn measure_first_line(text: &str) -> usize {
    let line = text.lines().next().unwrap_or_default();
    let code = line.find(" #").and_then(|comment| line.get(..comment)).unwrap_or(line);
    code.trim_end().len()
}

fn measure_quoted(text: &str, quote: u8) -> usize {
    let bytes = text.as_bytes();
    let mut at = 1;
    while let Some(&byte) = bytes.get(at) {
        let escaped = match quote {
            b'"' => byte == b'\\',
            _ => byte == b'\'' && bytes.get(at + 1) == Some(&b'\''),
        };
        if escaped {
            at += 2;
        } else if byte == quote {
            return at + 1;
        } else {
            at += 1;
        }
    }
    text.len()
}

fn measure_bracketed(text: &str) -> usize {
    let bytes = text.as_bytes();
    let (mut at, mut depth) = (0, 0_usize);
    let mut before = b' ';
    while let Some(&byte) = bytes.get(at) {
        let mut step = 1;
        match byte {
            b'{' | b'[' => depth += 1,
            b'}' | b']' => depth = depth.saturating_sub(1),
            // A quote inside a plain word is an apostrophe.
            b'"' | b'\'' if matches!(before, b' ' | b'\t' | b'\n' | b'[' | b'{' | b',' | b':') => {
                step = measure_quoted(text.get(at..).unwrap_or_default(), byte);
            }
            b'#' if before.is_ascii_whitespace() => {
                step = text.get(at..).and_then(|rest| rest.find('\n')).unwrap_or(text.len() - at);
            }
            _ => {}
        }
        before = byte;
        at += step;
        if depth == 0 {
            return at;
        }
    }
    text.len()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[track_caller]
    fn token(text: &str, plain: Option<&str>, expected: &str) {
        let start = skip_anchor_and_tag(text, 0);
        let rest = &text[start..];
        assert_eq!(&rest[..measure_node(rest, plain)], expected);
    }

    #[test]
    fn a_token_is_all_of_the_value_and_nothing_else() {
        token("0.5  # half", None, "0.5");
        token("0.5, b: 1}", None, "0.5");
        token("5 mm # long", Some("5 mm"), "5 mm");
        token("\"a \\\" # b\" # c", Some("a \" # b"), "\"a \\\" # b\"");
        token("'it''s' x", Some("it's"), "'it''s'");
        token("{ a: [1, '}'], b: it's } # c", None, "{ a: [1, '}'], b: it's }");
        token("[ 1, # one ]\n 2 ]\n", None, "[ 1, # one ]\n 2 ]");
        token("&a !t # why\n  7\n", None, "7");
        token("a: 1 # one\nb: 2", None, "a: 1");
        token("- 1\n- 2", None, "- 1");
        token("| # text\n  a\n", Some("a\n"), "|");
        token("two\n  lines", Some("two lines"), "two");
        token("", None, "");
    }
}

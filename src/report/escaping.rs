//! This module escapes text of files for HTML and Markdown, so that it is shown and never interpreted as
//! markup.

use crate::presentation::safe_text::{to_safe_line, to_visible_character};

/// Returns text as HTML that only shows it. Line breaks stay.
pub(super) fn escape_html(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => out.push_str("&amp;"),
            '<' => out.push_str("&lt;"),
            '>' => out.push_str("&gt;"),
            '"' => out.push_str("&quot;"),
            '\'' => out.push_str("&#39;"),
            '\n' => out.push('\n'),
            '\r' => {}
            c => out.push(to_visible_character(c, true)),
        }
    }
    out
}

/// Returns text as one line of Markdown that only shows it.
pub(super) fn escape_markdown(text: &str) -> String {
    let mut out = String::new();
    for c in to_safe_line(text).chars() {
        if matches!(
            c,
            '\\' | '`' | '*' | '_' | '[' | ']' | '<' | '>' | '|' | '~' | '#' | '&' | '$' | '@' | '!'
        ) {
            out.push('\\');
        }
        out.push(c);
    }
    out
}

//! Text as HTML.

use crate::presentation::safe_text::to_visible_character;
use std::io::{self, Write};

/// Text as HTML that shows it and does nothing else; line breaks stay.
pub fn escape_html(text: &str) -> String {
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

/// Writes text.
pub fn write_text(out: &mut dyn Write, text: &str) -> io::Result<()> {
    out.write_all(escape_html(text).as_bytes())
}

/// Writes a table: the first `left` columns to the left, numbers to the right.
pub fn write_table<S: AsRef<str>>(
    out: &mut dyn Write,
    head: &[&str],
    left: usize,
    rows: &[Vec<S>],
) -> io::Result<()> {
    out.write_all(b"<div class=\"wide\"><table><thead><tr>")?;
    let class = |column: usize| if column < left { "" } else { " class=\"n\"" };
    for (column, cell) in head.iter().enumerate() {
        write!(out, "<th{}>{}</th>", class(column), escape_html(cell))?;
    }
    out.write_all(b"</tr></thead><tbody>\n")?;
    for row in rows {
        out.write_all(b"<tr>")?;
        for (column, cell) in row.iter().enumerate() {
            write!(out, "<td{}>{}</td>", class(column), escape_html(cell.as_ref()))?;
        }
        out.write_all(b"</tr>\n")?;
    }
    out.write_all(b"</tbody></table></div>\n")
}

/// A value as JSON that may stand in a script element.
pub fn to_script_json(value: &serde_json::Value) -> String {
    value.to_string().replace('<', "\\u003c")
}

//! This module writes text as HTML.

use crate::report::escaping::escape_html;
use std::io::{self, Write};

/// Writes text, escaped so that it is only shown.
pub(super) fn write_text(out: &mut dyn Write, text: &str) -> io::Result<()> {
    out.write_all(escape_html(text).as_bytes())
}

/// Returns a value as JSON that is safe in a script element.
pub(super) fn to_script_json(value: &serde_json::Value) -> String {
    // `</script`, `<script` and `<!--` would be read as HTML even inside of a script element. All of them
    // begin with this character.
    value.to_string().replace('<', "\\u003c")
}

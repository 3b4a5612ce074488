//! This module writes one line for each finding, for editors, `grep` and logs.

use super::NO_FILE;
use crate::diagnostic::Diagnostic;
use crate::presentation::safe_text;
use std::io::{self, Write};

/// Writes `file:line:column: CODE: message` for each finding, and `file: CODE: message` for one without a
/// place. The message of a finding that `--allow` named begins with `allowed: `.
///
/// The place is that of the first label. Columns count bytes from 1. Line breaks in messages become blanks,
/// so every line is a finding. `file` is the name of the run's file, for findings without a place.
///
/// ```
/// use clsmith::parse::parse;
/// use clsmith::report::render::line::render_lines;
/// use clsmith::source::Source;
///
/// let source = Source::new("part.cls", b"GOTO/1,2,3O\n".to_vec())?;
/// let mut text = Vec::new();
/// render_lines(&mut text, &parse(&source, None).diagnostics, None)?;
/// assert!(text.starts_with(b"part.cls:1:10: CL0003"), "{}", String::from_utf8_lossy(&text));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Returns the errors of the writer.
pub fn render_lines(out: &mut dyn Write, diagnostics: &[Diagnostic], file: Option<&str>) -> io::Result<()> {
    diagnostics.iter().try_for_each(|found| writeln!(out, "{}", format_finding_line(found, file)))
}

pub(super) fn format_finding_line(found: &Diagnostic, file: Option<&str>) -> String {
    let place = match found.labels.first() {
        Some(label) => {
            let (line, column) = label.source.line_column(label.span.start);
            format!("{}:{line}:{column}", label.source.name())
        }
        None => file.unwrap_or(NO_FILE).to_owned(),
    };
    format!(
        "{}: {}: {}{}",
        safe_text::to_safe_line(&place),
        found.code,
        if found.is_allowed { "allowed: " } else { "" },
        safe_text::to_safe_line(&found.message)
    )
}

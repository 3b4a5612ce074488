//! This module writes what the catalogue of findings knows about a code: its meaning, severity, explanation
//! and help.

use crate::diagnostic::{CATALOGUE, DiagnosticCode};
use std::fmt::Write;

const WIDTH: usize = 80;

/// Returns everything that the catalogue contains about a code, wrapped at 80 columns.
///
/// ```
/// use clsmith::diagnostic::codes;
/// use clsmith::report::explain::explain_code;
///
/// assert!(explain_code(codes::BAD_NUMBER).starts_with("CL0003"));
/// ```
pub fn explain_code(code: DiagnosticCode) -> String {
    let mut text = format!("{code}: {} ({})\n", code.meaning(), code.severity());
    for part in [code.explanation(), code.help()] {
        if !part.is_empty() {
            text.push('\n');
            text.push_str(&wrap_paragraphs(part));
        }
    }
    text
}

/// Returns all codes, one on each line: code, severity, meaning.
pub fn list_codes() -> String {
    let mut text = String::new();
    for code in CATALOGUE.iter().flat_map(|rows| rows.iter()) {
        // Writing to a String cannot fail.
        let _ = writeln!(text, "{code}  {:<7}  {}", code.severity().to_string(), code.meaning());
    }
    text
}

/// Wraps paragraphs. Lines that start with a blank belong to a table or an example and are not wrapped.
fn wrap_paragraphs(text: &str) -> String {
    let mut wrapped = String::new();
    for line in text.lines() {
        if line.starts_with(' ') {
            wrapped.push_str(line);
        } else {
            let mut column = 0;
            for word in line.split(' ') {
                let length = word.chars().count();
                if column > 0 && column + 1 + length > WIDTH {
                    wrapped.push('\n');
                    column = 0;
                } else if column > 0 {
                    wrapped.push(' ');
                    column += 1;
                }
                wrapped.push_str(word);
                column += length;
            }
        }
        wrapped.push('\n');
    }
    wrapped
}

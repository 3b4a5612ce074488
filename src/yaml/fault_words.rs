//! This module translates serde's terms into the words of a machinist.

use serde::de::{Expected, Unexpected};

/// Words what was found: `the text `5 mm``, `the number 5`, `a list`.
pub(super) fn describe_found(found: Unexpected<'_>) -> String {
    match found {
        Unexpected::Bool(value) => format!("`{value}`"),
        Unexpected::Unsigned(value) => format!("the number {value}"),
        Unexpected::Signed(value) => format!("the number {value}"),
        Unexpected::Float(value) if value.is_nan() => "`.nan`".to_owned(),
        Unexpected::Float(value) if value.is_infinite() => {
            if value > 0.0 { "`.inf`" } else { "`-.inf`" }.to_owned()
        }
        Unexpected::Float(value) => format!("the number {value}"),
        Unexpected::Str(text) => format!("the text {}", quote_text(text)),
        Unexpected::Unit | Unexpected::Option => "nothing".to_owned(),
        Unexpected::Seq => "a list".to_owned(),
        Unexpected::Map => "a map (`key: value`)".to_owned(),
        other => other.to_string(),
    }
}

/// Words what was expected. serde names Rust types, which mean nothing to people who write recipes.
pub(super) fn describe_expected(expected: &dyn Expected) -> String {
    let text = expected.to_string();
    let plain = match text.as_str() {
        "a string" | "a character" | "a borrowed string" | "path string" => "text",
        "a boolean" => "`true` or `false`",
        "f64" | "f32" => "a number",
        "u8" | "u16" | "u32" | "u64" | "usize" => "a whole number, 0 or more",
        "i8" | "i16" | "i32" | "i64" | "isize" => "a whole number",
        "a sequence" => "a list",
        "a map" => "a map (`key: value`)",
        "unit" => "nothing",
        text if text.starts_with("struct ") => "a map (`key: value`)",
        text => return describe_array(text).unwrap_or_else(|| text.to_owned()),
    };
    plain.to_owned()
}

fn describe_array(text: &str) -> Option<String> {
    let count = text.strip_prefix("an array of length ").or_else(|| text.strip_prefix("a tuple of size "))?;
    Some(format!("a list of {}", count_elements(count.parse().ok()?)))
}

/// Words a number of elements: `1 element`, `2 elements`.
pub(super) fn count_elements(count: usize) -> String {
    format!("{count} element{}", if count == 1 { "" } else { "s" })
}

/// Returns the text between backticks, shortened and on one line.
pub(super) fn quote_text(text: &str) -> String {
    const MOST: usize = 40;
    let line: String = text.chars().take(MOST).map(|c| if c.is_control() { ' ' } else { c }).collect();
    let more = if text.chars().nth(MOST).is_some() { "…" } else { "" };
    format!("`{line}{more}`")
}

/// Joins names with commas and `or`, each between backticks: `a`, `a or b`, `a, b or c`.
pub(super) fn join_choices(names: &[&str]) -> String {
    let names: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match names.split_last() {
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} or {last}", rest.join(", ")),
        None => "nothing".to_owned(),
    }
}

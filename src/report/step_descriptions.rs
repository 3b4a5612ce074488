//! This module describes the steps of recipes from the doc comments of their parameters.

use crate::transform;
use serde_json::{Map, Value};

/// Returns one line for each step: its name and the first sentence of its description.
pub fn list_steps() -> String {
    let mut text = String::new();
    for name in transform::NAMES {
        let schema = step_schema(name).unwrap_or_default();
        let first = schema_description(&schema).lines().next().unwrap_or_default().to_owned();
        text.push_str(&format!("{name:<16} {first}\n"));
    }
    text.push_str("\n`clsmith transforms NAME` describes one.\n");
    text
}

/// Returns what a step does, with its parameters. Returns `None` if there is no such step.
///
/// ```
/// use clsmith::report::step_descriptions::describe_step;
///
/// assert!(describe_step("scale_feed").is_some_and(|text| text.contains("factor")));
/// assert_eq!(describe_step("scale_fed"), None);
/// ```
pub fn describe_step(name: &str) -> Option<String> {
    let schema = step_schema(name)?;
    let mut text = format!("{name}\n\n{}\n\nParameters:\n", wrap_paragraphs(&schema_description(&schema), 0));
    let definitions = schema.get("$defs").and_then(Value::as_object).cloned().unwrap_or_default();
    append_parameters(&schema, &definitions, 1, &mut text);
    Some(text)
}

fn step_schema(name: &str) -> Option<Value> {
    transform::schema_of(name).map(schemars::Schema::to_value)
}

fn schema_description(schema: &Value) -> String {
    schema.get("description").and_then(Value::as_str).unwrap_or_default().to_owned()
}

/// Parameters that are nested deeper than this are rules of their own and explained elsewhere.
const DEEPEST: usize = 4;

fn append_parameters(schema: &Value, definitions: &Map<String, Value>, depth: usize, text: &mut String) {
    let Some(properties) = schema.get("properties").and_then(Value::as_object) else { return };
    let required: Vec<&str> = schema
        .get("required")
        .and_then(Value::as_array)
        .map(|names| names.iter().filter_map(Value::as_str).collect())
        .unwrap_or_default();
    let indent = "  ".repeat(depth);
    for (name, property) in properties {
        let target = resolve_schema(property, definitions);
        let own = schema_description(property);
        let told = if own.is_empty() { schema_description(&target) } else { own };
        let needed = if required.contains(&name.as_str()) { " (required)" } else { "" };
        text.push_str(&format!("{indent}{name}: {}{needed}\n", describe_value_kind(&target, definitions)));
        if !told.is_empty() {
            text.push_str(&wrap_paragraphs(&told, depth + 2));
            text.push('\n');
        }
        let inner = target.get("items").map(|items| resolve_schema(items, definitions)).unwrap_or(target);
        if depth < DEEPEST {
            append_parameters(&inner, definitions, depth + 1, text);
        }
    }
}

/// Follows `$ref`, and the alternative of an optional value that is not null.
fn resolve_schema(schema: &Value, definitions: &Map<String, Value>) -> Value {
    if let Some(name) = schema.get("$ref").and_then(Value::as_str).and_then(|path| path.rsplit('/').next()) {
        return definitions
            .get(name)
            .map_or_else(|| schema.clone(), |found| resolve_schema(found, definitions));
    }
    let alternatives = schema.get("anyOf").and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default();
    let mut real = alternatives.iter().filter(|one| one.get("type").and_then(Value::as_str) != Some("null"));
    match (real.next(), real.next()) {
        (Some(only), None) => resolve_schema(only, definitions),
        _ => schema.clone(),
    }
}

/// Words the kind of a value.
fn describe_value_kind(schema: &Value, definitions: &Map<String, Value>) -> String {
    let words = |key: &str| {
        let values = schema.get(key).and_then(Value::as_array)?;
        let names: Vec<String> = values
            .iter()
            .filter(|value| value.get("type").and_then(Value::as_str) != Some("null"))
            .map(|value| match value {
                Value::String(word) => word.clone(),
                _ => describe_value_kind(&resolve_schema(value, definitions), definitions),
            })
            .collect();
        Some(names.join(" | "))
    };
    if let Some(word) = schema.get("const") {
        return word.as_str().map_or_else(|| word.to_string(), str::to_owned);
    }
    if let Some(choices) = words("enum").or_else(|| words("oneOf")).or_else(|| words("anyOf")) {
        return choices;
    }
    let kind = match schema.get("type") {
        Some(Value::String(kind)) => kind.clone(),
        Some(Value::Array(kinds)) => kinds
            .iter()
            .filter_map(Value::as_str)
            .filter(|kind| *kind != "null")
            .collect::<Vec<_>>()
            .join(" | "),
        _ => "value".to_owned(),
    };
    match (kind.as_str(), schema.get("items")) {
        ("array", Some(items)) => format!("list of {}", describe_item_kind(items, definitions)),
        ("object", _) => "map".to_owned(),
        _ => kind,
    }
}

fn describe_item_kind(items: &Value, definitions: &Map<String, Value>) -> String {
    describe_value_kind(&resolve_schema(items, definitions), definitions)
}

/// Wraps paragraphs and items of lists to 96 columns. Indented lines (examples) stay.
fn wrap_paragraphs(text: &str, depth: usize) -> String {
    let indent = "  ".repeat(depth);
    let mut lines: Vec<String> = Vec::new();
    for paragraph in text.split("\n\n") {
        if !lines.is_empty() {
            lines.push(String::new());
        }
        if paragraph.lines().all(|line| line.starts_with("  ") || line.starts_with("```")) {
            lines.extend(paragraph.lines().map(|line| format!("{indent}{line}")));
            continue;
        }
        let mut line = indent.clone();
        for (word, starts_item) in split_words(paragraph) {
            let full = line.chars().count() + 1 + word.chars().count() > 96;
            if line.len() > indent.len() && (starts_item || full) {
                lines.push(std::mem::replace(&mut line, indent.clone()));
            }
            if line.len() > indent.len() {
                line.push(' ');
            }
            line.push_str(word);
        }
        lines.push(line);
    }
    lines.join("\n")
}

/// Returns the words of a paragraph, each with whether it is the dash at the start of a list item.
fn split_words(paragraph: &str) -> impl Iterator<Item = (&str, bool)> {
    paragraph.lines().flat_map(|line| {
        let dash = line.trim_start().starts_with("- ");
        line.split_whitespace().enumerate().map(move |(index, word)| (word, dash && index == 0))
    })
}

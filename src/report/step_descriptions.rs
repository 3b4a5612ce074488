//! This module describes the steps of recipes from the doc comments and the schemas of their parameters.

use super::schema_wording::{
    Definitions, describe_facts, describe_value_kind, list_keys, resolve_schema, schema_description,
};
use crate::transform;
use serde_json::Value;

/// The largest number of columns that are used, because longer lines of prose are hard to read.
const WIDEST: usize = 96;

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

/// Returns what a step does, an example, and all parameters with unit, range and default. Returns `None` if
/// there is no such step.
///
/// ```
/// use clsmith::report::step_descriptions::describe_step;
///
/// assert!(describe_step("scale_feed").is_some_and(|text| text.contains("factor")));
/// assert_eq!(describe_step("scale_fed"), None);
/// ```
pub fn describe_step(name: &str) -> Option<String> {
    describe_step_in(name, WIDEST)
}

/// Does the same as [`describe_step`], with lines of at most `columns` characters. At most 96 are used.
pub fn describe_step_in(name: &str, columns: usize) -> Option<String> {
    let columns = columns.min(WIDEST);
    let schema = step_schema(name)?;
    let described = schema_description(&schema);
    let (what, _) = split_example(&described);
    let mut text = format!("{name}\n\n{}\n", wrap_paragraphs(what.trim_end(), 0, columns));
    if let Some(example) = step_example(name) {
        let indented: Vec<String> = example.lines().map(|line| format!("  {line}")).collect();
        text.push_str(&format!("\nExample:\n{}\n", indented.join("\n")));
    }
    text.push_str("\nParameters:\n");
    let definitions = schema.get("$defs").and_then(Value::as_object).cloned().unwrap_or_default();
    append_parameters(&schema, &definitions, (1, columns), &mut text);
    Some(text)
}

/// Returns the recipe that a step's description shows as its example.
///
/// ```
/// use clsmith::report::step_descriptions::step_example;
///
/// assert!(step_example("scale_feed").is_some_and(|recipe| recipe.starts_with("version: 1\n")));
/// ```
pub fn step_example(name: &str) -> Option<String> {
    let described = schema_description(&step_schema(name)?);
    let (_, example) = split_example(&described);
    let mut text: String = example?.lines().map(|line| format!("{line}\n")).collect();
    text.truncate(text.trim_end().len());
    Some(text + "\n")
}

/// Splits a description into its prose and its example, which is a block of YAML at its end.
fn split_example(described: &str) -> (&str, Option<&str>) {
    let Some((what, example)) = described.split_once("```yaml\n") else { return (described, None) };
    (what, example.split_once("```").map(|(example, _)| example))
}

fn step_schema(name: &str) -> Option<Value> {
    transform::schema_of(name).map(schemars::Schema::to_value)
}

/// Parameters that are nested deeper than this are not listed. They have documentation of their own.
const DEEPEST: usize = 4;

fn append_parameters(
    schema: &Value,
    definitions: &Definitions,
    (depth, columns): (usize, usize),
    text: &mut String,
) {
    let indent = "  ".repeat(depth);
    for (name, property, is_required) in list_keys(schema, definitions) {
        let target = resolve_schema(&property, definitions);
        let own = schema_description(&property);
        let what = if own.is_empty() { schema_description(&target) } else { own };
        let needed = if is_required { " (required)" } else { "" };
        text.push_str(&format!("{indent}{name}: {}{needed}\n", describe_value_kind(&target, definitions)));
        for part in [what, describe_facts(&property, &target, is_required)] {
            if !part.is_empty() {
                text.push_str(&wrap_paragraphs(&part, depth + 2, columns));
                text.push('\n');
            }
        }
        let inner = target.get("items").map(|items| resolve_schema(items, definitions)).unwrap_or(target);
        if depth < DEEPEST {
            append_parameters(&inner, definitions, (depth + 1, columns), text);
        }
    }
}
/// Wraps paragraphs and items of lists. Indented lines (examples) stay.
fn wrap_paragraphs(text: &str, depth: usize, columns: usize) -> String {
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
            let full = line.chars().count() + 1 + word.chars().count() > columns;
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

//! This module describes parts of a JSON schema in words for people: kinds of values, ranges, units and
//! defaults.
//!
//! JSON schema has no key for units, nor for defaults that only words can describe. They are under the keys
//! `x-unit` and `x-default` of the parameter that they are about.

use serde_json::{Map, Value};

/// The definitions to which a schema refers.
pub(super) type Definitions = Map<String, Value>;

/// Returns the description of a schema.
pub(super) fn schema_description(schema: &Value) -> String {
    schema.get("description").and_then(Value::as_str).unwrap_or_default().to_owned()
}

/// Resolves a schema: follows `$ref`, and takes the alternative of an optional value that is not null.
pub(super) fn resolve_schema(schema: &Value, definitions: &Definitions) -> Value {
    if let Some(name) = schema.get("$ref").and_then(Value::as_str).and_then(|path| path.rsplit('/').next()) {
        return definitions
            .get(name)
            .map_or_else(|| schema.clone(), |found| resolve_schema(found, definitions));
    }
    let alternatives = list_alternatives(schema, "anyOf");
    let mut real = alternatives.iter().filter(|one| one.get("type").and_then(Value::as_str) != Some("null"));
    match (real.next(), real.next()) {
        (Some(only), None) => resolve_schema(only, definitions),
        _ => schema.clone(),
    }
}

fn list_alternatives<'s>(schema: &'s Value, key: &str) -> &'s [Value] {
    schema.get(key).and_then(Value::as_array).map(Vec::as_slice).unwrap_or_default()
}

/// Returns the keys of a map, with their schemas and whether they are required. The keys of alternatives that
/// are maps are included.
pub(super) fn list_keys(schema: &Value, definitions: &Definitions) -> Vec<(String, Value, bool)> {
    let required: Vec<&str> =
        list_alternatives(schema, "required").iter().filter_map(Value::as_str).collect();
    let own = schema.get("properties").and_then(Value::as_object).into_iter().flatten();
    let mut keys: Vec<(String, Value, bool)> = own
        .map(|(name, property)| (name.clone(), property.clone(), required.contains(&name.as_str())))
        .collect();
    for alternative in ["oneOf", "anyOf"].into_iter().flat_map(|key| list_alternatives(schema, key)) {
        let alternative = resolve_schema(alternative, definitions);
        let is_choice = find_only_key(&alternative).is_some();
        for (name, mut property, needed) in list_keys(&alternative, definitions) {
            // A choice is written as `name: value`, and its description and unit are those of the value.
            if let (true, Value::Object(of_value), Value::Object(of_choice)) =
                (is_choice, &mut property, &alternative)
            {
                let said = of_choice.iter().filter(|(key, _)| *key == "description" || key.starts_with("x-"));
                of_value.extend(said.map(|(key, value)| (key.clone(), value.clone())));
            }
            keys.push((name, property, needed && !is_choice));
        }
    }
    keys
}

/// Returns the key of a choice that is written as `name: value`.
fn find_only_key(schema: &Value) -> Option<(&String, &Value)> {
    let properties = schema.get("properties").and_then(Value::as_object)?;
    let mut all = properties.iter();
    all.next().filter(|_| properties.len() == 1 && schema.get("required").is_some())
}

/// Describes the kind of a value: `number`, `milled | hull | polygon: list`.
pub(super) fn describe_value_kind(schema: &Value, definitions: &Definitions) -> String {
    if let Some(word) = schema.get("const") {
        return word.as_str().map_or_else(|| word.to_string(), str::to_owned);
    }
    for key in ["enum", "oneOf", "anyOf"] {
        let names: Vec<String> = list_alternatives(schema, key)
            .iter()
            .filter(|value| value.get("type").and_then(Value::as_str) != Some("null"))
            .map(|value| match value {
                Value::String(word) => word.clone(),
                _ => describe_value_kind(&resolve_schema(value, definitions), definitions),
            })
            .collect();
        if !names.is_empty() {
            return names.join(" | ");
        }
    }
    if let Some((name, value)) = find_only_key(schema) {
        let value = resolve_schema(value, definitions);
        return format!("`{name}: {}`", describe_value_kind(&value, definitions));
    }
    let kind = describe_type(schema);
    match (kind.as_str(), schema.get("items")) {
        ("array", Some(items)) => {
            let items = describe_value_kind(&resolve_schema(items, definitions), definitions);
            let [least, most] = ["minItems", "maxItems"].map(|key| schema.get(key).and_then(Value::as_u64));
            match least.filter(|_| least == most) {
                Some(count) => format!("list of {count} x {items}"),
                None => format!("list of {items}"),
            }
        }
        ("object", _) => "map".to_owned(),
        _ => kind,
    }
}

fn describe_type(schema: &Value) -> String {
    match schema.get("type") {
        Some(Value::String(kind)) => kind.clone(),
        Some(Value::Array(kinds)) => {
            let kinds = kinds.iter().filter_map(Value::as_str).filter(|kind| *kind != "null");
            kinds.collect::<Vec<_>>().join(" | ")
        }
        _ => "value".to_owned(),
    }
}

/// Describes what is known of a value besides its kind: `Unit: rev/min. Range: above 0. Default: all.`
pub(super) fn describe_facts(property: &Value, target: &Value, is_required: bool) -> String {
    let said = |key: &str| [property, target].into_iter().find_map(|schema| schema.get(key));
    let unit = said("x-unit").and_then(Value::as_str).map(|unit| format!("Unit: {unit}."));
    let range = describe_range(target).map(|range| format!("Range: {range}."));
    let stated = said("default").filter(|default| !default.is_null()).map(word_value);
    let default = stated.or_else(|| said("x-default").map(word_value)).filter(|_| !is_required);
    let default = default.map(|default| format!("Default: {default}."));
    [unit, range, default].into_iter().flatten().collect::<Vec<_>>().join(" ")
}

/// Describes the range of a number. Returns `None` if it has no bounds.
fn describe_range(schema: &Value) -> Option<String> {
    let bound =
        |key: &str| schema.get(key).and_then(Value::as_f64).filter(|bound| *bound < f64::from(u32::MAX));
    let low = bound("minimum")
        .map(|low| format!("{low} or more"))
        .or_else(|| bound("exclusiveMinimum").map(|low| format!("above {low}")));
    let high = bound("maximum")
        .map(|high| format!("up to {high}"))
        .or_else(|| bound("exclusiveMaximum").map(|high| format!("below {high}")));
    match (low, high) {
        (Some(low), Some(high)) => Some(format!("{low}, {high}")),
        (low, high) => low.or(high),
    }
}

/// Returns a value as it is written in a recipe.
fn word_value(value: &Value) -> String {
    match value {
        Value::String(text) => text.clone(),
        Value::Array(values) => {
            format!("[{}]", values.iter().map(word_value).collect::<Vec<_>>().join(", "))
        }
        Value::Number(number) => {
            number.as_f64().map_or_else(|| number.to_string(), |value| value.to_string())
        }
        other => other.to_string(),
    }
}

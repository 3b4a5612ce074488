//! This module makes the JSON schemas of files, with which editors complete, explain and check.
//!
//! Each schema is named by a URN and not by an address, so that no editor asks a network for it. Keys that choose one of
//! several kinds (the steps of a recipe, the bodies of a stock) are described where the key stands, because editors show
//! the description of a key and not that of the alternative around it.

use schemars::JsonSchema;
use serde_json::{Map, Value};

/// Returns the JSON schema of a kind of file: `recipe` is named `urn:clsmith:schema:recipe`.
pub(crate) fn make_file_schema<T: JsonSchema>(kind: &str) -> Value {
    let mut schema = schemars::schema_for!(T).to_value();
    let definitions = schema.get("$defs").and_then(Value::as_object).cloned().unwrap_or_default();
    describe_choices(&mut schema, &definitions);
    if let Value::Object(root) = &mut schema {
        root.insert("$id".to_owned(), format!("urn:clsmith:schema:{kind}").into());
    }
    schema
}

/// Describes the key of every alternative that is a map with this one key, in the whole of a schema.
fn describe_choices(schema: &mut Value, definitions: &Map<String, Value>) {
    match schema {
        Value::Array(parts) => parts.iter_mut().for_each(|part| describe_choices(part, definitions)),
        Value::Object(parts) => {
            let alternatives = parts.get_mut("oneOf").and_then(Value::as_array_mut);
            alternatives.into_iter().flatten().for_each(|one| describe_only_key(one, definitions));
            parts.values_mut().for_each(|part| describe_choices(part, definitions));
        }
        _ => {}
    }
}

/// Gives the only key of an alternative the description of the alternative, or the first paragraph of that of its value.
fn describe_only_key(alternative: &mut Value, definitions: &Map<String, Value>) {
    let said = read_description(alternative);
    let Some(keys) = alternative.get_mut("properties").and_then(Value::as_object_mut) else { return };
    let mut all = keys.iter_mut();
    let (Some((key, Value::Object(only))), None) = (all.next(), all.next()) else { return };
    // The alternatives of steps say nothing but their names.
    let said = said.filter(|text| *text != format!("`{key}`."));
    if only.contains_key("description") {
        return;
    }
    let name = only.get("$ref").and_then(Value::as_str).and_then(|path| path.rsplit('/').next());
    let of_value = || name.and_then(|name| read_description(definitions.get(name)?));
    if let Some(text) = said.or_else(of_value) {
        let first = text.split("\n\n").next().unwrap_or_default().to_owned();
        only.insert("description".to_owned(), first.into());
    }
}

fn read_description(schema: &Value) -> Option<String> {
    schema.get("description").and_then(Value::as_str).map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::make_file_schema;
    use schemars::JsonSchema;

    /// A choice.
    #[derive(JsonSchema)]
    #[allow(dead_code)]
    #[schemars(rename_all = "snake_case")]
    enum Choice {
        /// A number of teeth.
        Teeth(u32),
        Shape(Shape),
    }

    /// A shape.
    ///
    /// More about it.
    #[derive(JsonSchema)]
    #[allow(dead_code)]
    struct Shape {
        /// Its width.
        width: f64,
    }

    #[test]
    fn a_choice_is_described_where_its_key_stands() {
        let schema = make_file_schema::<Choice>("choice");
        assert_eq!(schema["$id"], "urn:clsmith:schema:choice");
        let of_key = |at: usize, key: &str| schema["oneOf"][at]["properties"][key]["description"].clone();
        assert_eq!(of_key(0, "teeth"), "A number of teeth.");
        assert_eq!(of_key(1, "shape"), "A shape.");
    }
}

//! The JSON schema that editors complete from.

use super::Step;
use crate::support::snapshots;
use clsmith::recipe::recipe_schema;
use clsmith::setup::Setup;
use serde_json::Value;

#[test]
fn the_schema_of_a_recipe_and_of_a_setup_file() {
    let text = |schema: &Value| serde_json::to_string_pretty(schema).unwrap();
    snapshots("recipe").bind(|| {
        insta::assert_snapshot!("schema", text(&recipe_schema::<Step>()));
        insta::assert_snapshot!("setup_schema", text(&Setup::schema()));
    });
}

#[test]
fn what_the_recipe_refuses_the_schema_refuses() {
    let schema = recipe_schema::<Step>();
    let good: [&str; 3] = [
        "{ version: 1, steps: [{ scale_feed: { factor: 0.5, where: { tools: [1, A], motions: [cut] } } }] }",
        "{ version: 1, units: inch, setup: { machine: { max_feed: 1 } }, steps: [reverse, { shift: { by: [1, 2, 3] } }] }",
        "{ version: 1, steps: [{ rewrite: { rules: [{ find: A, replace: B }] } }] }",
    ];
    for text in good {
        super::good(text);
        assert!(fits(&schema, &schema, &serde_yaml::from_str(text).unwrap()), "{text}");
    }
    let bad = [
        "{ version: 2, steps: [] }",
        "{ version: 1 }",
        "{ version: 1, steps: [], colour: red }",
        "{ version: 1, units: furlong, steps: [] }",
        "{ version: 1, steps: [{ scale_feed: { factor: 0 } }] }",
        "{ version: 1, steps: [{ scale_feed: { factor: 1, share: 1.1 } }] }",
        "{ version: 1, steps: [{ scale_feed: { factor: 1, where: { tools: [] } } }] }",
        "{ version: 1, steps: [{ scale_feed: { factor: 1 }, reverse: {} }] }",
        "{ version: 1, steps: [{ shift: { by: [1, 2] } }] }",
        "{ version: 1, steps: [polish] }",
    ];
    for text in bad {
        super::bad(text);
        assert!(!fits(&schema, &schema, &serde_yaml::from_str(text).unwrap()), "{text}");
    }
}

/// The few keywords of JSON schema that are used here.
fn fits(root: &Value, schema: &Value, value: &Value) -> bool {
    let Some(rules) = schema.as_object() else { return schema.as_bool().unwrap() };
    rules.iter().all(|(keyword, rule)| match keyword.as_str() {
        "$ref" => fits(root, root.pointer(rule.as_str().unwrap().trim_start_matches('#')).unwrap(), value),
        "type" => match rule {
            Value::Array(types) => types.iter().any(|name| is(name, value)),
            name => is(name, value),
        },
        "const" => rule == value,
        "enum" => rule.as_array().unwrap().contains(value),
        "anyOf" => rule.as_array().unwrap().iter().any(|rule| fits(root, rule, value)),
        "oneOf" => rule.as_array().unwrap().iter().filter(|rule| fits(root, rule, value)).count() == 1,
        "minimum" => value.as_f64().is_none_or(|number| number >= rule.as_f64().unwrap()),
        "maximum" => value.as_f64().is_none_or(|number| number <= rule.as_f64().unwrap()),
        "exclusiveMinimum" => value.as_f64().is_none_or(|number| number > rule.as_f64().unwrap()),
        "minLength" => value.as_str().is_none_or(|text| text.len() as u64 >= rule.as_u64().unwrap()),
        "minItems" => value.as_array().is_none_or(|list| list.len() as u64 >= rule.as_u64().unwrap()),
        "maxItems" => value.as_array().is_none_or(|list| list.len() as u64 <= rule.as_u64().unwrap()),
        "items" => value.as_array().is_none_or(|list| list.iter().all(|item| fits(root, rule, item))),
        "required" => value.as_object().is_none_or(|map| {
            rule.as_array().unwrap().iter().all(|name| map.contains_key(name.as_str().unwrap()))
        }),
        "properties" => value.as_object().is_none_or(|map| {
            map.iter().all(|(key, value)| rule.get(key).is_none_or(|rule| fits(root, rule, value)))
        }),
        "additionalProperties" => {
            assert_eq!(rule, &Value::Bool(false));
            value.as_object().is_none_or(|map| {
                map.keys().all(|key| schema.get("properties").is_some_and(|known| known.get(key).is_some()))
            })
        }
        "$schema" | "$id" | "$defs" | "title" | "description" | "default" | "format" | "x-unit"
        | "x-default" => true,
        other => panic!("the test does not know the keyword {other}"),
    })
}

fn is(name: &Value, value: &Value) -> bool {
    match name.as_str().unwrap() {
        "object" => value.is_object(),
        "array" => value.is_array(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "null" => value.is_null(),
        "number" => value.is_number(),
        "integer" => value.is_u64() || value.is_i64(),
        other => panic!("the test does not know the type {other}"),
    }
}

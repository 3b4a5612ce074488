//! The schemas that stand in `schemas/`, and the lines by which shipped files name them.

use clsmith::setup::{Setup, WorkMaterial};
use clsmith::transform::Step;
use serde_json::Value;
use std::path::{Path, PathBuf};

fn all_schemas() -> [(&'static str, Value); 6] {
    [
        ("recipe", clsmith::recipe::recipe_schema::<Step>()),
        ("setup", Setup::schema()),
        ("material", WorkMaterial::schema()),
        ("jobs", clsmith::batch::jobs_file::jobs_schema()),
        ("select", clsmith::recipe_rules::rules_schema()),
        ("profile", clsmith::surface_milling::profile_schema()),
    ]
}

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR"))
}

/// `INSTA_UPDATE=always` writes them.
#[test]
fn the_files_are_what_the_command_prints() {
    for (kind, schema) in all_schemas() {
        let path = root().join(format!("schemas/clsmith-{kind}.schema.json"));
        let text = serde_json::to_string_pretty(&schema).unwrap() + "\n";
        if std::env::var_os("INSTA_UPDATE").is_some_and(|value| value == "always") {
            std::fs::create_dir_all(path.parent().unwrap()).unwrap();
            std::fs::write(&path, &text).unwrap();
        }
        let there = std::fs::read_to_string(&path).unwrap_or_default();
        assert!(there == text, "{} is older than the command; INSTA_UPDATE=always writes it", path.display());
    }
}

#[test]
fn every_schema_is_named_and_every_key_described() {
    let mut ids = Vec::new();
    for (kind, schema) in all_schemas() {
        assert_eq!(schema["$id"], format!("urn:clsmith:schema:{kind}"));
        assert!(schema["title"].as_str().unwrap().starts_with("clsmith "), "{kind}");
        ids.push(schema["$id"].clone());
        let mut missing = Vec::new();
        find_undescribed(&schema, kind, &mut missing);
        assert!(missing.is_empty(), "{missing:#?}");
    }
    assert_eq!(ids.len(), 6);
}

/// Keys without a description, or with one whose first paragraph says nothing but their name.
fn find_undescribed(schema: &Value, path: &str, missing: &mut Vec<String>) {
    match schema {
        Value::Object(parts) => {
            for (key, value) in parts.get("properties").and_then(Value::as_object).into_iter().flatten() {
                let text = value["description"].as_str().unwrap_or_default();
                if text.split_whitespace().count() < 2 {
                    missing.push(format!("{path}: {key}: {text:?}"));
                }
            }
            parts.iter().for_each(|(key, part)| find_undescribed(part, &format!("{path}/{key}"), missing));
        }
        Value::Array(parts) => parts.iter().for_each(|part| find_undescribed(part, path, missing)),
        _ => {}
    }
}

#[test]
fn every_shipped_file_names_its_schema() {
    let mut count = 0;
    for folder in ["configs", "examples", "docs"] {
        for entry in walkdir::WalkDir::new(root().join(folder)).into_iter().flatten() {
            let path = entry.path();
            // A job of Kubernetes is not ours.
            let is_ours =
                path.extension().is_some_and(|end| end == "yaml") && !path.ends_with("kubernetes/job.yaml");
            if !is_ours {
                continue;
            }
            count += 1;
            let text = std::fs::read_to_string(path).unwrap();
            let first = text.lines().next().unwrap_or_default();
            let name = first.strip_prefix("# yaml-language-server: $schema=");
            let name = name.unwrap_or_else(|| panic!("{}: {first}", path.display()));
            assert!(
                path.parent().unwrap_or(Path::new("")).join(name).is_file(),
                "{}: {name}",
                path.display()
            );
        }
    }
    assert!(count > 25, "{count}");
}

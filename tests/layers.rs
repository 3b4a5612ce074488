//! Imports run one way. The table is the one in ARCHITECTURE.md.

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

/// What each module of the library may import, besides itself.
const MAY_IMPORT: &[(&str, &[&str])] = &[
    ("source", &[]),
    ("number", &[]),
    ("threads", &[]),
    ("diagnostic", &["source"]),
    ("program", &["source", "number", "diagnostic"]),
    ("presentation", &["source", "number", "program"]),
    ("parse", &["source", "number", "diagnostic", "program", "threads"]),
    ("write", &["source", "number", "diagnostic", "program", "parse", "threads"]),
    ("output_files", &[]),
    ("parameters", &["source", "diagnostic", "program"]),
    ("yaml", &["source", "diagnostic", "parameters"]),
    ("cutter", &[]),
    ("stock", &["number"]),
    ("certified_engagement", &["cutter"]),
    ("engagement", &["program", "cutter", "stock", "certified_engagement"]),
    ("layered_chips", &["program", "cutter", "stock", "engagement"]),
    ("surface", &["program", "stock"]),
    ("machine", &["source", "diagnostic", "program", "presentation", "write", "engagement"]),
    (
        "setup",
        &[
            "machine",
            "source",
            "number",
            "diagnostic",
            "program",
            "presentation",
            "parameters",
            "yaml",
            "cutter",
            "stock",
            "engagement",
        ],
    ),
    ("recipe", &["source", "diagnostic", "program", "parameters", "yaml", "setup"]),
    ("recipe_rules", &["source", "diagnostic", "program", "parse", "parameters", "yaml"]),
    (
        "simulation_run",
        &[
            "machine",
            "source",
            "number",
            "diagnostic",
            "program",
            "parameters",
            "setup",
            "cutter",
            "stock",
            "engagement",
            "layered_chips",
            "certified_engagement",
            "presentation",
        ],
    ),
    ("check", &["source", "number", "diagnostic", "program", "parse", "threads"]),
    (
        "surface_milling",
        &[
            "source",
            "diagnostic",
            "program",
            "parse",
            "write",
            "parameters",
            "yaml",
            "cutter",
            "stock",
            "engagement",
            "surface",
            "simulation_run",
        ],
    ),
    (
        "transform",
        &[
            "machine",
            "source",
            "number",
            "diagnostic",
            "program",
            "parse",
            "write",
            "parameters",
            "cutter",
            "stock",
            "engagement",
            "layered_chips",
            "surface",
            "setup",
            "recipe",
            "simulation_run",
            "check",
            "presentation",
        ],
    ),
    (
        "report",
        &[
            "machine",
            "source",
            "number",
            "diagnostic",
            "program",
            "parse",
            "write",
            "parameters",
            "cutter",
            "stock",
            "engagement",
            "layered_chips",
            "surface",
            "surface_milling",
            "setup",
            "recipe",
            "simulation_run",
            "check",
            "presentation",
            "transform",
        ],
    ),
    ("fingerprint", &["source", "diagnostic", "setup", "transform"]),
    (
        "provenance",
        &["source", "diagnostic", "program", "parse", "write", "recipe", "transform", "fingerprint"],
    ),
    ("undo", &["source", "diagnostic", "program", "recipe", "presentation", "report", "fingerprint"]),
    (
        "job",
        &[
            "source",
            "threads",
            "diagnostic",
            "program",
            "parse",
            "write",
            "cutter",
            "stock",
            "engagement",
            "setup",
            "recipe",
            "simulation_run",
            "check",
            "transform",
            "report",
            "fingerprint",
            "provenance",
        ],
    ),
    (
        "editor",
        &[
            "source",
            "number",
            "diagnostic",
            "program",
            "check",
            "presentation",
            "setup",
            "recipe_rules",
            "simulation_run",
            "surface_milling",
            "transform",
            "provenance",
            "undo",
            "fingerprint",
            "report",
            "job",
        ],
    ),
    (
        "batch",
        &[
            "source",
            "diagnostic",
            "program",
            "output_files",
            "parameters",
            "yaml",
            "setup",
            "recipe",
            "simulation_run",
            "presentation",
            "transform",
            "report",
            "fingerprint",
            "job",
        ],
    ),
];

/// What no module of the library may use: the command line, the terminal, printing and exiting.
const FORBIDDEN: &[&str] =
    &["clap", "println!(", "eprintln!(", "print!(", "process::exit", "is_terminal", "std::env::var"];

#[test]
fn imports_run_one_way() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut imports: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for path in library_files(&root) {
        let text = std::fs::read_to_string(&path).unwrap();
        // Unit tests may look at the whole crate.
        let text = text.split("#[cfg(test)]").next().unwrap();
        let module = module(&root, &path);
        for line in text.lines().filter(|line| !line.trim_start().starts_with("//")) {
            for part in line.split("crate::").skip(1) {
                let name: String = part.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
                imports.entry(module.clone()).or_default().insert(name);
            }
        }
    }
    let known: BTreeSet<&str> = MAY_IMPORT.iter().map(|(module, _)| *module).collect();
    for (module, imported) in &imports {
        let allowed = MAY_IMPORT.iter().find(|(name, _)| name == module);
        let (_, allowed) = allowed.unwrap_or_else(|| panic!("{module} has no place in the table"));
        for name in imported.iter().filter(|name| *name != module && known.contains(name.as_str())) {
            assert!(allowed.contains(&name.as_str()), "{module} must not import {name}");
        }
    }
    assert!(imports.len() > 8, "the sources were found");
}

/// The stages of `optimize_feed` in the order of their data.
const FEED_STAGES: &[&str] = &["measure", "limit", "plan", "write", "prove"];

#[test]
fn stages_of_optimize_feed_import_only_earlier_ones() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src/transform/optimize_feed");
    let mut seen = BTreeSet::new();
    for path in library_files(&root) {
        let stage = module(&root, &path);
        // The door (mod, parameters, step) stands above all stages.
        let Some(place) = FEED_STAGES.iter().position(|name| *name == stage) else { continue };
        seen.insert(place);
        let text = std::fs::read_to_string(&path).unwrap();
        let depth = path.strip_prefix(&root).unwrap().components().count();
        for line in text.lines().filter(|line| !line.trim_start().starts_with("//")) {
            for part in line.split("crate::transform::optimize_feed::").skip(1) {
                let imported: String =
                    part.chars().take_while(|c| c.is_alphanumeric() || *c == '_').collect();
                let Some(other) = FEED_STAGES.iter().position(|name| *name == imported) else {
                    assert!(line.contains("pub(in "), "{stage} must not import the door: {line}");
                    continue;
                };
                assert!(other <= place, "{stage} must not import {imported}: {line}");
            }
            assert!(depth > 1 && !line.contains("super::super"), "stages name each other in full: {line}");
        }
    }
    assert_eq!(seen.len(), FEED_STAGES.len(), "all stages were found");
}

#[test]
fn the_library_knows_no_terminal() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    for path in library_files(&root) {
        let text = std::fs::read_to_string(&path).unwrap();
        for line in text.lines().filter(|line| !line.trim_start().starts_with("//")) {
            for word in FORBIDDEN {
                assert!(!line.contains(word), "{}: {line}", path.display());
            }
        }
    }
}

#[test]
fn only_tests_and_measurements_look_inside() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let mut files = library_files(&root);
    files.extend(library_files(&root.join("cli")));
    for path in files {
        let text = std::fs::read_to_string(&path).unwrap();
        for line in text.lines().filter(|line| !line.trim_start().starts_with("///")) {
            let uses = line.contains("clsmith::internals") || line.contains("crate::internals");
            assert!(!uses, "{}: {line}", path.display());
        }
    }
}

fn library_files(root: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![root.to_path_buf()];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap().flatten() {
            let path = entry.path();
            if path.is_dir() && !path.ends_with("cli") {
                folders.push(path);
            } else if path.extension().is_some_and(|end| end == "rs")
                && !path.ends_with("main.rs")
                && !path.ends_with("lib.rs")
                // It opens private rooms to these tests and is of no floor.
                && !path.ends_with("internals.rs")
            {
                found.push(path);
            }
        }
    }
    found
}

fn module(root: &Path, path: &Path) -> String {
    let first = path.strip_prefix(root).unwrap().components().next().unwrap();
    first.as_os_str().to_string_lossy().trim_end_matches(".rs").to_owned()
}

//! This module checks the YAML files of a shop as they are typed, and finds the files that they name.

use crate::diagnostic::{Diagnostic, Failure};
use crate::recipe_rules::RecipeRules;
use crate::setup::{Setup, WorkMaterial};
use crate::source::{Source, Span};
use crate::surface_milling::load_profile;
use crate::transform::{self, Recipe};
use std::sync::Arc;

/// The kinds of YAML files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum YamlFileKind {
    /// A recipe: it has `version:` or `steps:`.
    Recipe,
    /// A selection: it has `rules:`.
    Selection,
    /// A profile: it has `pieces:`.
    Profile,
    /// A material: it has `k_tc:` or `kienzle:`.
    Material,
    /// A setup, a machine or a list of tools: it has one of `machine:`, `stock:`, `tools:`, `material:`, `words:`.
    Setup,
}

impl YamlFileKind {
    /// Tells a file by its keys, or by the schema that it names. Returns `None` for other YAML, of which nothing is said.
    ///
    /// ```
    /// use clsmith::editor::YamlFileKind;
    ///
    /// assert_eq!(YamlFileKind::from_text(b"version: 1\nsteps: []\n"), Some(YamlFileKind::Recipe));
    /// assert_eq!(YamlFileKind::from_text(b"# a machine\nmachine:\n"), Some(YamlFileKind::Setup));
    /// assert_eq!(YamlFileKind::from_text(b"services: {}\n"), None);
    /// ```
    pub fn from_text(text: &[u8]) -> Option<Self> {
        let lines = || text.split(|byte| *byte == b'\n');
        let has = |word: &[u8]| lines().any(|line| line.starts_with(word));
        let named = lines().find_map(|line| {
            let line = std::str::from_utf8(line).ok()?.strip_prefix("# yaml-language-server: $schema=")?;
            let name = line.trim().rsplit('/').next()?.strip_prefix("clsmith-")?;
            name.strip_suffix(".schema.json")
        });
        match named {
            Some("recipe") => return Some(Self::Recipe),
            Some("select") => return Some(Self::Selection),
            Some("profile") => return Some(Self::Profile),
            Some("material") => return Some(Self::Material),
            Some("setup") => return Some(Self::Setup),
            // Jobs files name files of a batch, which only the batch itself can look for.
            Some(_) => return None,
            None => {}
        }
        let has_any = |words: &[&[u8]]| words.iter().any(|word| has(word));
        if has(b"steps:") {
            Some(Self::Recipe)
        } else if has(b"rules:") {
            Some(Self::Selection)
        } else if has(b"pieces:") {
            Some(Self::Profile)
        } else if has_any(&[b"k_tc:", b"kienzle:"]) {
            Some(Self::Material)
        } else if has_any(&[b"machine:", b"stock:", b"tools:", b"material:", b"words:"]) {
            Some(Self::Setup)
        } else {
            None
        }
    }
}

/// Checks a file of a kind by itself; files that it names are not read.
pub fn check_yaml_text(source: &Arc<Source>, kind: YamlFileKind) -> Vec<Diagnostic> {
    let found = match kind {
        YamlFileKind::Recipe => Recipe::load(source).err(),
        YamlFileKind::Selection => RecipeRules::load(source).err(),
        YamlFileKind::Profile => load_profile(source).err(),
        YamlFileKind::Material => WorkMaterial::load(source).err(),
        YamlFileKind::Setup => Setup::load(source).err(),
    };
    found.map(Failure::into_findings).unwrap_or_default()
}

/// Returns the places of paths to other files, with the paths: values of keys that name one.
pub fn find_file_names(source: &Source) -> Vec<(Span, String)> {
    const KEYS: [&str; 7] = ["setup_file", "file", "machine_file", "stl", "mesh", "recipe", "setup"];
    let mut found = Vec::new();
    let mut start = 0;
    for line in source.bytes().split_inclusive(|byte| *byte == b'\n') {
        if let Ok(text) = std::str::from_utf8(line) {
            for key in KEYS {
                found.extend(
                    find_value(text, key)
                        .map(|(at, name)| (Span::new(start + at, start + at + name.len()), name.to_owned())),
                );
            }
        }
        start += line.len();
    }
    found.sort();
    found
}

/// Returns the plain value of a key on a line, block or flow, with its place.
fn find_value<'t>(line: &'t str, key: &str) -> Option<(usize, &'t str)> {
    let code = line.split(" #").next().unwrap_or_default();
    let pattern = format!("{key}:");
    let at = code.match_indices(&pattern).map(|(at, _)| at).find(|at| {
        let before = code.get(..*at).unwrap_or_default();
        before.is_empty() || before.ends_with([' ', '{', ',']) && !before.trim_start().starts_with('#')
    })?;
    let rest = code.get(at + pattern.len()..)?;
    let value = rest.trim_start();
    let start = at + pattern.len() + rest.len() - value.len();
    let quote = value.chars().next().filter(|c| matches!(c, '"' | '\''));
    let (skipped, end) = match quote {
        Some(quote) => (1, value.get(1..)?.find(quote)? + 1),
        None => (0, value.find([',', '}', '\n', '\r']).unwrap_or(value.len())),
    };
    let name = value.get(skipped..end)?.trim_end();
    (!name.is_empty() && !name.starts_with(['{', '[', '&', '*', '|', '>'])).then_some((start + skipped, name))
}

/// What is wanted at a place of a recipe that schemas cannot know, or that this program can tell without one.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum RecipeWords {
    /// Names of steps.
    Steps,
    /// Names of operations of a program.
    Operations,
    /// Names or numbers of tools of a program.
    Tools,
}

impl RecipeWords {
    /// Tells what is wanted behind the text of a line up to the cursor.
    pub fn wanted(before: &str) -> Option<Self> {
        let within = |key: &str| {
            let at = before.rfind(key)?;
            let rest = before.get(at + key.len()..)?;
            (!rest.contains([']', '}'])).then_some(at)
        };
        let (operations, tools) = (within("operations:"), within("tools:"));
        if operations.is_some() && operations > tools {
            return Some(Self::Operations);
        }
        if tools.is_some() {
            return Some(Self::Tools);
        }
        let word = before.trim_start().strip_prefix("- ")?.trim_start();
        word.chars().all(|c| c.is_ascii_lowercase() || c == '_').then_some(Self::Steps)
    }
}

/// Returns the names of the steps of recipes, each with the first line of its description.
pub fn list_step_words() -> Vec<(&'static str, String)> {
    let describe = |name: &str| {
        let schema = transform::schema_of(name)?.to_value();
        let text = schema.get("description")?.as_str()?;
        Some(text.lines().next().unwrap_or_default().to_owned())
    };
    transform::NAMES.iter().map(|name| (*name, describe(name).unwrap_or_default())).collect()
}

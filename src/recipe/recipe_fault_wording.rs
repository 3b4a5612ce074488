//! This module words faults that have a particular meaning in a recipe: its version, and the names of its
//! steps.

use crate::diagnostic::{DiagnosticCode, codes};
use crate::yaml::{LocatedYamlFault, YamlFaultKind, YamlPathSegment, suggest_names};

pub(super) fn word_recipe_fault(finding: &LocatedYamlFault<'_>) -> Option<(DiagnosticCode, String, String)> {
    match (finding.kind, finding.path) {
        (YamlFaultKind::Missing { name: "version" }, []) => {
            let message = "the recipe does not state its version".to_owned();
            Some((codes::RECIPE_VERSION, message, codes::RECIPE_VERSION.help().to_owned()))
        }
        (YamlFaultKind::Missing { name: "steps" }, []) => {
            let message = "the recipe has no `steps`".to_owned();
            let help = "Add `steps:` with one `- name: { … }` per step; `steps: []` for a recipe that changes nothing.";
            Some((codes::MISSING_KEY, message, help.to_owned()))
        }
        (YamlFaultKind::Type { found, .. }, [YamlPathSegment::Key("version")]) => {
            let message = format!("the version is a whole number, found {found}");
            Some((codes::RECIPE_VERSION, message, codes::RECIPE_VERSION.help().to_owned()))
        }
        (YamlFaultKind::Value { message, .. }, [YamlPathSegment::Key("version")]) => {
            let help = "This clsmith knows version 1; a recipe with a higher one needs a newer clsmith.";
            Some((codes::RECIPE_VERSION, message.clone(), help.to_owned()))
        }
        (YamlFaultKind::Type { found, .. }, []) => {
            let message = format!("a recipe is a map of keys (`version:`, `steps:`), found {found}");
            let help = "A recipe begins with `version: 1`. Check that the right file was given.";
            Some((codes::WRONG_TYPE, message, help.to_owned()))
        }
        (YamlFaultKind::Type { found, .. }, [YamlPathSegment::Key("steps"), YamlPathSegment::Index(_)]) => {
            let message = format!("a step is a name with its settings, found {found}");
            Some((codes::WRONG_TYPE, message, "Write `- name: { key: value }`.".to_owned()))
        }
        (
            YamlFaultKind::UnknownChoice { name, expected },
            [YamlPathSegment::Key("steps"), YamlPathSegment::Index(_), ..],
        ) if finding.path.len() <= 3 && is_step(finding.path, name) => Some((
            codes::UNKNOWN_STEP,
            format!("there is no step `{name}`"),
            suggest_names(name, expected, "The steps:"),
        )),
        _ => None,
    }
}

/// Returns whether an unknown choice is the step itself, by its key or as a bare word, and not one of its
/// settings.
fn is_step(path: &[YamlPathSegment<'_>], name: &str) -> bool {
    match path.get(2) {
        None => true,
        Some(YamlPathSegment::Key(key)) => *key == name,
        Some(YamlPathSegment::Index(_)) => false,
    }
}

//! This module words faults: it gives each the code, the message, the place that is underlined, and a
//! suggestion of what was probably meant.

use super::fault_words::{join_choices, quote_text};
use super::yaml_fault::{YamlFault, YamlFaultKind};
use super::yaml_tree::YamlNode;
use super::{KeyOrValue, YamlDocument, YamlPathSegment};
use crate::diagnostic::{Diagnostic, DiagnosticCode, codes};
use crate::parameters::find_similar_name;
use crate::source::Span;

/// A fault with the path to it, which [`FaultWording`] examines.
pub(crate) struct LocatedYamlFault<'f> {
    /// What is wrong.
    pub kind: &'f YamlFaultKind,
    /// The path to the value, from the root. For an unknown key, that key is the last segment.
    pub path: &'f [YamlPathSegment<'f>],
}

/// The wording that a kind of file has for some of its faults: the code, the message and the help that
/// replace the usual ones.
pub(crate) type FaultWording = fn(&LocatedYamlFault<'_>) -> Option<(DiagnosticCode, String, String)>;

pub(super) fn render_fault(document: &YamlDocument, fault: &YamlFault, special: FaultWording) -> Diagnostic {
    let path = list_path_segments(document, &fault.path);
    let span = find_fault_span(document, fault);
    let mut owner = find_value_name(&path).map(|name| format!("`{name}`"));
    if let Some(YamlPathSegment::Index(_)) = path.last() {
        owner = match document.root.node_at_path(&fault.path) {
            Some(YamlNode::Text(name)) => Some(quote_text(name)),
            _ => owner.map(|list| format!("an element of {list}")),
        };
    }
    let (code, message, help, label) = word_fault(&fault.kind, &path, owner);
    let diagnostic = match special(&LocatedYamlFault { kind: &fault.kind, path: &path }) {
        Some((code, message, help)) => Diagnostic::new(code, message).with_help(help),
        None => {
            let diagnostic = Diagnostic::new(code, message);
            match help {
                Some(help) => diagnostic.with_help(help),
                None => diagnostic,
            }
        }
    };
    diagnostic.with_label(&document.source, span, label)
}

/// Words a fault. `owner` names what misses a key.
fn word_fault(
    kind: &YamlFaultKind,
    path: &[YamlPathSegment<'_>],
    owner: Option<String>,
) -> (DiagnosticCode, String, Option<String>, String) {
    match kind {
        YamlFaultKind::UnknownKey { name, expected } => {
            let owner = path.split_last().and_then(|(_, parent)| find_value_name(parent));
            let within = owner.map(|owner| format!(" in `{owner}`")).unwrap_or_default();
            let help = if name == "<<" {
                "Merge keys (`<<`) are not part of YAML 1.2; repeat the keys, or give the whole value by `*name`.".into()
            } else {
                suggest_names(name, expected, "Known here:")
            };
            let message = format!("unknown key {}{within}", quote_text(name));
            (codes::UNKNOWN_KEY, message, Some(help), "not a known key".into())
        }
        YamlFaultKind::UnknownChoice { name, expected } => {
            let help = suggest_names(name, expected, "Choose");
            let owner = match path.split_last() {
                // An unknown choice that is written as a key is the last segment of its own path.
                Some((YamlPathSegment::Key(key), parent)) if key == name => parent,
                _ => path,
            };
            let message = match find_value_name(owner) {
                Some(owner) => format!("{} is not a choice for `{owner}`", quote_text(name)),
                None => format!("{} is not a choice here", quote_text(name)),
            };
            (codes::UNKNOWN_CHOICE, message, Some(help), "not one of the choices".into())
        }
        YamlFaultKind::Missing { name } => {
            let message = match owner {
                Some(owner) => format!("{owner} needs `{name}`"),
                None => format!("`{name}` is missing"),
            };
            (codes::MISSING_KEY, message, Some(format!("Add `{name}: …`.")), format!("`{name}` is missing"))
        }
        YamlFaultKind::Type { found, expected } => {
            let scalar = found.starts_with("the number") || found.starts_with('`');
            let help = match expected.as_str() {
                "text" if scalar => Some("Text that looks like a number needs quotes.".to_owned()),
                "a list" => Some("Write a list as `[a, b]`, or one `- element` per line.".to_owned()),
                _ => None,
            };
            let message = prefix_name(path, &format!("expected {expected}, found {found}"));
            (codes::WRONG_TYPE, message, help, format!("expected {expected}"))
        }
        YamlFaultKind::Value { message, help } => {
            (codes::BAD_VALUE, prefix_name(path, message), help.clone(), "not allowed here".into())
        }
        YamlFaultKind::NotOneName { names } => {
            let help = match names.as_slice() {
                [first, second, ..] => format!(
                    "If {} belongs to {}, indent it deeper; if it is a choice of its own, start it with `- `.",
                    quote_text(second),
                    quote_text(first)
                ),
                _ => "Write a name, or `name: { … }`.".to_owned(),
            };
            let message = match names.len() {
                0 => "expected one name with its settings, found an empty map".to_owned(),
                count => format!("expected one name with its settings, found {count} keys side by side"),
            };
            let label = if names.is_empty() { "no name here" } else { "beside the name, not below it" };
            (codes::NOT_ONE_NAME, message, Some(help), label.into())
        }
    }
}

/// `factor: expected a number, …`
fn prefix_name(path: &[YamlPathSegment<'_>], message: &str) -> String {
    match find_value_name(path) {
        Some(name) => format!("`{name}`: {message}"),
        None => message.to_owned(),
    }
}

/// Returns the name of a value: its key, or the key of the list that contains it.
fn find_value_name<'a>(path: &[YamlPathSegment<'a>]) -> Option<&'a str> {
    path.iter().rev().find_map(|segment| match segment {
        YamlPathSegment::Key(key) => Some(*key),
        YamlPathSegment::Index(_) => None,
    })
}

/// Returns `Did you mean …?`, or the list of possible names.
pub(crate) fn suggest_names(name: &str, expected: &[&str], listing: &str) -> String {
    match find_similar_name(name, expected) {
        Some(near) => format!("Did you mean `{near}`?"),
        None if expected.is_empty() => "Nothing can be set here.".to_owned(),
        None => format!("{listing} {}.", join_choices(expected)),
    }
}

fn list_path_segments<'d>(document: &'d YamlDocument, path: &[usize]) -> Vec<YamlPathSegment<'d>> {
    let mut node = Some(&document.root);
    path.iter()
        .map(|&index| {
            let segment = match node.and_then(|node| node.entry_at(index)) {
                Some(entry) => YamlPathSegment::Key(&entry.key),
                None => YamlPathSegment::Index(index),
            };
            node = node.and_then(|node| node.child_at(index));
            segment
        })
        .collect()
}

/// Returns the place to underline: the key or the value itself. For something missing, it is the key under
/// which it is missing.
fn find_fault_span(document: &YamlDocument, fault: &YamlFault) -> Span {
    let path = fault.path.as_slice();
    let node = document.root.node_at_path(path);
    if fault.at_key {
        return document.node_span(path, KeyOrValue::Key).unwrap_or_default();
    }
    if let (YamlFaultKind::NotOneName { .. }, Some(YamlNode::Map(entries))) = (&fault.kind, node)
        && let Some(second) = entries.get(1)
    {
        return document.node_span(&[path, &[second.index]].concat(), KeyOrValue::Key).unwrap_or_default();
    }
    let parent = path.split_last().and_then(|(_, parent)| document.root.node_at_path(parent));
    let part = match (&fault.kind, parent) {
        (YamlFaultKind::Missing { .. }, Some(YamlNode::Map(_))) => KeyOrValue::Key,
        _ => KeyOrValue::Value,
    };
    document.node_span(path, part).unwrap_or_default()
}

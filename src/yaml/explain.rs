//! Faults in words: which code, which message, what is underlined, and what was probably meant.

use super::fault::{Fault, Kind};
use super::node::Node;
use super::words::{choices, meant, quoted};
use super::{Document, Part, Segment};
use crate::diagnostic::{Code, Diagnostic, codes};
use crate::source::Span;

/// A fault with the way to it, for [`Special`] to look at.
pub(crate) struct Finding<'f> {
    /// What is wrong.
    pub kind: &'f Kind,
    /// The way to the value, from the root. For an unknown key, that key is the last segment.
    pub path: &'f [Segment<'f>],
}

/// What a kind of file says about some of its faults: the code, the message and the help to use instead of the usual.
pub(crate) type Special = fn(&Finding<'_>) -> Option<(Code, String, String)>;

pub(super) fn diagnostic(document: &Document, fault: &Fault, special: Special) -> Diagnostic {
    let path = segments(document, &fault.path);
    let span = span(document, fault);
    let mut owner = name_of(&path).map(|name| format!("`{name}`"));
    if let Some(Segment::Index(_)) = path.last() {
        owner = match document.root.at(&fault.path) {
            Some(Node::Text(name)) => Some(quoted(name)),
            _ => owner.map(|list| format!("an element of {list}")),
        };
    }
    let (code, message, help, label) = usual(&fault.kind, &path, owner);
    let diagnostic = match special(&Finding { kind: &fault.kind, path: &path }) {
        Some((code, message, help)) => Diagnostic::new(code, message).help(help),
        None => {
            let diagnostic = Diagnostic::new(code, message);
            match help {
                Some(help) => diagnostic.help(help),
                None => diagnostic,
            }
        }
    };
    diagnostic.label(&document.source, span, label)
}

/// `owner` is what misses a key, in words.
fn usual(kind: &Kind, path: &[Segment<'_>], owner: Option<String>) -> (Code, String, Option<String>, String) {
    match kind {
        Kind::UnknownKey { name, expected } => {
            let owner = path.split_last().and_then(|(_, parent)| name_of(parent));
            let within = owner.map(|owner| format!(" in `{owner}`")).unwrap_or_default();
            let help = if name == "<<" {
                "Merge keys (`<<`) are not part of YAML 1.2; repeat the keys, or give the whole value by `*name`.".into()
            } else {
                suggestion(name, expected, "Known here:")
            };
            let message = format!("unknown key {}{within}", quoted(name));
            (codes::UNKNOWN_KEY, message, Some(help), "not a known key".into())
        }
        Kind::UnknownChoice { name, expected } => {
            let help = suggestion(name, expected, "Choose");
            let owner = match path.split_last() {
                // As a key, the name is the end of its own way.
                Some((Segment::Key(key), parent)) if key == name => parent,
                _ => path,
            };
            let message = match name_of(owner) {
                Some(owner) => format!("{} is no choice for `{owner}`", quoted(name)),
                None => format!("{} is no choice here", quoted(name)),
            };
            (codes::UNKNOWN_CHOICE, message, Some(help), "not one of the choices".into())
        }
        Kind::Missing { name } => {
            let message = match owner {
                Some(owner) => format!("{owner} needs `{name}`"),
                None => format!("`{name}` is missing"),
            };
            (codes::MISSING_KEY, message, Some(format!("Add `{name}: …`.")), format!("`{name}` is missing"))
        }
        Kind::Type { found, expected } => {
            let scalar = found.starts_with("the number") || found.starts_with('`');
            let help = match expected.as_str() {
                "text" if scalar => Some("Text that looks like a number needs quotes.".to_owned()),
                "a list" => Some("Write a list as `[a, b]`, or one `- element` per line.".to_owned()),
                _ => None,
            };
            let message = about(path, &format!("expected {expected}, found {found}"));
            (codes::WRONG_TYPE, message, help, format!("expected {expected}"))
        }
        Kind::Value { message, help } => {
            (codes::BAD_VALUE, about(path, message), help.clone(), "not allowed here".into())
        }
        Kind::NotOneName { names } => {
            let help = match names.as_slice() {
                [first, second, ..] => format!(
                    "If {} belongs to {}, indent it deeper; if it is a choice of its own, start it with `- `.",
                    quoted(second),
                    quoted(first)
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
fn about(path: &[Segment<'_>], message: &str) -> String {
    match name_of(path) {
        Some(name) => format!("`{name}`: {message}"),
        None => message.to_owned(),
    }
}

/// What a value is called: its key, or the key of the list it is in.
fn name_of<'a>(path: &[Segment<'a>]) -> Option<&'a str> {
    path.iter().rev().find_map(|segment| match segment {
        Segment::Key(key) => Some(*key),
        Segment::Index(_) => None,
    })
}

/// `Did you mean …?`, or the names there are.
pub(crate) fn suggestion(name: &str, expected: &[&str], listing: &str) -> String {
    match meant(name, expected) {
        Some(near) => format!("Did you mean `{near}`?"),
        None if expected.is_empty() => "Nothing can be set here.".to_owned(),
        None => format!("{listing} {}.", choices(expected)),
    }
}

fn segments<'d>(document: &'d Document, path: &[usize]) -> Vec<Segment<'d>> {
    let mut node = Some(&document.root);
    path.iter()
        .map(|&index| {
            let segment = match node.and_then(|node| node.entry(index)) {
                Some(entry) => Segment::Key(&entry.key),
                None => Segment::Index(index),
            };
            node = node.and_then(|node| node.child(index));
            segment
        })
        .collect()
}

/// What to underline: the key or the value itself; for something missing, the key that it is missing under.
fn span(document: &Document, fault: &Fault) -> Span {
    let path = fault.path.as_slice();
    let node = document.root.at(path);
    if fault.at_key {
        return document.span(path, Part::Key).unwrap_or_default();
    }
    if let (Kind::NotOneName { .. }, Some(Node::Map(entries))) = (&fault.kind, node)
        && let Some(second) = entries.get(1)
    {
        return document.span(&[path, &[second.index]].concat(), Part::Key).unwrap_or_default();
    }
    let parent = path.split_last().and_then(|(_, parent)| document.root.at(parent));
    let part = match (&fault.kind, parent) {
        (Kind::Missing { .. }, Some(Node::Map(_))) => Part::Key,
        _ => Part::Value,
    };
    document.span(path, part).unwrap_or_default()
}

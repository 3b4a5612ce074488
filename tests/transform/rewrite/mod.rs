//! rewrite.

mod broken;
mod conditions;
mod dialects;
mod insertions;
mod matching;
mod properties;
mod replacing;
mod running;

use super::{apply, try_apply};
use clsmith::diagnostic::Diagnostic;

/// One `rewrite` step with these rules (YAML, each line of it a rule in braces).
pub fn rules(rules: &[&str]) -> String {
    let rules: String = rules.iter().map(|rule| format!("        - {{ {rule} }}\n")).collect();
    format!("  - rewrite:\n      rules:\n{rules}")
}

/// The text after a step with one rule; the rule must find something to do.
#[track_caller]
pub fn by(rule: &str, text: impl AsRef<[u8]>) -> String {
    let (text, findings) = apply(&rules(&[rule]), text);
    assert!(findings.is_empty(), "{findings:?}");
    text
}

/// Whether a pattern fits a statement.
#[track_caller]
pub fn fits(pattern: &str, statement: &str) -> bool {
    let rule = format!("match: {}, delete: true", serde_json::to_string(pattern).unwrap());
    let (text, findings) = apply(&rules(&[&rule]), format!("{statement}\n"));
    assert_eq!(text.is_empty(), findings.is_empty(), "a rule that takes nothing says so");
    text.is_empty()
}

/// What a step with these rules says when it stops.
#[track_caller]
pub fn stopped(step: &str, text: &str) -> Diagnostic {
    let mut found = try_apply(&format!("version: 1\nsteps:\n{step}"), text).unwrap_err();
    assert_eq!(found.len(), 1, "{found:?}");
    found.remove(0)
}

/// A finding in one line per place: what is said, and which text is underlined.
pub fn shown(found: &Diagnostic) -> String {
    let mut text = format!("{} {}: {}\n", found.code, found.severity, found.message);
    for label in &found.labels {
        let marked = String::from_utf8_lossy(label.source.slice(label.span)).into_owned();
        text += &format!("    {} [{}] {}\n", label.source.name(), marked.trim_end(), label.message);
    }
    if let Some(help) = &found.help {
        text += &format!("    help: {help}\n");
    }
    text
}

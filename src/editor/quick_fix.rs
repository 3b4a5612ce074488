//! This module repairs what a finding points at, where its text says how.

use crate::diagnostic::{Diagnostic, codes};
use crate::number::parse_number;
use crate::source::Span;

/// A repair of one finding.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct QuickFix {
    /// What it does: ``write `12.5000` ``.
    pub title: String,
    /// The bytes that are replaced, in the source of the finding's first label.
    pub span: Span,
    /// What stands there afterwards.
    pub text: String,
    /// Whether nothing else can be meant. Names that are only similar are proposals.
    pub is_certain: bool,
}

/// Returns the repair of a finding, if there is one.
pub fn find_quick_fix(found: &Diagnostic) -> Option<QuickFix> {
    let label = found.labels.first()?;
    let here = std::str::from_utf8(label.source.slice(label.span)).ok()?;
    if found.code == codes::BAD_NUMBER {
        return repair_number(here, label.span);
    }
    if found.code == codes::NO_LAST_LINE_END {
        let end = label.source.bytes().len();
        let line_end =
            if label.source.bytes().windows(2).any(|pair| pair == b"\r\n") { "\r\n" } else { "\n" };
        return Some(QuickFix {
            title: "end the last line".to_owned(),
            span: Span::new(end, end),
            text: line_end.to_owned(),
            is_certain: true,
        });
    }
    let name = [found.help.as_deref(), Some(found.message.as_str())]
        .into_iter()
        .flatten()
        .find_map(find_proposal)?;
    let is_word =
        !here.is_empty() && here.chars().all(|c| c.is_alphanumeric() || matches!(c, '_' | '-' | '.'));
    is_word.then(|| QuickFix {
        title: format!("write `{name}`"),
        span: label.span,
        text: name.to_owned(),
        is_certain: false,
    })
}

/// Letters for digits, as they come from scans and typewriters: the letter O for 0, and l or I for 1.
fn repair_number(here: &str, span: Span) -> Option<QuickFix> {
    let digits: String = here
        .chars()
        .map(|c| match c {
            'O' | 'o' => '0',
            'l' | 'I' => '1',
            other => other,
        })
        .collect();
    let is_number = digits != here && parse_number(digits.as_bytes()).is_some();
    is_number.then(|| QuickFix { title: format!("write `{digits}`"), span, text: digits, is_certain: true })
}

/// Returns the name in ``did you mean `name`?``.
fn find_proposal(text: &str) -> Option<&str> {
    let (_, rest) = text.split_once("id you mean `")?;
    rest.split_once("`?").map(|(name, _)| name)
}

//! This module decides which findings are shown with which severity: `--deny`, `--allow`, `--notes`.

use crate::diagnostic::codes::{
    BAD_RESULTS, BAD_UNDO, EXIT_CODE_SHARED, INPUT_CHANGED, LEAVES_FOLDER, NEWER_RUN_REPORT, NO_RULE,
    NO_RUN_REPORT, NOT_ONE_BATCH, NOTHING_MATCHES, OTHER_FILE, OUTPUT_IN_USE, OUTPUT_IS_INPUT,
    OUTPUTS_COLLIDE, OUTSIDE_OUTPUT, PASSED_ORIGINAL, POST_KILLED, POST_MISSING, POST_NOT_STARTED,
    POST_TIMED_OUT, RESULTS_MISSING, TOO_LARGE, UNREADABLE, UNWRITABLE, WATCHED_ALREADY, WATCHED_FOLDERS,
};
use crate::diagnostic::{CATALOGUE, Diagnostic, DiagnosticCode, DiagnosticLabel, Severity, find_code};
use crate::source::Span;
use std::cmp::Ordering;
use std::fmt;

/// What the user decided about findings: which are errors, which are allowed, and whether notes are shown.
///
/// ```
/// use clsmith::diagnostic::{Diagnostic, codes};
/// use clsmith::report::finding_policy::FindingPolicy;
///
/// let policy = FindingPolicy::from_code_lists(["CL0120"], ["CL0125"], false)?;
/// let told = policy.apply(vec![
///     Diagnostic::new(codes::CUT_WITHOUT_FEED, "the tool cuts before any feed"),
///     Diagnostic::new(codes::CUT_WITHOUT_SPINDLE, "the tool cuts while the spindle stands"),
/// ]);
/// assert!(told[0].is_error());
/// assert!(told[1].is_allowed);
/// # Ok::<(), clsmith::report::finding_policy::FindingPolicyError>(())
/// ```
#[derive(Debug, Clone, Default)]
#[non_exhaustive]
pub struct FindingPolicy {
    /// Codes that are errors, whatever the catalogue says.
    pub deny: Vec<DiagnosticCode>,
    /// Codes that stop nothing. They are counted and shown as allowed by hand.
    pub allow: Vec<DiagnosticCode>,
    /// Whether every remaining warning is an error.
    pub deny_warnings: bool,
    /// Whether notes are shown.
    pub notes: bool,
}

/// Findings that end a run. Dropping them would end it without a message.
const NEVER_ALLOWED: &[DiagnosticCode] = &[
    UNREADABLE,
    UNWRITABLE,
    TOO_LARGE,
    OUTPUT_IS_INPUT,
    POST_MISSING,
    POST_NOT_STARTED,
    POST_TIMED_OUT,
    POST_KILLED,
    NO_RULE,
    WATCHED_FOLDERS,
    WATCHED_ALREADY,
    NOTHING_MATCHES,
    OUTPUTS_COLLIDE,
    OUTSIDE_OUTPUT,
    OUTPUT_IN_USE,
    INPUT_CHANGED,
    BAD_RESULTS,
    NOT_ONE_BATCH,
    RESULTS_MISSING,
    NO_RUN_REPORT,
    NEWER_RUN_REPORT,
    OTHER_FILE,
    BAD_UNDO,
];

/// Findings about the run itself, which must always be seen. Without them, nobody would notice that the
/// original program was passed on, for example.
const NEVER_SILENT: &[DiagnosticCode] = &[PASSED_ORIGINAL, EXIT_CODE_SHARED, LEAVES_FOLDER];

/// The reason why `--deny` and `--allow` make no policy.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FindingPolicyError {
    /// A word is no code.
    #[error(transparent)]
    UnknownCode(#[from] UnknownCode),
    /// All warnings together cannot be allowed.
    #[error("`warnings` can be denied but not allowed; name the codes you know to be harmless")]
    WarningsAllowed,
    /// The finding ends the run, which must not end without a message.
    #[error("{code} cannot be allowed: {meaning} ends the run", code = .0, meaning = .0.meaning())]
    EndsRun(DiagnosticCode),
    /// The finding is about the run itself.
    #[error("{code} cannot be allowed, because it is always reported: {meaning}", code = .0, meaning = .0.meaning())]
    AlwaysReported(DiagnosticCode),
    /// The code is in both lists.
    #[error("{0} is both denied and allowed")]
    DeniedAndAllowed(DiagnosticCode),
}

/// A text that is no code of a finding.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct UnknownCode {
    /// The text.
    pub text: String,
    /// The code that is most similar.
    pub nearest: Option<DiagnosticCode>,
}

impl fmt::Display for UnknownCode {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "`{}` is not a code; ", self.text)?;
        match self.nearest {
            Some(near) => write!(f, "did you mean {near} ({})?", near.meaning()),
            None => f.write_str("codes look like CL0001"),
        }
    }
}

impl std::error::Error for UnknownCode {}

impl FindingPolicy {
    /// Reads the values of `--deny` and `--allow`: codes in upper or lower case, and `warnings` to deny every
    /// warning.
    ///
    /// # Errors
    /// Returns the first word that is no code, is both denied and allowed, or cannot be allowed.
    pub fn from_code_lists<'a>(
        deny: impl IntoIterator<Item = &'a str>,
        allow: impl IntoIterator<Item = &'a str>,
        notes: bool,
    ) -> Result<Self, FindingPolicyError> {
        let mut policy = Self { notes, ..Self::default() };
        for word in deny {
            if word.trim().eq_ignore_ascii_case("warnings") {
                policy.deny_warnings = true;
            } else {
                policy.deny.push(parse_code(word)?);
            }
        }
        for word in allow {
            if word.trim().eq_ignore_ascii_case("warnings") {
                return Err(FindingPolicyError::WarningsAllowed);
            }
            let code = parse_code(word)?;
            if NEVER_ALLOWED.contains(&code) {
                return Err(FindingPolicyError::EndsRun(code));
            }
            if NEVER_SILENT.contains(&code) {
                return Err(FindingPolicyError::AlwaysReported(code));
            }
            if policy.deny.contains(&code) {
                return Err(FindingPolicyError::DeniedAndAllowed(code));
            }
            policy.allow.push(code);
        }
        Ok(policy)
    }

    /// Returns the findings that remain with their severities, sorted by file, place and code and without
    /// duplicates.
    ///
    /// A denied note is shown even if notes are not. A finding whose code is named in `allow` stays among the
    /// findings and is marked as allowed; it stops nothing, even if warnings are denied.
    pub fn apply(&self, mut diagnostics: Vec<Diagnostic>) -> Vec<Diagnostic> {
        for found in &mut diagnostics {
            found.is_allowed = self.allow.contains(&found.code);
            if found.is_allowed {
                continue;
            }
            let warning = self.deny_warnings && found.severity == Severity::Warning;
            if warning || self.deny.contains(&found.code) {
                found.severity = Severity::Error;
            }
        }
        diagnostics.retain(|found| self.notes || found.severity != Severity::Note);
        sort_findings(&mut diagnostics);
        diagnostics
    }
}

/// Sorts findings by file, place and code, and removes exact duplicates. Findings without a place come first.
pub fn sort_findings(diagnostics: &mut Vec<Diagnostic>) {
    diagnostics.sort_by(compare_findings);
    diagnostics.dedup_by(|a, b| compare_findings(a, b) == Ordering::Equal);
}

/// Compares all fields. So findings that compare as equal are duplicates, and the sorted order does not
/// depend on the order in which they were found.
fn compare_findings(a: &Diagnostic, b: &Diagnostic) -> Ordering {
    finding_place(a)
        .cmp(&finding_place(b))
        .then_with(|| a.code.cmp(&b.code))
        .then_with(|| b.severity.cmp(&a.severity))
        .then_with(|| a.is_allowed.cmp(&b.is_allowed))
        .then_with(|| a.step.cmp(&b.step))
        .then_with(|| a.message.cmp(&b.message))
        .then_with(|| a.help.cmp(&b.help))
        .then_with(|| a.labels.iter().map(label_parts).cmp(b.labels.iter().map(label_parts)))
}

fn finding_place(found: &Diagnostic) -> Option<(&str, Span)> {
    found.labels.first().map(|label| (label.source.name(), label.span))
}

fn label_parts(label: &DiagnosticLabel) -> (&str, Span, &str) {
    (label.source.name(), label.span, &label.message)
}

/// Returns the code that a user typed in upper or lower case.
///
/// # Errors
/// Returns the text and the nearest code.
pub fn parse_code(text: &str) -> Result<DiagnosticCode, UnknownCode> {
    let text = text.trim();
    find_code(text).ok_or_else(|| UnknownCode { text: text.to_owned(), nearest: find_nearest_code(text) })
}

fn find_nearest_code(text: &str) -> Option<DiagnosticCode> {
    let upper = text.to_ascii_uppercase();
    // `CL1`, `1` and `0001` mean CL0001.
    let digits = upper.trim_start_matches("CL").trim_start_matches(['-', '_', ' ']);
    if let Some(found) = digits.parse::<u16>().ok().and_then(|number| find_code(&format!("CL{number:04}"))) {
        return Some(found);
    }
    let all = CATALOGUE.iter().flat_map(|rows| rows.iter()).copied();
    let near = all.map(|code| (strsim::damerau_levenshtein(code.id(), &upper), code));
    near.filter(|(distance, _)| *distance <= 2).min().map(|(_, code)| code)
}

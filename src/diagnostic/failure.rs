//! This module tells how a function of the library fails: with findings, or because it was asked to stop.

use super::Diagnostic;
use std::fmt;

/// The reason why a function of the library ended without a result.
///
/// Every function that can end with findings or by an interruption returns `Result<T, Failure>`. An
/// interruption is never a finding: it travels as [`Failure::Interrupted`] from where it is noticed up to the
/// command.
///
/// ```
/// use clsmith::diagnostic::{Diagnostic, Failure, codes};
///
/// let failure = Failure::from(Diagnostic::new(codes::BAD_NUMBER, "`3O` is not a number"));
/// match failure {
///     Failure::Found(findings) => assert_eq!(findings[0].code.id(), "CL0003"),
///     Failure::Interrupted => unreachable!("nobody raised an interrupt"),
/// }
/// ```
#[derive(Debug, Clone)]
pub enum Failure {
    /// The findings that prevented a result, in the order in which they were found. There is at least one.
    /// Findings of lower severity that were made earlier may come before the errors.
    Found(Vec<Diagnostic>),
    /// The work was asked to stop (Ctrl-C). Nothing is wrong, and nothing is reported.
    Interrupted,
}

impl Failure {
    /// Puts findings that were made before the failure in front of it. An interruption stays an interruption.
    #[must_use]
    pub fn after(self, mut earlier: Vec<Diagnostic>) -> Self {
        match self {
            Self::Found(found) => {
                earlier.extend(found);
                Self::Found(earlier)
            }
            Self::Interrupted => Self::Interrupted,
        }
    }

    /// Changes every finding, for example to add the place of a caller. An interruption stays an
    /// interruption.
    #[must_use]
    pub fn map_findings(self, change: impl FnMut(Diagnostic) -> Diagnostic) -> Self {
        match self {
            Self::Found(found) => Self::Found(found.into_iter().map(change).collect()),
            Self::Interrupted => Self::Interrupted,
        }
    }

    /// Returns the findings. An interruption has none.
    pub fn into_findings(self) -> Vec<Diagnostic> {
        match self {
            Self::Found(found) => found,
            Self::Interrupted => Vec::new(),
        }
    }

    /// Returns the findings. An interruption has none.
    pub fn findings(&self) -> &[Diagnostic] {
        match self {
            Self::Found(found) => found,
            Self::Interrupted => &[],
        }
    }
}

impl From<Diagnostic> for Failure {
    fn from(found: Diagnostic) -> Self {
        Self::Found(vec![found])
    }
}

impl From<Box<Diagnostic>> for Failure {
    fn from(found: Box<Diagnostic>) -> Self {
        Self::from(*found)
    }
}

impl From<Vec<Diagnostic>> for Failure {
    fn from(found: Vec<Diagnostic>) -> Self {
        debug_assert!(!found.is_empty(), "a failure has findings");
        Self::Found(found)
    }
}

/// Writes the messages of all findings, one on each line, for programs without a renderer of findings.
impl fmt::Display for Failure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Found(found) => {
                for (index, finding) in found.iter().enumerate() {
                    let line_end = if index == 0 { "" } else { "\n" };
                    write!(f, "{line_end}{}: {}", finding.severity, finding.message)?;
                }
                Ok(())
            }
            Self::Interrupted => f.write_str("stopped before the end"),
        }
    }
}

impl std::error::Error for Failure {}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::diagnostic::codes;

    fn finding(message: &str) -> Diagnostic {
        Diagnostic::new(codes::STEP_FAILED, message)
    }

    fn messages(failure: &Failure) -> Vec<&str> {
        failure.findings().iter().map(|found| found.message.as_str()).collect()
    }

    #[test]
    fn one_finding_boxed_or_not_and_many_become_a_failure() {
        assert_eq!(messages(&finding("a").into()), ["a"]);
        assert_eq!(messages(&Box::new(finding("b")).into()), ["b"]);
        assert_eq!(messages(&vec![finding("c"), finding("d")].into()), ["c", "d"]);
    }

    #[test]
    fn question_mark_converts_what_was_found() {
        fn fail() -> Result<(), Failure> {
            Err(finding("here"))?;
            Ok(())
        }
        assert_eq!(messages(&fail().unwrap_err()), ["here"]);
    }

    #[test]
    fn earlier_findings_stand_in_front() {
        let failure = Failure::from(finding("last")).after(vec![finding("first")]);
        assert_eq!(messages(&failure), ["first", "last"]);
    }

    #[test]
    fn an_interruption_stays_one() {
        let stopped = Failure::Interrupted.after(vec![finding("first")]);
        assert!(matches!(stopped, Failure::Interrupted));
        let stopped = stopped.map_findings(|found| found.with_help("never called"));
        assert!(matches!(stopped, Failure::Interrupted));
        assert_eq!(stopped.findings().len(), 0);
        assert_eq!(stopped.to_string(), "stopped before the end");
    }

    #[test]
    fn it_prints_a_line_for_each_finding() {
        let failure = Failure::from(vec![finding("one"), finding("two")]);
        assert_eq!(failure.to_string(), "error: one\nerror: two");
    }
}

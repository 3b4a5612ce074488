//! How a function of the library fails: with findings, or because somebody asked it to stop.

use super::Diagnostic;
use std::fmt;

/// Why a function of the library ended without a result.
///
/// Every function that can end with findings or by an interruption returns `Result<T, Failure>`. An interruption
/// is never a finding: it travels as [`Failure::Interrupted`] from where it is noticed up to the command.
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
    /// What stands in the way, in the order in which it was found; never empty. Findings of lower severity that
    /// were made on the way may stand before the errors.
    Found(Vec<Diagnostic>),
    /// Somebody asked the work to stop (Ctrl-C). Nothing is wrong, and nothing is told.
    Interrupted,
}

impl Failure {
    /// Puts findings that were made before the failure in front of it. An interruption stays one.
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

    /// Changes every finding, to add the place of a caller to it, say. An interruption stays one.
    #[must_use]
    pub fn map_findings(self, change: impl FnMut(Diagnostic) -> Diagnostic) -> Self {
        match self {
            Self::Found(found) => Self::Found(found.into_iter().map(change).collect()),
            Self::Interrupted => Self::Interrupted,
        }
    }

    /// The findings; none after an interruption.
    pub fn into_findings(self) -> Vec<Diagnostic> {
        match self {
            Self::Found(found) => found,
            Self::Interrupted => Vec::new(),
        }
    }

    /// The findings; none after an interruption.
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
        debug_assert!(!found.is_empty(), "who fails says why");
        Self::Found(found)
    }
}

/// The messages of all findings, a line each; for programs that have no renderer of findings.
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

//! This module reads a program with all that is wrong with it, in the same way for every command that measures one.

use clsmith::check::CheckedProgram;
use clsmith::diagnostic::Diagnostic;
use clsmith::program::{Dialect, LengthUnit, Program};
use clsmith::report::finding_policy::FindingPolicy;
use clsmith::report::stats::ResolvedLengthUnit;
use clsmith::setup::Setup;
use clsmith::source::Source;
use clsmith::transform::check_with_setup;
use std::sync::Arc;

/// A program with all that is wrong with it.
pub(super) struct JudgedProgram {
    /// The program.
    pub program: Program,
    /// The findings of reading and checking, and what the setup knows against the program. No policy was applied.
    pub findings: Vec<Diagnostic>,
    /// Whether there are lines that nobody can read, so that nothing can be said of what the program does.
    pub is_unread: bool,
}

impl JudgedProgram {
    /// Reads and checks a program, and asks the setup about it if there is one. `units` is the unit of lengths of a
    /// file that does not state it. A setup is not asked about a program that cannot be read.
    pub(super) fn read_source(
        source: &Arc<Source>,
        dialect: Option<Dialect>,
        units: Option<LengthUnit>,
        setup: Option<&Setup>,
        policy: &FindingPolicy,
    ) -> Self {
        let vocabulary = setup.map(|setup| Arc::clone(&setup.vocabulary)).unwrap_or_default();
        let CheckedProgram { program, of_reading, of_checks } =
            CheckedProgram::read_source(source, dialect, &vocabulary);
        let is_unread = policy.apply(of_reading.clone()).iter().any(Diagnostic::is_error);
        let mut findings = of_reading;
        findings.extend(of_checks);
        if let Some(setup) = setup.filter(|_| !is_unread) {
            let unit = ResolvedLengthUnit::from_program(&program, units).unit;
            findings.extend(check_with_setup(&program, setup, unit));
        }
        Self { program, findings, is_unread }
    }
}

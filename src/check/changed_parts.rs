//! This module tells which parts of a program steps have changed, so that only the lints that look at them run again.
//!
//! A feed sets neither a pose nor a path, spindle, tool or cycle. So a program in which nothing but feeds has other
//! numbers has the same motions up to their feeds, and a lint that looks neither at feeds nor at the texts that state
//! them finds in it what it found before.

use super::findings::sort_findings;
use super::lint_run::run_lints;
use super::{LINTS, LintRow};
use crate::diagnostic::Diagnostic;
use crate::parse;
use crate::program::record::DrillingCycle;
use crate::program::{Program, Record, Statement, StatementChange};

/// The parts of a program that steps have changed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ChangedParts {
    /// The numbers of feeds.
    Feeds,
    /// Anything.
    Any,
}

impl ChangedParts {
    /// Compares a program with its source.
    fn of_program(program: &Program) -> Self {
        let same = |statement: &Statement| match statement.change() {
            StatementChange::Untouched => true,
            StatementChange::Edited(_) => changes_only_feed(program, statement),
            StatementChange::Inserted(_) | StatementChange::Deleted(_) => false,
        };
        if program.statements().iter().all(same) { Self::Feeds } else { Self::Any }
    }

    /// Returns whether a lint looks at these parts.
    fn concern(self, row: &LintRow) -> bool {
        match self {
            Self::Feeds => row.reads_feeds,
            Self::Any => true,
        }
    }
}

/// Checks a program with the lints that look at what steps have changed. The findings of all others are those that
/// the program had before its first step, at the same statements.
pub(crate) fn check_changed_parts(program: &Program) -> Vec<Diagnostic> {
    let changed = ChangedParts::of_program(program);
    run_lints(program, LINTS.iter().filter(|row| changed.concern(row)))
}

/// Returns the list of [`super::check_program`], made of the one that the program had before its first step and of
/// `check_changed_parts`.
pub fn recheck_program(program: &Program, mut before: Vec<Diagnostic>) -> Vec<Diagnostic> {
    let changed = ChangedParts::of_program(program);
    let is_new = |code| LINTS.iter().any(|row| changed.concern(row) && row.codes.contains(&code));
    before.retain(|found| !is_new(found.code));
    before.extend(check_changed_parts(program));
    sort_findings(&mut before);
    before
}

/// Returns whether an edited statement is what it was up to its feed.
fn changes_only_feed(program: &Program, statement: &Statement) -> bool {
    let original = program.source().slice(statement.origin());
    match (statement.record(), parse::read_whole_record(original, program.vocabulary())) {
        (Record::Feed(_), Ok(Record::Feed(_))) => true,
        (Record::Cycle(now), Ok(Record::Cycle(before))) => {
            let same_feed = DrillingCycle { feed: now.feed, ..(*before).clone() };
            now.feed.is_some() && before.feed.is_some() && **now == same_feed
        }
        _ => false,
    }
}

//! This module shows a program to lints: statements and motions in one pass, and in a second thread statements alone
//! to the lints that need no motions.

use super::findings::LintFindings;
use super::{Lint, LintInput, LintRow};
use crate::diagnostic::Diagnostic;
use crate::program::motion::Motion;
use crate::program::{Program, Record, Statement, StatementId};
use crate::threads::both_ways;

/// The number of statements from which a second thread gains more than it costs.
const WORTH_A_THREAD: usize = 20_000;

/// Runs lints over a program and returns their findings in the order of the file. Those about the whole file come
/// last.
pub(super) fn run_lints<'r>(program: &Program, rows: impl Iterator<Item = &'r LintRow>) -> Vec<Diagnostic> {
    let (of_statements, of_motions): (Vec<_>, Vec<_>) =
        rows.partition(|row| row.input == LintInput::Statements);
    let facts = LintFindings::new(program).facts;
    // A code belongs to one lint, so the order of findings does not depend on which thread ran it.
    let (mut found, others) = both_ways(
        program.statements().len() >= WORTH_A_THREAD,
        || show_motions(&of_motions, LintFindings::with_facts(program, facts)),
        || show_statements(&of_statements, LintFindings::with_facts(program, facts)),
    );
    found.append(others);
    found.finish()
}

/// Makes the lints of rows, each without memory.
fn make_lints<'r>(rows: impl Iterator<Item = &'r LintRow>) -> Vec<Box<dyn Lint>> {
    rows.map(|row| (row.new)()).collect()
}

// A browser compiles a function anew, and better, once it was called often, and not inside of a call that goes on: so what
// is done with each statement and each motion is not part of the loops over millions of them.
#[inline(never)]
fn show_statement(
    lints: &mut [Box<dyn Lint>],
    (id, statement): (StatementId, &Statement),
    found: &mut LintFindings<'_>,
) {
    lints.iter_mut().for_each(|lint| lint.check_statement(id, statement, found));
}

#[inline(never)]
fn show_motion(lints: &mut [Box<dyn Lint>], motion: &Motion, found: &mut LintFindings<'_>) {
    lints.iter_mut().for_each(|lint| lint.check_motion(motion, found));
}

/// Runs lints that need no motions.
fn show_statements<'p>(rows: &[&LintRow], mut found: LintFindings<'p>) -> LintFindings<'p> {
    let mut lints = make_lints(rows.iter().copied());
    for (id, statement) in found.program.live_statements() {
        show_statement(&mut lints, (id, statement), &mut found);
    }
    lints.iter_mut().for_each(|lint| lint.finish(&mut found));
    found
}

/// Runs lints that need motions. Each motion comes after the statements that make it.
fn show_motions<'p>(rows: &[&LintRow], mut found: LintFindings<'p>) -> LintFindings<'p> {
    let program = found.program;
    let reads_statements = |row: &&LintRow| row.input == LintInput::Both;
    let mut with_statements = make_lints(rows.iter().copied().filter(reads_statements));
    let mut without = make_lints(rows.iter().copied().filter(|row| !reads_statements(row)));
    let mut motions = program.motions();
    let mut statements = program.live_statements().peekable();
    loop {
        let motion = motions.next();
        let last = motion.as_ref().map(Motion::last_statement);
        while let Some((id, statement)) = statements.next_if(|(id, _)| last.is_none_or(|last| *id <= last)) {
            // Most statements of a long program are points, and what a point means is in its motion.
            if !matches!(statement.record(), Record::Goto(_)) {
                show_statement(&mut with_statements, (id, statement), &mut found);
            }
        }
        for problem in motions.take_problems() {
            let own = motion.as_ref().filter(|motion| motion.statements.contains(problem.statement));
            for lint in with_statements.iter_mut().chain(&mut without) {
                lint.check_problem(&problem, own, &mut found);
            }
        }
        let Some(motion) = motion else { break };
        show_motion(&mut with_statements, &motion, &mut found);
        show_motion(&mut without, &motion, &mut found);
        motions.give_back(motion);
    }
    with_statements.iter_mut().chain(&mut without).for_each(|lint| lint.finish(&mut found));
    found
}

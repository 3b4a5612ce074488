//! This module checks programs. It tells programmers what they want to know before the post is run.
//!
//! A lint is a file (or a small family in one) and one line in [`LINTS`]. A lint sees the program in a
//! single pass: statements in order, each motion after the statements that make it, and the problems that the
//! motions met. Of a long program, half of the lints run in a second thread. Memory and time are linear. The grammar only runs again where there is something to point at.

mod arcs;
mod axis;
mod compensation;
mod cycle;
mod feed;
mod fields_and_lines;
mod findings;
mod frame;
mod points;
mod points_apart;
mod spindle;
mod structure;
mod thread_pitch;
mod tool;
mod units;
mod unknown_words;

pub use unknown_words::list_unknown_words;

use crate::diagnostic::{Diagnostic, DiagnosticCode, codes};
use crate::parse::{self, ParsedProgram};
use crate::program::motion::{Motion, MotionProblem};
use crate::program::{Dialect, Program, ShopVocabulary, Statement, StatementId};
use crate::source::Source;
use crate::threads::both_ways;
use findings::LintFindings;
use std::sync::Arc;

/// Reads a file and checks it. Returns the program and the findings of reading and checking, with those of
/// reading first.
///
/// A file that is no CL data has a single finding that says so.
///
/// ```
/// use clsmith::check::read_and_check;
/// use clsmith::diagnostic::codes;
/// use clsmith::source::Source;
///
/// // The tool cuts before any feed is programmed.
/// let source = Source::new("part.cls", b"SPINDL/RPM,5000,CLW\nFROM/0,0,50\nGOTO/0,0,0\n".to_vec())?;
/// let (_, findings) = read_and_check(&source, None);
/// assert!(findings.iter().any(|found| found.code == codes::CUT_WITHOUT_FEED));
/// # Ok::<(), clsmith::source::SourceTooLarge>(())
/// ```
pub fn read_and_check(source: &Arc<Source>, dialect: Option<Dialect>) -> (Program, Vec<Diagnostic>) {
    read_and_check_with_vocabulary(source, dialect, &Arc::default())
}

/// Reads a file and checks it as [`read_and_check`] does, and gives the shop's own words their meanings.
pub fn read_and_check_with_vocabulary(
    source: &Arc<Source>,
    dialect: Option<Dialect>,
    vocabulary: &Arc<ShopVocabulary>,
) -> (Program, Vec<Diagnostic>) {
    let ParsedProgram { program, mut diagnostics, refused } =
        parse::parse_with_vocabulary(source, dialect, vocabulary);
    if !refused {
        let unread = diagnostics.iter().any(Diagnostic::is_error);
        // Motions that could not be read are no missing motions.
        let repeats = |found: &Diagnostic| unread && found.code == codes::NO_MOTION;
        diagnostics.extend(check_program(&program).into_iter().filter(|found| !repeats(found)));
    }
    (program, diagnostics)
}

/// A check, with its memory of the program so far.
trait Lint {
    /// Checks a live statement. Statements come in order.
    fn check_statement(&mut self, _id: StatementId, _statement: &Statement, _found: &mut LintFindings<'_>) {}
    /// Checks a motion, after its statements.
    fn check_motion(&mut self, _motion: &Motion, _found: &mut LintFindings<'_>) {}
    /// Checks a problem that the motions met, with the motion to which it belongs if there is one.
    fn check_problem(
        &mut self,
        _problem: &MotionProblem,
        _motion: Option<&Motion>,
        _found: &mut LintFindings<'_>,
    ) {
    }
    /// Checks the end of the program.
    fn finish(&mut self, _found: &mut LintFindings<'_>) {}
}

/// A row of [`LINTS`].
pub struct LintRow {
    /// The codes it reports.
    pub codes: &'static [DiagnosticCode],
    new: fn() -> Box<dyn Lint>,
}

/// Makes a row for a lint that starts without memory.
const fn lint_row<L: Lint + Default + 'static>(codes: &'static [DiagnosticCode]) -> LintRow {
    LintRow { codes, new: || Box::new(L::default()) }
}

/// All lints. A new one needs a line here, and its file.
pub const LINTS: &[LintRow] = &[
    lint_row::<arcs::MotionProblemLint>(arcs::CODES),
    lint_row::<arcs::RapidArcLint>(&[codes::RAPID_ARC]),
    lint_row::<arcs::OtherSenseLint>(&[codes::OTHER_SENSE_FITS]),
    lint_row::<axis::UnitAxisLint>(&[codes::AXIS_NOT_UNIT, codes::NO_AXIS]),
    lint_row::<axis::MultaxLint>(&[codes::AXIS_WITHOUT_MULTAX]),
    lint_row::<axis::AxisJumpLint>(&[codes::AXIS_JUMP]),
    lint_row::<points::PointLint>(&[codes::REPEATED_POINT, codes::FAR_AWAY, codes::NO_MOTION]),
    lint_row::<points_apart::PointApartLint>(&[codes::POINT_APART]),
    lint_row::<points::LeftInCutLint>(&[codes::LEFT_IN_CUT]),
    lint_row::<feed::FeedLint>(feed::CODES),
    lint_row::<spindle::SpindleLint>(spindle::CODES),
    lint_row::<thread_pitch::ThreadPitchLint>(&[codes::THREAD_PITCH_DIFFERS]),
    lint_row::<spindle::CoolantLint>(&[codes::NO_COOLANT]),
    lint_row::<tool::ToolShapeLint>(tool::CODES),
    lint_row::<tool::ToolNumberLint>(&[codes::TOOL_NUMBERS_DIFFER]),
    lint_row::<compensation::CompensationLint>(compensation::CODES),
    lint_row::<cycle::CycleLint>(cycle::CODES),
    lint_row::<unknown_words::UnknownWordLint>(unknown_words::CODES),
    lint_row::<structure::OperationLint>(&[codes::OPERATION_OPEN, codes::EMPTY_OPERATION]),
    lint_row::<structure::ProgramEndLint>(&[codes::AFTER_END, codes::MISSING_END]),
    lint_row::<frame::FrameLint>(&[codes::FRAME_SKEWED, codes::FRAME_LEFT_HANDED]),
    lint_row::<units::LengthUnitLint>(&[codes::UNITS_DIFFER, codes::UNITS_LATE]),
    lint_row::<units::FeedUnitLint>(&[codes::FEED_UNITS_MIXED]),
    lint_row::<fields_and_lines::FieldLint>(&[codes::MISSING_COMMA, codes::UNUSUAL_NUMBER]),
    lint_row::<fields_and_lines::LineLint>(fields_and_lines::LINE_CODES),
];

/// Checks a program. Findings come in the order of the file, and those about the whole file come last.
///
/// What could not be read at all is not repeated here, because [`crate::parse::parse`] has reported it.
pub fn check_program(program: &Program) -> Vec<Diagnostic> {
    let facts = LintFindings::new(program).facts;
    let (even, odd): (Vec<_>, Vec<_>) = LINTS.iter().enumerate().partition(|(index, _)| index % 2 == 0);
    // A code belongs to one lint, so the order of findings does not depend on which thread ran it.
    let (mut found, others) = both_ways(
        program.statements().len() >= WORTH_A_THREAD,
        || run_lints(&even, LintFindings::with_facts(program, facts)),
        || run_lints(&odd, LintFindings::with_facts(program, facts)),
    );
    found.append(others);
    found.finish()
}

/// The number of statements from which a second thread gains more than it costs.
const WORTH_A_THREAD: usize = 20_000;

/// Runs some lints over a program, in a single pass.
fn run_lints<'p>(rows: &[(usize, &LintRow)], mut found: LintFindings<'p>) -> LintFindings<'p> {
    let program = found.program;
    let mut lints: Vec<Box<dyn Lint>> = rows.iter().map(|(_, row)| (row.new)()).collect();
    let mut motions = program.motions();
    let mut statements = program.live_statements().peekable();
    loop {
        let motion = motions.next();
        let last = motion.as_ref().map(Motion::last_statement);
        while let Some((id, statement)) = statements.next_if(|(id, _)| last.is_none_or(|last| *id <= last)) {
            lints.iter_mut().for_each(|lint| lint.check_statement(id, statement, &mut found));
        }
        for problem in motions.take_problems() {
            let own = motion.as_ref().filter(|motion| motion.statements.contains(problem.statement));
            lints.iter_mut().for_each(|lint| lint.check_problem(&problem, own, &mut found));
        }
        match &motion {
            Some(motion) => lints.iter_mut().for_each(|lint| lint.check_motion(motion, &mut found)),
            None => break,
        }
    }
    lints.iter_mut().for_each(|lint| lint.finish(&mut found));
    found
}

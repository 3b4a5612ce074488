//! This module checks programs. It tells programmers what they want to know before the post is run.
//!
//! A lint is a file (or a small family in one) and one line in [`LINTS`]. A lint sees the program in a
//! single pass: statements in order, each motion after the statements that make it, and the problems that the
//! motions met. Of a long program, the lints that need no motions run in a second thread. Memory and time are
//! linear. The grammar only runs again where there is something to point at.
//!
//! After a change, only the lints that look at what changed have anything to say that they have not said before
//! (`changed_parts`).

mod arcs;
mod axis;
pub(crate) mod changed_parts;
mod compensation;
mod cycle;
mod feed;
mod fields_and_lines;
mod findings;
mod frame;
mod lint_run;
mod points;
mod points_apart;
mod spindle;
mod structure;
mod thread_names;
mod thread_pitch;
mod tool;
mod units;
mod unknown_words;

pub(crate) use changed_parts::check_changed_parts;
pub use unknown_words::list_unknown_words;

use crate::diagnostic::{Diagnostic, DiagnosticCode, codes};
use crate::parse::{self, ParsedProgram};
use crate::program::motion::{Motion, MotionProblem};
use crate::program::{Dialect, Program, ShopVocabulary, Statement, StatementId};
use crate::source::Source;
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
    let CheckedProgram { program, mut of_reading, of_checks } =
        CheckedProgram::read_source(source, dialect, vocabulary);
    of_reading.extend(of_checks);
    (program, of_reading)
}

/// A program that was read and checked.
#[derive(Debug)]
pub struct CheckedProgram {
    /// The program.
    pub program: Program,
    /// What cannot be read, or was read with a doubt.
    pub of_reading: Vec<Diagnostic>,
    /// What is wrong with what was read. It is empty for a file that is no CL data.
    pub of_checks: Vec<Diagnostic>,
}

impl CheckedProgram {
    /// Reads a file, gives the shop's own words their meanings, and checks the program.
    pub fn read_source(
        source: &Arc<Source>,
        dialect: Option<Dialect>,
        vocabulary: &Arc<ShopVocabulary>,
    ) -> Self {
        let ParsedProgram { program, diagnostics, refused } =
            parse::parse_with_vocabulary(source, dialect, vocabulary);
        let mut of_checks = Vec::new();
        if !refused {
            let unread = diagnostics.iter().any(Diagnostic::is_error);
            // Motions that could not be read are no missing motions.
            let repeats = |found: &Diagnostic| unread && found.code == codes::NO_MOTION;
            of_checks = check_program(&program);
            of_checks.retain(|found| !repeats(found));
        }
        Self { program, of_reading: diagnostics, of_checks }
    }
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

/// What a lint is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum LintInput {
    /// Statements only.
    Statements,
    /// Motions and their problems only.
    Motions,
    /// Motions, their problems, and all statements but GOTO.
    Both,
}

/// A row of [`LINTS`].
pub struct LintRow {
    /// The codes it reports.
    pub codes: &'static [DiagnosticCode],
    new: fn() -> Box<dyn Lint>,
    input: LintInput,
    /// Whether it looks at feeds, or at the texts of statements that state one.
    reads_feeds: bool,
}

impl LintRow {
    /// Returns the row of a lint that looks at feeds, or at the texts of statements that state one.
    const fn of_feeds(mut self) -> Self {
        self.reads_feeds = true;
        self
    }
}

/// Makes a row for a lint that starts without memory.
const fn lint_row<L: Lint + Default + 'static>(
    input: LintInput,
    codes: &'static [DiagnosticCode],
) -> LintRow {
    LintRow { codes, new: || Box::new(L::default()), input, reads_feeds: false }
}

use LintInput::{Both, Motions, Statements};

/// All lints. A new one needs a line here, and its file.
pub const LINTS: &[LintRow] = &[
    lint_row::<arcs::MotionProblemLint>(Motions, arcs::CODES),
    lint_row::<arcs::RapidArcLint>(Motions, &[codes::RAPID_ARC]),
    lint_row::<arcs::OtherSenseLint>(Motions, &[codes::OTHER_SENSE_FITS]),
    lint_row::<axis::UnitAxisLint>(Statements, &[codes::AXIS_NOT_UNIT, codes::NO_AXIS]),
    lint_row::<axis::MultaxLint>(Statements, &[codes::AXIS_WITHOUT_MULTAX]),
    lint_row::<axis::AxisJumpLint>(Both, &[codes::AXIS_JUMP]),
    lint_row::<points::PointLint>(Motions, &[codes::REPEATED_POINT, codes::FAR_AWAY, codes::NO_MOTION]),
    lint_row::<points_apart::PointApartLint>(Motions, &[codes::POINT_APART]),
    lint_row::<points::LeftInCutLint>(Both, &[codes::LEFT_IN_CUT]),
    lint_row::<feed::FeedLint>(Motions, feed::CODES).of_feeds(),
    lint_row::<spindle::SpindleLint>(Both, spindle::CODES),
    lint_row::<thread_pitch::ThreadPitchLint>(Both, &[codes::THREAD_PITCH_DIFFERS]).of_feeds(),
    lint_row::<spindle::CoolantLint>(Both, &[codes::NO_COOLANT]),
    lint_row::<tool::ToolShapeLint>(Both, tool::CODES),
    lint_row::<tool::ToolNumberLint>(Both, &[codes::TOOL_NUMBERS_DIFFER]),
    lint_row::<compensation::CompensationLint>(Both, compensation::CODES),
    lint_row::<cycle::CycleLint>(Both, cycle::CODES).of_feeds(),
    lint_row::<unknown_words::UnknownWordLint>(Both, unknown_words::CODES),
    lint_row::<structure::OperationLint>(Both, &[codes::OPERATION_OPEN, codes::EMPTY_OPERATION]),
    lint_row::<structure::ProgramEndLint>(Statements, &[codes::AFTER_END, codes::MISSING_END]),
    lint_row::<frame::FrameLint>(Statements, &[codes::FRAME_SKEWED, codes::FRAME_LEFT_HANDED]),
    lint_row::<units::LengthUnitLint>(Both, &[codes::UNITS_DIFFER, codes::UNITS_LATE]),
    lint_row::<units::FeedUnitLint>(Statements, &[codes::FEED_UNITS_MIXED]).of_feeds(),
    lint_row::<fields_and_lines::FieldLint>(Statements, &[codes::MISSING_COMMA, codes::UNUSUAL_NUMBER])
        .of_feeds(),
    lint_row::<fields_and_lines::LineLint>(Statements, fields_and_lines::LINE_CODES).of_feeds(),
];

/// Checks a program. Findings come in the order of the file, and those about the whole file come last.
///
/// What could not be read at all is not repeated here, because [`crate::parse::parse`] has reported it.
pub fn check_program(program: &Program) -> Vec<Diagnostic> {
    lint_run::run_lints(program, LINTS.iter())
}

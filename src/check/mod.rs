//! Checking: what a programmer wants to know before the post does.
//!
//! A lint is a file (or a small family in one) and one line in [`LINTS`]. All lints see the program once, together:
//! statements in order, each motion after the statements that make it, and the problems that the motions met. Memory and
//! time are linear; the grammar runs again only where there is something to point at.

mod arcs;
mod axis;
mod compensation;
mod cycle;
mod displacement;
mod feed;
mod findings;
mod frame;
mod points;
mod spindle;
mod stale;
mod structure;
mod text;
mod tool;
mod units;
mod words;

pub use stale::{STALE_CODES, stale};

use crate::diagnostic::{Code, Diagnostic, codes};
use crate::parse::{self, Parsed};
use crate::program::motion::{Motion, Problem};
use crate::program::{Dialect, Program, Statement};
use crate::source::Source;
use findings::Findings;
use std::sync::Arc;

/// Reads a file and checks it: the program, and everything that reading and checking find, reading first.
///
/// A file that is no CL data has the one finding that says so.
pub fn read_and_check(source: &Arc<Source>, dialect: Option<Dialect>) -> (Program, Vec<Diagnostic>) {
    let Parsed { program, mut diagnostics, refused } = parse::parse(source, dialect);
    if !refused {
        diagnostics.extend(check(&program));
    }
    (program, diagnostics)
}

/// One check, with what it has to remember of the program so far.
trait Lint {
    /// A live statement, in order.
    fn statement(&mut self, _index: usize, _statement: &Statement, _found: &mut Findings<'_>) {}
    /// A motion, after its statements.
    fn motion(&mut self, _motion: &Motion, _found: &mut Findings<'_>) {}
    /// A problem that the motions met; with the motion it belongs to, where there is one.
    fn problem(&mut self, _problem: &Problem, _motion: Option<&Motion>, _found: &mut Findings<'_>) {}
    /// The end of the program.
    fn finish(&mut self, _found: &mut Findings<'_>) {}
}

/// A row of [`LINTS`].
pub struct LintRow {
    /// The codes it reports.
    pub codes: &'static [Code],
    new: fn() -> Box<dyn Lint>,
}

/// A row of a lint that starts with nothing to remember.
const fn row<L: Lint + Default + 'static>(codes: &'static [Code]) -> LintRow {
    LintRow { codes, new: || Box::new(L::default()) }
}

/// Every lint. A new one is one line here, and its file.
pub const LINTS: &[LintRow] = &[
    row::<arcs::Problems>(arcs::CODES),
    row::<arcs::RapidArc>(&[codes::RAPID_ARC]),
    row::<axis::UnitAxis>(&[codes::AXIS_NOT_UNIT, codes::NO_AXIS]),
    row::<axis::WithoutMultax>(&[codes::AXIS_WITHOUT_MULTAX]),
    row::<axis::Jump>(&[codes::AXIS_JUMP]),
    row::<points::Points>(&[codes::REPEATED_POINT, codes::FAR_AWAY, codes::NO_MOTION]),
    row::<points::LeftInCut>(&[codes::LEFT_IN_CUT]),
    row::<feed::Feeds>(feed::CODES),
    row::<spindle::Spindles>(spindle::CODES),
    row::<spindle::Coolant>(&[codes::NO_COOLANT]),
    row::<tool::Shapes>(tool::CODES),
    row::<tool::Numbers>(&[codes::TOOL_NUMBERS_DIFFER]),
    row::<compensation::Compensation>(compensation::CODES),
    row::<cycle::Cycles>(cycle::CODES),
    row::<words::Words>(&[codes::UNKNOWN_WORD, codes::MISSPELT_WORD]),
    row::<structure::Operations>(&[codes::OPERATION_OPEN, codes::EMPTY_OPERATION]),
    row::<structure::End>(&[codes::AFTER_END, codes::MISSING_END]),
    row::<frame::Frames>(&[codes::FRAME_SKEWED, codes::FRAME_LEFT_HANDED]),
    row::<units::Lengths>(&[codes::UNITS_DIFFER, codes::UNITS_LATE]),
    row::<units::FeedUnits>(&[codes::FEED_UNITS_MIXED]),
    row::<text::Fields>(&[codes::MISSING_COMMA, codes::UNUSUAL_NUMBER]),
    row::<text::Lines>(text::LINE_CODES),
];

/// Checks a program. Findings come in the order of the file; those about the whole file come last.
///
/// What could not be read at all is not repeated here: [`crate::parse::parse`] has reported it.
pub fn check(program: &Program) -> Vec<Diagnostic> {
    let mut found = Findings::new(program);
    let mut lints: Vec<Box<dyn Lint>> = LINTS.iter().map(|row| (row.new)()).collect();
    let mut motions = program.motions();
    let mut next = 0;
    loop {
        let motion = motions.next();
        let end = motion.as_ref().map_or(program.statements().len(), |motion| motion.statements.end);
        for index in next..end {
            let Some(statement) = program.statement(index).filter(|statement| statement.is_live()) else {
                continue;
            };
            lints.iter_mut().for_each(|lint| lint.statement(index, statement, &mut found));
        }
        next = next.max(end);
        for problem in motions.take_problems() {
            let own = motion.as_ref().filter(|motion| motion.statements.contains(&problem.statement));
            lints.iter_mut().for_each(|lint| lint.problem(&problem, own, &mut found));
        }
        match &motion {
            Some(motion) => lints.iter_mut().for_each(|lint| lint.motion(motion, &mut found)),
            None => break,
        }
    }
    lints.iter_mut().for_each(|lint| lint.finish(&mut found));
    found.finish()
}

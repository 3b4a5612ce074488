//! This module ends a program at a line, for the stock as it is there.

use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::parse::parse_with_vocabulary;
use clsmith::program::Program;
use clsmith::setup::Setup;
use clsmith::source::Source;

/// Returns the program up to the statement that begins on a line or before it, with the lines that it has in its file.
///
/// # Errors
/// Returns a finding if no statement begins there, or no motion has ended by then.
pub(super) fn end_program_at_line(
    program: &Program,
    line: usize,
    setup: &Setup,
) -> Result<Program, Diagnostic> {
    let source = program.source();
    let begins = |start: u32| source.line_column(start).0;
    let spans = program.live_statements().map(|(_, statement)| statement.origin());
    let last = spans.take_while(|span| begins(span.start) <= line).last();
    let missing = |what: String| {
        Diagnostic::new(codes::NO_MOTION_ASKED, format!("{what}; there is no stock at line {line}"))
    };
    let last = last.ok_or_else(|| missing("the program begins after that line".to_owned()))?;
    // The last line end begins no line.
    let lines = begins(u32::try_from(source.bytes().len()).unwrap_or(u32::MAX).saturating_sub(1));
    if line > lines {
        return Err(missing(format!("the program has {lines} lines")));
    }
    let bytes = source.bytes().get(..last.end as usize).unwrap_or_default().to_vec();
    let cut = Source::new(source.name(), bytes).map_err(|error| missing(error.to_string()))?;
    let ended = parse_with_vocabulary(&cut, Some(program.dialect()), &setup.vocabulary).program;
    if ended.motions().next().is_none() {
        return Err(missing("no motion has ended by then".to_owned()));
    }
    Ok(ended)
}

//! This module writes what steps have made of a program as a unified diff.
//!
//! A program carries its changes: each statement knows its place in the file and its current text. So the
//! diff needs no search. It is written statement by statement, in time linear in the file. It is a patch:
//! applied to the file, it gives the program byte for byte, whatever the encoding and the line ends.

mod hunk;

use crate::program::{Program, StatementChange};
use hunk::HunkWriter;
use std::io::{self, Write};

/// The options of a unified diff.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub struct UnifiedDiffOptions {
    /// The number of unchanged lines around a change.
    pub context: usize,
    /// Whether to write ANSI colours.
    pub color: bool,
    /// Whether the diff is for a terminal. Then a CR before a line's end is left out and control characters
    /// are replaced, because text in a CL file must not send commands to the terminal. The result is no patch
    /// any more.
    pub display: bool,
}

impl Default for UnifiedDiffOptions {
    fn default() -> Self {
        Self { context: 3, color: false, display: false }
    }
}

impl UnifiedDiffOptions {
    /// Returns the options with so many unchanged lines around a change.
    #[must_use]
    pub fn with_context(mut self, context: usize) -> Self {
        self.context = context;
        self
    }

    /// Returns the options with or without ANSI colours.
    #[must_use]
    pub fn with_color(mut self, color: bool) -> Self {
        self.color = color;
        self
    }

    /// Returns the options for a terminal, or for a patch.
    #[must_use]
    pub fn with_display(mut self, display: bool) -> Self {
        self.display = display;
        self
    }
}

/// Writes the changes that a program carries as a unified diff. Writes nothing if it carries none.
///
/// Lines end at LF, as for `patch`.
///
/// # Errors
/// Returns the errors of the writer.
pub fn write_unified_diff(
    out: &mut dyn Write,
    program: &Program,
    options: &UnifiedDiffOptions,
) -> io::Result<()> {
    let mut hunks = HunkWriter::new(out, program.source().name(), options);
    let (mut old, mut new) = (Vec::new(), Vec::new());
    for statement in program.statements() {
        let origin = program.source().slice(statement.origin());
        // An untouched statement is a number of whole lines, unless single CRs put several statements on one
        // line.
        let untouched = statement.change() == StatementChange::Untouched && origin.ends_with(b"\n");
        if untouched && old.is_empty() && new.is_empty() {
            split_lines(origin).try_for_each(|line| hunks.push_unchanged(line))?;
            continue;
        }
        old.extend_from_slice(origin);
        if statement.is_live() {
            new.extend_from_slice(program.statement_text(statement));
        }
        if ends_complete(&old) && ends_complete(&new) {
            write_changed_lines(&mut hunks, &old, &new)?;
            old.clear();
            new.clear();
        }
    }
    write_changed_lines(&mut hunks, &old, &new)?;
    hunks.finish()
}

/// Returns the diff as bytes, for callers that keep it.
///
/// ```
/// use clsmith::parameters::Factor;
/// use clsmith::parse::parse;
/// use clsmith::program::LengthUnit;
/// use clsmith::report::unified_diff::{UnifiedDiffOptions, to_bytes};
/// use clsmith::setup::Setup;
/// use clsmith::source::Source;
/// use clsmith::transform::{ScaleFeed, run_steps};
///
/// let program = parse(&Source::new("part.cls", b"FEDRAT/MMPM,600.\nGOTO/1,0,0\n".to_vec())?, None).program;
/// let step = ScaleFeed::new(Factor::new(0.5).expect("0.5 is above 0"));
/// let program = run_steps(&[&step], LengthUnit::Mm, &Setup::default(), program)?.program;
/// let diff = String::from_utf8(to_bytes(&program, &UnifiedDiffOptions::default()))?;
/// assert!(diff.contains("-FEDRAT/MMPM,600.\n+FEDRAT/MMPM,300.\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn to_bytes(program: &Program, options: &UnifiedDiffOptions) -> Vec<u8> {
    let mut out = Vec::new();
    // Writing to memory cannot fail.
    let _ = write_unified_diff(&mut out, program, options);
    out
}

fn ends_complete(text: &[u8]) -> bool {
    text.is_empty() || text.ends_with(b"\n")
}

/// Writes lines that have changed, without the unchanged ones at both ends.
fn write_changed_lines(hunks: &mut HunkWriter<'_>, old: &[u8], new: &[u8]) -> io::Result<()> {
    let old: Vec<&[u8]> = split_lines(old).collect();
    let new: Vec<&[u8]> = split_lines(new).collect();
    let head = old.iter().zip(&new).take_while(|(old, new)| old == new).count();
    let rest = old.len().min(new.len()) - head;
    let ends = old.iter().rev().zip(new.iter().rev()).take(rest);
    let tail = ends.take_while(|(old, new)| old == new).count();
    for line in old.iter().take(head) {
        hunks.push_unchanged(line)?;
    }
    old.iter().take(old.len() - tail).skip(head).for_each(|line| hunks.push_removed(line));
    new.iter().take(new.len() - tail).skip(head).for_each(|line| hunks.push_added(line));
    for line in old.iter().skip(old.len() - tail) {
        hunks.push_unchanged(line)?;
    }
    Ok(())
}

/// Returns lines as `patch` sees them, each with its LF. The last one may have none.
fn split_lines(text: &[u8]) -> impl Iterator<Item = &[u8]> {
    text.split_inclusive(|byte| *byte == b'\n')
}

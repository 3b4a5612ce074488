//! This module lists the text of the program line by line, with the lines that steps changed or deleted
//! beside it.

use crate::program::{Program, Record, Statement, StatementChange};

/// The value that stands for no row, or for no motion.
pub(super) const NONE: u32 = u32::MAX;

/// The kind of a row, as in a patch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub(super) enum ListingRowKind {
    /// It is in both programs.
    Kept = 0,
    /// It is only in the program before.
    Old = 1,
    /// It is only in the program after.
    New = 2,
}

/// The rows of the listing, and the row at which each statement begins.
#[derive(Debug, Default)]
pub(super) struct ProgramListing {
    /// The texts of the rows, each with LF at its end.
    pub text: Vec<u8>,
    /// The kind of each row.
    pub kinds: Vec<u8>,
    /// The step (from 1) that made each row; 0 for none.
    pub steps: Vec<u16>,
    /// The first row of each statement of the current program, or [`NONE`] for a deleted one.
    pub after: Vec<u32>,
    /// The first row of each statement of the program as it was read, in their order.
    pub before: Vec<u32>,
    /// For each statement as it was read, its index in the current program.
    pub origins: Vec<u32>,
}

impl ProgramListing {
    /// Lists a program, whether steps changed it or not.
    pub(super) fn from_program(program: &Program) -> Self {
        let mut listing = Self::default();
        for (index, statement) in program.statements().iter().enumerate() {
            let row = listing.kinds.len() as u32;
            let step = statement.edited_by().map_or(0, |step| step.0.saturating_add(1));
            let was_read = !statement.origin().is_empty();
            let mut now = NONE;
            match statement.change() {
                // A byte order mark is on the first line, with the statement that begins there.
                StatementChange::Untouched if matches!(statement.record(), Record::ByteOrderMark) => {
                    now = row;
                    listing.text.extend_from_slice(program.statement_text(statement));
                }
                StatementChange::Untouched => {
                    now = row;
                    listing.append_rows(program.statement_text(statement), ListingRowKind::Kept, step);
                }
                StatementChange::Edited(_) => {
                    listing.append_rows(text_as_read(program, statement), ListingRowKind::Old, step);
                    now = listing.kinds.len() as u32;
                    listing.append_rows(program.statement_text(statement), ListingRowKind::New, step);
                }
                StatementChange::Inserted(_) => {
                    now = row;
                    listing.append_rows(program.statement_text(statement), ListingRowKind::New, step);
                }
                StatementChange::Deleted(_) if was_read => {
                    listing.append_rows(text_as_read(program, statement), ListingRowKind::Old, step);
                }
                // A statement that one step inserted and a later one deleted is in neither program.
                StatementChange::Deleted(_) => {}
            }
            listing.after.push(now);
            if was_read && !matches!(statement.change(), StatementChange::Inserted(_)) {
                listing.before.push(row);
                listing.origins.push(index as u32);
            }
        }
        listing
    }

    fn append_rows(&mut self, text: &[u8], kind: ListingRowKind, step: u16) {
        let mut rest = text;
        while !rest.is_empty() {
            let end = rest.iter().position(|byte| matches!(byte, b'\n' | b'\r')).unwrap_or(rest.len());
            let (line, after) = rest.split_at(end);
            rest = after.strip_prefix(b"\r\n").or_else(|| after.get(1..)).unwrap_or_default();
            self.text.extend_from_slice(line);
            self.text.push(b'\n');
            self.kinds.push(kind as u8);
            self.steps.push(step);
        }
    }
}

fn text_as_read<'p>(program: &'p Program, statement: &Statement) -> &'p [u8] {
    program.source().slice(statement.origin())
}

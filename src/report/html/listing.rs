//! This module lists the text of the program line by line, with the lines that steps changed or deleted
//! beside it.

use crate::program::{Program, Record, Statement, StatementChange, StatementId};
use crate::report::diff::{AlignmentRun, StatementAlignment};

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
    /// For each statement as it was read, its index in the current program, or [`NONE`] if it is not in another file.
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

    /// Lists the programs of two files, which are as they were read. Statements that belong together and have the same
    /// text are in one row.
    pub(super) fn from_files(before: &Program, after: &Program, alignment: &StatementAlignment) -> Self {
        let mut listing = Self::default();
        let id_of = |ids: &[StatementId], at: usize| ids.get(at).copied();
        for run in &alignment.runs {
            match run.clone() {
                AlignmentRun::Pairs(in_a, in_b) => in_a.zip(in_b).for_each(|(at_a, at_b)| {
                    let ids = id_of(&alignment.ids_a, at_a).zip(id_of(&alignment.ids_b, at_b));
                    if let Some((old, new)) = ids {
                        listing.append_pair((before, old), (after, new));
                    }
                }),
                AlignmentRun::Removed(in_a, _) => in_a.for_each(|at| {
                    if let Some(old) = id_of(&alignment.ids_a, at) {
                        listing.append_old(before, old, NONE);
                    }
                }),
                AlignmentRun::Added(_, in_b) => in_b.for_each(|at| {
                    if let Some(new) = id_of(&alignment.ids_b, at) {
                        listing.append_new(after, new);
                    }
                }),
            }
        }
        listing
    }

    fn append_pair(&mut self, old: (&Program, StatementId), new: (&Program, StatementId)) {
        let texts = [old, new].map(|(program, id)| program.statement_text(program.statement(id)));
        if texts[0] == texts[1] {
            let row = self.kinds.len() as u32;
            // A byte order mark is on the first line, with the statement that begins there.
            match new.0.statement(new.1).record() {
                Record::ByteOrderMark => self.text.extend_from_slice(texts[1]),
                _ => self.append_rows(texts[1], ListingRowKind::Kept, 0),
            }
            self.before.push(row);
            self.origins.push(new.1.index() as u32);
            self.after.push(row);
            return;
        }
        self.append_old(old.0, old.1, new.1.index() as u32);
        self.append_new(new.0, new.1);
    }

    fn append_old(&mut self, program: &Program, id: StatementId, origin: u32) {
        self.before.push(self.kinds.len() as u32);
        self.origins.push(origin);
        self.append_rows(program.statement_text(program.statement(id)), ListingRowKind::Old, 0);
    }

    fn append_new(&mut self, program: &Program, id: StatementId) {
        self.after.push(self.kinds.len() as u32);
        self.append_rows(program.statement_text(program.statement(id)), ListingRowKind::New, 0);
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

//! Structure: operations that are open or empty, and the end of the program.

use super::{Findings, Lint};
use crate::diagnostic::{Diagnostic, codes};
use crate::program::motion::Motion;
use crate::program::{Dialect, Record, Statement, operation};

/// Operations that are not closed or do nothing, in the dialects that close them.
#[derive(Default)]
pub(super) struct Operations {
    open: Option<usize>,
    moved: bool,
}

impl Operations {
    fn left_open(&mut self, found: &mut Findings<'_>) {
        if let Some(at) = self.open.take() {
            let message = format!("the operation{} is not closed", name(at, found));
            found.report(codes::OPERATION_OPEN, found.whole(at), message, "starts here");
        }
    }
}

impl Lint for Operations {
    fn statement(&mut self, index: usize, statement: &Statement, found: &mut Findings<'_>) {
        if !closes_operations(found.program.dialect()) {
            return;
        }
        match statement.record() {
            Record::OperationStart(_) => {
                self.left_open(found);
                (self.open, self.moved) = (Some(index), false);
            }
            Record::OperationEnd => {
                if let Some(at) = self.open.take().filter(|_| !self.moved) {
                    let message = format!("nothing moves in the operation{}", name(at, found));
                    found.report(codes::EMPTY_OPERATION, found.whole(at), message, "");
                }
            }
            _ => {}
        }
    }

    fn motion(&mut self, _motion: &Motion, _found: &mut Findings<'_>) {
        self.moved = true;
    }

    fn finish(&mut self, found: &mut Findings<'_>) {
        self.left_open(found);
    }
}

fn name(at: usize, found: &Findings<'_>) -> String {
    let name = found.program.statement(at).and_then(|statement| operation::name(found.program, statement));
    name.filter(|name| !name.is_empty()).map(|name| format!(" `{name}`")).unwrap_or_default()
}

/// CATIA marks the end of an operation in the PC's language only.
fn closes_operations(dialect: Dialect) -> bool {
    matches!(dialect, Dialect::Nx | Dialect::Creo | Dialect::CreoGpost | Dialect::CamWorks)
}

/// FINI: missing, or with something after it.
#[derive(Default)]
pub(super) struct End {
    end: Option<usize>,
    /// The first statement after the end, and how many there are.
    after: Option<(usize, usize)>,
    /// How many of them move the tool.
    motions: usize,
}

impl Lint for End {
    fn statement(&mut self, index: usize, statement: &Statement, _found: &mut Findings<'_>) {
        match statement.record() {
            Record::ProgramEnd => {
                self.end.get_or_insert(index);
            }
            Record::Blank | Record::Comment => {}
            record if self.end.is_some() => {
                self.after.get_or_insert((index, 0)).1 += 1;
                self.motions += usize::from(record.is_motion());
            }
            _ => {}
        }
    }

    fn finish(&mut self, found: &mut Findings<'_>) {
        match (self.end, self.after) {
            (Some(end), Some((first, count))) => {
                let message = match (count, self.motions) {
                    (1, 0) => "a statement follows the end of the program".to_owned(),
                    (_, 0) => format!("{count} statements follow the end of the program"),
                    (_, motions) => {
                        format!("{count} statements follow the end of the program, {motions} of them motions")
                    }
                };
                let end = (found.whole(end), "the program ends here");
                found.report_two(
                    codes::AFTER_END,
                    message,
                    (found.whole(first), "never read by a post"),
                    end,
                );
            }
            (None, _) if found.program.dialect().ends_with_fini() => missing(found),
            _ => {}
        }
    }
}

fn missing(found: &mut Findings<'_>) {
    let message = format!("{} programs end with FINI, this one does not", found.program.dialect());
    let last = found.program.live().rev().find(|(_, statement)| !matches!(statement.record(), Record::Blank));
    match last.map(|(index, _)| index) {
        Some(last) => found.report(codes::MISSING_END, found.whole(last), message, "the last statement"),
        None => found.push(Diagnostic::new(codes::MISSING_END, message)),
    }
}

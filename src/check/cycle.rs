//! Drilling cycles: left on, without holes, without depth.

use super::{Findings, Lint};
use crate::diagnostic::{Code, codes};
use crate::program::motion::Motion;
use crate::program::record::Cycle;
use crate::program::{Dialect, Record, Statement};

pub(super) const CODES: &[Code] = &[
    codes::CYCLE_LEFT_ON,
    codes::CYCLE_WITHOUT_HOLE,
    codes::CYCLE_WITHOUT_DEPTH,
    codes::CYCLE_CUTS_NOTHING,
    codes::CYCLE_BELOW_POINT,
];

/// Follows CYCLE through the program.
#[derive(Default)]
pub(super) struct Cycles {
    /// The cycle in force, and whether it has drilled.
    open: Option<(usize, bool)>,
    tool: Option<u32>,
}

impl Cycles {
    fn end(&mut self, what: &str, found: &mut Findings<'_>) {
        if let Some((at, _)) = self.open.take() {
            let message = format!("this cycle is still on at the end of {what}");
            found.report(codes::CYCLE_LEFT_ON, found.whole(at), message, "");
        }
    }

    fn close(&mut self, found: &mut Findings<'_>) {
        if let Some((at, false)) = self.open.take() {
            found.report(codes::CYCLE_WITHOUT_HOLE, found.whole(at), "this cycle drills no hole", "");
        }
    }
}

impl Lint for Cycles {
    fn statement(&mut self, index: usize, statement: &Statement, found: &mut Findings<'_>) {
        match statement.record() {
            Record::Cycle(cycle) => {
                self.close(found);
                self.open = Some((index, false));
                look(index, cycle, found);
            }
            Record::CycleOff => self.close(found),
            Record::OperationStart(_) | Record::OperationEnd => self.end("the operation", found),
            Record::ProgramEnd => self.end("the program", found),
            Record::ToolCall(call) if call.loads => {
                if self.tool.is_some_and(|tool| tool != call.number) {
                    self.end("the tool's work", found);
                }
                self.tool = Some(call.number);
            }
            _ => {}
        }
    }

    fn motion(&mut self, motion: &Motion, _found: &mut Findings<'_>) {
        if let (Some((_, drilled)), true) = (&mut self.open, motion.hole.is_some()) {
            *drilled = true;
        }
    }

    fn finish(&mut self, found: &mut Findings<'_>) {
        self.end("the program", found);
    }
}

fn look(index: usize, cycle: &Cycle, found: &mut Findings<'_>) {
    let coordinate = cycle.depth_is_fedto && found.program.dialect() == Dialect::Nx;
    match cycle.depth {
        None => found.report(codes::CYCLE_WITHOUT_DEPTH, found.whole(index), "this cycle has no depth", ""),
        Some(depth) if depth == 0.0 || coordinate && depth > 0.0 => {
            let span = number(index, depth, found);
            found.report(codes::CYCLE_CUTS_NOTHING, span, "this cycle does not go below its points", "");
        }
        Some(_) => {}
    }
    if let Some(clearance) = cycle.clearance.filter(|clearance| *clearance < 0.0) {
        let message = format!("the rapid of this cycle ends {} below its points", found.length(-clearance));
        let span = number(index, clearance, found);
        found.report(codes::CYCLE_BELOW_POINT, span, message, "");
    }
}

/// The first number of the cycle with a value: which word governs it only the record's reader knows.
fn number(index: usize, value: f64, found: &Findings<'_>) -> crate::source::Span {
    let numbers = found.syntax(index).numbers();
    match numbers.iter().find(|(_, found)| *found == value) {
        Some((at, _)) => found.place(index, at),
        None => found.whole(index),
    }
}

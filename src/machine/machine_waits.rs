//! This module finds where a program lets the machine wait.

use crate::program::record::Record;
use crate::program::{Program, RecordKind, StatementId};
use crate::write::statement_syntax;

/// A statement at which the machine stands: STOP, OPSTOP or DELAY.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct MachineWait {
    pub statement: StatementId,
    /// How long, where the statement says so.
    pub dwell: Option<DwellTime>,
}

/// The time of a DELAY.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum DwellTime {
    Seconds(f64),
    Revolutions(f64),
}

/// Returns the waits of a program in their order.
pub(super) fn find_machine_waits(program: &Program) -> Vec<MachineWait> {
    let others = program.live_statements_of(&[RecordKind::Other]);
    let known = others.filter(|(_, statement)| matches!(statement.record(), Record::Known | Record::Other));
    known
        .filter_map(|(id, _)| {
            let syntax = statement_syntax(program, id);
            match syntax.major_word().as_ref() {
                "STOP" | "OPSTOP" => Some(MachineWait { statement: id, dwell: None }),
                "DELAY" => {
                    let words = (0..syntax.fields.len()).filter_map(|field| syntax.word_at(field));
                    let by_turns = words.into_iter().any(|word| word == "REV");
                    let number = syntax.numbers().first().map(|(_, number)| *number);
                    let number = number.filter(|number| number.is_finite() && *number >= 0.0);
                    let dwell = number.map(match by_turns {
                        true => DwellTime::Revolutions,
                        false => DwellTime::Seconds,
                    });
                    Some(MachineWait { statement: id, dwell })
                }
                _ => None,
            }
        })
        .collect()
}

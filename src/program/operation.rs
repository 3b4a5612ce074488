//! Operations: how a program is divided.
//!
//! NX `TOOL PATH/`..`END-OF-PATH`, CATIA `$$ OPERATION NAME :`, Creo `FEATNO`..`END`, CLT `OPFEATSTART`..`OPFEATEND`; one
//! unnamed operation where the file marks none. Statements before the first mark belong to the first operation.

use super::{Program, Record, Statement};
use std::ops::Range;

/// One operation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Operation {
    /// Its name, empty where the file has none. Bytes that are no UTF-8 stand as Latin-1.
    pub name: String,
    /// The statement that starts it.
    pub start: usize,
    /// Its statements.
    pub statements: Range<usize>,
    /// Whether an end mark closed it.
    pub closed: bool,
}

/// The operations of a program, in order, without gaps. Never empty.
pub fn find_operations(program: &Program) -> Vec<Operation> {
    let end = program.statements().len();
    let mut found: Vec<Operation> = Vec::new();
    for (index, statement) in program.live_statements() {
        match statement.record() {
            Record::OperationStart(_) => {
                if let Some(last) = found.last_mut() {
                    last.statements.end = index;
                }
                let name = operation_name(program, statement).unwrap_or_default();
                found.push(Operation { name, start: index, statements: index..end, closed: false });
            }
            Record::OperationEnd => {
                if let Some(last) = found.last_mut() {
                    last.closed = true;
                }
            }
            _ => {}
        }
    }
    match found.first_mut() {
        Some(first) => first.statements.start = 0,
        None => found.push(Operation { name: String::new(), start: 0, statements: 0..end, closed: true }),
    }
    found
}

/// The name in an operation's start statement.
pub fn operation_name(program: &Program, statement: &Statement) -> Option<String> {
    let Record::OperationStart(names) = statement.record() else { return None };
    program.statement_text(statement).get((*names.name).clone()).map(decode_text)
}

/// The tool's name in an operation's start statement (NX).
pub fn tool_name(program: &Program, statement: &Statement) -> Option<String> {
    let Record::OperationStart(names) = statement.record() else { return None };
    names.tool.as_deref().and_then(|at| program.statement_text(statement).get(at.clone())).map(decode_text)
}

/// UTF-8 where it is, else Latin-1: every byte a character, none lost.
pub fn decode_text(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    }
}

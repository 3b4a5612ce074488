//! This module divides a program into operations.
//!
//! Operations are marked by NX `TOOL PATH/`..`END-OF-PATH`, CATIA `$$ OPERATION NAME :`, Creo `FEATNO`..`END`
//! and CLT `OPFEATSTART`..`OPFEATEND`. A file without marks has one unnamed operation. Statements before the
//! first mark belong to the first operation.

use super::{Program, Record, Statement};
use std::ops::Range;

/// One operation.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Operation {
    /// The name, empty if the file has none. Bytes that are not UTF-8 are read as Latin-1.
    pub name: String,
    /// The index of the statement that starts it.
    pub start: usize,
    /// The indices of its statements.
    pub statements: Range<usize>,
    /// Whether an end mark closed it.
    pub closed: bool,
}

/// Finds the operations of a program, in order and without gaps. There is always at least one.
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

/// Returns the name in the start statement of an operation.
pub fn operation_name(program: &Program, statement: &Statement) -> Option<String> {
    let Record::OperationStart(names) = statement.record() else { return None };
    program.statement_text(statement).get((*names.name).clone()).map(decode_text)
}

/// Returns the name of the tool in the start statement of an operation (NX).
pub fn tool_name(program: &Program, statement: &Statement) -> Option<String> {
    let Record::OperationStart(names) = statement.record() else { return None };
    names.tool.as_deref().and_then(|at| program.statement_text(statement).get(at.clone())).map(decode_text)
}

/// Reads bytes as UTF-8 or, if they are not, as Latin-1, in which every byte is a character.
pub fn decode_text(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    }
}

//! This module divides a program into operations.
//!
//! Operations are marked by NX `TOOL PATH/`..`END-OF-PATH`, CATIA `$$ OPERATION NAME :`, Creo `FEATNO`..`END`
//! and CLT `OPFEATSTART`..`OPFEATEND`. A file without marks has one unnamed operation. Statements before the
//! first mark belong to the first operation.

use super::{InsertionPoint, Program, Record, RecordKind, Statement, StatementId, StatementRange};

/// One operation.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub struct Operation {
    /// The name, empty if the file has none. Bytes that are not UTF-8 are read as Latin-1.
    pub name: String,
    /// The statement that starts it, or `None` if the file marks no operation.
    pub start: Option<StatementId>,
    /// Its statements including deleted ones, or `None` in a program without statements.
    pub statements: Option<StatementRange>,
    /// Whether an end mark closed it.
    pub closed: bool,
}

impl Operation {
    /// Returns whether a statement belongs to it.
    pub fn contains(&self, id: StatementId) -> bool {
        self.statements.is_some_and(|statements| statements.contains(id))
    }
}

/// Finds the operations of a program, in order and without gaps. There is always at least one.
///
/// ```
/// use clsmith::parse::parse;
/// use clsmith::program::operation::find_operations;
/// use clsmith::source::Source;
///
/// let text = b"TOOL PATH/ROUGH,TOOL,T1\nGOTO/0,0,0\nEND-OF-PATH\n\
///     TOOL PATH/FINISH,TOOL,T2\nGOTO/1,0,0\nEND-OF-PATH\n";
/// let program = parse(&Source::new("part.cls", text.to_vec())?, None).program;
/// let operations = find_operations(&program);
/// let names: Vec<&str> = operations.iter().map(|operation| operation.name.as_str()).collect();
/// assert!(names.ends_with(&["ROUGH", "FINISH"]));
/// # Ok::<(), clsmith::source::SourceTooLarge>(())
/// ```
pub fn find_operations(program: &Program) -> Vec<Operation> {
    let mut found: Vec<Operation> = Vec::new();
    for (id, statement) in program.live_statements_of(&[RecordKind::Structure]) {
        match statement.record() {
            Record::OperationStart(_) => {
                let name = operation_name(program, statement).unwrap_or_default();
                found.push(Operation { name, start: Some(id), statements: None, closed: false });
            }
            Record::OperationEnd => {
                if let Some(last) = found.last_mut() {
                    last.closed = true;
                }
            }
            _ => {}
        }
    }
    if found.is_empty() {
        found.push(Operation { name: String::new(), start: None, statements: None, closed: true });
    }
    set_operation_statements(program, &mut found);
    found
}

/// Gives each operation the statements from its start to that of the next one. The first operation also gets
/// the statements before it.
fn set_operation_statements(program: &Program, operations: &mut [Operation]) {
    let mut next = program.end();
    let last_before = |at: InsertionPoint| {
        let index = at.index().checked_sub(1)?;
        Some(StatementId::new(index, program.stamp))
    };
    for (number, operation) in operations.iter_mut().enumerate().rev() {
        let first = operation.start.filter(|_| number > 0).map_or(program.start(), StatementId::before);
        operation.statements = program
            .statement_behind(first)
            .zip(last_before(next))
            .map(|(first, last)| StatementRange::new(first, last));
        next = first;
    }
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
pub(crate) fn decode_text(bytes: &[u8]) -> String {
    match std::str::from_utf8(bytes) {
        Ok(text) => text.to_owned(),
        Err(_) => bytes.iter().map(|&byte| char::from(byte)).collect(),
    }
}

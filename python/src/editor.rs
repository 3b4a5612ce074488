//! Edits of a program, statement by statement.

use crate::finding::to_exception;
use crate::program::Program;
use clsmith::diagnostic::Failure;
use clsmith::program::{StatementId, StepId};
use clsmith::write::ProgramEditor;
use pyo3::exceptions::{PyIndexError, PyRuntimeError};
use pyo3::prelude::*;
use std::collections::BTreeMap;
use std::sync::{Mutex, PoisonError};

/// Edits of a program. Statements are given by their indices in the program from which `edit()` was called, throughout.
#[pyclass(frozen, module = "clsmith")]
pub(crate) struct Editor {
    /// `None` once it has finished.
    open: Mutex<Option<(ProgramEditor, Vec<StatementId>)>>,
}

impl Editor {
    pub(crate) fn new(program: clsmith::Program) -> Self {
        let ids = program.statement_ids().collect();
        Self { open: Mutex::new(Some((ProgramEditor::new(program, StepId(0)), ids))) }
    }

    fn change(
        &self,
        py: Python<'_>,
        statement: usize,
        change: impl FnOnce(&mut ProgramEditor, StatementId) -> Result<(), Failure>,
    ) -> PyResult<()> {
        let mut open = self.open.lock().unwrap_or_else(PoisonError::into_inner);
        let Some((editor, ids)) = open.as_mut() else { return Err(already_finished()) };
        let id = ids.get(statement).copied();
        let id = id.ok_or_else(|| PyIndexError::new_err(format!("there is no statement {statement}")))?;
        change(editor, id).map_err(|failure| to_exception(py, &failure))
    }
}

fn already_finished() -> PyErr {
    PyRuntimeError::new_err("these edits are finished; call edit() of the new program for more")
}

#[pymethods]
impl Editor {
    /// Gives numbers of a statement new values: index of the number among those of the statement, value. Each is printed
    /// as its neighbours are.
    fn set_numbers(&self, py: Python<'_>, statement: usize, numbers: BTreeMap<usize, f64>) -> PyResult<()> {
        let numbers: Vec<(usize, f64)> = numbers.into_iter().collect();
        self.change(py, statement, |editor, id| editor.set_numbers(id, &numbers))
    }

    /// Gives a statement another text, with its line end.
    fn set_text(&self, py: Python<'_>, statement: usize, text: &[u8]) -> PyResult<()> {
        self.change(py, statement, |editor, id| editor.set_text(id, text))
    }

    /// Inserts a statement before another one.
    fn insert_before(&self, py: Python<'_>, statement: usize, text: &[u8]) -> PyResult<()> {
        self.change(py, statement, |editor, id| editor.insert_before(id, text))
    }

    /// Inserts a statement after another one.
    fn insert_after(&self, py: Python<'_>, statement: usize, text: &[u8]) -> PyResult<()> {
        self.change(py, statement, |editor, id| editor.insert_after(id, text))
    }

    /// Deletes a statement.
    fn delete(&self, py: Python<'_>, statement: usize) -> PyResult<()> {
        self.change(py, statement, |editor, id| editor.delete_statement(id))
    }

    /// Ends the edits and returns the edited program.
    fn finish(&self, py: Python<'_>) -> PyResult<Program> {
        let taken = self.open.lock().unwrap_or_else(PoisonError::into_inner).take();
        let Some((editor, _)) = taken else { return Err(already_finished()) };
        let program = editor.finish().map_err(|failure| to_exception(py, &failure))?;
        Ok(Program::corrected(program))
    }
}

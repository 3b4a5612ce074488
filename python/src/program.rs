//! Programs: reading, statements, motions, writing.

use crate::editor::Editor;
use crate::files::GivenText;
use crate::finding::{Finding, to_exception};
use crate::motions::Motions;
use crate::recipe::{SharedProgram, read_dialect, read_setup};
use clsmith::check::{check_program, read_and_check_with_vocabulary};
use clsmith::diagnostic::{Diagnostic, Failure, codes};
use clsmith::output_files::write_atomically;
use clsmith::parse::parse_with_vocabulary;
use clsmith::program::Dialect;
use clsmith::program::operation::find_operations;
use clsmith::report::stats::ResolvedLengthUnit;
use clsmith::setup::Setup;
use clsmith::source::Source;
use pyo3::exceptions::{PyIndexError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use std::path::PathBuf;
use std::sync::Arc;

/// A program. It never changes: edits and recipes make another one.
#[pyclass(frozen, module = "clsmith")]
pub(crate) struct Program {
    program: SharedProgram,
    /// What reading found; `None` for one that was made of another.
    of_reading: Option<Vec<Diagnostic>>,
    refused: bool,
    /// The dialect that the caller forced.
    forced: Option<Dialect>,
}

/// Reads a program from a path or from bytes. What cannot be read is kept, and told in `findings`; `check()` tells all that
/// `clsmith check` does. `dialect` forces a dialect; `setup` gives the words of the shop's own post.
#[pyfunction]
#[pyo3(signature = (source, *, name=None, dialect=None, setup=None))]
pub(crate) fn read(
    py: Python<'_>,
    source: &Bound<'_, PyAny>,
    name: Option<String>,
    dialect: Option<&str>,
    setup: Option<&Bound<'_, PyAny>>,
) -> PyResult<Program> {
    let given = GivenText::program(source, name)?;
    let dialect = read_dialect(dialect)?;
    let setup = setup.map(|setup| GivenText::yaml(setup, "setup")).transpose()?;
    let read = py.detach(|| -> Result<Program, Failure> {
        let setup = setup.map_or_else(|| Ok(Setup::default()), read_setup)?;
        Ok(Program::parse(&given.read()?, dialect, &setup))
    });
    read.map_err(|failure| to_exception(py, &failure))
}

impl Program {
    fn parse(source: &Arc<Source>, dialect: Option<Dialect>, setup: &Setup) -> Self {
        let parsed = parse_with_vocabulary(source, dialect, &setup.vocabulary);
        Self {
            program: Arc::new(parsed.program),
            of_reading: Some(parsed.diagnostics),
            refused: parsed.refused,
            forced: dialect,
        }
    }

    /// Takes a program that was made of another one.
    pub(crate) fn corrected(program: clsmith::Program) -> Self {
        Self { program: Arc::new(program), of_reading: None, refused: false, forced: None }
    }

    /// Takes what a function got: a program, or what `read` takes.
    pub(crate) fn from_argument(given: &Bound<'_, PyAny>) -> PyResult<ProgramArgument> {
        match given.cast::<Self>() {
            Ok(program) => {
                let program = program.get();
                Ok(ProgramArgument::Read(Arc::clone(&program.program), program.forced))
            }
            Err(_) => Ok(ProgramArgument::Given(GivenText::program(given, None)?)),
        }
    }

    pub(crate) fn name(&self) -> &str {
        self.program.source().name()
    }
}

/// A program as a function got it.
pub(crate) enum ProgramArgument {
    Read(SharedProgram, Option<Dialect>),
    Given(GivenText),
}

impl ProgramArgument {
    pub(crate) fn name(&self) -> String {
        match self {
            Self::Read(program, _) => program.source().name().to_owned(),
            Self::Given(given) => given.name(),
        }
    }

    /// Returns the text, and the dialect if it was forced. An edited program is what its text says.
    pub(crate) fn read_source(self) -> Result<(Arc<Source>, Option<Dialect>), Failure> {
        match self {
            Self::Given(given) => Ok((given.read()?, None)),
            Self::Read(program, forced) => {
                let bytes = program.to_bytes();
                if bytes == program.source().bytes() {
                    return Ok((Arc::clone(program.source()), forced));
                }
                let source = Source::new(program.source().name(), bytes);
                let too_large = |error: clsmith::source::SourceTooLarge| {
                    Diagnostic::new(codes::TOO_LARGE, error.to_string())
                };
                Ok((source.map_err(too_large)?, forced))
            }
        }
    }

    /// Returns the program for a run that measures it; what cannot be read of it stops the run.
    pub(crate) fn read_program(self, setup: &Setup) -> Result<SharedProgram, Failure> {
        let (source, dialect) = self.read_source()?;
        let parsed = parse_with_vocabulary(&source, dialect, &setup.vocabulary);
        if parsed.diagnostics.iter().any(Diagnostic::is_error) {
            return Err(parsed.diagnostics.into());
        }
        Ok(Arc::new(parsed.program))
    }
}

#[pymethods]
impl Program {
    /// The name of its file.
    #[getter(name)]
    fn file_name(&self) -> &str {
        self.name()
    }

    /// Its dialect, as `--dialect` names it.
    #[getter]
    fn dialect(&self) -> &'static str {
        self.program.dialect().name()
    }

    /// The unit of its lengths, `mm` or `inch`.
    #[getter]
    fn units(&self) -> &'static str {
        match ResolvedLengthUnit::from_program(&self.program, None).unit {
            clsmith::LengthUnit::Mm => "mm",
            clsmith::LengthUnit::Inch => "inch",
        }
    }

    /// What could not be read, or was read with a doubt; of a program that was made of another one, nothing.
    #[getter]
    fn findings(&self) -> Vec<Finding> {
        Finding::list(self.of_reading.as_deref().unwrap_or_default())
    }

    /// The names of its operations, in order.
    #[getter]
    fn operations(&self) -> Vec<String> {
        find_operations(&self.program).into_iter().map(|operation| operation.name).collect()
    }

    /// Checks it, as `clsmith check` does, and returns all findings. Their places are in the file that was read; those of a
    /// program that was made of another one are in its own text.
    fn check(&self, py: Python<'_>) -> Vec<Finding> {
        let found = py.detach(|| match &self.of_reading {
            Some(of_reading) => {
                let mut found = of_reading.clone();
                if !self.refused {
                    let unread = found.iter().any(Diagnostic::is_error);
                    // Motions that could not be read are no missing motions.
                    let checks = check_program(&self.program).into_iter();
                    found.extend(checks.filter(|one| !(unread && one.code == codes::NO_MOTION)));
                }
                found
            }
            // One that was made of another one is what its text says.
            None => match Source::new(self.name(), self.program.to_bytes()) {
                Ok(source) => {
                    let (dialect, words) = (Some(self.program.dialect()), self.program.vocabulary());
                    read_and_check_with_vocabulary(&source, dialect, words).1
                }
                Err(error) => vec![Diagnostic::new(codes::TOO_LARGE, error.to_string())],
            },
        });
        Finding::list(&found)
    }

    /// Its motions as arrays.
    fn motions(&self, py: Python<'_>) -> PyResult<Motions> {
        Motions::collect(py, &self.program)
    }

    /// The text of a statement as it stands, by its index.
    fn text<'py>(&self, py: Python<'py>, statement: usize) -> PyResult<Bound<'py, PyBytes>> {
        let found = self.program.statements().get(statement);
        let found =
            found.ok_or_else(|| PyIndexError::new_err(format!("there is no statement {statement}")))?;
        Ok(PyBytes::new(py, self.program.statement_text(found)))
    }

    /// The indices of its statements, without deleted ones.
    fn statements(&self) -> Vec<usize> {
        self.program.live_statements().map(|(id, _)| id.index()).collect()
    }

    /// The index of the statement of a line of the file that was read, from 1.
    fn statement_at(&self, line: usize) -> PyResult<usize> {
        let span = self.program.source().line_span(line);
        let found = span.and_then(|span| self.program.statement_at_offset(span.start));
        let found = found.ok_or_else(|| PyValueError::new_err(format!("there is no line {line}")))?;
        Ok(found.index())
    }

    /// Begins edits. `finish()` of what it returns makes the edited program.
    fn edit(&self) -> Editor {
        Editor::new((*self.program).clone())
    }

    /// Its bytes: what was not changed stands as it was.
    fn to_bytes<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        let bytes = py.detach(|| self.program.to_bytes());
        PyBytes::new(py, &bytes)
    }

    /// Writes it. The file appears whole or not at all.
    fn write(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        py.detach(|| {
            write_atomically(&path, |out| {
                self.program.byte_chunks().try_for_each(|chunk| out.write_all(chunk))
            })
        })?;
        Ok(())
    }

    fn __len__(&self) -> usize {
        self.program.statements().len()
    }

    fn __repr__(&self) -> String {
        format!("<Program {}, {}, {} statements>", self.name(), self.program.dialect().name(), self.__len__())
    }
}

//! Findings as objects, and failures as exceptions.

use clsmith::diagnostic::{Diagnostic, DiagnosticLabel, Failure};
use clsmith::report::render::line::render_lines;
use pyo3::exceptions::PyKeyboardInterrupt;
use pyo3::prelude::*;

/// A place in a file.
#[pyclass(frozen, get_all, module = "clsmith")]
#[derive(Clone)]
pub(crate) struct Place {
    /// The name of the file.
    file: String,
    /// The line, from 1.
    line: usize,
    /// The column in bytes, from 1.
    column: usize,
    /// The bytes, from and behind.
    span: (u32, u32),
    /// A text about the place; it may be empty.
    message: String,
}

impl Place {
    fn from_label(label: &DiagnosticLabel) -> Self {
        let (line, column) = label.source.line_column(label.span.start);
        let span = (label.span.start, label.span.end);
        Self { file: label.source.name().to_owned(), line, column, span, message: label.message.clone() }
    }
}

#[pymethods]
impl Place {
    fn __repr__(&self) -> String {
        format!("<Place {}:{}:{}>", self.file, self.line, self.column)
    }
}

/// Something that was found in a program, a recipe or a setup.
#[pyclass(frozen, get_all, module = "clsmith")]
#[derive(Clone)]
pub(crate) struct Finding {
    /// The code, `CL0003`.
    code: &'static str,
    /// `error`, `warning` or `note`.
    severity: String,
    /// A sentence about this finding.
    message: String,
    /// What to do about it.
    help: Option<String>,
    /// The step of the recipe that found it, from 1.
    step: Option<usize>,
    /// Whether `allow` named its code.
    allowed: bool,
    /// Its places; the first one is the primary one.
    places: Vec<Place>,
    /// As `clsmith check --format line` prints it.
    text: String,
}

impl Finding {
    pub(crate) fn from_diagnostic(found: &Diagnostic) -> Self {
        let mut line = Vec::new();
        // Writing into memory does not fail.
        let printed = render_lines(&mut line, std::slice::from_ref(found), None);
        debug_assert!(printed.is_ok(), "{printed:?}");
        Self {
            code: found.code.id(),
            severity: found.severity.to_string(),
            message: found.message.clone(),
            help: found.help.clone(),
            step: found.step,
            allowed: found.is_allowed,
            places: found.labels.iter().map(Place::from_label).collect(),
            text: String::from_utf8_lossy(&line).trim_end().to_owned(),
        }
    }

    pub(crate) fn list(found: &[Diagnostic]) -> Vec<Self> {
        found.iter().map(Self::from_diagnostic).collect()
    }

    fn place(&self) -> Option<&Place> {
        self.places.first()
    }
}

#[pymethods]
impl Finding {
    /// The file of its first place.
    #[getter]
    fn file(&self) -> Option<&str> {
        self.place().map(|place| place.file.as_str())
    }

    /// The line of its first place, from 1.
    #[getter]
    fn line(&self) -> Option<usize> {
        self.place().map(|place| place.line)
    }

    /// The column of its first place in bytes, from 1.
    #[getter]
    fn column(&self) -> Option<usize> {
        self.place().map(|place| place.column)
    }

    /// The bytes of its first place, from and behind.
    #[getter]
    fn span(&self) -> Option<(u32, u32)> {
        self.place().map(|place| place.span)
    }

    fn __str__(&self) -> &str {
        &self.text
    }

    fn __repr__(&self) -> String {
        format!("<Finding {}>", self.text)
    }
}

/// Makes the exception of a failure: `KeyboardInterrupt` where it was stopped, else `ClsmithError` with all findings.
pub(crate) fn to_exception(py: Python<'_>, failure: &Failure) -> PyErr {
    match failure {
        Failure::Interrupted => PyKeyboardInterrupt::new_err(()),
        Failure::Found(found) => findings_to_exception(py, found),
    }
}

/// Makes `ClsmithError` of findings.
pub(crate) fn findings_to_exception(py: Python<'_>, found: &[Diagnostic]) -> PyErr {
    let raised = py
        .import("clsmith._errors")
        .and_then(|errors| errors.getattr("ClsmithError"))
        .and_then(|class| class.call1((Finding::list(found),)));
    raised.map_or_else(|error| error, PyErr::from_value)
}

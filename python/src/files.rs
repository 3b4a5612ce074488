//! Programs, recipes and setups as Python gives them: paths, bytes, text or dicts.

use clsmith::diagnostic::{Diagnostic, Failure, codes};
use clsmith::source::{LARGEST_STREAM_BYTES, Source, SourceReadError, SourceTooLarge, read_file_or_pipe};
use pyo3::exceptions::PyTypeError;
use pyo3::prelude::*;
use pyo3::types::{PyBytes, PyDict, PyString};
use std::path::{Path, PathBuf};
use std::sync::Arc;

/// A text that Python gave.
pub(crate) enum GivenText {
    /// A file to read.
    File(PathBuf),
    /// Its bytes, and the name that findings have for it.
    Bytes { name: String, bytes: Vec<u8> },
}

impl GivenText {
    /// Takes a program: bytes, or a path.
    pub(crate) fn program(given: &Bound<'_, PyAny>, name: Option<String>) -> PyResult<Self> {
        if let Ok(bytes) = given.cast::<PyBytes>() {
            return Ok(Self::Bytes {
                name: name.unwrap_or_else(|| "program".to_owned()),
                bytes: bytes.as_bytes().to_vec(),
            });
        }
        if name.is_some() {
            return Err(PyTypeError::new_err("`name` is for bytes; a file has its own"));
        }
        let path = given.extract::<PathBuf>();
        path.map(Self::File).map_err(|_| PyTypeError::new_err("a program is given as a path or as bytes"))
    }

    /// Takes a recipe or a setup, `what`: a dict, YAML text (of two lines or more), or a path. YAML has JSON in it.
    pub(crate) fn yaml(given: &Bound<'_, PyAny>, what: &str) -> PyResult<Self> {
        let name = what.to_owned();
        if given.is_instance_of::<PyDict>() {
            let json = given.py().import("json")?;
            let options = PyDict::new(given.py());
            options.set_item("indent", 1)?;
            options.set_item("allow_nan", false)?;
            options.set_item("ensure_ascii", false)?;
            let text: String = json.call_method("dumps", (given,), Some(&options))?.extract()?;
            return Ok(Self::Bytes { name, bytes: text.into_bytes() });
        }
        if let Ok(text) = given.cast::<PyString>() {
            let text = text.to_str()?;
            if text.contains('\n') {
                return Ok(Self::Bytes { name, bytes: text.as_bytes().to_vec() });
            }
        }
        given.extract::<PathBuf>().map(Self::File).map_err(|_| {
            PyTypeError::new_err(format!(
                "a {what} is given as a dict, as YAML text with line ends, or as a path"
            ))
        })
    }

    /// The folder from which a recipe names files; that of the process for text and dicts.
    pub(crate) fn folder(&self) -> &Path {
        match self {
            Self::File(path) => path.parent().unwrap_or(Path::new("")),
            Self::Bytes { .. } => Path::new(""),
        }
    }

    /// The name that findings have for it.
    pub(crate) fn name(&self) -> String {
        match self {
            Self::File(path) => path.to_string_lossy().into_owned(),
            Self::Bytes { name, .. } => name.clone(),
        }
    }

    /// Reads it.
    pub(crate) fn read(self) -> Result<Arc<Source>, Failure> {
        let (name, bytes) = match self {
            Self::File(path) => return Ok(read_source(&path).map_err(|error| to_finding(&error))?),
            Self::Bytes { name, bytes } => (name, bytes),
        };
        Ok(Source::new(name, bytes).map_err(|error| Diagnostic::new(codes::TOO_LARGE, error.to_string()))?)
    }
}

fn to_finding(error: &SourceReadError) -> Diagnostic {
    let code = match error {
        SourceReadError::Unreadable { .. } => codes::UNREADABLE,
        SourceReadError::TooLarge(_) => codes::TOO_LARGE,
    };
    Diagnostic::new(code, error.to_string())
}

/// Reads a file, also one that a recipe or a setup names.
pub(crate) fn read_source(path: &Path) -> Result<Arc<Source>, SourceReadError> {
    let name = path.to_string_lossy().into_owned();
    let bytes = read_file_or_pipe(path, LARGEST_STREAM_BYTES).map_err(|error| {
        match error.get_ref().and_then(|inner| inner.downcast_ref::<SourceTooLarge>()) {
            Some(too_large) => SourceReadError::TooLarge(*too_large),
            None => SourceReadError::Unreadable { name: name.clone(), error },
        }
    })?;
    Ok(Source::new(name, bytes)?)
}

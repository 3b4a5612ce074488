//! Arrays of numpy that take over the memory of a list, so that no element is copied.

use numpy::{Element, IntoPyArray, PyArray1, PyArray2, PyArrayMethods};
use pyo3::prelude::*;

/// A column of values.
pub(crate) fn column<T: Element>(py: Python<'_>, values: Vec<T>) -> Py<PyArray1<T>> {
    values.into_pyarray(py).unbind()
}

/// Rows of `width` values each, which stand one after the other.
///
/// # Errors
/// Returns an error if the values do not fill the last row.
pub(crate) fn rows<T: Element>(py: Python<'_>, values: Vec<T>, width: usize) -> PyResult<Py<PyArray2<T>>> {
    let count = values.len() / width.max(1);
    Ok(values.into_pyarray(py).reshape([count, width])?.unbind())
}

/// Rows of three values each.
///
/// # Errors
/// Returns an error if numpy does not take the shape.
pub(crate) fn rows_of_three(py: Python<'_>, values: Vec<[f64; 3]>) -> PyResult<Py<PyArray2<f64>>> {
    rows(py, values.into_flattened(), 3)
}

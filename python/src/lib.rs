//! The extension module of the Python package `clsmith`: programs, motions and loads as arrays, findings as objects.
//!
//! What is computed stands in the library; here values are handed over. Long work runs without the interpreter's lock, on a
//! thread of its own, while the calling thread looks for Ctrl-C and calls back.

mod background;
mod columns;
mod editor;
mod engagement;
mod files;
mod finding;
mod motions;
mod program;
mod recipe;
mod simulation;

use pyo3::prelude::*;

/// The extension module; `clsmith/__init__.py` shows what is in it.
#[pymodule]
fn _clsmith(module: &Bound<'_, PyModule>) -> PyResult<()> {
    module.add("__version__", env!("CARGO_PKG_VERSION"))?;
    module.add("KINDS", pyo3::types::PyTuple::new(module.py(), motions::kind_names())?)?;
    module.add_class::<finding::Finding>()?;
    module.add_class::<finding::Place>()?;
    module.add_class::<program::Program>()?;
    module.add_class::<motions::Motions>()?;
    module.add_class::<editor::Editor>()?;
    module.add_class::<recipe::Correction>()?;
    module.add_class::<simulation::Simulation>()?;
    module.add_class::<engagement::Engagement>()?;
    module.add_function(wrap_pyfunction!(program::read, module)?)?;
    module.add_function(wrap_pyfunction!(recipe::apply, module)?)?;
    module.add_function(wrap_pyfunction!(simulation::simulate, module)?)?;
    module.add_function(wrap_pyfunction!(engagement::engagement, module)?)?;
    Ok(())
}

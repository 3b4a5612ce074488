//! The simulation as arrays.

use crate::background;
use crate::columns::column;
use crate::files::GivenText;
use crate::finding::Finding;
use crate::program::Program;
use crate::recipe::read_setup;
use clsmith::Machining;
use clsmith::diagnostic::Diagnostic;
use clsmith::report::simulation::{ColumnValues, SimulationReport};
use clsmith::report::stats::ResolvedLengthUnit;
use clsmith::simulation_run::{KnownShares, SimulationRunOptions};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// A simulation of a program on its stock.
#[pyclass(frozen, module = "clsmith")]
pub(crate) struct Simulation {
    columns: Py<PyDict>,
    /// What was found: collisions, rapids through material, assumptions.
    #[pyo3(get)]
    findings: Vec<Finding>,
    /// The volumes of the stock before, of what was removed, and of what is left, mm3.
    #[pyo3(get)]
    volumes_mm3: (f64, f64, f64),
    /// The distance of columns, mm.
    #[pyo3(get)]
    cell_mm: f64,
    /// The numbers of collisions, rapids through material, and cuts with a standing spindle.
    #[pyo3(get)]
    faults: (usize, usize, usize),
}

#[pymethods]
impl Simulation {
    /// The columns of `clsmith simulate --csv` under their names: arrays of numbers (NaN where a value is not known) and lists
    /// of names. `pandas.DataFrame(simulation.columns)` and `polars.DataFrame(simulation.columns)` take it.
    #[getter]
    fn columns<'py>(&self, py: Python<'py>) -> Bound<'py, PyDict> {
        self.columns.bind(py).clone()
    }

    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        self.columns.bind(py).as_any().get_item(name)
    }
}

/// Simulates a program, as `clsmith simulate` does. `cell_mm` is the distance of columns, `certified` whether thickest chips are
/// proved from the motions, which takes longer. Collisions are findings, and no exceptions.
#[pyfunction]
#[pyo3(signature = (program, setup, *, cell_mm=None, certified=true, progress=None))]
pub(crate) fn simulate(
    py: Python<'_>,
    program: &Bound<'_, PyAny>,
    setup: &Bound<'_, PyAny>,
    cell_mm: Option<f64>,
    certified: bool,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Simulation> {
    check_cell(cell_mm)?;
    let program = Program::from_argument(program)?;
    let setup = GivenText::yaml(setup, "setup")?;
    let file = program.name();
    let (report, columns, found) = background::run(py, &file, progress, |watch| {
        let setup = read_setup(setup)?;
        let program = program.read_program(&setup)?;
        let units = ResolvedLengthUnit::from_program(&program, None).unit;
        let mut found: Vec<Diagnostic> = Vec::new();
        let machining = Machining::new(&program, &setup, units, &mut found)?;
        let options = SimulationRunOptions::default().with_cell_mm(cell_mm);
        let mut report = SimulationReport::simulate_program(&machining, &options, watch)?;
        if certified {
            report.certify_chips(&machining, &KnownShares::default(), watch)?;
        }
        found.append(&mut report.findings);
        let columns = report.to_column_arrays();
        Ok((report, columns, found))
    })?;
    let dict = PyDict::new(py);
    for one in columns {
        match one.values {
            ColumnValues::Numbers(numbers) => dict.set_item(one.name, column(py, numbers))?,
            ColumnValues::Texts(texts) => dict.set_item(one.name, texts)?,
        }
    }
    let stock = report.stock;
    Ok(Simulation {
        columns: dict.unbind(),
        findings: Finding::list(&found),
        volumes_mm3: (stock.before_mm3, stock.removed_mm3, stock.left_mm3),
        cell_mm: report.accuracy.cell_mm,
        faults: (report.faults.collisions, report.faults.rapids_in_material, report.faults.spindle_stands),
    })
}

/// A distance of columns is above 0.
pub(crate) fn check_cell(cell_mm: Option<f64>) -> PyResult<()> {
    match cell_mm {
        Some(cell_mm) if !(cell_mm > 0.0 && cell_mm.is_finite()) => {
            Err(pyo3::exceptions::PyValueError::new_err("cell_mm must be a number above 0"))
        }
        _ => Ok(()),
    }
}

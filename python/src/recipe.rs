//! Programs through recipes.

use crate::background;
use crate::files::{GivenText, read_source};
use crate::finding::{Finding, findings_to_exception};
use crate::program::Program;
use clsmith::diagnostic::Failure;
use clsmith::job::{CorrectionJob, JobOutcome};
use clsmith::program::Dialect;
use clsmith::report::finding_policy::FindingPolicy;
use clsmith::setup::Setup;
use clsmith::transform::Recipe;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use std::sync::Arc;

/// What a recipe made of a program.
#[pyclass(frozen, module = "clsmith")]
pub(crate) struct Correction {
    /// The corrected program.
    #[pyo3(get)]
    program: Py<Program>,
    /// What was found, worst for the machine and mere notes.
    #[pyo3(get)]
    findings: Vec<Finding>,
    /// What steps tell of themselves, as JSON.
    reports: String,
}

#[pymethods]
impl Correction {
    /// What steps tell of themselves: a list of dicts, `{name of the step: its report}`.
    #[getter]
    fn reports<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        py.import("json")?.call_method1("loads", (&self.reports,))
    }

    fn __repr__(&self) -> String {
        format!("<Correction of {}, {} findings>", self.program.get().name(), self.findings.len())
    }
}

/// Corrects a program by a recipe, as `clsmith apply` does: the program is checked before and after, and simulated where the
/// setup has a stock. Raises `ClsmithError` with all findings if one of them is an error, so no program comes of a mistake.
#[pyfunction]
#[pyo3(
    signature = (program, recipe, *, setup=None, allow=Vec::new(), deny=Vec::new(), notes=false, progress=None),
    text_signature = "(program, recipe, *, setup=None, allow=(), deny=(), notes=False, progress=None)"
)]
#[allow(clippy::too_many_arguments)] // They are the keywords that Python's users see.
pub(crate) fn apply(
    py: Python<'_>,
    program: &Bound<'_, PyAny>,
    recipe: &Bound<'_, PyAny>,
    setup: Option<&Bound<'_, PyAny>>,
    allow: Vec<String>,
    deny: Vec<String>,
    notes: bool,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Correction> {
    let program = Program::from_argument(program)?;
    let recipe = GivenText::yaml(recipe, "recipe")?;
    let setup = setup.map(|setup| GivenText::yaml(setup, "setup")).transpose()?;
    let (deny, allow) = (deny.iter().map(String::as_str), allow.iter().map(String::as_str));
    let policy = FindingPolicy::from_code_lists(deny, allow, notes)
        .map_err(|error| PyValueError::new_err(error.to_string()))?;
    let file = program.name();
    let outcome = background::run(py, &file, progress, |watch| {
        let (source, dialect) = program.read_source()?;
        let (recipe, setup) = read_recipe(recipe, setup)?;
        CorrectionJob::new(&recipe, &setup, &policy)
            .with_dialect(dialect)
            .with_watcher(watch)
            .try_source(&source)
    })?;
    if outcome.is_refused() {
        return Err(findings_to_exception(py, &outcome.findings));
    }
    let reports: Vec<String> = outcome.reports.iter().map(|report| to_json(report.as_ref())).collect();
    let JobOutcome { program, findings, .. } = outcome;
    let findings = Finding::list(&findings);
    let program = Py::new(py, Program::corrected(program))?;
    Ok(Correction { program, findings, reports: format!("[{}]", reports.join(",")) })
}

fn to_json(report: &dyn clsmith::transform::TransformReport) -> String {
    format!("{{{:?}:{}}}", report.step_name(), report.to_json())
}

/// Reads a recipe and the setup in force: that of the call, before that of the recipe, before the file that it names.
fn read_recipe(recipe: GivenText, setup: Option<GivenText>) -> Result<(Recipe, Setup), Failure> {
    let folder = recipe.folder().to_owned();
    let recipe = Recipe::load(&recipe.read()?)?;
    let named = recipe.load_setup_file(|name| read_source(&folder.join(name)))?;
    let given = setup.map_or_else(|| Ok(Setup::default()), |setup| Setup::load(&setup.read()?))?;
    let setup = recipe.merge_setups(named, given);
    let setup = setup.read_machine_file(read_source)?.read_material_file(read_source)?;
    Ok((recipe, setup))
}

/// Reads a setup, with the files of machine and material that it names.
pub(crate) fn read_setup(setup: GivenText) -> Result<Setup, Failure> {
    Setup::load(&setup.read()?)?.read_machine_file(read_source)?.read_material_file(read_source)
}

/// Reads the name of a dialect.
pub(crate) fn read_dialect(name: Option<&str>) -> PyResult<Option<Dialect>> {
    let Some(name) = name else { return Ok(None) };
    Dialect::from_name(name).map(Some).ok_or_else(|| {
        let names: Vec<&str> = Dialect::ALL.iter().map(|dialect| dialect.name()).collect();
        PyValueError::new_err(format!("`{name}` is no dialect; they are {}", names.join(", ")))
    })
}

/// Something that a program can be read from more than once.
pub(crate) type SharedProgram = Arc<clsmith::Program>;

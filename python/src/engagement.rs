//! What of the cutter each motion engages, as arrays.

use crate::background;
use crate::columns::{column, rows};
use crate::files::GivenText;
use crate::finding::Finding;
use crate::program::Program;
use crate::recipe::read_setup;
use crate::simulation::check_cell;
use clsmith::Machining;
use clsmith::diagnostic::Diagnostic;
use clsmith::engagement::Engagement as Engaged;
use clsmith::engagement::engagement_bins::BINS;
use clsmith::report::stats::ResolvedLengthUnit;
use clsmith::simulation_run::SimulationRunOptions;
use numpy::{PyArray1, PyArray2};
use pyo3::prelude::*;

/// Engagements, one a row for each row of `Program.motions()`.
#[pyclass(frozen, get_all, module = "clsmith")]
pub(crate) struct Engagement {
    /// Removed volumes, mm3.
    removed_mm3: Py<PyArray1<f64>>,
    /// Heights of the engaged part of the cutter along its axis, mm.
    axial_depth_mm: Py<PyArray1<f64>>,
    /// Widths of the removed material across path and tool axis, mm.
    radial_depth_mm: Py<PyArray1<f64>>,
    /// Advance ratios around the cutter, (n, 120): the speed of the surface along its normal by the feed; 0 where nothing is
    /// engaged. Column `i` covers -180 + 3 i to -180 + 3 (i + 1) degrees from the feed's direction, positive to its left.
    advance_ratio: Py<PyArray2<f32>>,
    /// Upper bounds of the advance ratios, (n, 120).
    advance_ratio_bound: Py<PyArray2<f32>>,
    /// Lowest and highest engaged lengths along the meridian from the tip, mm, (n, 120) each; NaN where nothing is engaged.
    low_mm: Py<PyArray2<f32>>,
    high_mm: Py<PyArray2<f32>>,
    /// What was found: collisions, rapids through material, assumptions.
    findings: Vec<Finding>,
}

#[derive(Default)]
struct EngagementLists {
    removed: Vec<f64>,
    axial: Vec<f64>,
    radial: Vec<f64>,
    ratio: Vec<f32>,
    bound: Vec<f32>,
    low: Vec<f32>,
    high: Vec<f32>,
}

impl EngagementLists {
    /// Adds a row; motions that stay at their place engage nothing.
    fn add(&mut self, engaged: Option<&Engaged>) {
        self.removed.push(engaged.map_or(0.0, |engaged| engaged.removed_mm3));
        self.axial.push(engaged.map_or(0.0, Engaged::axial_depth_mm));
        self.radial.push(engaged.map_or(0.0, Engaged::radial_depth_mm));
        for index in 0..BINS {
            let bin = engaged.and_then(|engaged| engaged.bins.get(index)).filter(|bin| bin.is_engaged());
            self.ratio.push(bin.map_or(0.0, |bin| bin.advance_ratio));
            self.bound.push(bin.map_or(0.0, |bin| bin.advance_ratio_bound));
            self.low.push(bin.map_or(f32::NAN, |bin| bin.low));
            self.high.push(bin.map_or(f32::NAN, |bin| bin.high));
        }
    }

    fn fill_to(&mut self, count: usize) {
        while self.removed.len() < count {
            self.add(None);
        }
    }
}

/// Removes the stock motion by motion and returns what each engages in every direction around the cutter.
#[pyfunction]
#[pyo3(signature = (program, setup, *, cell_mm=None, progress=None))]
pub(crate) fn engagement(
    py: Python<'_>,
    program: &Bound<'_, PyAny>,
    setup: &Bound<'_, PyAny>,
    cell_mm: Option<f64>,
    progress: Option<&Bound<'_, PyAny>>,
) -> PyResult<Engagement> {
    check_cell(cell_mm)?;
    let program = Program::from_argument(program)?;
    let setup = GivenText::yaml(setup, "setup")?;
    let file = program.name();
    let (lists, found) = background::run(py, &file, progress, |watch| {
        let setup = read_setup(setup)?;
        let program = program.read_program(&setup)?;
        let units = ResolvedLengthUnit::from_program(&program, None).unit;
        let mut found: Vec<Diagnostic> = Vec::new();
        let machining = Machining::new(&program, &setup, units, &mut found)?;
        // Without the detail that forces need, only contacts with the largest ratios are kept.
        let options = SimulationRunOptions::default().with_cell_mm(cell_mm).with_forces(true);
        let mut lists = EngagementLists::default();
        let result = machining.simulate_program(&options, watch, &mut |motion| {
            lists.fill_to(motion.number);
            lists.add(motion.whole_engagement().as_ref());
        })?;
        lists.fill_to(program.motions().count());
        found.extend(result.findings);
        Ok((lists, found))
    })?;
    Ok(Engagement {
        removed_mm3: column(py, lists.removed),
        axial_depth_mm: column(py, lists.axial),
        radial_depth_mm: column(py, lists.radial),
        advance_ratio: rows(py, lists.ratio, BINS)?,
        advance_ratio_bound: rows(py, lists.bound, BINS)?,
        low_mm: rows(py, lists.low, BINS)?,
        high_mm: rows(py, lists.high, BINS)?,
        findings: Finding::list(&found),
    })
}

//! The chips of a program, layer by layer: one row a motion, sums of operations, pictures.
//!
//! [`ChipReport::simulate_layers`] runs a [`Machining`] in layers and keeps what it hears; [`to_text`], [`write_csv`] and [`write_json`] present it,
//! [`draw_layers`] draws layers. Lengths are in mm, and a reader sees them in [`ChipReport::units`]. What is not known is an empty cell, `null` in JSON, and
//! one of the assumptions says why.

mod chip_collector;
mod chip_columns;
mod chip_document;
mod chip_merging;
mod chip_row;
mod chip_thickness;
mod diagram_drawing;
mod json_formatter;
mod layer_drawing;
mod move_scene;
mod panel_sheet;
mod stl_export;
mod sum_columns;
mod sums;
mod text;

pub use chip_document::{write_csv, write_json};
pub use chip_row::{ChipLayerRow, ChipRow};
pub use diagram_drawing::draw_diagrams;
pub use layer_drawing::draw_layers;
pub use move_scene::{MoveScene, MoveSceneLayer};
pub use stl_export::write_stl;
pub use sums::{ChipPeak, ChipTotals, OperationChips};
pub use text::to_text;

use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::layered_chips::stack::LayerStack;
use crate::report::table::DisplayUnits;
use crate::simulation_run::layer_run::LayerRunOptions;
use crate::simulation_run::{Machining, RunWatcher};

/// What is kept of a run besides its sums.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct ChipReportOptions {
    /// The borders of all pieces: JSON and STL need them. They take by far the most memory.
    pub borders: bool,
    /// The workpiece around so many moves that cut, for pictures; the run is slower then.
    pub scenes: usize,
    /// A height, mm: then only moves that cut on the layer there.
    pub at_z_mm: Option<f64>,
}

impl ChipReportOptions {
    /// Returns the options that keep the borders of all pieces, or not.
    #[must_use]
    pub fn with_borders(mut self, borders: bool) -> Self {
        self.borders = borders;
        self
    }

    /// Returns the options that keep the workpiece around so many moves.
    #[must_use]
    pub fn with_scenes(mut self, scenes: usize) -> Self {
        self.scenes = scenes;
        self
    }

    /// Returns the options for moves that cut on the layer at a height, mm.
    #[must_use]
    pub fn with_at_z_mm(mut self, at_z_mm: impl Into<Option<f64>>) -> Self {
        self.at_z_mm = at_z_mm.into();
        self
    }
}

/// The chips of a program.
#[derive(Debug)]
#[non_exhaustive]
pub struct ChipReport {
    /// The file's name.
    pub file: String,
    /// The units that a reader sees: those of the program, until a caller sets others. All values here are in mm.
    pub units: DisplayUnits,
    /// How it was run.
    pub options: LayerRunOptions,
    /// Sums of everything that ran.
    pub totals: ChipTotals,
    /// Sums of each operation with a motion that is asked for, in order.
    pub operations: Vec<OperationChips>,
    /// What the run took for granted, in sentences.
    pub assumptions: Vec<String>,
    /// Motions that are asked for and were not cut, or in part.
    pub skipped: Vec<UncutMotion>,
    /// The motions that are asked for and were cut, in order.
    pub rows: Vec<ChipRow>,
    /// The first moves that cut, for pictures.
    pub scenes: Vec<MoveScene>,
    /// What went wrong, with its places.
    pub findings: Vec<Diagnostic>,
    /// The workpiece that is left.
    pub left: LayerStack,
}

/// A motion that was not cut, or in part.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct UncutMotion {
    /// Its line.
    pub line: usize,
    /// Its operation.
    pub operation: String,
    /// Its tool.
    pub tool: String,
    /// Why.
    pub reason: String,
}

impl ChipReport {
    /// Runs a program over its stock in layers. `None` when `watch` stopped it.
    ///
    /// # Errors
    /// As [`Machining::simulate_layers`], and when no motion is on the lines that are asked for.
    pub fn simulate_layers(
        machining: &Machining<'_>,
        options: &LayerRunOptions,
        keep: ChipReportOptions,
        watch: &dyn RunWatcher,
    ) -> Result<Self, Failure> {
        let options =
            LayerRunOptions { one_by_one: options.one_by_one || keep.scenes > 0, ..options.clone() };
        let mut gathering = chip_collector::ChipCollector::new(machining, keep, options.tolerance_mm);
        let ran = machining.simulate_layers(&options, watch, &mut |cut| gathering.add_motion(cut))?;
        if gathering.rows.is_empty() && gathering.skipped.is_empty() {
            let (from, to) = (*options.lines.start(), *options.lines.end());
            let message = match to {
                usize::MAX => format!("no motion ends on line {from} or after it"),
                to if to == from => format!("no motion ends on line {from}"),
                to => format!("no motion ends on lines {from} to {to}"),
            };
            return Err(Diagnostic::new(codes::NO_MOTION_ASKED, message).into());
        }
        Ok(gathering.into_report(options, ran))
    }
}

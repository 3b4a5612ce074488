//! This module reports the chips of a program layer by layer: a row for each motion, sums of operations, and
//! pictures.
//!
//! [`ChipReport::simulate_layers`] runs a [`Machining`] in layers and keeps the results of each motion.
//! [`to_text`], [`write_csv`] and [`write_json`] write them, and [`draw_layers`] and [`draw_diagrams`] draw
//! them. Lengths are in mm; a reader sees them in the units of [`ChipReport::units`]. A value that is not
//! known is an empty cell in CSV and `null` in JSON, and one of the assumptions gives the reason.

mod chip_collector;
mod chip_columns;
mod chip_document;
mod chip_merging;
mod chip_moment;
mod chip_row;
mod chip_thickness;
mod diagram_drawing;
mod json_formatter;
mod kept_chips;
mod layer_drawing;
mod move_scene;
mod panel_sheet;
mod stl_export;
mod sum_columns;
mod sums;
mod text;

pub use chip_document::{write_csv, write_json};
pub use chip_moment::ChipMoment;
pub use chip_row::{ChipLayerRow, ChipRow};
pub use diagram_drawing::draw_diagrams;
pub use layer_drawing::draw_layers;
pub use move_scene::{MoveScene, MoveSceneLayer};
pub use stl_export::write_stl;
pub use sums::{ChipPeak, ChipTotals, OperationChips};
pub use text::to_text;

use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::layered_chips::LayerFrame;
use crate::layered_chips::stack::LayerStack;
use crate::report::table::DisplayUnits;
use crate::simulation_run::layer_run::LayerRunOptions;
use crate::simulation_run::{Machining, RunWatcher};
use kept_chips::KeptChipsWatcher;

/// About how many bytes the boundary of a chip on one layer takes: two arcs of some fifty points each, and what
/// lists of them need.
const BYTES_PER_BORDER: u64 = 2500;

/// Options about what a run keeps besides its rows and sums.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct ChipReportOptions {
    /// Whether the boundaries of all pieces are kept, which JSON and STL need. They take most of the memory.
    pub borders: bool,
    /// The number of cutting moves whose surroundings are kept for pictures. The run is slower then.
    pub scenes: usize,
    /// A height in mm. If it is given, only moves that cut on the layer at this height are kept for pictures.
    pub at_z_mm: Option<f64>,
}

impl ChipReportOptions {
    /// Returns the options with or without the boundaries of all pieces.
    #[must_use]
    pub fn with_borders(mut self, borders: bool) -> Self {
        self.borders = borders;
        self
    }

    /// Returns about how many bytes are kept of each section of a chip.
    fn bytes_per_section(self) -> u64 {
        let row = size_of::<ChipLayerRow>() as u64;
        if self.borders { row + BYTES_PER_BORDER } else { row }
    }

    /// Returns the options that keep the surroundings of so many cutting moves.
    #[must_use]
    pub fn with_scenes(mut self, scenes: usize) -> Self {
        self.scenes = scenes;
        self
    }

    /// Returns the options that keep only moves that cut on the layer at a height, mm.
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
    /// The units that a reader sees: those of the program, until a caller sets others. All values here are in
    /// mm.
    pub units: DisplayUnits,
    /// The options of the run.
    pub options: LayerRunOptions,
    /// Sums of everything that ran.
    pub totals: ChipTotals,
    /// The sums of each operation with a requested motion, in order.
    pub operations: Vec<OperationChips>,
    /// The assumptions of the run, in sentences.
    pub assumptions: Vec<String>,
    /// The requested motions that were not cut, or only in part.
    pub skipped: Vec<UncutMotion>,
    /// The requested motions that were cut, in order.
    pub rows: Vec<ChipRow>,
    /// The first moves that cut, for pictures.
    pub scenes: Vec<MoveScene>,
    /// The findings.
    pub findings: Vec<Diagnostic>,
    /// The remaining workpiece, in the frame of the layers.
    pub left: LayerStack,
    /// The frame of the layers. Heights and boundaries of chips are told in it.
    pub frame: LayerFrame,
}

/// A motion that was not cut, or only in part.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct UncutMotion {
    /// Its line.
    pub line: usize,
    /// Its operation.
    pub operation: String,
    /// Its tool.
    pub tool: String,
    /// The reason.
    pub reason: String,
}

/// The largest number of ranges of lines that are listed.
const MOST_RANGES: usize = 8;

/// Returns a sentence about the lines on which motions end. `lines` must ascend.
fn describe_motion_lines(lines: &[usize]) -> String {
    let mut ranges: Vec<(usize, usize)> = Vec::new();
    for line in lines {
        match ranges.last_mut() {
            Some((_, last)) if *last == *line || *last + 1 == *line => *last = *line,
            _ => ranges.push((*line, *line)),
        }
    }
    let told =
        |(from, to): &(usize, usize)| if from == to { from.to_string() } else { format!("{from}..{to}") };
    let mut shown: Vec<String> = ranges.iter().take(MOST_RANGES).map(told).collect();
    if let Some(last) = ranges.last().filter(|_| ranges.len() > MOST_RANGES) {
        shown.push(format!("... up to {}", last.1));
        return format!("motions end on lines {}", shown.join(", "));
    }
    match shown.as_slice() {
        [] => "the program has no motions".to_owned(),
        [one] if !one.contains("..") => format!("the only motion ends on line {one}"),
        [most @ .., last] if !most.is_empty() => {
            format!("motions end on lines {} and {last}", most.join(", "))
        }
        all => format!("motions end on lines {}", all.join(", ")),
    }
}

impl ChipReport {
    /// Returns the word for heights of layers in drawings.
    fn height_word(&self) -> &'static str {
        if self.frame.is_workpiece() { "z" } else { "height" }
    }

    /// Runs a program over its stock in layers. `keep` selects what is kept besides rows and sums.
    ///
    /// # Errors
    /// Returns the errors of [`Machining::simulate_layers`], among them [`Failure::Interrupted`] if `watch`
    /// stopped the run. Returns an error if no motion ends on the requested lines.
    pub fn simulate_layers(
        machining: &Machining<'_>,
        options: &LayerRunOptions,
        keep: ChipReportOptions,
        watch: &dyn RunWatcher,
    ) -> Result<Self, Failure> {
        let options = LayerRunOptions {
            one_by_one: options.one_by_one || keep.scenes > 0,
            kept_bytes: options.kept_bytes + keep.bytes_per_section(),
            ..options.clone()
        };
        let mut gathering = chip_collector::ChipCollector::new(machining, keep, &options);
        let budget = KeptChipsWatcher::new(watch);
        let ran = machining.simulate_layers(&options, &budget, &mut |cut| {
            gathering.add_motion(cut);
            budget.set_kept_bytes(gathering.kept_bytes);
        })?;
        if gathering.rows.is_empty() && gathering.skipped.is_empty() {
            let (from, to) = (*options.lines.start(), *options.lines.end());
            let asked = match to {
                usize::MAX => format!("no motion ends on line {from} or after it"),
                to if to == from => format!("no motion ends on line {from}"),
                to => format!("no motion ends on lines {from} to {to}"),
            };
            let message = format!("{asked}; {}", describe_motion_lines(&machining.motion_lines()));
            return Err(Diagnostic::new(codes::NO_MOTION_ASKED, message).into());
        }
        Ok(gathering.into_report(options, ran))
    }
}

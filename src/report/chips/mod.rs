//! The chips of a program, layer by layer: one row a motion, sums of operations, pictures.
//!
//! [`ChipReport::of`] runs a [`Machining`] in layers and keeps what it hears; [`to_text`], [`to_csv`] and [`to_json`] present it,
//! [`picture`] draws layers. Lengths are in mm, whatever the file's unit. What is not known is an empty cell, `null` in JSON, and
//! one of the assumptions says why.

mod compact;
mod diagrams;
mod fuse;
mod gather;
mod pace;
mod picture;
mod row;
mod scene;
mod sheet;
mod solids;
mod sums;
mod text;

pub use diagrams::diagrams;
pub use picture::picture;
pub use row::{LayerRow, Row, to_csv, to_json};
pub use scene::{Scene, SceneLayer};
pub use solids::to_stl;
pub use sums::{Largest, OperationChips, Totals};
pub use text::to_text;

use crate::chips::stack::Stack;
use crate::diagnostic::{Diagnostic, codes};
use crate::machining::chips::ChipOptions;
use crate::machining::{Machining, Watch};

/// What is kept of a run besides its sums.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Keep {
    /// The borders of all pieces: JSON and STL need them. They take by far the most memory.
    pub borders: bool,
    /// The workpiece around so many moves that cut, for pictures; the run is slower then.
    pub scenes: usize,
    /// A height, mm: then only moves that cut on the layer there.
    pub at: Option<f64>,
}

/// The chips of a program.
#[derive(Debug)]
pub struct ChipReport {
    /// The file's name.
    pub file: String,
    /// How it was run.
    pub options: ChipOptions,
    /// Sums of everything that ran.
    pub totals: Totals,
    /// Sums of each operation with a motion that is asked for, in order.
    pub operations: Vec<OperationChips>,
    /// What the run took for granted, in sentences.
    pub assumptions: Vec<String>,
    /// Motions that are asked for and were not cut, or in part.
    pub skipped: Vec<Skipped>,
    /// The motions that are asked for and were cut, in order.
    pub rows: Vec<Row>,
    /// The first moves that cut, for pictures.
    pub scenes: Vec<Scene>,
    /// What went wrong, with its places.
    pub findings: Vec<Diagnostic>,
    /// The workpiece that is left.
    pub left: Stack,
}

/// A motion that was not cut, or in part.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
pub struct Skipped {
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
    /// As [`Machining::chips`], and when no motion is on the lines that are asked for.
    pub fn of(
        machining: &Machining<'_>,
        options: &ChipOptions,
        keep: Keep,
        watch: &dyn Watch,
    ) -> Result<Option<Self>, Vec<Diagnostic>> {
        let options = ChipOptions { one_by_one: options.one_by_one || keep.scenes > 0, ..options.clone() };
        let mut gathering = gather::Gathering::new(machining, keep, options.tolerance);
        let ran = machining.chips(&options, watch, &mut |cut| gathering.add(cut));
        let Some(ran) = ran.map_err(|found| vec![*found])? else { return Ok(None) };
        if gathering.rows.is_empty() && gathering.skipped.is_empty() {
            let (from, to) = (*options.lines.start(), *options.lines.end());
            let message = match to {
                usize::MAX => format!("no motion ends on line {from} or after it"),
                to if to == from => format!("no motion ends on line {from}"),
                to => format!("no motion ends on lines {from} to {to}"),
            };
            return Err(vec![Diagnostic::new(codes::NO_MOTION_ASKED, message)]);
        }
        Ok(Some(gathering.end(options, ran)))
    }
}

//! This module runs a program over its stock in layers and finds the chip of every motion.
//!
//! It works like [`Machining::simulate_program`](super::Machining::simulate_program), with the exact chips of
//! `crate::layered_chips` instead of columns. Columns and layers are two simulations of the same path, with
//! the same frames, chords and checks, so each one checks the other.
//!
//! Layers lie across z or any other direction; path and stock are turned into their frame. They model flat end mills whose axis is not nearly parallel to the layers. A motion that they cannot
//! model is reported, left out and not approximated, and its material stays. It is not reported if it cannot
//! reach the stock.

mod flat_mills;
mod layer_cost;
mod layer_direction;
mod layer_runner;
mod stock_reach;

pub(crate) use flat_mills::to_flat_mill;
pub use layer_cost::LayerRunCost;
pub use layer_direction::LayerDirection;

use crate::diagnostic::Diagnostic;
use crate::engagement::MotionPiece;
use crate::layered_chips::stack::LayerStack;
use crate::layered_chips::{LayerFrame, MillStepError, chip::Chip};
use crate::program::motion::Motion;
use std::ops::RangeInclusive;

/// The options of a run in layers.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct LayerRunOptions {
    /// The thickness of the layers, mm.
    pub layer_mm: f64,
    /// Across which direction the layers lie.
    pub direction: LayerDirection,
    /// The largest distance of chords from their curve, for boundaries and for arcs, mm.
    pub tolerance_mm: f64,
    /// The lines of the file whose motions are asked for. Motions before them are cut too, motions after them
    /// are not run.
    pub lines: RangeInclusive<usize>,
    /// The longest piece of a motion that is cut on its own, mm; infinite for whole motions.
    pub longest_piece_mm: f64,
    /// Whether the motions that are asked for are cut one by one, so that the sink gets the workpiece right
    /// after each. This takes longer.
    pub one_by_one: bool,
    /// The memory that the caller keeps of each section, in bytes, for the estimate before the run.
    pub kept_bytes: u64,
    /// The number of equal parts, by length, in which motions that are asked for are cut.
    pub moments: usize,
}

impl LayerRunOptions {
    /// Returns the options for layers of this thickness (mm), the whole program, and chords within 0.002 mm.
    pub fn new(layer_mm: f64) -> Self {
        Self {
            layer_mm,
            direction: LayerDirection::WorkpieceZ,
            tolerance_mm: 0.002,
            lines: 1..=usize::MAX,
            longest_piece_mm: f64::INFINITY,
            one_by_one: false,
            kept_bytes: 0,
            moments: 1,
        }
    }

    /// Returns the options for layers across another direction.
    #[must_use]
    pub fn with_direction(mut self, direction: LayerDirection) -> Self {
        self.direction = direction;
        self
    }

    /// Returns the options with another largest distance of chords from their curve, mm.
    #[must_use]
    pub fn with_tolerance_mm(mut self, tolerance_mm: f64) -> Self {
        self.tolerance_mm = tolerance_mm;
        self
    }

    /// Returns the options for the motions of some lines of the file.
    #[must_use]
    pub fn with_lines(mut self, lines: RangeInclusive<usize>) -> Self {
        self.lines = lines;
        self
    }

    /// Returns the options with another longest piece, mm.
    #[must_use]
    pub fn with_longest_piece_mm(mut self, longest_piece_mm: f64) -> Self {
        self.longest_piece_mm = longest_piece_mm;
        self
    }

    /// Returns the options for a caller that keeps so many bytes of each section.
    #[must_use]
    pub fn with_kept_bytes(mut self, kept_bytes: u64) -> Self {
        self.kept_bytes = kept_bytes;
        self
    }

    /// Returns the options for motions that are cut in so many equal parts, one after the other.
    #[must_use]
    pub fn with_moments(mut self, moments: usize) -> Self {
        self.moments = moments.max(1);
        self
    }

    /// Returns the options for motions that are cut one by one, or together.
    #[must_use]
    pub fn with_one_by_one(mut self, one_by_one: bool) -> Self {
        self.one_by_one = one_by_one;
        self
    }
}

/// The reason why a motion was not cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum UncutReason {
    /// Its tool is not a flat end mill.
    Tool,
    /// It is a rapid of a tool whose shape is not known.
    Unknown,
    /// It neither moves the tip nor turns the axis.
    Still,
}

/// A motion and its chips.
#[derive(Debug)]
#[non_exhaustive]
pub struct MotionChips<'a> {
    /// The motion.
    pub motion: &'a Motion,
    /// The index of the motion in the program.
    pub number: usize,
    /// The line of the statement that ends it, counted from 1.
    pub line: usize,
    /// Whether the motion is asked for.
    pub asked: bool,
    /// The index of its cutter, if the shape of its tool is known.
    pub cutter: Option<usize>,
    /// The reason why it was not cut; then [`MotionChips::pieces`] is empty.
    pub left_out: Option<UncutReason>,
    /// Its pieces in order in the frame of the layers, each with its chip or the reason why it has none.
    pub pieces: &'a [(MotionPiece, Result<Chip, MillStepError>)],
    /// The workpiece: right after this motion if motions are cut one by one, else after some more motions.
    pub stack: &'a LayerStack,
}

impl MotionChips<'_> {
    /// Returns the volume of its chips, mm3.
    pub fn volume_mm3(&self) -> f64 {
        self.piece_chips().map(Chip::volume_mm3).sum()
    }

    /// Returns the chips of its pieces.
    pub fn piece_chips(&self) -> impl Iterator<Item = &Chip> {
        self.pieces.iter().filter_map(|(_, chip)| chip.as_ref().ok())
    }

    /// Returns the reason of the first piece that could not be modelled, and the number of such pieces.
    pub fn first_refusal(&self) -> Option<(MillStepError, usize)> {
        let mut refused = self.pieces.iter().filter_map(|(_, chip)| chip.as_ref().err());
        let first = refused.next()?;
        Some((*first, 1 + refused.count()))
    }
}

/// The result of a run in layers.
#[derive(Debug)]
#[non_exhaustive]
pub struct LayerRunResult {
    /// The workpiece that is left.
    pub left: LayerStack,
    /// The frame of its layers, and of all chips.
    pub frame: LayerFrame,
    /// The volume of the workpiece before the run, mm3.
    pub before_mm3: f64,
    /// The findings: motions that could not be modelled, and cuts at rapid or with a spindle that does not
    /// turn.
    pub findings: Vec<Diagnostic>,
}

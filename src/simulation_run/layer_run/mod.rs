//! Running a program over its stock in layers: the chip of every motion.
//!
//! As [`Machining::simulate_program`](super::Machining::simulate_program), with the exact chips of [`crate::layered_chips`] in place of columns. That theory is one of
//! flat end mills whose axis does not lie in the layers; what it cannot model is told and left out, and its material stays.

mod flat_mills;
mod layer_runner;
mod stock_reach;

pub use flat_mills::to_flat_mill;

use crate::diagnostic::Diagnostic;
use crate::layered_chips::stack::LayerStack;
use crate::layered_chips::{MillStepError, chip::Chip};
use crate::program::motion::Motion;
use crate::sim::MotionPiece;
use std::ops::RangeInclusive;

/// How chips are made.
#[derive(Debug, Clone, PartialEq)]
pub struct LayerRunOptions {
    /// Thickness of the layers, mm.
    pub layer: f64,
    /// Largest distance of a border's chords, and of an arc's, from the curve, mm.
    pub tolerance: f64,
    /// Lines of the file whose motions are asked for. What comes before them is cut, what comes after them is not run.
    pub lines: RangeInclusive<usize>,
    /// Longest piece of a motion that is cut on its own, mm; infinite for whole motions.
    pub longest: f64,
    /// Whether motions asked for are run one by one, so that the sink sees the workpiece right after each; takes longer.
    pub one_by_one: bool,
}

impl LayerRunOptions {
    /// Layers of this thickness (mm), the whole program, chords within 0.002 mm.
    pub fn new(layer: f64) -> Self {
        Self { layer, tolerance: 0.002, lines: 1..=usize::MAX, longest: f64::INFINITY, one_by_one: false }
    }
}

/// Why a motion was not cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum UncutReason {
    /// Its tool is no flat end mill.
    Tool,
    /// A rapid of a tool whose shape nobody says.
    Unknown,
    /// It goes nowhere.
    Still,
}

/// A motion and its chip.
#[derive(Debug)]
pub struct MotionChips<'a> {
    /// The motion.
    pub motion: &'a Motion,
    /// 1-based line of the statement that ends it.
    pub line: usize,
    /// Whether it is asked for.
    pub asked: bool,
    /// Index of its cutter, where its tool's shape is known.
    pub cutter: Option<usize>,
    /// Why it was not cut; [`MotionChips::pieces`] is empty then.
    pub left_out: Option<UncutReason>,
    /// Its pieces in order, each with its chip, or why it has none.
    pub pieces: &'a [(MotionPiece, Result<Chip, MillStepError>)],
    /// The workpiece after it where motions are run one by one, else after some motions more.
    pub stack: &'a LayerStack,
}

impl MotionChips<'_> {
    /// Volume of its chips, mm3.
    pub fn volume_mm3(&self) -> f64 {
        self.piece_chips().map(Chip::volume_mm3).sum()
    }

    /// The chips of its pieces.
    pub fn piece_chips(&self) -> impl Iterator<Item = &Chip> {
        self.pieces.iter().filter_map(|(_, chip)| chip.as_ref().ok())
    }

    /// The first piece that could not be modelled, and how many there are.
    pub fn first_refusal(&self) -> Option<(MillStepError, usize)> {
        let mut refused = self.pieces.iter().filter_map(|(_, chip)| chip.as_ref().err());
        let first = refused.next()?;
        Some((*first, 1 + refused.count()))
    }
}

/// What is left after a run.
#[derive(Debug)]
pub struct LayerRunResult {
    /// The workpiece that is left.
    pub left: LayerStack,
    /// Volume of the workpiece before, mm3.
    pub before_mm3: f64,
    /// What could not be modelled, cuts at rapid or without spindle.
    pub findings: Vec<Diagnostic>,
}

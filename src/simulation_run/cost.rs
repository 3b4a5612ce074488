//! This module estimates the cost of a run before it starts.

use super::tooling::statement_span;
use super::{Machining, SimulationRunOptions, WorkEstimate, chord_tolerance_mm};
use crate::cutter::CutterModel;
use crate::diagnostic::{Diagnostic, Failure, codes};
use crate::engagement::MOST_PIECES;
use crate::number::format_significant_number;
use crate::program::StatementId;
use crate::program::geometry::MotionPath;
use crate::stock::Dexels;

/// The most that a run may cost.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct SimulationBudget {
    /// The memory of the stock in bytes.
    pub bytes: u64,
    /// The number of times that columns are examined.
    pub visits: f64,
}

impl Default for SimulationBudget {
    /// Returns 2 GiB and about some hours of one core.
    fn default() -> Self {
        Self { bytes: 2 << 30, visits: 2e12 }
    }
}

impl SimulationBudget {
    /// Returns the budget with another amount of memory, in bytes.
    #[must_use]
    pub fn with_bytes(mut self, bytes: u64) -> Self {
        self.bytes = bytes;
        self
    }

    /// Returns the budget with another number of times that columns are examined.
    #[must_use]
    pub fn with_visits(mut self, visits: f64) -> Self {
        self.visits = visits;
        self
    }
}

/// The estimated cost of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct SimulationCost {
    /// The distance of columns, mm.
    pub cell_mm: f64,
    /// The number of columns.
    pub columns: u64,
    /// The memory of the stock in bytes, without overhangs.
    pub bytes: u64,
    /// An upper estimate of the number of times that columns are examined.
    pub visits: f64,
    /// The length of the path, mm.
    pub path_mm: f64,
}

/// How many columns one thread looks at in a second, with the contacts that it finds there: a ball or bull-nose
/// cutter in pieces of half a millimetre (`cargo bench --bench simulate`). Long pieces and flat ends are faster.
const LOOKS_PER_SECOND: f64 = 5e7;

impl SimulationCost {
    /// Returns what the run takes, for its watcher. A run that turns the axis takes longer than its time, ten to twenty
    /// times as long where the axis turns all the time.
    pub fn to_estimate(&self) -> WorkEstimate {
        WorkEstimate {
            work: "the simulation",
            thread_seconds: self.visits / LOOKS_PER_SECOND,
            bytes: self.bytes,
            size: format!(
                "{} columns of {:.3} mm, {:.0} mm of path",
                self.columns, self.cell_mm, self.path_mm
            ),
        }
    }
}

/// The number of cells in the smallest cutter's diameter if the cell is not given.
const CELLS_ACROSS: f64 = 40.0;

/// Returns how the distance of columns is chosen if it is not given, for people.
pub(crate) fn describe_default_cell() -> String {
    format!(
        "the diameter of the smallest cutter, of cones half of it, divided by {CELLS_ACROSS}; finer where pointed cutters \
         leave narrow grooves"
    )
}

/// The fewest cells in a cutter's diameter. With fewer, the boundary of material is known to no more than a
/// fifth of the radius.
const FEWEST_ACROSS: f64 = 10.0;

/// A bottom at least this steep, in radians, is a cone that mostly cuts near its tip: 44 degrees.
const STEEP_BOTTOM: f64 = 0.77;

/// The least z of the axis of a cutter that stands upright.
const UPRIGHT: f64 = 1.0 - 1e-9;

/// A bottom at least this high, by the height of the cutting part, is all of a cutter.
const WHOLE_BOTTOM: f64 = 0.9;

/// Whether a cutter has a bottom that mostly cuts near its tip: a steep one, or a flat cone that is all of the cutter, whose
/// diameter only says how long its flutes are.
fn is_cone(cutter: &CutterModel) -> bool {
    let profile = &cutter.profile;
    let [_, bottom_end] = profile.flank_start();
    let is_whole = profile.bottom_angle_rad() > 0.0 && bottom_end > WHOLE_BOTTOM * profile.height_mm();
    is_whole || profile.bottom_angle_rad() > STEEP_BOTTOM
}

/// Returns the width of a pointed cutter at a height above its tip, mm; `None` for one that is not far wider above.
fn tip_width_mm(cutter: &CutterModel, height_mm: f64) -> Option<f64> {
    let profile = &cutter.profile;
    let [tip, _] = profile.flank_start();
    let radius = profile.radius_at_height_mm(height_mm.min(profile.height_mm()));
    if is_cone(cutter) {
        return Some(2.0 * radius);
    }
    let is_pointed = profile.taper_rad() > 0.0 && tip < cutter.radius_mm() / 2.0;
    // A rounded tip is as wide as it is round: its finishing cuts are shallow everywhere.
    is_pointed.then(|| 2.0 * radius.max(tip))
}

/// Returns the width of a cutter for the choice of cells, mm: its diameter, or half of it for a cone, of which only the
/// lower part cuts.
fn across_mm(cutter: &CutterModel) -> f64 {
    2.0 * cutter.radius_mm() * if is_cone(cutter) { 0.5 } else { 1.0 }
}

impl Machining<'_> {
    /// Estimates the cost of a run with these options.
    ///
    /// # Errors
    /// Returns [`codes::TOO_MUCH`] with a cell that fits if the cost exceeds the budget, and
    /// [`codes::CELL_TOO_COARSE`] if the cell is too coarse for a cutter.
    pub fn estimate_cost(&self, options: &SimulationRunOptions) -> Result<SimulationCost, Failure> {
        let smallest = self.tooling.cutters().iter().map(across_mm).fold(f64::INFINITY, f64::min);
        let asked = options.cell_mm;
        let MeasuredPath { path_mm, area, pieces, largest } = self.measure_path(options.longest_piece_mm);
        // Every column under a piece is examined once for that piece, so the visits are its area divided by
        // that of a cell.
        let at = |cell: f64| SimulationCost {
            cell_mm: cell,
            columns: self.stock.count_columns(cell) as u64,
            bytes: (self.stock.count_columns(cell) as u64).saturating_mul(Dexels::BYTES_PER_COLUMN as u64),
            visits: area / (cell * cell),
            path_mm,
        };
        let fits = |plan: &SimulationCost| {
            plan.bytes <= options.budget.bytes && plan.visits <= options.budget.visits
        };
        // A cell that the user gave is never changed; only the default may be made coarser to fit.
        if let Some(cell) = asked
            && cell * FEWEST_ACROSS > smallest
        {
            let message = format!("a cell of {cell} mm is too coarse for a cutter of {smallest:.3} mm");
            let help = format!(
                "Take a cell of {} mm or less.",
                format_significant_number(smallest / CELLS_ACROSS, 3, 6)
            );
            return Err(Diagnostic::new(codes::CELL_TOO_COARSE, message).with_help(help).into());
        }
        let usual = if smallest.is_finite() { smallest / CELLS_ACROSS } else { 0.1 };
        let wanted = at(asked.unwrap_or_else(|| usual.min(self.narrowest_groove_mm() / FEWEST_ACROSS)));
        if fits(&wanted) {
            self.refuse_long_motions(wanted.cell_mm, options.longest_piece_mm)?;
            return Ok(wanted);
        }
        // Grow the cell in steps of 10 % until it fits, and round it up so that the message has few digits.
        let mut cell = wanted.cell_mm;
        while !fits(&at(cell)) && cell < 1e4 {
            cell *= 1.1;
        }
        let cell = (cell * 1000.0).ceil() / 1000.0;
        if asked.is_none() && cell * FEWEST_ACROSS <= smallest {
            self.refuse_long_motions(cell, options.longest_piece_mm)?;
            return Ok(at(cell));
        }
        let message = format!(
            "with a cell of {} mm the simulation takes {:.1} GiB and about {:.0e} looks at columns in {pieces} pieces of path, \
             more than the {:.1} GiB and {:.0e} that it may",
            format_significant_number(wanted.cell_mm, 3, 6),
            wanted.bytes as f64 / f64::from(1 << 30),
            wanted.visits,
            options.budget.bytes as f64 / f64::from(1 << 30),
            options.budget.visits,
        );
        let help = format!(
            "A cell of {} mm fits. Or describe the stock no larger than it is.",
            format_significant_number(cell, 3, 6)
        );
        let found = Diagnostic::new(codes::TOO_MUCH, message).with_help(help);
        // Where one motion makes most of it, that motion is the first to look at.
        Err(
            match largest.filter(|(_, of_one)| wanted.visits > options.budget.visits && of_one * 2.0 > area) {
                Some((statement, of_one)) => {
                    let at = statement_span(self.program, statement);
                    let label = format!("{:.0} % of the looks are at this motion", 100.0 * of_one / area);
                    found.with_label(self.program.source(), at, label).into()
                }
                None => found.into(),
            },
        )
    }

    /// Refuses motions that would be cut into far too many pieces over columns that are `cell_mm` apart.
    fn refuse_long_motions(&self, cell_mm: f64, longest_piece_mm: f64) -> Result<(), Failure> {
        let trace = self.start_path(chord_tolerance_mm(cell_mm), longest_piece_mm);
        let trace = trace.with_air_clip(self.surroundings_of_stock());
        self.refuse_too_many_pieces(trace, usize::MAX, &|_| true)
    }

    /// Returns the width of the narrowest groove that a pointed cutter leaves, mm, by how deep it comes below the top of the
    /// stock along z. It is infinite where none does.
    fn narrowest_groove_mm(&self) -> f64 {
        // Most programs have no such cutter, and their motions need not be read for it.
        if !self.tooling.cutters().iter().any(|cutter| tip_width_mm(cutter, 0.0).is_some()) {
            return f64::INFINITY;
        }
        let unit = self.units.mm_per_unit();
        let (_, [.., top]) = self.stock.bounds();
        let mut depths = vec![0.0_f64; self.tooling.cutters().len()];
        for motion in self.program.motions().filter(|motion| !motion.rapid) {
            let Some(index) = self.tooling.cutter_index(&motion) else { continue };
            let is_upright = motion.from.axis.z > UPRIGHT && motion.to.axis.z > UPRIGHT;
            if let Some(depth) = depths.get_mut(index).filter(|_| is_upright) {
                let points = motion.path.sample_points(motion.from.point, motion.to.point);
                let lowest = points.iter().map(|point| point.z * unit).fold(f64::INFINITY, f64::min);
                *depth = depth.max(top - lowest);
            }
        }
        let cutters = self.tooling.cutters().iter().zip(depths).filter(|(_, depth)| *depth > 0.0);
        cutters.filter_map(|(cutter, depth)| tip_width_mm(cutter, depth)).fold(f64::INFINITY, f64::min)
    }

    /// Measures the path. Tools without a known shape do not count.
    fn measure_path(&self, longest: f64) -> MeasuredPath {
        let unit = self.units.mm_per_unit();
        let far = self.surroundings_of_stock().far_mm();
        let mut measured = MeasuredPath::default();
        for motion in self.program.motions() {
            let Some(cutter) =
                self.tooling.cutter_index(&motion).and_then(|index| self.tooling.cutters().get(index))
            else {
                continue;
            };
            let length = motion.length() * unit;
            let radius = cutter.radius_mm();
            measured.path_mm += length;
            // Of a straight line that goes far away, no more than the surroundings' diagonal is near the stock.
            let near = if motion.path == MotionPath::Line { length.min(far) } else { length };
            let count = (near / longest).ceil().clamp(1.0, MOST_PIECES as f64);
            // A piece is a strip with a disc's ends. One that continues the piece before examines at most
            // half of the disc again.
            let area = near * 2.0 * radius + count * std::f64::consts::PI * radius * radius;
            measured.area += area;
            measured.pieces += count as u64;
            if measured.largest.is_none_or(|(_, largest)| area > largest) {
                measured.largest = Some((motion.last_statement(), area));
            }
        }
        measured
    }
}

/// The path of a run as far as its cost depends on it.
#[derive(Debug, Default)]
struct MeasuredPath {
    /// Its length, mm.
    path_mm: f64,
    /// The sum of the areas under its pieces, mm2.
    area: f64,
    /// The number of pieces.
    pieces: u64,
    /// The motion with the largest area, and that area, mm2.
    largest: Option<(StatementId, f64)>,
}

//! What a run costs, before it runs.

use super::{Machining, SimulationRunOptions};
use crate::diagnostic::{Diagnostic, codes};
use crate::sim::Dexels;

/// What a run may cost.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SimulationBudget {
    /// Bytes of stock.
    pub bytes: u64,
    /// Visits to columns.
    pub visits: f64,
}

impl Default for SimulationBudget {
    /// 2 GiB, and some hours of one core.
    fn default() -> Self {
        Self { bytes: 2 << 30, visits: 2e12 }
    }
}

/// What a run costs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SimulationCost {
    /// Distance of columns, mm.
    pub cell: f64,
    /// Columns.
    pub columns: u64,
    /// Bytes of stock, overhangs aside.
    pub bytes: u64,
    /// About how many times a column is looked at, at most.
    pub visits: f64,
    /// Length of the path, mm.
    pub path_mm: f64,
}

/// Cells in the smallest cutter's diameter when nobody says the cell.
const CELLS_ACROSS: f64 = 40.0;

/// Fewest cells in a cutter's diameter: with less, the border of the ground is known to no more than a fifth of the radius.
const FEWEST_ACROSS: f64 = 10.0;

impl Machining<'_> {
    /// What a run with these options costs.
    ///
    /// # Errors
    /// [`codes::TOO_MUCH`] when it is more than the budget, with a cell that fits; [`codes::CELL_TOO_COARSE`] when the cell is
    /// too coarse for a cutter.
    pub fn estimate_cost(&self, options: &SimulationRunOptions) -> Result<SimulationCost, Box<Diagnostic>> {
        let smallest = self
            .tooling
            .cutters()
            .iter()
            .map(|cutter| 2.0 * cutter.radius_mm())
            .fold(f64::INFINITY, f64::min);
        let asked = options.cell;
        let (path_mm, area, pieces) = self.measure_path(options.longest);
        let at = |cell: f64| SimulationCost {
            cell,
            columns: self.stock.count_columns(cell) as u64,
            bytes: (self.stock.count_columns(cell) as u64).saturating_mul(Dexels::BYTES_PER_COLUMN as u64),
            visits: area / (cell * cell),
            path_mm,
        };
        let fits = |plan: &SimulationCost| {
            plan.bytes <= options.budget.bytes && plan.visits <= options.budget.visits
        };
        if let Some(cell) = asked
            && cell * FEWEST_ACROSS > smallest
        {
            let message = format!("a cell of {cell} mm is too coarse for a cutter of {smallest:.3} mm");
            let help = format!("Take a cell of {} mm or less.", format_short(smallest / CELLS_ACROSS));
            return Err(Box::new(Diagnostic::new(codes::CELL_TOO_COARSE, message).with_help(help)));
        }
        let wanted = at(asked.unwrap_or(if smallest.is_finite() { smallest / CELLS_ACROSS } else { 0.1 }));
        if fits(&wanted) {
            return Ok(wanted);
        }
        let mut cell = wanted.cell;
        while !fits(&at(cell)) && cell < 1e4 {
            cell *= 1.1;
        }
        let cell = (cell * 1000.0).ceil() / 1000.0;
        if asked.is_none() && cell * FEWEST_ACROSS <= smallest {
            return Ok(at(cell));
        }
        let message = format!(
            "with a cell of {} mm the simulation takes {:.1} GiB and about {:.0e} looks at columns in {pieces} pieces of path, \
             more than the {:.1} GiB and {:.0e} that it may",
            format_short(wanted.cell),
            wanted.bytes as f64 / f64::from(1 << 30),
            wanted.visits,
            options.budget.bytes as f64 / f64::from(1 << 30),
            options.budget.visits,
        );
        let help =
            format!("A cell of {} mm fits. Or describe the stock no larger than it is.", format_short(cell));
        Err(Box::new(Diagnostic::new(codes::TOO_MUCH, message).with_help(help)))
    }

    /// Length of the path, the ground that its pieces cover (each counted whole), and how many pieces.
    fn measure_path(&self, longest: f64) -> (f64, f64, u64) {
        let unit = self.units.mm_per_unit();
        let (mut path, mut area, mut pieces) = (0.0, 0.0, 0);
        for motion in self.program.motions() {
            let Some(cutter) =
                self.tooling.cutter_index(&motion).and_then(|index| self.tooling.cutters().get(index))
            else {
                continue;
            };
            let length = motion.length() * unit;
            let radius = cutter.radius_mm();
            let count = (length / longest).ceil().max(1.0);
            path += length;
            // A piece that goes on where the last one ended looks at half of the disc again at most.
            area += length * 2.0 * radius + count * std::f64::consts::PI * radius * radius;
            pieces += count as u64;
        }
        (path, area, pieces)
    }
}

/// A length with as many digits as matter.
fn format_short(value: f64) -> String {
    let digits = (2.0 - value.abs().max(1e-9).log10().floor()).clamp(0.0, 6.0) as usize;
    let text = format!("{value:.digits$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_owned() } else { text }
}

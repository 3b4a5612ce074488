//! This module makes curves of programs.

use super::curve_drawing::{CurvePanel, PlotCurve, PlotSegment, draw_curve_panels};
use crate::engagement::{MachinePath, PathLinearizer};
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::program::{LengthUnit, Program};
use crate::report::machine_time::MachineClock;
use crate::report::motion_measure::measure_motion;
use crate::report::simulation::{MotionRow, SimulationReport};
use crate::report::table::{ColumnUnit, DisplayUnits};
use crate::setup::Setup;
use crate::simulation_run::find_machine_path;
use std::io;
use std::sync::Arc;

/// The largest distance between chords and their arcs in a drawing, mm.
const CHORD_MM: f64 = 0.05;

/// The quantity of the vertical axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum PlotQuantity {
    /// Feed.
    Feed,
    /// Thickest chip.
    Chip,
    /// Removal rate.
    Removal,
    /// Cutting force.
    Force,
    /// Torque.
    Torque,
    /// Power.
    Power,
    /// Deflection of the tool's tip.
    Deflection,
    /// Bending stress of the tool.
    Stress,
    /// Height of the tip.
    Z,
}

impl PlotQuantity {
    /// All of them.
    pub const ALL: [Self; 9] = [
        Self::Feed,
        Self::Chip,
        Self::Removal,
        Self::Force,
        Self::Torque,
        Self::Power,
        Self::Deflection,
        Self::Stress,
        Self::Z,
    ];

    /// Returns its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Feed => "feed",
            Self::Chip => "chip",
            Self::Removal => "removal",
            Self::Force => "force",
            Self::Torque => "torque",
            Self::Power => "power",
            Self::Deflection => "deflection",
            Self::Stress => "stress",
            Self::Z => "z",
        }
    }

    /// Returns the title of its axis: its name and unit.
    pub fn axis_title(self, units: DisplayUnits) -> String {
        let words = match self {
            Self::Feed => "feed",
            Self::Chip => "thickest chip",
            Self::Removal => "largest removal rate",
            Self::Force => "largest force",
            Self::Torque => "largest torque",
            Self::Power => "largest power",
            Self::Deflection => "largest deflection",
            Self::Stress => "largest bending stress",
            Self::Z => "z",
        };
        units.title(words, self.unit())
    }

    fn unit(self) -> ColumnUnit {
        match self {
            Self::Feed => ColumnUnit::FeedPerMinute,
            Self::Chip | Self::Deflection | Self::Z => ColumnUnit::Length,
            Self::Removal => ColumnUnit::RemovalRate,
            Self::Force => ColumnUnit::Force,
            Self::Torque => ColumnUnit::Torque,
            Self::Power => ColumnUnit::Power,
            Self::Stress => ColumnUnit::Stress,
        }
    }

    /// Returns whether the quantity comes from a simulation.
    pub fn is_simulated(self) -> bool {
        !matches!(self, Self::Feed | Self::Z)
    }

    fn row_value(self, row: &MotionRow) -> Option<f64> {
        row.cut_load(match self {
            Self::Chip => row.chip_thickness_mm,
            Self::Removal => row.peak_removal_rate_mm3_min,
            Self::Force => row.force_n,
            Self::Torque => row.torque_nm,
            Self::Power => row.power_kw,
            Self::Deflection => row.deflection_mm(),
            Self::Stress => row.bending_stress_mpa(),
            Self::Feed | Self::Z => None,
        })
    }
}

/// The quantity of the horizontal axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum PlotAbscissa {
    /// Time. Motions of unknown time take none.
    Time,
    /// The path.
    Path,
    /// The number of the block: every motion is as long as every other one.
    Block,
}

impl PlotAbscissa {
    /// Returns the title of its axis: its name and unit.
    pub fn axis_title(self, units: DisplayUnits) -> String {
        match self {
            Self::Time => "time, s".to_owned(),
            Self::Path => units.title("path", ColumnUnit::Length),
            Self::Block => "block".to_owned(),
        }
    }
}

/// A program to be drawn.
#[derive(Debug, Clone, Copy)]
pub struct PlottedProgram<'a> {
    /// The name of the program.
    pub name: &'a str,
    /// The program.
    pub program: &'a Program,
    /// The unit of its lengths.
    pub units: LengthUnit,
    /// The setup, whose machine gives times and the path between points.
    pub setup: &'a Setup,
    /// Its simulation.
    pub simulated: Option<&'a SimulationReport>,
    /// The lines of the file whose motions are drawn, the first and the last one. A motion counts by the line on which its
    /// last statement begins. All of them with `None`; the axis begins at the first motion that is drawn.
    pub lines: Option<(usize, usize)>,
}

impl PlottedProgram<'_> {
    /// Returns whether a motion stands on the lines that are drawn.
    fn shows_motion(&self, motion: &Motion) -> bool {
        self.lines.is_none_or(|(first, last)| {
            let at = self.program.statement(motion.last_statement()).origin();
            (first..=last).contains(&self.program.source().line_column(at.start).0)
        })
    }
}

/// Draws quantities of programs as SVG, a panel each, in the units that a reader sees. Of several programs,
/// all but the last are drawn as thin grey lines over the last one.
///
/// ```
/// use clsmith::parse::parse;
/// use clsmith::program::LengthUnit;
/// use clsmith::report::plot::{PlotAbscissa, PlotQuantity, PlottedProgram, draw_programs};
/// use clsmith::report::DisplayUnits;
/// use clsmith::setup::Setup;
/// use clsmith::source::Source;
///
/// let part = b"FROM/0,0,0\nFEDRAT/MMPM,600.\nGOTO/100,0,0\nFEDRAT/MMPM,900.\nGOTO/200,0,0\n";
/// let program = parse(&Source::new("part.cls", part.to_vec())?, None).program;
/// let plotted = PlottedProgram {
///     name: "part.cls",
///     program: &program,
///     units: LengthUnit::Mm,
///     setup: &Setup::default(),
///     simulated: None,
///     lines: None,
/// };
/// let shown = [PlotQuantity::Feed, PlotQuantity::Z];
/// let svg = draw_programs(&[plotted], &shown, PlotAbscissa::Time, DisplayUnits::MM)?;
/// assert!(svg.starts_with("<svg") && svg.contains("feed, mm/min"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// Returns the errors of the drawing library. A drawing in memory has none.
pub fn draw_programs(
    programs: &[PlottedProgram<'_>],
    quantities: &[PlotQuantity],
    along: PlotAbscissa,
    units: DisplayUnits,
) -> io::Result<String> {
    draw_curve_panels(&along.axis_title(units), &build_panels(programs, quantities, along, units))
}

/// Returns what [`draw_programs`] draws: a panel for each quantity, in their order.
pub fn build_panels(
    programs: &[PlottedProgram<'_>],
    quantities: &[PlotQuantity],
    along: PlotAbscissa,
    units: DisplayUnits,
) -> Vec<CurvePanel> {
    let machines: Vec<PlotMachine> = programs.iter().map(PlotMachine::new).collect();
    let panel = |quantity: &PlotQuantity| CurvePanel {
        up: quantity.axis_title(units),
        from_zero: *quantity != PlotQuantity::Z,
        curves: programs
            .iter()
            .zip(&machines)
            .map(|(program, machine)| build_curve(program, machine, *quantity, along, units))
            .collect(),
    };
    quantities.iter().map(panel).collect()
}

/// What the machine makes of a program.
struct PlotMachine {
    clock: MachineClock,
    path: Option<Arc<dyn MachinePath>>,
}

impl PlotMachine {
    fn new(plotted: &PlottedProgram<'_>) -> Self {
        Self {
            clock: MachineClock::new(plotted.program, plotted.units, plotted.setup),
            path: find_machine_path(plotted.program, plotted.setup, plotted.units),
        }
    }
}

fn build_curve(
    plotted: &PlottedProgram<'_>,
    machine: &PlotMachine,
    quantity: PlotQuantity,
    along: PlotAbscissa,
    units: DisplayUnits,
) -> PlotCurve {
    let shown = |value: f64| units.convert(quantity.unit(), value);
    let mut trace = PathLinearizer::new(plotted.units.mm_per_unit(), CHORD_MM, f64::INFINITY)
        .with_machine_path(machine.path.clone());
    let rapid_feed = plotted.setup.machine.rapid_feed.map(|feed| feed.get());
    let mut segments = Vec::new();
    let mut pieces = Vec::new();
    let (mut at, mut number) = (0.0, 0);
    for (place, motion) in plotted.program.motions().enumerate() {
        trace.adopt_workpiece_frame(&motion);
        if motion.path == MotionPath::Start {
            continue;
        }
        let moved = measure_motion(&motion, plotted.units, rapid_feed);
        let size = match along {
            PlotAbscissa::Time => machine.clock.motion_seconds(number, moved.seconds).unwrap_or(0.0),
            PlotAbscissa::Path => units.convert(ColumnUnit::Length, moved.length_mm),
            PlotAbscissa::Block => 1.0,
        };
        let row = plotted.simulated.and_then(|simulated| simulated.motions.rows.get(number));
        number += 1;
        if !plotted.shows_motion(&motion) {
            continue;
        }
        let (from, to) = (at, at + size);
        if size <= 0.0 {
            continue;
        }
        at = to;
        match quantity {
            PlotQuantity::Z => {
                pieces.clear();
                trace.append_pieces((place, &motion), 0, &mut pieces);
                segments.extend(pieces.iter().map(|step| PlotSegment {
                    from: from + size * step.from,
                    to: from + size * step.to,
                    values: Some([step.piece.from.point.z, step.piece.to.point.z].map(shown)),
                }));
            }
            PlotQuantity::Feed => {
                let feed = moved.feed_mm_min.filter(|_| !moved.rapid);
                segments.push(PlotSegment { from, to, values: feed.map(|feed| [shown(feed); 2]) });
            }
            _ => {
                let value = row.and_then(|row| quantity.row_value(row));
                segments.push(PlotSegment { from, to, values: value.map(|value| [shown(value); 2]) });
            }
        }
    }
    PlotCurve { name: plotted.name.to_owned(), segments }
}

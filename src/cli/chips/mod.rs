//! This module runs `clsmith chips`.

mod outputs;

use crate::cli::bad_argument::BadArgument;
use crate::cli::command_exit::CommandExit;
use crate::cli::input_files;
use crate::cli::line_range::parse_line_range;
use crate::cli::measuring_args::MeasuringArgs;
use crate::cli::measuring_command::{MeasuringCommand, MeasuringContext};
use crate::cli::output_args::JsonArgs;
use crate::cli::stop::Stop;
use clap::Args;
use clsmith::report::layered_chips::{self, ChipReport, ChipReportOptions};
use clsmith::report::stats::ResolvedLengthUnit;
use clsmith::simulation_run::Machining;
use clsmith::simulation_run::layer_run::{LayerDirection, LayerRunOptions};
use outputs::ChipDrawings;
use std::ops::RangeInclusive;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  clsmith chips part.cls --setup shop.yaml --layer 0.5                     chips of all motions, in sums
  clsmith chips part.cls --setup shop.yaml --layer 0.5 --json chips.json   every chip's borders, layer by layer
  clsmith chips part.cls --setup shop.yaml --layer 0.5 --csv - | head      one row for each motion and layer
  clsmith chips part.cls --setup shop.yaml --layer 0.5 --lines 40..48 --plot corner.svg --at -2
                                                                           the moves through a corner, side by side
  clsmith chips part.cls --setup shop.yaml --layer 0.2 --lines 44 --stl chip.stl --diagram diagram.svg
                                                                           one chip as a solid, and how it was found
  clsmith chips part.cls --setup shop.yaml --layer 0.5 --lines 44 --moments 10 --csv entry.csv
                                                           how the chip of a move into a corner grows, with forces
  clsmith chips side.cls --setup shop.yaml --layer 0.5 --layers-across tool
                                                                           a side that is milled with a level tool

Chips are those of flat end mills in three and five axes; other tools are told and left out, and so are moves whose
axis is more than 80 degrees from z: give them layers that lie otherwise, by --layers-across. Heights, --at and the
boundaries of the JSON are then told in the frame of the layers, which the JSON names; an STL stays in the workpiece frame. The setup says stock, tools and machine: see configs/README.md. Lengths of the
command line are in mm. Outputs appear whole or not at all, and never over an input.
Outputs are in the unit of the program, or in that of --display-units; of a program in inches the names end in _in.
The columns of the CSV: line, operation, tool, length_mm, feed_mm_min, z_mm, thickness_mm, area_mm2, volume_mm3,
inside_mm2, pieces, chip_thickness_mm, engaged_deg, arcs_deg. Thickness is the largest on the way, engagement that at the
motion's end. With --moments there is a row for each part, with the columns moment, along_from_mm, along_to_mm and those of forces
behind the others. An empty cell is a value that is not known, as engagement where the cutter has left the chip by then.
A name that begins as a formula does (= + - @) has an apostrophe in front.";

/// Finds the exact undeformed chip of every motion, layer by layer, in three and five axes
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct ChipsArgs {
    /// The program; `-` is standard input
    #[arg(value_name = "PROGRAM")]
    program: PathBuf,
    /// The setup file: stock, tools, machine
    #[arg(long, value_name = "FILE")]
    setup: PathBuf,
    /// Thickness of the layers into which the workpiece is cut
    #[arg(long, value_name = "MM", value_parser = super::simulate::parse_positive)]
    layer: f64,
    /// Across which direction the layers lie: three numbers in the workpiece frame, `z`, `tool` (the axis of the first
    /// motion that is reported), `frame` (z of the frame in which it is programmed) or `table` (the machine's, from the
    /// setup's axes)
    #[arg(long, value_name = "I,J,K", allow_hyphen_values = true, value_parser = parse_layer_direction, default_value = "z",
          hide_default_value = true)]
    layers_across: LayerDirection,
    /// Report only motions on these lines of the file: A..B, A.., ..B or A. Motions before them are cut,
    /// motions after them are not run
    #[arg(long, value_name = "A..B", value_parser = parse_line_range, default_value = "..", hide_default_value = true)]
    lines: RangeInclusive<usize>,
    #[command(flatten)]
    json: JsonArgs,
    /// A table with one row for each motion and layer; `-` is standard output
    #[arg(long, value_name = "FILE", help_heading = "Outputs")]
    csv: Option<PathBuf>,
    /// The chips as solids, stacked of their layers, as a binary STL in mm
    #[arg(long, value_name = "FILE", help_heading = "Outputs")]
    stl: Option<PathBuf>,
    /// Layers of the first moves that cut, side by side, as SVG, or as PNG if the file ends in .png
    #[arg(long, alias = "svg", value_name = "FILE", help_heading = "Outputs")]
    plot: Option<PathBuf>,
    /// The boundary construction diagrams of these moves, as SVG or PNG
    #[arg(long, value_name = "FILE", help_heading = "Outputs")]
    diagram: Option<PathBuf>,
    /// Draw only the layer at this height; by default a few of all layers
    #[arg(long, value_name = "Z", allow_negative_numbers = true, value_parser = parse_height_mm)]
    at: Option<f64>,
    /// The largest number of moves that are drawn
    #[arg(long, value_name = "N", default_value = "6", value_parser = clap::value_parser!(u8).range(1..=24))]
    moves: u8,
    /// Tell the chip of each motion in so many equal parts, one after the other, with the forces in the middle of each
    /// if the setup names a material: means and peaks in the CSV, and one revolution in the JSON
    #[arg(long, value_name = "N", default_value = "1", hide_default_value = true,
          value_parser = clap::value_parser!(u16).range(1..=1000))]
    moments: u16,
    /// The largest distance between straight pieces of a boundary, or chords of arcs, and the curve
    #[arg(long, value_name = "MM", default_value = "0.002", value_parser = parse_tolerance_mm)]
    tolerance: f64,
    #[command(flatten)]
    pub(in crate::cli) shared: MeasuringArgs,
}

/// Reads a height in mm.
fn parse_height_mm(text: &str) -> Result<f64, BadArgument> {
    let value = text.parse::<f64>().ok().filter(|value| value.is_finite());
    value.ok_or(BadArgument::new("this must be a number"))
}

/// Reads a distance of chords from their curve, in mm. It is not finer than the grid of areas, and not
/// coarser than a picture needs.
fn parse_tolerance_mm(text: &str) -> Result<f64, BadArgument> {
    let value = text.parse::<f64>().ok().filter(|value| (1e-5..=0.1).contains(value));
    value.ok_or(BadArgument::new("this must be a number of millimetres from 0.00001 to 0.1"))
}

/// Reads the direction across which layers lie.
fn parse_layer_direction(text: &str) -> Result<LayerDirection, BadArgument> {
    let wrong =
        || BadArgument::new("this must be `z`, `tool`, `frame`, `table`, or three numbers as in 0,-1,0");
    Ok(match text {
        "z" => LayerDirection::WorkpieceZ,
        "tool" => LayerDirection::ToolAxis,
        "frame" => LayerDirection::ProgramFrame,
        "table" => LayerDirection::MachineTable,
        numbers => {
            let read = |part: &str| part.trim().parse::<f64>().ok().filter(|value| value.is_finite());
            let parts: Vec<f64> = numbers.split(',').map(read).collect::<Option<_>>().ok_or_else(wrong)?;
            let direction: [f64; 3] = parts.try_into().map_err(|_| wrong())?;
            if direction == [0.0; 3] {
                return Err(BadArgument::new("a direction needs a number that is not 0"));
            }
            LayerDirection::Vector(direction)
        }
    })
}

impl ChipsArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        let measuring = MeasuringCommand {
            program: &self.program,
            outputs: self.output_paths().collect(),
            json: &self.json,
            simulations: 1,
            shared: &self.shared,
        };
        measuring.run_measurement(
            self.find_usage_problem(),
            |under| self.find_chips(under),
            |(report, _)| layered_chips::to_text(report),
            |(report, drawn), findings, outputs| self.write_outputs(report, drawn, findings, outputs),
        )
    }

    /// Computes the chips, and the drawings if some are wanted. Findings that do not stop the run are added
    /// to those of `under`.
    fn find_chips(&self, under: &mut MeasuringContext<'_>) -> Result<(ChipReport, ChipDrawings), Stop> {
        let setup = input_files::read_setup(&self.setup)?;
        self.check_outputs(&setup)?;
        under.outputs_are_checked = true;
        let program = under.read_program(&self.program, &setup)?;
        let units = ResolvedLengthUnit::from_program(&program, self.shared.units).unit;
        let machining = Machining::new(&program, &setup, units, under.findings)?;
        let options =
            LayerRunOptions::new(self.layer).with_tolerance_mm(self.tolerance).with_lines(self.lines.clone());
        let options = options.with_direction(self.layers_across).with_moments(usize::from(self.moments));
        let scenes = if self.plot.is_some() || self.diagram.is_some() { usize::from(self.moves) } else { 0 };
        let keep = ChipReportOptions::default()
            .with_borders(self.json.is_wanted() || self.stl.is_some())
            .with_scenes(scenes)
            .with_at_z_mm(self.at);
        let mut report = ChipReport::simulate_layers(&machining, &options, keep, under.progress)?;
        if self.moments > 1 {
            report.find_moment_forces(&machining, under.progress)?;
        }
        report.units = self.shared.display.of_program(units);
        under.findings.append(&mut report.findings);
        let drawn = self.draw_chips(&report)?;
        Ok((report, drawn))
    }
}

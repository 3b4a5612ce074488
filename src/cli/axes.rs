//! This module runs `clsmith axes`.

use super::command_exit::CommandExit;
use super::command_outputs::{CommandOutputs, refuse_overwritten_input};
use super::input_files::{self, STANDARD};
use super::measuring_args::MeasuringArgs;
use super::measuring_command::{MeasuringCommand, MeasuringContext};
use super::output_args::JsonArgs;
use super::output_endings::{OutputContent, find_wrong_ending};
use super::plot::encode_drawing;
use super::stop::Stop;
use clap::{Args, ValueEnum};
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::report::machine_axes::{JointAbscissa, JointTable, draw_joints};
use clsmith::report::stats::ResolvedLengthUnit;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  clsmith axes part.cls --setup shop.yaml                       how far each axis goes, poles, flips, rewinds
  clsmith axes part.cls --setup shop.yaml --csv joints.csv      the values of all axes, one row a motion
  clsmith axes part.cls --setup shop.yaml --npy joints.npy      the same for NumPy: line, time, values
  clsmith axes part.cls --setup shop.yaml --plot joints.svg --along line

The setup's machine has the axes: see configs/README.md. Lengths are in the unit of the program, or in that
of --display-units, angles in degrees; of all ways with both branches and all turns
of the rotary axes it is the one with the fewest values outside their limits, and then the shortest.
The columns of the CSV: line, motion, time_s, tip_x_mm, tip_y_mm, tip_z_mm, axis_i, axis_j, axis_k, the axes under their
names (C_deg, X_mm), pole_deg, pole, flip, rewind, outside, sag_mm (without control of the tip), feed_limit_mm_min. Of a
program in inches the names end in _in.";

/// Writes where the axes of a machine stand over a program
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct AxesArgs {
    /// The program; `-` is standard input
    #[arg(value_name = "PROGRAM")]
    program: PathBuf,
    /// The setup file with the machine
    #[arg(long, value_name = "FILE")]
    setup: PathBuf,
    /// The values as a table; `-` is standard output
    #[arg(long, value_name = "FILE", help_heading = "Outputs")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    json: JsonArgs,
    /// The values as an array for NumPy
    #[arg(long, value_name = "FILE", help_heading = "Outputs")]
    npy: Option<PathBuf>,
    /// The values as curves, as SVG, or as PNG if the file ends in .png
    #[arg(long, value_name = "FILE", help_heading = "Outputs")]
    plot: Option<PathBuf>,
    /// The horizontal axis of the plot
    #[arg(long, value_enum, value_name = "AXIS", default_value = "time", requires = "plot")]
    along: JointAbscissaArg,
    #[command(flatten)]
    pub(in crate::cli) shared: MeasuringArgs,
}

/// The quantity of the horizontal axis.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum JointAbscissaArg {
    /// Time, s
    Time,
    /// Line of the program
    Line,
}

/// What was computed, and its drawing.
struct AxesOutcome {
    table: JointTable,
    drawn: Vec<u8>,
}

impl AxesArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        let measuring = MeasuringCommand {
            program: &self.program,
            outputs: self.output_paths().collect(),
            simulations: 0,
            shared: &self.shared,
            json: &self.json,
        };
        measuring.run_measurement(
            self.find_usage_problem(),
            |under| self.solve_axes(under),
            |ran| ran.table.to_text(),
            |ran, findings, outputs| self.write_outputs(ran, findings, outputs),
        )
    }

    fn output_paths(&self) -> impl Iterator<Item = &Path> {
        let all = [&self.csv, &self.npy, &self.plot];
        all.into_iter().filter_map(|path| path.as_deref()).chain(self.json.path())
    }

    fn find_usage_problem(&self) -> Option<String> {
        let standard = Path::new(STANDARD);
        if self.program == standard && self.setup == standard {
            return Some("standard input can be read only once".into());
        }
        if self.npy.as_deref() == Some(standard) {
            return Some("--npy needs a file".into());
        }
        let outputs: Vec<&Path> = self.output_paths().collect();
        let twice = outputs
            .iter()
            .enumerate()
            .find(|(index, one)| outputs.iter().skip(index + 1).any(|other| other == *one));
        if let Some((_, twice)) = twice {
            return Some(format!("two outputs would go to {}", twice.display()));
        }
        find_wrong_ending([
            ("--csv", self.csv.as_deref(), OutputContent::Csv),
            ("--json", self.json.path(), OutputContent::Json),
            ("--npy", self.npy.as_deref(), OutputContent::Array),
            ("--plot", self.plot.as_deref(), OutputContent::Drawing),
        ])
    }

    fn solve_axes(&self, under: &mut MeasuringContext<'_>) -> Result<AxesOutcome, Stop> {
        let setup = input_files::read_setup(&self.setup)?;
        let mut inputs = vec![self.program.as_path(), &self.setup];
        inputs.extend(setup.referenced_files());
        refuse_overwritten_input(self.output_paths(), &inputs)?;
        under.outputs_are_checked = true;
        let machine = &setup.machine;
        let (Some(search), Some(dynamics)) = (machine.fault_search(), machine.dynamics()) else {
            let message = format!("the machine of {} has no axes", self.setup.display());
            return Err(Diagnostic::new(codes::MACHINE_WITHOUT_AXES, message).into());
        };
        let program = under.read_program(&self.program, &setup)?;
        let units = ResolvedLengthUnit::from_program(&program, self.shared.units).unit;
        let table = JointTable::from_program(&program, search.chain, &dynamics, units)
            .shown_in(self.shared.display.of_program(units).shown_in);
        let along = match self.along {
            JointAbscissaArg::Time => JointAbscissa::Time,
            JointAbscissaArg::Line => JointAbscissa::Line,
        };
        let drawn = match &self.plot {
            Some(path) => {
                let failed = |error: io::Error| Diagnostic::new(codes::UNWRITABLE, error.to_string());
                draw_joints(&table, along).and_then(|svg| encode_drawing(path, svg)).map_err(failed)?
            }
            None => Vec::new(),
        };
        Ok(AxesOutcome { table, drawn })
    }

    fn write_outputs(
        &self,
        ran: &AxesOutcome,
        findings: &[Diagnostic],
        outputs: &CommandOutputs,
    ) -> Result<(), Stop> {
        type Writer<'a> = Box<dyn Fn(&mut dyn Write) -> io::Result<()> + 'a>;
        let all: [(Option<&Path>, Writer<'_>); 4] = [
            (self.csv.as_deref(), Box::new(|out| ran.table.write_csv(out))),
            (self.json.path(), Box::new(|out| out.write_all(ran.table.to_json(findings).as_bytes()))),
            (self.npy.as_deref(), Box::new(|out| ran.table.write_npy(out))),
            (self.plot.as_deref(), Box::new(|out| out.write_all(&ran.drawn))),
        ];
        for (path, write_all) in &all {
            if let Some(path) = path {
                outputs.write_output(path, write_all)?;
            }
        }
        Ok(())
    }
}

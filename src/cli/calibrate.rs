//! This module runs `clsmith calibrate`.

use super::command_exit::CommandExit;
use super::command_outputs::{CommandOutputs, refuse_overwritten_input};
use super::input_files;
use super::measuring_args::MeasuringArgs;
use super::measuring_command::{MeasuringCommand, MeasuringContext};
use super::output_args::JsonArgs;
use super::output_endings::{OutputContent, find_wrong_ending};
use super::plot::encode_drawing;
use super::stop::Stop;
use clap::{Args, ValueEnum};
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::report::calibration::{Calibration, EdgeTerms, read_measured_forces};
use clsmith::report::stats::ResolvedLengthUnit;
use clsmith::setup::Setup;
use clsmith::simulation_run::Machining;
use std::io;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  clsmith calibrate cuts.csv slots.cls --setup shop.yaml                    coefficients and residuals
  clsmith calibrate cuts.csv slots.cls --setup shop.yaml -o my-steel.yaml   and a material file
  clsmith calibrate cuts.csv slots.cls --setup shop.yaml --edge one-number --plot residuals.svg

The table is CSV with a head, and `#` before comments. A row picks motions by `line`, or by `line_from` and `line_to`, or
by `operation`, and of one motion a stretch by `from_mm` and `to_mm`. It carries means over these motions: fx_mean_N,
fy_mean_N, fz_mean_N (forces on the workpiece in program axes), power_kW (without idle), or spindle_current_A with
idle_current_A; it may have a `weight`. A power counts where a row has no forces; beside forces it, and every current,
is compared with what the forces explain. The setup's material is the first guess, and the source of what the rows do
not tell. Where all rows have the same chips, K_c and K_e are not told apart: --edge says what is done then.";

/// Fits the coefficients of a material to measured forces
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct CalibrateArgs {
    /// The measured means
    #[arg(value_name = "MEASURED.csv")]
    measured: PathBuf,
    /// The program that was measured
    #[arg(value_name = "PROGRAM")]
    program: PathBuf,
    /// The setup file: stock, tools, and a guess of the material
    #[arg(long, value_name = "FILE")]
    setup: PathBuf,
    /// Where edge terms come from that the rows do not tell apart
    #[arg(long, value_name = "HOW", value_enum, default_value_t = EdgeArg::Keep)]
    edge: EdgeArg,
    /// The day of the measurement, for the material file; today if it is not given
    #[arg(long, value_name = "DATE")]
    date: Option<String>,
    /// The material file
    #[arg(short, long, value_name = "FILE", help_heading = "Outputs")]
    output: Option<PathBuf>,
    #[command(flatten)]
    json: JsonArgs,
    /// The residuals of the rows, as SVG, or as PNG if the file ends in .png
    #[arg(long, value_name = "FILE", help_heading = "Outputs")]
    plot: Option<PathBuf>,
    #[command(flatten)]
    pub(in crate::cli) shared: MeasuringArgs,
}

/// What is done where a cutting coefficient and its edge term cannot be told apart.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum EdgeArg {
    /// The edge terms of the setup's material stay
    Keep,
    /// One number is fitted for both
    OneNumber,
}

impl CalibrateArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        let measuring = MeasuringCommand {
            program: &self.program,
            outputs: self.output_paths().collect(),
            json: &self.json,
            simulations: 1,
            shared: &self.shared,
        };
        let wrong = find_wrong_ending([
            ("--plot", self.plot.as_deref(), OutputContent::Drawing),
            ("--json", self.json.path(), OutputContent::Json),
        ]);
        measuring.run_measurement(
            wrong,
            |under| self.calibrate(under),
            Calibration::to_text,
            |calibration, findings, outputs| self.write_outputs(calibration, findings, outputs),
        )
    }

    fn output_paths(&self) -> impl Iterator<Item = &Path> {
        let named = [&self.output, &self.plot].into_iter().filter_map(|path| path.as_deref());
        named.chain(self.json.path())
    }

    fn calibrate(&self, under: &mut MeasuringContext<'_>) -> Result<Calibration, Stop> {
        let table = input_files::read_source(&self.measured)?;
        let setup = Setup::load(&input_files::read_source(&self.setup)?)?;
        let mut inputs = vec![self.measured.as_path(), &self.program, &self.setup];
        inputs.extend(setup.referenced_files());
        refuse_overwritten_input(self.output_paths(), &inputs)?;
        under.outputs_are_checked = true;
        let rows = read_measured_forces(&table)?;
        let setup =
            setup.read_machine_file(input_files::read_bytes)?.read_material_file(input_files::read_bytes)?;
        let program = under.read_program(&self.program, &setup)?;
        let units = ResolvedLengthUnit::from_program(&program, self.shared.units).unit;
        let machining = Machining::new(&program, &setup, units, under.findings)?;
        let edge = match self.edge {
            EdgeArg::Keep => EdgeTerms::Keep,
            EdgeArg::OneNumber => EdgeTerms::OneNumber,
        };
        Ok(Calibration::fit_rows(&machining, (&table, rows), edge, under.progress, under.findings)?)
    }

    fn write_outputs(
        &self,
        calibration: &Calibration,
        findings: &[Diagnostic],
        outputs: &CommandOutputs,
    ) -> Result<(), Stop> {
        if let Some(path) = &self.output {
            let [table, program] = [&self.measured, &self.program].map(|path| path.to_string_lossy());
            let source = format!("measured means of {table} on the cuts of {program}");
            let date = self.date.clone().unwrap_or_else(today);
            let text = calibration.to_material_file(&source, &date);
            outputs.write_output(path, |out| out.write_all(text.as_bytes()))?;
        }
        if let Some(path) = self.json.path() {
            outputs.write_output(path, |out| out.write_all(calibration.to_json(findings).as_bytes()))?;
        }
        if let Some(path) = &self.plot {
            let failed = |error: io::Error| Diagnostic::new(codes::UNWRITABLE, error.to_string());
            let drawing = calibration.draw().and_then(|svg| encode_drawing(path, svg)).map_err(failed)?;
            outputs.write_output(path, |out| out.write_all(&drawing))?;
        }
        Ok(())
    }
}

/// Returns the day in universal time.
fn today() -> String {
    jiff::Timestamp::now().strftime("%Y-%m-%d").to_string()
}

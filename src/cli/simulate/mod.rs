//! This module runs `clsmith simulate`.

mod outputs;
mod stop_line;

use crate::cli::bad_argument::BadArgument;
use crate::cli::command_exit::CommandExit;
use crate::cli::input_files;
use crate::cli::line_range::parse_line_range;
use crate::cli::measuring_args::MeasuringArgs;
use crate::cli::measuring_command::{MeasuringCommand, MeasuringContext, ProgramSimulation};
use crate::cli::output_args::JsonArgs;
use crate::cli::plot::encode_drawing;
use crate::cli::progress::CommandProgress;
use crate::cli::report_args::ReportArgs;
use crate::cli::stop::Stop;
use clap::{Args, ValueEnum};
use clsmith::diagnostic::{Diagnostic, Failure, codes};
use clsmith::parameters::LengthUnit;
use clsmith::program::Program;
use clsmith::report::comparison::{ComparisonRuns, ComparisonSubject};
use clsmith::report::simulation::{self, SimulationReport, time_plot};
use clsmith::report::stats::ResolvedLengthUnit;
use clsmith::setup::Setup;
use clsmith::simulation_run::{Machining, SimulationBudget, SimulationRunOptions};
use clsmith::source::Source;
use clsmith::stock::Mesh;
use std::io;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};
use std::sync::Arc;

const EXAMPLES: &str = "\
Examples:
  clsmith simulate part.cls --setup shop.yaml                       what is cut, how hard, what collides
  clsmith simulate part.cls --setup shop.yaml --csv loads.csv       one row a motion
  clsmith simulate part.cls --setup shop.yaml --csv - | head        the same to standard output
  clsmith simulate part.cls --setup shop.yaml --json | jq .tools    the same for programs
  clsmith simulate part.cls --setup shop.yaml --target part.stl     gouges and excess against the part
  clsmith simulate part.cls --setup shop.yaml --until 1250 --stl there.stl   the stock at a line
  clsmith simulate op1.cls --setup shop.yaml --save-stock op1.clstock --stl left.stl
  clsmith simulate new.cls --setup shop.yaml --plot loads.svg --plot-before old.cls
  clsmith simulate part.cls --setup shop.yaml --report loads.html   charts and the path in 3D, as a page
  clsmith simulate part.cls --setup shop.yaml --forces-along 0.5mm --csv forces.csv    forces inside motions
  clsmith simulate part.cls --setup shop.yaml --tooth-period 12 --csv turn.csv --plot turn.svg
  clsmith simulate part.cls --setup shop.yaml --edges 12..14 --csv edges.csv --plot edges.png   chips along edges

The setup says stock, tools and material: see configs/README.md. Outputs appear whole or not at all, never
over an input. They are written also when errors were found (a collision is one), with exit code 1; only
--save-stock is not. `--allow CL0511` lets collisions pass.
Lengths are in the unit of the program, or in that of --display-units; of a program in inches the names end in _in.
The columns of the CSV: line, operation, tool, length_mm, feed_mm_min, chip_thickness_mm,
chip_thickness_bound_mm, removal_rate_mean_mm3_min, removal_rate_peak_mm3_min, axial_depth_mm, radial_depth_mm,
engagement_start_deg, engagement_end_deg, f_resultant_peak_n, torque_peak_nm, power_peak_kw, machine_time_s,
standing_time_s; then, of forces on the workpiece in program axes, fx_mean_n, fy_mean_n, fz_mean_n, their least and
largest values over a revolution (fx_min_n, fx_max_n, ...), means along the feed, to its left and along the tool axis
(f_feed_mean_n, f_normal_mean_n, f_axial_mean_n; the first two are empty for a plunge), f_resultant_mean_n,
bending_mean_n and bending_peak_n across the tool axis, torque_mean_nm, power_mean_kw. Where the setup says how stiff the
tool is: deflection_mean_mm and deflection_peak_mm of its tip, bending_stress_peak_mpa, and what the deflection leaves on
walls, surface_error_left_peak_mm and surface_error_right_peak_mm (above 0 where material stays). A mean is over the time of the
motion, a peak the largest value of any rotation; power_peak_kw is the largest mean power of a revolution.
With --forces-along the table has a row for each stretch of each cutting motion instead (along_from_mm, along_to_mm,
forces in its middle); with --tooth-period the forces of one revolution in the middle of a motion (angle_deg, fx_n,
fy_n, fz_n, torque_nm), and --plot draws them; with --edges the chips of edges there (line, tooth, rotation_deg,
along_mm from the tip along the edge, height_mm, radius_mm, chip_thickness_mm). Teeth that cut alike have one map. The bound is what the
thickest chip may be at most: a point is proved to cut with chip_thickness, and none with more than the bound. Where that
cannot be proved, or with --chips columns, both are what columns tell, and the summary says so. The mean of the removal rate is over the
motion, the peak over eight cells of path, at least 0.5 mm, also across the ends of motions. An empty cell is a
value that is not known.";

/// Removes the stock motion by motion: chips, depths, forces, collisions, remaining stock
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct SimulateArgs {
    /// The program; `-` is standard input
    #[arg(value_name = "PROGRAM")]
    program: PathBuf,
    /// The setup file: stock, tools, material, machine
    #[arg(long, value_name = "FILE")]
    setup: PathBuf,
    /// The motions as a table; `-` is standard output
    #[arg(long, value_name = "FILE", help_heading = "Outputs")]
    csv: Option<PathBuf>,
    #[command(flatten)]
    json: JsonArgs,
    /// The remaining stock, as a binary STL in mm
    #[arg(long, value_name = "FILE", help_heading = "Outputs")]
    stl: Option<PathBuf>,
    /// The remaining stock, as the stock of the next program
    #[arg(long, value_name = "FILE", help_heading = "Outputs")]
    save_stock: Option<PathBuf>,
    /// Thickest chips and feeds over time, as SVG, or as PNG if the file ends in .png
    #[arg(long, value_name = "FILE", help_heading = "Outputs")]
    plot: Option<PathBuf>,
    /// A second program that is drawn behind the first one, in grey
    #[arg(long, value_name = "PROGRAM", requires = "plot", help_heading = "Outputs")]
    plot_before: Option<PathBuf>,
    #[command(flatten)]
    reports: ReportArgs,
    /// The target part: a closed STL in the coordinates and the unit of the program
    #[arg(long, value_name = "FILE")]
    target: Option<PathBuf>,
    /// How far the remaining stock may be off the target; by default a cell
    #[arg(long, value_name = "MM", value_parser = parse_positive, requires = "target")]
    tolerance: Option<f64>,
    /// End with the statement on this line of the file: the stock, its outputs and all figures are those of that moment
    #[arg(long, value_name = "LINE", value_parser = clap::value_parser!(usize))]
    until: Option<usize>,
    /// Distance between the columns of the stock; by default a fortieth of the smallest cutter
    #[arg(long, value_name = "MM", value_parser = parse_positive)]
    cell: Option<f64>,
    /// Forces on stretches inside motions that are no longer than this, as `--csv` and in `--json`
    #[arg(long, value_name = "LENGTH", value_parser = parse_length_mm, conflicts_with = "tooth_period")]
    forces_along: Option<f64>,
    /// Forces over one revolution in the middle of the motion that ends at this line, as `--csv`, `--plot` and in `--json`
    #[arg(long, value_name = "LINE", conflicts_with = "plot_before")]
    tooth_period: Option<usize>,
    /// Chip thickness over each edge and one revolution in the middle of the motions at feed that end on these lines (A..B
    /// or A), as `--csv` and in `--json`; `--plot` draws maps, and the edges in the stock at that moment
    #[arg(long, value_name = "LINE[..LINE]", value_parser = parse_line_range, conflicts_with_all = ["tooth_period", "forces_along", "plot_before"])]
    edges: Option<RangeInclusive<usize>>,
    /// How thickest chips are found: certified is proved from the motions, columns is a quicker estimate
    #[arg(long, value_name = "HOW", value_enum, default_value_t = ChipsArg::Certified)]
    chips: ChipsArg,
    /// The memory for the stock alone, as earlier versions had it
    #[arg(long, value_name = "GIB", value_parser = parse_positive, hide = true, conflicts_with = "memory")]
    budget: Option<f64>,
    #[command(flatten)]
    pub(in crate::cli) shared: MeasuringArgs,
}

/// How thickest chips are found.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum ChipsArg {
    /// From the motions themselves: one point is known to have the chip, and none has more than the bound
    Certified,
    /// From the columns: quicker, and only as good as they are fine
    Columns,
}

/// Reads a positive number.
pub(super) fn parse_positive(text: &str) -> Result<f64, BadArgument> {
    let value = text.parse::<f64>().ok().filter(|value| *value > 0.0 && value.is_finite());
    value.ok_or(BadArgument::new("this must be a number above 0"))
}

/// Reads a length above 0 with its unit, mm or in; without one it is in mm.
fn parse_length_mm(text: &str) -> Result<f64, BadArgument> {
    let text = text.trim();
    let (number, mm_per_unit) = if let Some(number) = text.strip_suffix("mm") {
        (number, 1.0)
    } else if let Some(number) = text.strip_suffix("inch").or(text.strip_suffix("in")) {
        (number, 25.4)
    } else {
        (text, 1.0)
    };
    let value = number.trim().parse::<f64>().ok().map(|value| value * mm_per_unit);
    let value = value.filter(|value| *value >= 1e-3 && value.is_finite());
    value.ok_or(BadArgument::new("this must be a length of a micrometre or more, such as 0.5mm or 0.02in"))
}

/// A simulation with its inputs.
struct SimulateOutcome {
    program: Program,
    setup: Setup,
    setup_file: Arc<Source>,
    runs: ComparisonRuns,
    drawn: Option<Vec<u8>>,
    /// The unit that readers see.
    shown_in: LengthUnit,
}

impl SimulateOutcome {
    /// Returns the inputs of reports.
    fn report_subject<'a>(
        &'a self,
        units: Option<LengthUnit>,
        findings: &'a [Diagnostic],
    ) -> ComparisonSubject<'a> {
        ComparisonSubject {
            before: None,
            program: &self.program,
            recipe: None,
            setup: &self.setup,
            setup_files: std::slice::from_ref(&self.setup_file),
            units,
            shown_in: Some(self.shown_in),
            findings,
            reports: &[],
            print: None,
        }
    }
}

impl SimulateArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        let measuring = MeasuringCommand {
            program: &self.program,
            outputs: self.output_paths().collect(),
            json: &self.json,
            simulations: (1 + usize::from(self.plot_before.is_some()))
                * (1 + usize::from(self.chips == ChipsArg::Certified)),
            shared: &self.shared,
        };
        measuring.run_measurement(
            self.find_usage_problem(),
            |under| self.simulate_and_draw(under),
            |ran| ran.runs.after.as_ref().map(simulation::to_text).unwrap_or_default(),
            |ran, findings, outputs| self.write_outputs(ran, findings, outputs),
        )
    }

    /// Simulates the program, and draws its loads if that is wanted. Findings that do not stop the run are
    /// added to those of `under`.
    fn simulate_and_draw(&self, under: &mut MeasuringContext<'_>) -> Result<SimulateOutcome, Stop> {
        let setup_file = input_files::read_source(&self.setup)?;
        let setup = Setup::load(&setup_file)?;
        self.check_outputs(&setup)?;
        under.outputs_are_checked = true;
        let setup =
            setup.read_machine_file(input_files::read_bytes)?.read_material_file(input_files::read_bytes)?;
        let program = under.read_program(&self.program, &setup)?;
        // The whole program was judged: what an unfinished one lacks is no fault.
        let program = match self.until {
            Some(line) => stop_line::end_program_at_line(&program, line, &setup)?,
            None => program,
        };
        let units = ResolvedLengthUnit::from_program(&program, self.shared.units).unit;
        let target = self.target.as_deref().map(|path| read_target(path, units)).transpose()?;
        let mut simulated = self.simulate_program(&program, &setup, under.progress, under.findings)?;
        self.find_inner_forces(&program, &setup, &mut simulated, under.progress)?;
        let shown_in = simulated.units.shown_in;
        under.findings.append(&mut simulated.findings);
        if let (Some(mesh), Some(path)) = (target, &self.target) {
            simulated.compare_with_target(&mesh, &path.to_string_lossy(), self.tolerance);
            under.findings.append(&mut simulated.findings);
        }
        let drawn = match &self.plot {
            Some(path) => Some(self.draw_loads(path, &simulated, &setup, under)?),
            None => None,
        };
        Ok(SimulateOutcome {
            program,
            setup,
            setup_file,
            runs: ComparisonRuns { after: Some(simulated), ..ComparisonRuns::default() },
            drawn,
            shown_in,
        })
    }

    /// Finds forces inside motions, if they are asked for.
    fn find_inner_forces(
        &self,
        program: &Program,
        setup: &Setup,
        simulated: &mut SimulationReport,
        progress: &CommandProgress,
    ) -> Result<(), Stop> {
        if self.forces_along.is_none() && self.tooth_period.is_none() && self.edges.is_none() {
            return Ok(());
        }
        let units = ResolvedLengthUnit::from_program(program, self.shared.units).unit;
        // What is to be said about tools and stock was said of the first run.
        let machining = Machining::new(program, setup, units, &mut Vec::new())?;
        if let Some(spacing) = self.forces_along {
            simulated.find_forces_along(&machining, spacing, progress)?;
        }
        if let Some(line) = self.tooth_period {
            simulated.find_tooth_period(&machining, line, progress)?;
        }
        if let Some(lines) = &self.edges {
            simulated.find_edge_maps(&machining, lines, progress)?;
            if self.plot.is_some() {
                simulated.check_edge_drawing()?;
                simulated.find_stock_at_edges(&machining, &self.run_options(), progress)?;
            }
        }
        Ok(())
    }

    fn draw_loads(
        &self,
        path: &Path,
        simulated: &SimulationReport,
        setup: &Setup,
        under: &mut MeasuringContext<'_>,
    ) -> Result<Vec<u8>, Stop> {
        let failed = |error: io::Error| Diagnostic::new(codes::UNWRITABLE, error.to_string());
        if let Some(period) = &simulated.tooth_period {
            let drawn = simulation::draw_tooth_period(period);
            return Ok(drawn.and_then(|svg| encode_drawing(path, svg)).map_err(failed)?);
        }
        if let Some(drawn) = simulation::draw_edge_maps(simulated).map_err(failed)? {
            return Ok(encode_drawing(path, drawn).map_err(failed)?);
        }
        let mut series = Vec::new();
        if let Some(path) = &self.plot_before {
            let before = under.read_background_program(path, setup)?;
            let before = self.simulate_program(&before, setup, under.progress, &mut Vec::new())?;
            series.push(before.to_time_series(path.to_string_lossy()));
        }
        series.push(simulated.to_time_series(simulated.file.as_str()));
        Ok(time_plot::draw_time_series(&series).and_then(|svg| encode_drawing(path, svg)).map_err(failed)?)
    }

    fn run_options(&self) -> SimulationRunOptions {
        let options = SimulationRunOptions::default().with_cell_mm(self.cell);
        let Some(gib) = self.budget else { return options };
        let bytes = (gib * f64::from(1 << 30)) as u64;
        options.with_budget(SimulationBudget::default().with_bytes(bytes))
    }

    fn simulate_program(
        &self,
        program: &Program,
        setup: &Setup,
        progress: &CommandProgress,
        findings: &mut Vec<Diagnostic>,
    ) -> Result<SimulationReport, Stop> {
        let simulation = ProgramSimulation {
            setup,
            units: self.shared.units,
            options: self.run_options(),
            certified: self.chips == ChipsArg::Certified,
            progress,
        };
        let mut simulated = simulation.simulate_program(program, findings)?;
        let units = ResolvedLengthUnit::from_program(program, self.shared.units).unit;
        simulated.units = self.shared.display.of_program(units);
        Ok(simulated)
    }
}

/// Reads a target part from an STL whose lengths are in `units`.
fn read_target(path: &Path, units: LengthUnit) -> Result<Arc<Mesh>, Failure> {
    let source = input_files::read_source(path)?;
    let mesh = Machining::read_target_part(source.bytes(), units).map_err(|error| {
        let message = format!("the target {} cannot be used: {error}", path.display());
        let help = "The file must be a closed STL, in the coordinates and the unit of the program.";
        Diagnostic::new(codes::STOCK_FILE, message).with_help(help)
    })?;
    Ok(mesh)
}

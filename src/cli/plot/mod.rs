//! This module runs `clsmith plot`.

mod outputs;

use crate::cli::command_exit::CommandExit;
use crate::cli::command_outputs::CommandOutputs;
use crate::cli::input_files;
use crate::cli::judged_program::JudgedProgram;
use crate::cli::line_range::parse_line_range;
use crate::cli::measuring_args::MeasuringArgs;
use crate::cli::measuring_command::ProgramSimulation;
use crate::cli::output_args::JsonArgs;
use crate::cli::progress::CommandProgress;
use crate::cli::stop::Stop;
use clap::{Args, ValueEnum};
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::parameters::LengthUnit;
use clsmith::program::Program;
use clsmith::report::DisplayUnits;
use clsmith::report::finding_policy::FindingPolicy;
use clsmith::report::plot::{self, CurvePanel, PlotAbscissa, PlotQuantity, PlottedProgram};
use clsmith::report::simulation::SimulationReport;
use clsmith::report::stats::ResolvedLengthUnit;
use clsmith::setup::Setup;
use clsmith::simulation_run::SimulationRunOptions;
use std::io;
use std::ops::RangeInclusive;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  clsmith plot part.cls -o feed.svg                                    feed and z along time
  clsmith plot part.cls --after out.cls --of feed,z --along path -o both.png
  clsmith plot part.cls --after out.cls --setup shop.yaml --of chip,feed,power -o loads.png
  clsmith plot part.cls --setup shop.yaml --of chip,z --lines 1200..1450 --along block -o layer.svg
  clsmith plot part.cls --setup shop.yaml --criteria chip_thickness,removal_rate,force -o criteria.svg
  clsmith plot part.cls -o feed.svg --json | jq .panels                what was drawn, for programs

chip, removal, force, torque and power are simulated, and need stock and tools: see configs/README.md. The ending of
the output says what it is, .svg or .png; `-` is SVG on standard output. The same bytes come out whatever the machine.";

/// Draws feed, chips, loads or z of a program over time or path, as SVG or PNG
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct PlotArgs {
    /// The program; `-` is standard input
    #[arg(value_name = "PROGRAM")]
    program: PathBuf,
    /// A second program that is drawn over the first, which is grey then
    #[arg(long, value_name = "PROGRAM")]
    after: Option<PathBuf>,
    /// A setup file: stock and tools, and the feed of rapids
    #[arg(long, value_name = "FILE")]
    setup: Option<PathBuf>,
    /// What to draw, with a panel for each quantity; criteria of `optimize_feed` have their names there, too
    #[arg(
        long,
        value_enum,
        value_name = "WHAT",
        value_delimiter = ',',
        default_value = "feed,z",
        visible_alias = "criteria"
    )]
    of: Vec<PlotQuantityArg>,
    /// The horizontal axis
    #[arg(long, value_enum, value_name = "AXIS", default_value = "time")]
    along: PlotAxisArg,
    /// Draw only motions on these lines of the file: A..B, A.., ..B or A. The axis begins at the first of them
    #[arg(long, value_name = "A..B", value_parser = parse_line_range)]
    lines: Option<RangeInclusive<usize>>,
    /// Where to write: a file that ends in .svg or .png, or `-` for SVG on standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    #[command(flatten)]
    json: JsonArgs,
    #[command(flatten)]
    pub(in crate::cli) shared: MeasuringArgs,
}

/// The quantity of the vertical axis.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum PlotQuantityArg {
    /// Programmed feed
    Feed,
    /// Thickest chip
    #[value(alias = "chip_thickness")]
    Chip,
    /// Removal rate
    #[value(alias = "removal_rate")]
    Removal,
    /// Cutting force, N
    Force,
    /// Torque, N m
    Torque,
    /// Power, kW
    #[value(alias = "load")]
    Power,
    /// Deflection of the tool's tip, where the setup says how stiff it is
    Deflection,
    /// Bending stress of the tool, MPa
    #[value(alias = "bending_stress")]
    Stress,
    /// Height of the tip
    Z,
}

impl PlotQuantityArg {
    fn quantity(self) -> PlotQuantity {
        match self {
            Self::Feed => PlotQuantity::Feed,
            Self::Chip => PlotQuantity::Chip,
            Self::Removal => PlotQuantity::Removal,
            Self::Force => PlotQuantity::Force,
            Self::Torque => PlotQuantity::Torque,
            Self::Power => PlotQuantity::Power,
            Self::Deflection => PlotQuantity::Deflection,
            Self::Stress => PlotQuantity::Stress,
            Self::Z => PlotQuantity::Z,
        }
    }
}

/// The quantity of the horizontal axis.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum PlotAxisArg {
    /// Time, s; without dwells and acceleration
    Time,
    /// Length of the path
    Path,
    /// Number of the block
    Block,
}

impl PlotAxisArg {
    fn abscissa(self) -> PlotAbscissa {
        match self {
            Self::Time => PlotAbscissa::Time,
            Self::Path => PlotAbscissa::Path,
            Self::Block => PlotAbscissa::Block,
        }
    }
}

/// Returns whether a drawing is written as PNG.
pub(super) fn is_png(path: &Path) -> bool {
    path.extension().is_some_and(|end| end.eq_ignore_ascii_case("png"))
}

/// Encodes a drawing in the format of the file's extension.
pub(super) fn encode_drawing(path: &Path, svg: String) -> io::Result<Vec<u8>> {
    if is_png(path) { plot::render_png(&svg) } else { Ok(svg.into_bytes()) }
}

/// A drawing, with remarks about what is missing in it.
struct PlotDrawing {
    /// The drawing. It is `None` if no panel has a curve.
    svg: Option<String>,
    /// A sentence for each panel without a curve.
    empty: Vec<String>,
    /// The panels, with what they show.
    panels: Vec<(PlotQuantity, CurvePanel)>,
    /// The units that a reader sees.
    units: DisplayUnits,
}

/// Explains why a panel is empty, and how to fill it.
fn explain_empty_panel(
    plotted: &[PlottedProgram<'_>],
    quantity: PlotQuantity,
    along: PlotAbscissa,
    units: DisplayUnits,
) -> String {
    let name = quantity.name();
    if along != PlotAbscissa::Time {
        return format!("the panel of {name} is empty, because no value is known");
    }
    let helps =
        !plot::build_panels(plotted, &[quantity], PlotAbscissa::Path, units).iter().all(CurvePanel::is_empty);
    let help = if helps { "; try --along path" } else { "" };
    format!("the panel of {name} is empty, because no value is known over time{help}")
}

impl PlotArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        self.find_usage_problem().map_or(Ok(()), |problem| Err(Stop::Usage(problem)))?;
        let policy = self.shared.findings.build_policy()?;
        let programs = [&self.program].into_iter().chain(&self.after).map(PathBuf::as_path);
        let outputs = CommandOutputs::default().for_inputs(programs);
        self.shared.limits.threads().start_threads()?;
        let progress =
            CommandProgress::new(self.shared.progress, outputs.interrupt(), self.shared.limits.of_run())
                .with_simulations(1 + usize::from(self.after.is_some()));
        outputs.stop_on_ctrl_c(progress.clear_on_ctrl_c())?;
        let mut findings = Vec::new();
        progress.begin_program(&self.program.to_string_lossy());
        let setup = self.read_setup();
        // A setup that cannot be read may name the file of the JSON as one of its own.
        let may_write_json = setup.is_ok() || self.json.is_surely_no_input();
        let drawn = setup.and_then(|setup| self.draw_panels(&setup, &policy, &progress, &mut findings));
        progress.clear_bar();
        let drawn = match drawn {
            Ok(drawn) => Some(drawn),
            Err(Stop::Found { findings: found, .. }) => {
                findings.extend(found);
                None
            }
            Err(stop) => return Err(stop),
        };
        let mut findings = policy.apply(findings);
        if !findings.is_empty() {
            self.show_findings(&findings)?;
        }
        let written = match self.write_drawing(drawn.as_ref(), &outputs) {
            Err(Stop::Found { findings: unwritten, .. }) => {
                self.show_findings(&unwritten)?;
                findings.extend(unwritten);
                false
            }
            written => written?,
        };
        if may_write_json {
            self.write_json(drawn.as_ref(), written, &findings)?;
        }
        // The drawing is written even if there are errors, because it shows what is wrong.
        let refused = !written || findings.iter().any(Diagnostic::is_error);
        Ok(if refused { CommandExit::Errors } else { CommandExit::Done })
    }

    /// Reads the setup, and checks that no output is an input or a file that the setup names.
    fn read_setup(&self) -> Result<Setup, Stop> {
        let setup = match &self.setup {
            Some(path) => input_files::read_setup(path)?.read_material_file(input_files::read_bytes)?,
            None => Setup::default(),
        };
        self.check_outputs(&setup)?;
        Ok(setup)
    }

    fn draw_panels(
        &self,
        setup: &Setup,
        policy: &FindingPolicy,
        progress: &CommandProgress,
        findings: &mut Vec<Diagnostic>,
    ) -> Result<PlotDrawing, Stop> {
        let mut programs = Vec::new();
        for path in std::iter::once(&self.program).chain(&self.after) {
            let source = progress.read_program(path)?;
            let asked = self.setup.is_some().then_some(setup);
            let (dialect, units) = (self.shared.dialect, self.shared.units);
            let judged = JudgedProgram::read_source(&source, dialect, units, asked, policy);
            findings.extend(judged.findings);
            if judged.is_unread {
                // The findings that stop the run are in `findings` already.
                return Err(Vec::new().into());
            }
            // Other faults do not stop it, because the drawing shows them.
            programs.push(judged.program);
        }
        let quantities: Vec<PlotQuantity> = self.of.iter().map(|what| what.quantity()).collect();
        let wanted = quantities.iter().any(|quantity| quantity.is_simulated());
        let simulation = ProgramSimulation {
            setup,
            units: self.shared.units,
            options: SimulationRunOptions::default(),
            certified: quantities.contains(&PlotQuantity::Chip),
            progress,
        };
        let mut runs: Vec<Option<SimulationReport>> = Vec::new();
        for program in &programs {
            let run = wanted.then(|| simulation.simulate_program(program, findings));
            let mut run = run.transpose()?;
            findings.extend(run.iter_mut().flat_map(|simulated| simulated.findings.drain(..)));
            runs.push(run);
        }
        let plotted = |(program, run)| {
            let program: &Program = program;
            let run: &Option<SimulationReport> = run;
            PlottedProgram {
                name: program.source().name(),
                program,
                units: ResolvedLengthUnit::from_program(program, self.shared.units).unit,
                setup,
                simulated: run.as_ref(),
                lines: self.lines.as_ref().map(|lines| (*lines.start(), *lines.end())),
            }
        };
        let plotted: Vec<PlottedProgram<'_>> = programs.iter().zip(&runs).map(plotted).collect();
        let along = self.along.abscissa();
        // The last program is drawn in front, so its unit is shown.
        let program_unit = plotted.last().map_or(LengthUnit::Mm, |last| last.units);
        let units = self.shared.display.of_program(program_unit);
        let panels = plot::build_panels(&plotted, &quantities, along, units);
        let empty = |(quantity, panel): (&PlotQuantity, &CurvePanel)| {
            panel.is_empty().then(|| explain_empty_panel(&plotted, *quantity, along, units))
        };
        let empty: Vec<String> = quantities.iter().zip(&panels).filter_map(empty).collect();
        let svg = match empty.len() == panels.len() {
            true => None,
            false => Some(
                plot::draw_curve_panels(&along.axis_title(units), &panels)
                    .map_err(|error| Diagnostic::new(codes::UNWRITABLE, error.to_string()))?,
            ),
        };
        Ok(PlotDrawing { svg, empty, panels: quantities.into_iter().zip(panels).collect(), units })
    }
}

//! This module runs `clsmith section`.

mod billet_setup;
mod command_line;
mod options;
mod outputs;

use super::closed_pipe::ignore_closed_pipe;
use super::command_exit::CommandExit;
use super::command_outputs::CommandOutputs;
use super::finding_args::FindingArgs;
use super::input_files;
use super::run_limits::LimitArgs;
use super::terminal;
use crate::cli::bad_argument::BadArgument;
use crate::cli::output_args::JsonArgs;
use crate::cli::progress::{CommandProgress, ProgressArgs};
use crate::cli::stop::Stop;
use clap::{Args, ValueEnum};
use clsmith::diagnostic::{Diagnostic, Failure, codes};
use clsmith::program::{Dialect, LengthUnit};
use clsmith::report::finding_policy::FindingPolicy;
use clsmith::report::simulation::SimulationReport;
use clsmith::report::surface_milling as report;
use clsmith::stock::Mesh;
use clsmith::surface_milling::{
    self, SurfaceMillingOptions, SurfacePart, SurfaceProgram, load_profile, make_watched_surface_program,
};
use std::io;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  clsmith section part.stl --plane zx --step 0.5 --radius 5 --tolerance 0.005 --feed 800 -o part.cls
  clsmith section part.stl --plane 30 --step 0.4 --radius 3 --feed 1200 --pattern one-way -o part.aptsource
  clsmith section --profile profile.yaml --from 0 --to 40 --step 0.5 --radius 5 --feed 800 -o part.ncl
  clsmith section part.stl --step 0.5 --radius 5 --feed 800 --dry-run --plot paths.svg
  clsmith section part.stl --step 0.5 --radius 5 --feed 800 --dry-run --json | jq .surface
  clsmith section part.stl --step 0.5 --radius 5 --feed 800 --spindle 8000 --teeth 2 --allowance 1 --save-setup part.yaml
      --simulate -o part.cls                                     with its billet, and how far what is left is off

Planes stand upright: zx along x (counted by y), yz along y (counted by x), or at an angle in degrees from x
(counted to the left of it). The ball's tip follows the part's top so that the ball touches it everywhere it can;
the path is checked against the part by other means, and nothing is written when it is farther off than the
tolerance. All lengths here, in the STL and in the program are in --units, feeds in that a minute; a profile
file says its own unit.

Passes end where the tip would go below the part's lowest place (or --floor). With --pattern zigzag the tool goes from
pass to pass over the surface where that is near; else it is lifted --clearance above the part.";

/// Makes a program for a ball that mills a part in parallel vertical planes
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub(super) struct SectionArgs {
    /// The part: a closed STL
    #[arg(value_name = "MODEL", required_unless_present = "profile", conflicts_with = "profile")]
    model: Option<PathBuf>,
    /// A profile (YAML) that is the same in all planes, instead of a model
    #[arg(long, value_name = "FILE")]
    profile: Option<PathBuf>,
    /// The planes: zx, yz, or an angle in degrees from x
    #[arg(long, value_name = "PLANE", default_value = "zx", allow_negative_numbers = true)]
    plane: String,
    /// Largest distance between planes; they are distributed evenly
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true)]
    step: Option<String>,
    /// The first plane; by default the boundary of the model
    #[arg(long, value_name = "PLACE", allow_negative_numbers = true)]
    from: Option<String>,
    /// The last plane
    #[arg(long, value_name = "PLACE", allow_negative_numbers = true)]
    to: Option<String>,
    /// The radius of the ball
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true)]
    radius: Option<String>,
    /// How deep passes may cut into the part, and how far from it they may stay; 0.01 mm by default
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true)]
    tolerance: Option<String>,
    /// What heights are computed from: the whole mesh, or only its profile in the plane
    #[arg(long, value_enum, default_value = "mesh", conflicts_with = "profile")]
    against: PassHeightsArg,
    /// The order of passes
    #[arg(long, value_enum, default_value = "zigzag")]
    pattern: PassPatternArg,
    /// Keep arcs if the dialect allows them in vertical planes (NX, CATIA)
    #[arg(long)]
    arcs: bool,
    /// The feed of the passes
    #[arg(long, value_name = "FEED", help_heading = "Motion", allow_negative_numbers = true)]
    feed: Option<String>,
    /// The feed down to a pass; by default half of the feed
    #[arg(long, value_name = "FEED", help_heading = "Motion", allow_negative_numbers = true)]
    plunge: Option<String>,
    /// The motion between passes above the part: `rapid`, or a feed
    #[arg(
        long,
        value_name = "FEED",
        default_value = "rapid",
        help_heading = "Motion",
        allow_negative_numbers = true
    )]
    between: String,
    /// How far above the top of the part the tool moves across; 10 mm by default
    #[arg(long, value_name = "LENGTH", help_heading = "Motion", allow_negative_numbers = true)]
    clearance: Option<String>,
    /// How far above a pass the plunge feed begins; 2 mm by default
    #[arg(long, value_name = "LENGTH", help_heading = "Motion", allow_negative_numbers = true)]
    approach: Option<String>,
    /// The tip stays above this z; by default the lowest point of the part
    #[arg(long, value_name = "PLACE", help_heading = "Motion", allow_negative_numbers = true)]
    floor: Option<String>,
    /// The spindle speed in revolutions per minute
    #[arg(long, value_name = "RPM", help_heading = "Program", allow_negative_numbers = true)]
    spindle: Option<String>,
    /// Switch coolant on
    #[arg(long, help_heading = "Program")]
    coolant: bool,
    /// The number of the tool
    #[arg(long, value_name = "N", default_value_t = 1, help_heading = "Program")]
    tool: u32,
    /// The name of the tool
    #[arg(long, value_name = "NAME", help_heading = "Program")]
    tool_name: Option<String>,
    /// The name of the operation
    #[arg(long, value_name = "NAME", help_heading = "Program")]
    operation: Option<String>,
    /// nx, catia or creo; by default the dialect of the output's extension (.aptsource and .apt, .ncl), else
    /// nx
    #[arg(long, value_parser = parse_writable_dialect, value_name = "NAME", help_heading = "Program")]
    dialect: Option<Dialect>,
    /// The unit of lengths here, in the STL and in the program
    #[arg(long, value_parser = input_files::length_unit_parser(), value_name = "UNIT", default_value = "mm", help_heading = "Program")]
    units: LengthUnit,
    /// Where to write the program; `-` is standard output
    #[arg(short, long, value_name = "FILE", required_unless_present = "dry_run", help_heading = "Outputs")]
    output: Option<PathBuf>,
    /// A drawing of the middle plane: part, shifted contact points, tip path; SVG, or PNG if the file ends in
    /// .png
    #[arg(long, value_name = "FILE", help_heading = "Outputs")]
    plot: Option<PathBuf>,
    /// The setup of the program, for `clsmith simulate`: a billet around the model, and the ball; YAML
    #[arg(
        long,
        value_name = "FILE",
        requires = "teeth",
        conflicts_with = "profile",
        help_heading = "Outputs"
    )]
    save_setup: Option<PathBuf>,
    /// Simulate the program on that billet, and compare what is left with the model
    #[arg(long, requires_all = ["teeth", "spindle"], conflicts_with = "profile")]
    simulate: bool,
    /// How much larger than the model the billet is at every side; 0 by default
    #[arg(long, value_name = "LENGTH", allow_negative_numbers = true)]
    allowance: Option<String>,
    /// The number of teeth of the ball
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=100))]
    teeth: Option<u32>,
    #[command(flatten)]
    json: JsonArgs,
    /// Make and prove the program, but do not write it
    #[arg(long)]
    dry_run: bool,
    #[command(flatten)]
    progress: ProgressArgs,
    #[command(flatten)]
    limits: LimitArgs,
    #[command(flatten)]
    pub(in crate::cli) findings: FindingArgs,
}

/// What heights over a mesh are computed from.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum PassHeightsArg {
    /// The whole mesh.
    Mesh,
    /// Its profile in the plane.
    Profile,
}

/// The order of passes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum PassPatternArg {
    /// Forth and back
    Zigzag,
    /// All in the same direction
    OneWay,
}

/// A program that was made, and what its simulation left.
struct MadeSurface<'a> {
    surfaced: &'a SurfaceProgram,
    /// How much larger than the model its billet is at every side, mm.
    allowance_mm: f64,
    /// The simulation; `None` if it was not asked for.
    simulated: Option<SimulationReport>,
}

fn parse_writable_dialect(name: &str) -> Result<Dialect, BadArgument> {
    let writable = clsmith::write::new_program::WRITABLE;
    let found = Dialect::from_name(name).filter(|dialect| writable.contains(dialect));
    found.ok_or(BadArgument::new("the dialects that can be written are nx, catia and creo"))
}

impl SectionArgs {
    pub(super) fn run(&self) -> Result<CommandExit, Stop> {
        self.find_usage_problem().map_or(Ok(()), |problem| Err(Stop::Usage(problem)))?;
        let policy = self.findings.build_policy()?;
        let (options, allowance_mm) = match self.check_options() {
            Ok(checked) => checked,
            Err(failure) => return self.refuse_part(failure, &policy, None),
        };
        self.limits.threads().start_threads()?;
        let outputs = CommandOutputs::default().for_inputs([self.input_path()]);
        let progress = CommandProgress::new(self.progress, outputs.interrupt(), self.limits.of_run());
        outputs.stop_on_ctrl_c(progress.clear_on_ctrl_c())?;
        if let Err(failure) = self.check_outputs() {
            let found = policy.apply(failure.into_findings());
            self.show_findings(&found)?;
            self.say_nothing_written();
            return Ok(CommandExit::Errors);
        }
        self.find_wrong_ending().map_or(Ok(()), |wrong| Err(Stop::Usage(wrong)))?;
        progress.begin_program(&self.input_path().to_string_lossy());
        let done = self
            .read_part(&options)
            .and_then(|part| make_watched_surface_program(&part, &options, &progress));
        progress.clear_bar();
        match done {
            Ok(surfaced) => {
                let simulated = self
                    .simulate
                    .then(|| self.simulate_surface(&surfaced, &options, allowance_mm, &progress))
                    .transpose();
                progress.clear_bar();
                match simulated {
                    Ok(simulated) => {
                        let made = MadeSurface { surfaced: &surfaced, allowance_mm, simulated };
                        self.show_and_write(&made, &options, &policy, &outputs)
                    }
                    Err(failure) => self.refuse_part(failure, &policy, Some(&options)),
                }
            }
            Err(failure) => self.refuse_part(failure, &policy, Some(&options)),
        }
    }

    /// Reports why there is no program. `options` are not given if the command line is at fault.
    fn refuse_part(
        &self,
        failure: Failure,
        policy: &FindingPolicy,
        options: Option<&SurfaceMillingOptions>,
    ) -> Result<CommandExit, Stop> {
        let Failure::Found(found) = failure else { return Err(Stop::Interrupted) };
        let found = policy.apply(found);
        self.show_findings(&found)?;
        self.say_nothing_written();
        let Some(options) = options else { return Ok(CommandExit::Usage) };
        self.write_json(None, options, false, &found)?;
        Ok(CommandExit::Errors)
    }

    /// Shows the findings, writes the outputs and shows the summary.
    fn show_and_write(
        &self,
        made: &MadeSurface<'_>,
        options: &SurfaceMillingOptions,
        policy: &FindingPolicy,
        outputs: &CommandOutputs,
    ) -> Result<CommandExit, Stop> {
        let surfaced = made.surfaced;
        let mut found = report::collect_findings(surfaced, options);
        found.extend(made.simulated.iter().flat_map(|simulated| simulated.findings.clone()));
        let mut found = policy.apply(found);
        if !found.is_empty() {
            self.show_findings(&found)?;
        }
        let mut refused = found.iter().any(Diagnostic::is_error);
        if refused {
            self.say_nothing_written();
        } else if let Err(stop) = self.write_outputs(made, options, outputs) {
            let Stop::Found { findings: unwritten, .. } = stop else { return Err(stop) };
            self.show_findings(&unwritten)?;
            found.extend(unwritten);
            refused = true;
        }
        self.write_json(Some(surfaced), options, !refused, &found)?;
        self.show_summary_unless_quiet(made, options)?;
        Ok(if refused { CommandExit::Errors } else { CommandExit::Done })
    }

    fn show_summary_unless_quiet(
        &self,
        made: &MadeSurface<'_>,
        options: &SurfaceMillingOptions,
    ) -> io::Result<()> {
        if self.progress.quiet { Ok(()) } else { ignore_closed_pipe(self.show_summary(made, options)) }
    }

    /// Reads the part, in mm.
    fn read_part(&self, options: &SurfaceMillingOptions) -> Result<SurfacePart, Failure> {
        if let Some(profile) = &self.profile {
            let source = input_files::read_source(profile)?;
            return load_profile(&source).map(SurfacePart::Profile);
        }
        let path = self.input_path();
        let source = input_files::read_source(path)?;
        let mesh = Mesh::from_stl(source.bytes()).and_then(|mesh| match options.words.units {
            LengthUnit::Mm => Ok(mesh),
            LengthUnit::Inch => mesh.scaled(LengthUnit::Inch.mm_per_unit()),
        });
        let part = mesh.map(SurfacePart::Mesh).map_err(|error| {
            let message = format!("the model {} cannot be milled: {error}", path.display());
            Diagnostic::new(codes::MODEL_FILE, message)
        })?;
        Ok(part)
    }

    /// Returns the only input.
    fn input_path(&self) -> &Path {
        self.profile.as_deref().or(self.model.as_deref()).unwrap_or(Path::new(""))
    }

    fn say_nothing_written(&self) {
        if !self.progress.quiet && self.output_paths().any(|path| Some(path) != self.json.path()) {
            let what = if self.json.is_wanted() { "no program was written" } else { "nothing was written" };
            eprintln!("{}: {what}", self.input_path().display());
        }
    }

    fn show_findings(&self, findings: &[Diagnostic]) -> io::Result<()> {
        let mut err = io::stderr().lock();
        let file = self.input_path().to_string_lossy();
        let seen = terminal::is_stderr_terminal();
        ignore_closed_pipe(self.findings.write_findings(&mut err, seen, findings, Some(&file)))
    }
}

impl From<PassHeightsArg> for surface_milling::PassHeights {
    fn from(against: PassHeightsArg) -> Self {
        match against {
            PassHeightsArg::Mesh => Self::Mesh,
            PassHeightsArg::Profile => Self::Profile,
        }
    }
}

impl From<PassPatternArg> for surface_milling::PassPattern {
    fn from(pattern: PassPatternArg) -> Self {
        match pattern {
            PassPatternArg::Zigzag => Self::ZigZag,
            PassPatternArg::OneWay => Self::OneWay,
        }
    }
}

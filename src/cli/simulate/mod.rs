//! `clsmith simulate`.

mod outputs;

use crate::cli::exit::Exit;
use crate::cli::files::{self, STANDARD};
use crate::cli::findings::FindingArgs;
use crate::cli::output::{Outputs, print_summary, unless_nobody_reads};
use crate::cli::plot::as_file;
use crate::cli::progress::Progress;
use crate::cli::reports::ReportArgs;
use crate::cli::stop::Stop;
use crate::cli::terminal;
use clap::Args;
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::machining::{Budget, Machining, Options};
use clsmith::parse::parse;
use clsmith::program::{Dialect, Program};
use clsmith::report::comparison::{Runs, Subject};
use clsmith::report::policy::Policy;
use clsmith::report::simulation::{self, Simulated, plot};
use clsmith::report::stats::Units;
use clsmith::setup::Setup;
use clsmith::sim::Mesh;
use clsmith::source::Source;
use clsmith::values::LengthUnit;
use clsmith::write::is_interrupt;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

const EXAMPLES: &str = "\
Examples:
  clsmith simulate part.cls --setup shop.yaml                       what is cut, how hard, what collides
  clsmith simulate part.cls --setup shop.yaml --csv loads.csv       one row a motion
  clsmith simulate part.cls --setup shop.yaml --csv - | head        the same to standard output
  clsmith simulate part.cls --setup shop.yaml --target part.stl     gouges and excess against the part
  clsmith simulate op1.cls --setup shop.yaml --save-stock op1.clstock --stl left.stl
  clsmith simulate new.cls --setup shop.yaml --plot loads.svg --plot-before old.cls
  clsmith simulate part.cls --setup shop.yaml --report loads.html   charts and the path in 3D, as a page

The setup says stock, tools and material: see configs/README.md. Outputs appear whole or not at all, never
over an input, and not while an error stands; a collision is one (`--allow CL0511` writes all the same).
The columns of the CSV: line, operation, tool, length_mm, feed_mm_min, chip_thickness_mm,
removal_rate_mm3_min, axial_depth_mm, radial_depth_mm, engagement_start_deg, engagement_end_deg, force_n,
torque_nm, power_kw. An empty cell is a value that is not known.";

/// Removes the stock motion by motion: chips, depths, forces, collisions, what is left
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Simulate {
    /// The program; `-` is standard input
    #[arg(value_name = "PROGRAM")]
    program: PathBuf,
    /// The setup file: stock, tools, material, machine
    #[arg(long, value_name = "FILE")]
    setup: PathBuf,
    /// The motions as a table; `-` is standard output
    #[arg(long, value_name = "FILE", help_heading = "Outputs")]
    csv: Option<PathBuf>,
    /// Everything as JSON; `-` is standard output
    #[arg(long, value_name = "FILE", help_heading = "Outputs")]
    json: Option<PathBuf>,
    /// The stock that is left, as a binary STL in mm
    #[arg(long, value_name = "FILE", help_heading = "Outputs")]
    stl: Option<PathBuf>,
    /// The stock that is left, as stock for the next program
    #[arg(long, value_name = "FILE", help_heading = "Outputs")]
    save_stock: Option<PathBuf>,
    /// Thickest chips and feeds along time, as SVG, or PNG where the file ends so
    #[arg(long, value_name = "FILE", help_heading = "Outputs")]
    plot: Option<PathBuf>,
    /// A second program that is drawn behind the first one, in grey
    #[arg(long, value_name = "PROGRAM", requires = "plot", help_heading = "Outputs")]
    plot_before: Option<PathBuf>,
    #[command(flatten)]
    reports: ReportArgs,
    /// The part that shall be: a closed STL in the coordinates and the unit of the program
    #[arg(long, value_name = "FILE")]
    target: Option<PathBuf>,
    /// How far the stock that is left may be off the target; a cell if not given
    #[arg(long, value_name = "MM", value_parser = length, requires = "target")]
    tolerance: Option<f64>,
    /// Distance of the columns that the stock is made of; a fortieth of the smallest cutter if not given
    #[arg(long, value_name = "MM", value_parser = length)]
    cell: Option<f64>,
    /// Memory that the stock may take
    #[arg(long, value_name = "GIB", value_parser = length, default_value = "2")]
    budget: f64,
    /// Threads; as many as there are cores if not given. The result is the same
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// The dialect, instead of finding it from the text
    #[arg(long, value_parser = files::dialect, value_name = "NAME")]
    dialect: Option<Dialect>,
    /// Unit of lengths of a file that does not state it: mm or inch
    #[arg(long, value_parser = files::units, value_name = "UNIT")]
    units: Option<LengthUnit>,
    /// No summary and no progress, findings only
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    findings: FindingArgs,
}

/// A positive number.
pub(super) fn length(text: &str) -> Result<f64, String> {
    let value = text.parse::<f64>().ok().filter(|value| *value > 0.0 && value.is_finite());
    value.ok_or_else(|| "this must be a number above 0".into())
}

/// A run, and what it was made of.
struct Ran {
    program: Program,
    setup: Setup,
    setup_file: Arc<Source>,
    runs: Runs,
    drawn: Option<Vec<u8>>,
}

impl Ran {
    /// What reports tell of.
    fn subject<'a>(&'a self, units: Option<LengthUnit>, findings: &'a [Diagnostic]) -> Subject<'a> {
        Subject {
            before: None,
            program: &self.program,
            recipe: None,
            setup: &self.setup,
            setup_files: std::slice::from_ref(&self.setup_file),
            units,
            findings,
            reports: &[],
        }
    }
}

impl Simulate {
    pub fn run(&self) -> io::Result<Exit> {
        let policy = match self.problem().map_or_else(|| self.findings.policy(), Err) {
            Ok(policy) => policy,
            Err(problem) => {
                eprintln!("clsmith simulate: {problem}");
                return Ok(Exit::Usage);
            }
        };
        if let Some(threads) = self.threads {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads.into());
            pool.build_global().map_err(io::Error::other)?;
        }
        let outputs = Outputs::default();
        let progress = Progress::new(self.quiet, outputs.interrupt());
        outputs.stop_on_ctrl_c(progress.clearing())?;
        let mut findings = Vec::new();
        let done = self.simulate(&policy, &progress, &mut findings);
        progress.clear();
        let ran = match done {
            Ok(done) => done,
            Err(Stop::Interrupted) => return Ok(Exit::Interrupted),
            Err(Stop::Found(found)) => {
                findings.extend(found);
                self.show(&policy.apply(findings))?;
                return self.nothing();
            }
        };
        let findings = policy.apply(findings);
        if !findings.is_empty() {
            self.show(&findings)?;
        }
        if !self.quiet
            && let Some(simulated) = &ran.runs.after
        {
            unless_nobody_reads(self.summary(simulated))?;
        }
        if findings.iter().any(Diagnostic::is_error) {
            return self.nothing();
        }
        match self.write(&ran, &findings, &outputs) {
            Ok(None) => Ok(Exit::Done),
            Ok(Some(found)) => {
                self.show(&[found])?;
                Ok(Exit::Errors)
            }
            Err(error) if is_interrupt(&error) => Ok(Exit::Interrupted),
            Err(error) => Err(error),
        }
    }

    /// Everything but writing: the simulation, and the drawing if one is wanted. What does not stop the run is added to `findings`.
    fn simulate(
        &self,
        policy: &Policy,
        progress: &Progress,
        findings: &mut Vec<Diagnostic>,
    ) -> Result<Ran, Stop> {
        let setup_file = files::read(&self.setup).map_err(|found| *found)?;
        let setup = Setup::load(&setup_file)?;
        self.overwrites(&setup)?;
        let read = |path: &Path| files::read(path).map_err(|found| found.message);
        let setup = setup.with_material_file(read)?;
        let program = self.program(&self.program, policy, findings)?;
        let units = Units::of(&program, self.units).unit;
        let target = self.target.as_deref().map(|path| target(path, units)).transpose()?;
        let mut simulated = self.one(&program, &setup, progress, findings)?;
        findings.append(&mut simulated.findings);
        if let (Some(mesh), Some(path)) = (target, &self.target) {
            simulated.compare(&mesh, &path.to_string_lossy(), self.tolerance);
            findings.append(&mut simulated.findings);
        }
        let drawn = match &self.plot {
            Some(path) => Some(self.draw(path, &simulated, &setup, policy, progress, findings)?),
            None => None,
        };
        Ok(Ran {
            program,
            setup,
            setup_file,
            runs: Runs { after: Some(simulated), ..Runs::default() },
            drawn,
        })
    }

    fn draw(
        &self,
        path: &Path,
        simulated: &Simulated,
        setup: &Setup,
        policy: &Policy,
        progress: &Progress,
        findings: &mut Vec<Diagnostic>,
    ) -> Result<Vec<u8>, Stop> {
        let mut series = Vec::new();
        if let Some(path) = &self.plot_before {
            let before = self.program(path, policy, findings)?;
            // What goes wrong in the program behind is not what was asked.
            let before = self.one(&before, setup, progress, &mut Vec::new())?;
            series.push(before.series(path.to_string_lossy()));
        }
        series.push(simulated.series(simulated.file.as_str()));
        let failed = |error: io::Error| Diagnostic::new(codes::UNWRITABLE, error.to_string());
        Ok(plot::plot(&series).and_then(|svg| as_file(path, svg)).map_err(failed)?)
    }

    /// Reads a program; errors in its text stop the run.
    fn program(&self, path: &Path, policy: &Policy, findings: &mut Vec<Diagnostic>) -> Result<Program, Stop> {
        let source = files::read(path).map_err(|found| *found)?;
        let parsed = parse(&source, self.dialect);
        findings.extend(parsed.diagnostics);
        if policy.apply(findings.clone()).iter().any(Diagnostic::is_error) {
            return Err(Stop::Found(Vec::new()));
        }
        Ok(parsed.program)
    }

    fn one(
        &self,
        program: &Program,
        setup: &Setup,
        progress: &Progress,
        findings: &mut Vec<Diagnostic>,
    ) -> Result<Simulated, Stop> {
        let units = Units::of(program, self.units).unit;
        let machining = Machining::new(program, setup, units, findings)?;
        let bytes = (self.budget * f64::from(1 << 30)) as u64;
        let options =
            Options { cell: self.cell, budget: Budget { bytes, ..Budget::default() }, ..Options::default() };
        progress.begin(program.source().name());
        Simulated::of(&machining, &options, progress)?.ok_or(Stop::Interrupted)
    }

    /// The summary on standard output, or on standard error when an output goes there.
    fn summary(&self, simulated: &Simulated) -> io::Result<()> {
        let text = simulation::to_text(simulated);
        print_summary(&text, self.outputs().any(|path| path == Path::new(STANDARD)))
    }

    fn nothing(&self) -> io::Result<Exit> {
        if !self.quiet && self.outputs().next().is_some() {
            eprintln!("{}: nothing was written", self.program.display());
        }
        Ok(Exit::Errors)
    }

    fn show(&self, findings: &[Diagnostic]) -> io::Result<()> {
        let mut err = io::stderr().lock();
        let file = self.program.to_string_lossy();
        let seen = terminal::errors_are_seen();
        unless_nobody_reads(self.findings.show(&mut err, seen, findings, Some(&file)))
    }
}

/// Reads a target part.
fn target(path: &Path, units: LengthUnit) -> Result<Arc<Mesh>, Diagnostic> {
    let source = files::read(path).map_err(|found| *found)?;
    Machining::target(source.bytes(), units).map_err(|error| {
        let message = format!("the target {} cannot be used: {error}", path.display());
        let help = "The file must be a closed STL, in the coordinates and the unit of the program.";
        Diagnostic::new(codes::STOCK_FILE, message).help(help)
    })
}

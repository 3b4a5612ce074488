//! `clsmith plot`.

use super::exit::Exit;
use super::files::{self, STANDARD};
use super::findings::FindingArgs;
use super::output::{Outputs, overwritten, unless_nobody_reads};
use super::progress::Progress;
use super::stop::Stop;
use super::terminal;
use clap::{Args, ValueEnum};
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::machining::{Machining, Options};
use clsmith::parse::parse;
use clsmith::program::{Dialect, Program};
use clsmith::report::plot::{self, Along, Panel, Plotted, Quantity};
use clsmith::report::simulation::Simulated;
use clsmith::report::stats::Units;
use clsmith::setup::Setup;
use clsmith::values::LengthUnit;
use std::io;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  clsmith plot part.cls -o feed.svg                                    feed and z along time
  clsmith plot part.cls --after out.cls --of feed,z --along path -o both.png
  clsmith plot part.cls --after out.cls --setup shop.yaml --of chip,feed,power -o loads.png

chip, removal, force, torque and power are simulated, and need stock and tools: see configs/README.md. The ending of
the output says what it is, .svg or .png; `-` is SVG on standard output. The same bytes come out whatever the machine.";

/// Draws feed, chips, loads or z of a program along time or path, as SVG or PNG
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Plot {
    /// The program; `-` is standard input
    #[arg(value_name = "PROGRAM")]
    program: PathBuf,
    /// A second program, drawn over the first, which then is grey
    #[arg(long, value_name = "PROGRAM")]
    after: Option<PathBuf>,
    /// A setup file: stock and tools, and how fast rapids are
    #[arg(long, value_name = "FILE")]
    setup: Option<PathBuf>,
    /// What to draw, a panel each
    #[arg(long, value_enum, value_name = "WHAT", value_delimiter = ',', default_value = "feed,z")]
    of: Vec<What>,
    /// What goes to the right
    #[arg(long, value_enum, value_name = "AXIS", default_value = "time")]
    along: Axis,
    /// Where to write: a file that ends in .svg or .png, or `-` for SVG on standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// The dialect, instead of finding it from the text
    #[arg(long, value_parser = files::dialect, value_name = "NAME")]
    dialect: Option<Dialect>,
    /// Unit of lengths of a file that does not state it: mm or inch
    #[arg(long, value_parser = files::units, value_name = "UNIT")]
    units: Option<LengthUnit>,
    /// No progress, findings only
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    findings: FindingArgs,
}

/// What goes up.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum What {
    /// Programmed feed, mm/min
    Feed,
    /// Thickest chip, mm
    Chip,
    /// Removal rate, mm3/min
    Removal,
    /// Cutting force, N
    Force,
    /// Torque, N m
    Torque,
    /// Power, kW
    #[value(alias = "load")]
    Power,
    /// Height of the tip, mm
    Z,
}

impl What {
    fn quantity(self) -> Quantity {
        match self {
            Self::Feed => Quantity::Feed,
            Self::Chip => Quantity::Chip,
            Self::Removal => Quantity::Removal,
            Self::Force => Quantity::Force,
            Self::Torque => Quantity::Torque,
            Self::Power => Quantity::Power,
            Self::Z => Quantity::Z,
        }
    }
}

/// What goes to the right.
#[derive(Debug, Clone, Copy, ValueEnum)]
enum Axis {
    /// Time, s; without dwells and acceleration
    Time,
    /// Length of the path, mm
    Path,
}

/// Whether a drawing goes into a PNG.
pub fn is_png(path: &Path) -> bool {
    path.extension().is_some_and(|end| end.eq_ignore_ascii_case("png"))
}

/// A drawing as the file's ending wants it.
pub fn as_file(path: &Path, svg: String) -> io::Result<Vec<u8>> {
    if is_png(path) { plot::png(&svg) } else { Ok(svg.into_bytes()) }
}

/// A drawing, and what is missing in it.
struct Drawn {
    /// `None` where no panel has a curve.
    svg: Option<String>,
    /// A sentence for each panel without a curve.
    empty: Vec<String>,
}

/// Says that a panel is empty, and how it would not be.
fn nothing_of(plotted: &[Plotted<'_>], quantity: Quantity, along: Along) -> String {
    let name = quantity.name();
    if along == Along::Path {
        return format!("the panel of {name} is empty: nothing is known of it");
    }
    let helps = !plot::panels(plotted, &[quantity], Along::Path).iter().all(Panel::is_empty);
    let help = if helps { "; try --along path" } else { "" };
    format!("the panel of {name} is empty: nothing is known of it along time{help}")
}

impl Plot {
    pub fn run(&self) -> io::Result<Exit> {
        let policy = match self.problem().map_or_else(|| self.findings.policy(), Err) {
            Ok(policy) => policy,
            Err(problem) => {
                eprintln!("clsmith plot: {problem}");
                return Ok(Exit::Usage);
            }
        };
        let outputs = Outputs::default();
        let progress = Progress::new(self.quiet, outputs.interrupt());
        outputs.stop_on_ctrl_c(progress.clearing())?;
        let mut findings = Vec::new();
        let drawn = self.draw(&progress, &mut findings);
        progress.clear();
        let drawn = match drawn {
            Ok(drawn) => Some(drawn),
            Err(Stop::Interrupted) => return Ok(Exit::Interrupted),
            Err(Stop::Found(found)) => {
                findings.extend(found);
                None
            }
        };
        let findings = policy.apply(findings);
        if !findings.is_empty() {
            self.show(&findings)?;
        }
        let Some(Drawn { svg, empty }) = drawn.filter(|_| !findings.iter().any(Diagnostic::is_error)) else {
            return Ok(Exit::Errors);
        };
        if svg.is_none() || !self.quiet {
            empty.iter().for_each(|sentence| eprintln!("clsmith plot: {sentence}"));
        }
        let Some(svg) = svg else {
            eprintln!("clsmith plot: there is nothing to draw, nothing was written");
            return Ok(Exit::Errors);
        };
        let bytes = as_file(&self.output, svg)?;
        match outputs.write(&self.output, |out| out.write_all(&bytes))? {
            Some(found) => self.show(&[found]).map(|()| Exit::Errors),
            None => Ok(Exit::Done),
        }
    }

    /// What is wrong with the command line beyond what clap can say.
    fn problem(&self) -> Option<String> {
        let standard = Path::new(STANDARD);
        let is_svg = self.output.extension().is_some_and(|end| end.eq_ignore_ascii_case("svg"));
        if self.output != standard && !is_svg && !is_png(&self.output) {
            return Some(format!("{} ends neither in .svg nor in .png", self.output.display()));
        }
        let read = [Some(&self.program), self.after.as_ref(), self.setup.as_ref()];
        if read.into_iter().flatten().filter(|path| path.as_path() == standard).count() > 1 {
            return Some("standard input can be read only once".into());
        }
        let simulated = self.of.iter().map(|what| what.quantity()).find(|quantity| quantity.is_simulated());
        let quantity = simulated.filter(|_| self.setup.is_none())?;
        Some(format!("--of {} is simulated, and needs --setup with stock and tools", quantity.name()))
    }

    fn draw(&self, progress: &Progress, findings: &mut Vec<Diagnostic>) -> Result<Drawn, Stop> {
        let setup = match &self.setup {
            Some(path) => {
                let setup = files::setup(path)?;
                let read = |path: &Path| files::read(path).map_err(|found| found.message);
                setup.with_material_file(read)?
            }
            None => Setup::default(),
        };
        self.overwrites(&setup)?;
        let mut programs = Vec::new();
        for path in std::iter::once(&self.program).chain(&self.after) {
            let source = files::read(path).map_err(|found| *found)?;
            let parsed = parse(&source, self.dialect);
            findings.extend(parsed.diagnostics);
            if findings.iter().any(Diagnostic::is_error) {
                return Err(Stop::Found(Vec::new()));
            }
            programs.push(parsed.program);
        }
        let quantities: Vec<Quantity> = self.of.iter().map(|what| what.quantity()).collect();
        let wanted = quantities.iter().any(|quantity| quantity.is_simulated());
        let mut runs: Vec<Option<Simulated>> = Vec::new();
        for program in &programs {
            let run = wanted.then(|| self.simulate(program, &setup, progress, findings));
            runs.push(run.transpose()?);
        }
        let plotted = |(program, run)| {
            let program: &Program = program;
            let run: &Option<Simulated> = run;
            Plotted {
                name: program.source().name(),
                program,
                units: Units::of(program, self.units).unit,
                rapid_feed: setup.machine.rapid_feed.map(|feed| feed.get()),
                simulated: run.as_ref(),
            }
        };
        let plotted: Vec<Plotted<'_>> = programs.iter().zip(&runs).map(plotted).collect();
        let along = match self.along {
            Axis::Time => Along::Time,
            Axis::Path => Along::Path,
        };
        let panels = plot::panels(&plotted, &quantities, along);
        let empty = |(quantity, panel): (&Quantity, &Panel)| {
            panel.is_empty().then(|| nothing_of(&plotted, *quantity, along))
        };
        let empty: Vec<String> = quantities.iter().zip(&panels).filter_map(empty).collect();
        if empty.len() == panels.len() {
            return Ok(Drawn { svg: None, empty });
        }
        let svg = plot::draw(along.title(), &panels)
            .map_err(|error| Diagnostic::new(codes::UNWRITABLE, error.to_string()))?;
        Ok(Drawn { svg: Some(svg), empty })
    }

    fn simulate(
        &self,
        program: &Program,
        setup: &Setup,
        progress: &Progress,
        findings: &mut Vec<Diagnostic>,
    ) -> Result<Simulated, Stop> {
        let units = Units::of(program, self.units).unit;
        let machining = Machining::new(program, setup, units, findings)?;
        progress.begin(program.source().name());
        Simulated::of(&machining, &Options::default(), progress)?.ok_or(Stop::Interrupted)
    }

    /// The output may be no input, nor a file that the setup names.
    fn overwrites(&self, setup: &Setup) -> Result<(), Stop> {
        let mut inputs = vec![self.program.as_path()];
        inputs.extend([&self.after, &self.setup].into_iter().filter_map(|path| path.as_deref()));
        inputs.extend(setup.files());
        match overwritten(std::iter::once(self.output.as_path()), &inputs) {
            Some(found) => Err(found.into()),
            None => Ok(()),
        }
    }

    fn show(&self, findings: &[Diagnostic]) -> io::Result<()> {
        let mut err = io::stderr().lock();
        let file = self.program.to_string_lossy();
        let seen = terminal::errors_are_seen();
        unless_nobody_reads(self.findings.show(&mut err, seen, findings, Some(&file)))
    }
}

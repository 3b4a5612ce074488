//! This module runs commands that measure one program with its setup: `simulate`, `chips` and `axes`. `plot` simulates as they do.

use crate::cli::closed_pipe::ignore_closed_pipe;
use crate::cli::command_exit::CommandExit;
use crate::cli::command_outputs::{CommandOutputs, print_summary};
use crate::cli::input_files::STANDARD;
use crate::cli::judged_program::JudgedProgram;
use crate::cli::measuring_args::MeasuringArgs;
use crate::cli::output_args::JsonArgs;
use crate::cli::progress::CommandProgress;
use crate::cli::stop::Stop;
use crate::cli::terminal;
use clsmith::diagnostic::Diagnostic;
use clsmith::parameters::LengthUnit;
use clsmith::parse::parse_with_vocabulary;
use clsmith::program::Program;
use clsmith::report::finding_policy::FindingPolicy;
use clsmith::report::render::json::refusal_to_json;
use clsmith::report::simulation::SimulationReport;
use clsmith::report::stats::ResolvedLengthUnit;
use clsmith::setup::Setup;
use clsmith::simulation_run::{KnownShares, Machining, RunPhase, RunWatcher, SimulationRunOptions};
use std::io;
use std::path::Path;

/// How a command simulates programs.
pub(super) struct ProgramSimulation<'a> {
    /// Stock and tools.
    pub setup: &'a Setup,
    /// The unit of a program that does not state it.
    pub units: Option<LengthUnit>,
    /// The columns.
    pub options: SimulationRunOptions,
    /// Whether thickest chips are proved from the motions.
    pub certified: bool,
    /// The display of progress, which also knows whether a stop was requested.
    pub progress: &'a CommandProgress,
}

impl ProgramSimulation<'_> {
    /// Simulates a program. What is to be said of its tools and its stock is added to `findings`; the rest stays in the
    /// report.
    pub(super) fn simulate_program(
        &self,
        program: &Program,
        findings: &mut Vec<Diagnostic>,
    ) -> Result<SimulationReport, Stop> {
        let units = ResolvedLengthUnit::from_program(program, self.units).unit;
        let machining = Machining::new(program, self.setup, units, findings)?;
        let mut simulated = SimulationReport::simulate_program(&machining, &self.options, self.progress)?;
        if self.certified {
            simulated.certify_chips(&machining, &KnownShares::default(), self.progress)?;
        }
        Ok(simulated)
    }
}

/// The arguments of every such command.
pub(super) struct MeasuringCommand<'a> {
    /// The program.
    pub program: &'a Path,
    /// The paths of outputs.
    pub outputs: Vec<&'a Path>,
    /// Where the analysis goes as JSON. It is written also if there is nothing but findings.
    pub json: &'a JsonArgs,
    /// How many programs are simulated.
    pub simulations: usize,
    /// How the program is read, what the work may take, and what is shown.
    pub shared: &'a MeasuringArgs,
}

/// What the part of a run that differs between commands gets.
pub(super) struct MeasuringContext<'r> {
    /// How programs are read.
    pub shared: &'r MeasuringArgs,
    /// The policy of findings.
    pub policy: &'r FindingPolicy,
    /// The display of progress, which also knows whether a stop was requested.
    pub progress: &'r CommandProgress,
    /// Findings that do not stop the run.
    pub findings: &'r mut Vec<Diagnostic>,
    /// Whether it is known that no output is an input, or a file that the setup names.
    pub outputs_are_checked: bool,
}

impl MeasuringContext<'_> {
    /// Reads a program, checks it and asks the setup about it. A text that cannot be read stops the run. Other faults of
    /// the program do not, because the measurement shows them better.
    pub(super) fn read_program(&mut self, path: &Path, setup: &Setup) -> Result<Program, Stop> {
        let source = self.progress.read_program(path)?;
        let JudgedProgram { program, findings, is_unread } = JudgedProgram::read_source(
            &source,
            self.shared.dialect,
            self.shared.units,
            Some(setup),
            self.policy,
        );
        self.findings.extend(findings);
        // The findings that stop the run are in `self.findings` already.
        if is_unread { Err(Vec::new().into()) } else { Ok(program) }
    }

    /// Reads a program that is only shown behind another one. Its faults are not told, unless nobody can read it.
    pub(super) fn read_background_program(&mut self, path: &Path, setup: &Setup) -> Result<Program, Stop> {
        let source = self.progress.read_program(path)?;
        let parsed = parse_with_vocabulary(&source, self.shared.dialect, &setup.vocabulary);
        if self.policy.apply(parsed.diagnostics.clone()).iter().any(Diagnostic::is_error) {
            self.findings.extend(parsed.diagnostics);
            return Err(Vec::new().into());
        }
        Ok(parsed.program)
    }
}

impl MeasuringCommand<'_> {
    /// Measures a program, shows findings and summary, and writes the outputs. Outputs are also written if
    /// errors were found in the program, because they show where. `problem` is what is wrong with the command
    /// line, `measure` computes everything but the outputs, `summary` returns the text for people, and
    /// `write` writes the outputs.
    pub(super) fn run_measurement<T>(
        &self,
        problem: Option<String>,
        measure: impl FnOnce(&mut MeasuringContext<'_>) -> Result<T, Stop>,
        summary: impl FnOnce(&T) -> String,
        write: impl FnOnce(&T, &[Diagnostic], &CommandOutputs) -> Result<(), Stop>,
    ) -> Result<CommandExit, Stop> {
        problem.map_or(Ok(()), |problem| Err(Stop::Usage(problem)))?;
        let policy = self.shared.findings.build_policy()?;
        self.shared.limits.threads().start_threads()?;
        let outputs = CommandOutputs::default().for_inputs([self.program]);
        let progress =
            CommandProgress::new(self.shared.progress, outputs.interrupt(), self.shared.limits.of_run())
                .with_simulations(self.simulations);
        outputs.stop_on_ctrl_c(progress.clear_on_ctrl_c())?;
        progress.begin_program(&self.program.to_string_lossy());
        let mut findings = Vec::new();
        let mut context = MeasuringContext {
            shared: self.shared,
            policy: &policy,
            progress: &progress,
            findings: &mut findings,
            outputs_are_checked: false,
        };
        let done = measure(&mut context);
        let may_write = context.outputs_are_checked || self.json.is_surely_no_input();
        if done.is_ok() {
            progress.begin_phase(RunPhase::Writing);
        }
        progress.clear_bar();
        let measured = match done {
            Ok(measured) => measured,
            Err(Stop::Found { findings: found, .. }) => {
                findings.extend(found);
                let findings = policy.apply(findings);
                self.show_findings(&findings)?;
                if may_write {
                    let name = self.program.to_string_lossy();
                    self.json.write_document(&[self.program], || refusal_to_json(&name, &findings))?;
                }
                return Ok(self.say_nothing_written(may_write));
            }
            Err(stop) => return Err(stop),
        };
        let findings = policy.apply(findings);
        if !findings.is_empty() {
            self.show_findings(&findings)?;
        }
        if !self.shared.progress.quiet {
            // If an output goes to standard output, the summary goes to standard error.
            let is_taken = self.outputs.contains(&Path::new(STANDARD));
            ignore_closed_pipe(print_summary(&summary(&measured), is_taken))?;
        }
        write(&measured, &findings, &outputs).map_err(|stop| stop.about(self.program))?;
        let refused = findings.iter().any(Diagnostic::is_error);
        Ok(if refused { CommandExit::Errors } else { CommandExit::Done })
    }

    /// Says that the outputs were not written. `has_json` tells whether JSON was, if it is wanted.
    fn say_nothing_written(&self, has_json: bool) -> CommandExit {
        let written = self.json.path().filter(|_| has_json);
        if !self.shared.progress.quiet && self.outputs.iter().any(|path| Some(*path) != written) {
            let what = if written.is_some() { "nothing but JSON" } else { "nothing" };
            eprintln!("{}: {what} was written", self.program.display());
        }
        CommandExit::Errors
    }

    fn show_findings(&self, findings: &[Diagnostic]) -> io::Result<()> {
        let mut err = io::stderr().lock();
        let file = self.program.to_string_lossy();
        let seen = terminal::is_stderr_terminal();
        ignore_closed_pipe(self.shared.findings.write_findings(&mut err, seen, findings, Some(&file)))
    }
}

//! This module writes the outputs of `clsmith simulate`, and checks where they may be written.

use super::{SimulateArgs, SimulateOutcome};
use crate::cli::command_outputs::{CommandOutputs, refuse_overwritten_input};
use crate::cli::input_files::STANDARD;
use crate::cli::output_endings::{OutputContent, find_wrong_ending};
use crate::cli::stop::Stop;
use clsmith::diagnostic::Diagnostic;
use clsmith::output_files::is_same_file;
use clsmith::report::comparison::Comparison;
use clsmith::report::simulation::{self, SimulationReport};
use clsmith::setup::Setup;
use clsmith::stock::{stl_export, stock_file};
use std::io::{self, Write};
use std::path::Path;

impl SimulateArgs {
    /// Returns what is wrong with the command line and cannot be found by clap, if there is anything.
    pub(super) fn find_usage_problem(&self) -> Option<String> {
        let outputs: Vec<&Path> = self.output_paths().collect();
        let twice = outputs.iter().enumerate().find_map(|(index, one)| {
            outputs.iter().skip(index + 1).find(|other| *other == one || is_same_file(one, other))
        });
        if let Some(twice) = twice {
            return Some(format!("two outputs would go to {}", twice.display()));
        }
        let standard = Some(Path::new(STANDARD));
        let read = [Some(&self.program), Some(&self.setup), self.plot_before.as_ref(), self.target.as_ref()];
        let read = read.into_iter().flatten().filter(|path| Some(path.as_path()) == standard).count();
        if read > 1 {
            return Some("standard input can be read only once".into());
        }
        let binary = [&self.stl, &self.save_stock].into_iter().any(|path| path.as_deref() == standard);
        binary.then(|| "--stl and --save-stock need a file".into())
    }

    pub(super) fn output_paths(&self) -> impl Iterator<Item = &Path> {
        let all = [&self.csv, &self.stl, &self.save_stock, &self.plot];
        let named = all.into_iter().filter_map(|path| path.as_deref());
        named.chain(self.json.path()).chain(self.reports.output_paths())
    }

    /// Checks that no output is an input, or a file that the setup names.
    pub(super) fn check_outputs(&self, setup: &Setup) -> Result<(), Stop> {
        let mut inputs = vec![self.program.as_path(), &self.setup];
        inputs.extend([&self.target, &self.plot_before].into_iter().filter_map(|path| path.as_deref()));
        inputs.extend(setup.referenced_files());
        refuse_overwritten_input(self.output_paths(), &inputs)?;
        let wrong = find_wrong_ending([
            ("--csv", self.csv.as_deref(), OutputContent::Csv),
            ("--json", self.json.path(), OutputContent::Json),
            ("--stl", self.stl.as_deref(), OutputContent::Stl),
            ("--save-stock", self.save_stock.as_deref(), OutputContent::Stock),
            ("--plot", self.plot.as_deref(), OutputContent::Drawing),
        ]);
        wrong.or_else(|| self.reports.find_wrong_ending()).map_or(Ok(()), |wrong| Err(Stop::Usage(wrong)))
    }

    /// Writes the table that was asked for: motions, stretches of them, one revolution, or edges.
    fn write_table(&self, simulated: &SimulationReport, out: &mut dyn Write) -> io::Result<()> {
        if self.tooth_period.is_some() {
            simulation::write_tooth_period_csv(simulated, out)
        } else if self.edges.is_some() {
            simulation::write_edges_csv(simulated, out)
        } else if self.forces_along.is_some() {
            simulation::write_places_csv(simulated, out)
        } else {
            simulation::write_csv(simulated, out)
        }
    }

    /// Writes the requested outputs. Returns a finding if that fails.
    pub(super) fn write_outputs(
        &self,
        ran: &SimulateOutcome,
        findings: &[Diagnostic],
        outputs: &CommandOutputs,
    ) -> Result<(), Stop> {
        let Some(simulated) = &ran.runs.after else {
            debug_assert!(false, "a run that was not stopped leaves a simulation");
            return Ok(());
        };
        type Writer<'a> = Box<dyn Fn(&mut dyn Write) -> io::Result<()> + 'a>;
        let all: [(Option<&Path>, Writer<'_>); 5] = [
            (self.csv.as_deref(), Box::new(|out| self.write_table(simulated, out))),
            (
                self.json.path(),
                Box::new(|out| out.write_all(simulation::to_json(simulated, findings).as_bytes())),
            ),
            (self.stl.as_deref(), Box::new(|out| stl_export::write_stl(&simulated.left, out))),
            (self.save_stock.as_deref(), Box::new(|out| stock_file::write_clstock(&simulated.left, out))),
            (self.plot.as_deref(), Box::new(|out| out.write_all(ran.drawn.as_deref().unwrap_or_default()))),
        ];
        let refused = findings.iter().any(Diagnostic::is_error);
        for (path, write_all) in &all {
            let Some(path) = path else { continue };
            // Other outputs are also written if errors were found. But the stock that a program with a crash
            // leaves must not become the stock of the next program.
            if refused && self.save_stock.as_deref() == Some(*path) {
                continue;
            }
            outputs.write_output(path, write_all)?;
        }
        if !self.reports.is_wanted() {
            return Ok(());
        }
        self.reports.write_reports(
            &Comparison::from_runs(ran.report_subject(self.shared.units, findings), &ran.runs),
            outputs,
        )
    }
}

//! This module writes the outputs of `clsmith plot`, and checks where they may be written.

use super::{PlotArgs, PlotDrawing, encode_drawing};
use crate::cli::closed_pipe::ignore_closed_pipe;
use crate::cli::command_outputs::{CommandOutputs, refuse_overwritten_input};
use crate::cli::input_files::STANDARD;
use crate::cli::output_endings::{OutputContent, find_wrong_ending};
use crate::cli::stop::Stop;
use crate::cli::terminal;
use clsmith::diagnostic::Diagnostic;
use clsmith::output_files::is_same_file;
use clsmith::report::DisplayUnits;
use clsmith::report::plot::{PlotSubject, plot_to_json};
use clsmith::setup::Setup;
use std::io;
use std::path::Path;

impl PlotArgs {
    /// Returns what is wrong with the command line and cannot be found by clap, if there is anything.
    pub(super) fn find_usage_problem(&self) -> Option<String> {
        let standard = Path::new(STANDARD);
        if let Some(wrong) = find_wrong_ending([("-o", Some(&*self.output), OutputContent::Drawing)]) {
            return Some(wrong);
        }
        if let Some(wrong) = self.json.find_wrong_ending() {
            return Some(wrong);
        }
        if self.json.path().is_some_and(|json| json == self.output || is_same_file(json, &self.output)) {
            return Some(format!("two outputs would go to {}", self.output.display()));
        }
        let read = [Some(&self.program), self.after.as_ref(), self.setup.as_ref()];
        if read.into_iter().flatten().filter(|path| path.as_path() == standard).count() > 1 {
            return Some("standard input can be read only once".into());
        }
        let simulated = self.of.iter().map(|what| what.quantity()).find(|quantity| quantity.is_simulated());
        let quantity = simulated.filter(|_| self.setup.is_none())?;
        Some(format!("--of {} needs a simulation; add --setup with stock and tools", quantity.name()))
    }

    /// Writes the drawing, and says what is missing in it. Returns whether there is one.
    pub(super) fn write_drawing(
        &self,
        drawn: Option<&PlotDrawing>,
        outputs: &CommandOutputs,
    ) -> Result<bool, Stop> {
        let Some(PlotDrawing { svg, empty, .. }) = drawn else { return Ok(false) };
        if svg.is_none() || !self.shared.progress.quiet {
            empty.iter().for_each(|sentence| eprintln!("clsmith plot: {sentence}"));
        }
        let Some(svg) = svg else {
            eprintln!("clsmith plot: there is nothing to draw, so nothing was written");
            return Ok(false);
        };
        let bytes = encode_drawing(&self.output, svg.clone())?;
        outputs.write_output(&self.output, |out| out.write_all(&bytes))?;
        Ok(true)
    }

    /// Writes what was drawn as JSON, if that is wanted.
    pub(super) fn write_json(
        &self,
        drawn: Option<&PlotDrawing>,
        written: bool,
        findings: &[Diagnostic],
    ) -> Result<(), Stop> {
        let output = self.output.to_string_lossy();
        let after = self.after.as_deref().map(Path::to_string_lossy);
        let subject = PlotSubject {
            file: &self.program.to_string_lossy(),
            after: after.as_deref(),
            along: self.along.abscissa(),
            units: drawn.map_or(DisplayUnits::MM, |drawn| drawn.units),
            panels: drawn.map(|drawn| drawn.panels.as_slice()).unwrap_or_default(),
            written: written.then_some(&*output),
        };
        self.json.write_document(&self.input_paths(), || plot_to_json(&subject, findings))
    }

    /// Returns the files that the command line names as inputs.
    pub(super) fn input_paths(&self) -> Vec<&Path> {
        let others = [&self.after, &self.setup].into_iter().filter_map(|path| path.as_deref());
        std::iter::once(self.program.as_path()).chain(others).collect()
    }

    /// Checks that the output is no input, and no file that the setup names.
    pub(super) fn check_outputs(&self, setup: &Setup) -> Result<(), Stop> {
        let mut inputs = self.input_paths();
        inputs.extend(setup.referenced_files());
        refuse_overwritten_input(std::iter::once(self.output.as_path()).chain(self.json.path()), &inputs)
    }

    pub(super) fn show_findings(&self, findings: &[Diagnostic]) -> io::Result<()> {
        let mut err = io::stderr().lock();
        let file = self.program.to_string_lossy();
        let seen = terminal::is_stderr_terminal();
        ignore_closed_pipe(self.shared.findings.write_findings(&mut err, seen, findings, Some(&file)))
    }
}

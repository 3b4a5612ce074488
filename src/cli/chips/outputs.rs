//! This module writes the outputs of `clsmith chips`, and checks where they may be written.

use super::ChipsArgs;
use crate::cli::command_outputs::{CommandOutputs, refuse_overwritten_input};
use crate::cli::input_files::STANDARD;
use crate::cli::output_endings::{OutputContent, find_wrong_ending};
use crate::cli::plot::encode_drawing;
use crate::cli::stop::Stop;
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::output_files::is_same_file;
use clsmith::report::layered_chips::{self, ChipReport};
use clsmith::setup::Setup;
use std::io::{self, Write};
use std::path::Path;

/// The drawings that were requested.
#[derive(Debug, Default)]
pub(super) struct ChipDrawings {
    layers: Option<Vec<u8>>,
    diagrams: Option<Vec<u8>>,
}

impl ChipsArgs {
    /// Returns what is wrong with the command line and cannot be found by clap, if there is anything.
    pub(super) fn find_usage_problem(&self) -> Option<String> {
        let outputs: Vec<&Path> = self.output_paths().collect();
        let twice = outputs.iter().enumerate().find_map(|(index, one)| {
            outputs.iter().skip(index + 1).find(|other| *other == one || is_same_file(one, other))
        });
        if let Some(twice) = twice {
            return Some(format!("two outputs would go to {}", twice.display()));
        }
        let standard = Path::new(STANDARD);
        if self.program == standard && self.setup == standard {
            return Some("standard input can be read only once".into());
        }
        if self.at.is_some() && self.plot.is_none() && self.diagram.is_none() {
            return Some("--at is for --plot and --diagram".into());
        }
        (self.stl.as_deref() == Some(standard)).then(|| "--stl needs a file".into())
    }

    pub(super) fn output_paths(&self) -> impl Iterator<Item = &Path> {
        let all = [&self.csv, &self.stl, &self.plot, &self.diagram];
        all.into_iter().filter_map(|path| path.as_deref()).chain(self.json.path())
    }

    /// Checks that no output is an input, or a file that the setup names.
    pub(super) fn check_outputs(&self, setup: &Setup) -> Result<(), Stop> {
        let mut inputs = vec![self.program.as_path(), &self.setup];
        inputs.extend(setup.referenced_files());
        refuse_overwritten_input(self.output_paths(), &inputs)?;
        let wrong = find_wrong_ending([
            ("--csv", self.csv.as_deref(), OutputContent::Csv),
            ("--json", self.json.path(), OutputContent::Json),
            ("--stl", self.stl.as_deref(), OutputContent::Stl),
            ("--plot", self.plot.as_deref(), OutputContent::Drawing),
            ("--diagram", self.diagram.as_deref(), OutputContent::Drawing),
        ]);
        wrong.map_or(Ok(()), |wrong| Err(Stop::Usage(wrong)))
    }

    /// Draws the requested drawings.
    pub(super) fn draw_chips(&self, report: &ChipReport) -> Result<ChipDrawings, Stop> {
        if self.plot.is_none() && self.diagram.is_none() {
            return Ok(ChipDrawings::default());
        }
        if report.scenes.is_empty() {
            let message = match self.at {
                Some(z) => {
                    format!("none of the moves removes anything at z {z}, so there is nothing to draw")
                }
                None => "none of the moves removes anything, so there is nothing to draw".to_owned(),
            };
            return Err(Diagnostic::new(codes::NO_SUCH_LAYER, message).into());
        }
        let failed = |error: io::Error| Diagnostic::new(codes::UNWRITABLE, error.to_string());
        let layers = self
            .plot
            .as_ref()
            .map(|path| encode_drawing(path, layered_chips::draw_layers(report, self.at)?))
            .transpose()
            .map_err(failed)?;
        let diagrams = self
            .diagram
            .as_ref()
            .map(|path| encode_drawing(path, layered_chips::draw_diagrams(report, self.at)?))
            .transpose()
            .map_err(failed)?;
        Ok(ChipDrawings { layers, diagrams })
    }

    /// Writes the requested outputs. Returns a finding if that fails.
    pub(super) fn write_outputs(
        &self,
        report: &ChipReport,
        drawn: &ChipDrawings,
        findings: &[Diagnostic],
        outputs: &CommandOutputs,
    ) -> Result<(), Stop> {
        type Writer<'a> = Box<dyn Fn(&mut dyn Write) -> io::Result<()> + 'a>;
        let all: [(Option<&Path>, Writer<'_>); 5] = [
            (self.csv.as_deref(), Box::new(|out| layered_chips::write_csv(report, out))),
            (self.json.path(), Box::new(|out| layered_chips::write_json(report, findings, out))),
            (self.stl.as_deref(), Box::new(|out| layered_chips::write_stl(report, out))),
            (
                self.plot.as_deref(),
                Box::new(|out| out.write_all(drawn.layers.as_deref().unwrap_or_default())),
            ),
            (
                self.diagram.as_deref(),
                Box::new(|out| out.write_all(drawn.diagrams.as_deref().unwrap_or_default())),
            ),
        ];
        for (path, write_all) in &all {
            let Some(path) = path else { continue };
            outputs.write_output(path, write_all)?;
        }
        Ok(())
    }
}

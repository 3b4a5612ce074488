//! This module writes the outputs of `clsmith section`, and checks where they may be written.

use super::{MadeSurface, SectionArgs};
use crate::cli::command_outputs::{CommandOutputs, print_summary};
use crate::cli::input_files::STANDARD;
use crate::cli::output_endings::{OutputContent, find_wrong_ending};
use crate::cli::plot::encode_drawing;
use crate::cli::stop::Stop;
use clsmith::diagnostic::{Diagnostic, Failure, codes};
use clsmith::output_files::is_same_file;
use clsmith::report::simulation;
use clsmith::report::surface_document::surface_to_json;
use clsmith::report::surface_milling as report;
use clsmith::surface_milling::{SurfaceMillingOptions, SurfaceProgram};
use std::io;
use std::path::Path;

impl SectionArgs {
    pub(super) fn write_outputs(
        &self,
        made: &MadeSurface<'_>,
        options: &SurfaceMillingOptions,
        outputs: &CommandOutputs,
    ) -> Result<(), Stop> {
        let surfaced = made.surfaced;
        if let Some(path) = &self.save_setup {
            let text = self.build_setup_text(options, made.allowance_mm, Some(path));
            outputs.write_output(path, |out| out.write_all(text.as_bytes()))?;
        }
        // The drawing is written first: if it fails, no program was written.
        if let Some(plot) = &self.plot {
            let drawn = encode_drawing(plot, report::draw_middle_plane(surfaced, options)?)?;
            outputs.write_output(plot, |out| out.write_all(&drawn))?;
        }
        match self.output.as_deref().filter(|_| !self.dry_run) {
            Some(output) => outputs.write_output(output, |out| out.write_all(&surfaced.text)),
            None => Ok(()),
        }
    }

    pub(super) fn output_paths(&self) -> impl Iterator<Item = &Path> {
        let output = self.output.as_deref().filter(|_| !self.dry_run);
        [output, self.save_setup.as_deref(), self.plot.as_deref(), self.json.path()].into_iter().flatten()
    }

    /// Returns what is wrong with the command line and is found neither by clap nor by the check of the
    /// options, if there is anything.
    pub(super) fn find_usage_problem(&self) -> Option<String> {
        let outputs: Vec<&Path> = self.output_paths().collect();
        let twice = outputs.iter().enumerate().find_map(|(index, one)| {
            outputs.iter().skip(index + 1).find(|other| *other == one || is_same_file(one, other))
        });
        twice.map(|twice| format!("two outputs would go to {}", twice.display()))
    }

    /// Returns a sentence about the first output whose ending does not fit its content. It is called after
    /// the check that no output is the input.
    pub(super) fn find_wrong_ending(&self) -> Option<String> {
        find_wrong_ending([
            ("-o", self.output.as_deref(), OutputContent::Program),
            ("--plot", self.plot.as_deref(), OutputContent::Drawing),
            ("--json", self.json.path(), OutputContent::Json),
        ])
    }

    /// Checks that no output is the input.
    pub(super) fn check_outputs(&self) -> Result<(), Failure> {
        let input = self.input_path();
        let files =
            self.output_paths().filter(|path| *path != Path::new(STANDARD) && input != Path::new(STANDARD));
        match files.into_iter().find(|path| is_same_file(path, input)) {
            Some(hit) => {
                let message =
                    format!("writing {} would overwrite the input {}", hit.display(), input.display());
                Err(Diagnostic::new(codes::OUTPUT_IS_INPUT, message).into())
            }
            None => Ok(()),
        }
    }

    /// Writes the figures as JSON, if that is wanted. `is_written` tells whether the outputs were written.
    pub(super) fn write_json(
        &self,
        surfaced: Option<&SurfaceProgram>,
        options: &SurfaceMillingOptions,
        is_written: bool,
        findings: &[Diagnostic],
    ) -> Result<(), Stop> {
        let written = self.output.as_deref().filter(|_| is_written && !self.dry_run);
        let written = written.map(Path::to_string_lossy);
        let file = self.input_path().to_string_lossy();
        self.json.write_document(&[self.input_path()], || {
            surface_to_json(&file, options, surfaced, written.as_deref(), findings)
        })
    }

    /// Prints the summary on standard output, or on standard error if an output goes there.
    pub(super) fn show_summary(
        &self,
        made: &MadeSurface<'_>,
        options: &SurfaceMillingOptions,
    ) -> io::Result<()> {
        let surfaced = made.surfaced;
        let mut text = report::to_text(surfaced, options, &self.input_path().to_string_lossy());
        let written = self.output.as_deref().filter(|_| !self.dry_run);
        if let Some(path) = written.filter(|_| surfaced.proof.is_within(options.tolerance_mm)) {
            let lines = surfaced.text.iter().filter(|byte| **byte == b'\n').count();
            let title = options.words.dialect.display_name();
            text.push_str(&format!("-> {}: {title}, {lines} lines\n", path.display()));
        }
        if let Some(simulated) = &made.simulated {
            text.push_str(&simulation::to_text(simulated));
        }
        print_summary(&text, self.output_paths().any(|path| path == Path::new(STANDARD)))
    }
}

//! What `clsmith section` writes, and where it may not.

use super::Section;
use crate::cli::files::STANDARD;
use crate::cli::output::{Outputs, print_summary};
use clsmith::diagnostic::{Diagnostic, codes};
use clsmith::report::surfacing as report;
use clsmith::surfacing::{Options, Surfaced};
use clsmith::write::same_file;
use std::io;
use std::path::Path;

impl Section {
    pub(super) fn write(
        &self,
        surfaced: &Surfaced,
        options: &Options,
        outputs: &Outputs,
    ) -> io::Result<Option<Diagnostic>> {
        // The drawing first: if it fails, no program was written.
        if let Some(plot) = &self.plot {
            let drawn = report::plot(surfaced, options)?;
            if let Some(found) = outputs.write(plot, |out| out.write_all(drawn.as_bytes()))? {
                return Ok(Some(found));
            }
        }
        match self.output.as_deref().filter(|_| !self.dry_run) {
            Some(output) => outputs.write(output, |out| out.write_all(&surfaced.text)),
            None => Ok(None),
        }
    }

    pub(super) fn outputs(&self) -> impl Iterator<Item = &Path> {
        let output = self.output.as_deref().filter(|_| !self.dry_run);
        [output, self.plot.as_deref()].into_iter().flatten()
    }

    /// What is wrong with the command line beyond what clap and options can say.
    pub(super) fn problem(&self) -> Option<String> {
        let mut outputs = self.outputs();
        let (one, other) = (outputs.next()?, outputs.next()?);
        (one == other || same_file(one, other)).then(|| format!("two outputs would go to {}", one.display()))
    }

    /// No output may be the input.
    pub(super) fn overwrites(&self) -> Result<(), Vec<Diagnostic>> {
        let input = self.input();
        let files =
            self.outputs().filter(|path| *path != Path::new(STANDARD) && input != Path::new(STANDARD));
        match files.into_iter().find(|path| same_file(path, input)) {
            Some(hit) => {
                let message =
                    format!("writing {} would overwrite the input {}", hit.display(), input.display());
                Err(vec![Diagnostic::new(codes::OUTPUT_IS_INPUT, message)])
            }
            None => Ok(()),
        }
    }

    /// The summary on standard output, or on standard error when an output goes there.
    pub(super) fn summary(&self, surfaced: &Surfaced, options: &Options) -> io::Result<()> {
        let mut text = report::to_text(surfaced, options, &self.input().to_string_lossy());
        let written = self.output.as_deref().filter(|_| !self.dry_run);
        if let Some(path) = written.filter(|_| surfaced.proof.holds(options.tolerance)) {
            let lines = surfaced.text.iter().filter(|byte| **byte == b'\n').count();
            let title = options.words.dialect.title();
            text.push_str(&format!("-> {}: {title}, {lines} lines\n", path.display()));
        }
        print_summary(&text, self.outputs().any(|path| path == Path::new(STANDARD)))
    }
}

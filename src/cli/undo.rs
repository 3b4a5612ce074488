//! `clsmith undo`.

use super::exit::Exit;
use super::files::{self, STANDARD};
use super::findings::FindingArgs;
use super::output::{Outputs, overwritten, unless_nobody_reads};
use super::terminal;
use clap::Args;
use clsmith::diagnostic::Diagnostic;
use clsmith::source::Source;
use clsmith::undo;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::Arc;

const EXAMPLES: &str = "\
Examples:
  clsmith apply recipe.yaml part.cls -o out.cls --json out.json
  clsmith undo out.cls --report out.json -o again.cls       again.cls is part.cls, byte for byte
  clsmith undo out.cls --report out.json -o - | diff - part.cls

The report holds the old bytes of all that the recipe changed, and digests of both files: nothing is written
unless the file is the one that the run wrote and what comes out is the original. After several runs, undo the
last one first. Only `apply --json` writes such a report; pages (`apply --report`), logs of hooks and results of
batches are none.";

/// Gives the original back, from a corrected program and the report of the run
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Undo {
    /// The corrected program; `-` is standard input
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// The report of the run that corrected it (`apply --json`)
    #[arg(long, value_name = "JSON")]
    report: PathBuf,
    /// Where to write: a file, or `-` for standard output
    #[arg(short, long, value_name = "FILE")]
    output: PathBuf,
    /// Say nothing but findings
    #[arg(short, long)]
    quiet: bool,
    #[command(flatten)]
    findings: FindingArgs,
}

impl Undo {
    pub fn run(&self) -> io::Result<Exit> {
        if let Err(problem) = self.findings.policy() {
            eprintln!("clsmith undo: {problem}");
            return Ok(Exit::Usage);
        }
        if [&self.file, &self.report].iter().all(|path| *path == Path::new(STANDARD)) {
            eprintln!("clsmith undo: standard input can be read only once");
            return Ok(Exit::Usage);
        }
        let outputs = Outputs::default();
        outputs.stop_on_ctrl_c(|| {})?;
        match self.undo(&outputs)? {
            None => Ok(Exit::Done),
            Some(found) => {
                let name = self.file.to_string_lossy();
                let mut err = io::stderr().lock();
                let seen = terminal::errors_are_seen();
                unless_nobody_reads(self.findings.show(&mut err, seen, &[found], Some(&name)))?;
                Ok(Exit::Errors)
            }
        }
    }

    fn undo(&self, outputs: &Outputs) -> io::Result<Option<Diagnostic>> {
        let target = self.output.as_path();
        if let Some(found) = overwritten([target].into_iter(), &[&self.file, &self.report]) {
            return Ok(Some(found));
        }
        let (file, undone) = match self.original() {
            Ok(found) => found,
            Err(found) => return Ok(Some(*found)),
        };
        if let Some(found) = outputs.write(target, |out| out.write_all(&undone.bytes))? {
            return Ok(Some(found));
        }
        if !self.quiet {
            let to = if target == Path::new(STANDARD) {
                "standard output".into()
            } else {
                target.to_string_lossy()
            };
            let places = match undone.places {
                1 => "1 place".to_owned(),
                places => format!("{places} places"),
            };
            eprintln!("{}: {places} undone -> {to}", file.name());
            eprintln!("  the original, sha256 {}", undone.sha256);
        }
        Ok(None)
    }

    fn original(&self) -> Result<(Arc<Source>, undo::Undone), Box<Diagnostic>> {
        let report = files::read(&self.report)?;
        let run = undo::Undo::read(&report)?;
        let file = files::read(&self.file)?;
        let undone = run.original(&file, &report)?;
        Ok((file, undone))
    }
}

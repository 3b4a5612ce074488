//! `clsmith diff`.

use super::exit::Exit;
use super::files;
use super::findings::FindingArgs;
use super::terminal;
use clap::Args;
use clsmith::diagnostic::Diagnostic;
use clsmith::parse::parse;
use clsmith::program::{Dialect, Program};
use clsmith::report::diff;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  clsmith diff part.cls corrected.cls
  clsmith diff --json part.cls corrected.cls
  clsmith diff --summary part.cls corrected.cls

Exit codes: 0 the programs mean the same (they may be written differently), 3 they differ, 1 one of them
cannot be read.";

/// Compares two programs by meaning: geometry, feeds, records
#[derive(Debug, Args)]
#[command(after_help = EXAMPLES)]
pub struct Diff {
    /// The first program; `-` is standard input
    a: PathBuf,
    /// The second program
    b: PathBuf,
    /// As JSON
    #[arg(long, conflicts_with = "summary")]
    json: bool,
    /// Only the summary
    #[arg(long)]
    summary: bool,
    /// How many differences are listed; 0 lists all
    #[arg(long, default_value_t = 20, value_name = "N")]
    most: usize,
    /// The dialect of both, instead of finding it from the text
    #[arg(long, value_parser = files::dialect, value_name = "NAME")]
    dialect: Option<Dialect>,
    #[command(flatten)]
    findings: FindingArgs,
}

impl Diff {
    pub fn run(&self) -> io::Result<Exit> {
        let policy = match self.findings.policy() {
            Ok(policy) => policy,
            Err(problem) => {
                eprintln!("clsmith diff: {problem}");
                return Ok(Exit::Usage);
            }
        };
        if self.a == self.b && self.a == Path::new(files::STANDARD) {
            eprintln!("clsmith diff: standard input can be read only once");
            return Ok(Exit::Usage);
        }
        let mut programs = Vec::new();
        for path in [&self.a, &self.b] {
            let (program, found) = self.program(path);
            let found = policy.apply(found);
            if !found.is_empty() {
                let name = path.to_string_lossy();
                self.findings.show(
                    &mut io::stderr().lock(),
                    terminal::errors_are_seen(),
                    &found,
                    Some(&name),
                )?;
            }
            programs.extend(program.filter(|_| !found.iter().any(Diagnostic::is_error)));
        }
        let [a, b] = programs.as_slice() else { return Ok(Exit::Errors) };
        let found = diff::Diff::of(a, b);
        let text = if self.json {
            diff::to_json(&found)
        } else if self.summary {
            diff::summary(&found)
        } else {
            diff::to_text(&found, if self.most == 0 { usize::MAX } else { self.most })
        };
        let mut out = io::stdout().lock();
        out.write_all(text.as_bytes())?;
        if !text.ends_with('\n') {
            out.write_all(b"\n")?;
        }
        out.flush()?;
        Ok(if found.same_meaning { Exit::Done } else { Exit::Differ })
    }

    fn program(&self, path: &Path) -> (Option<Program>, Vec<Diagnostic>) {
        match files::read(path) {
            Ok(source) => {
                let parsed = parse(&source, self.dialect);
                (Some(parsed.program), parsed.diagnostics)
            }
            Err(found) => (None, vec![*found]),
        }
    }
}

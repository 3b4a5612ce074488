//! This module holds the reason why a command ended early, and is the only place that reports it.

use super::closed_pipe::ignore_closed_pipe;
use super::command_exit::CommandExit;
use super::finding_args::FindingArgs;
use super::terminal;
use clsmith::diagnostic::{Diagnostic, Failure};
use clsmith::report::finding_policy::FindingPolicyError;
use std::io;
use std::path::Path;

/// The reason why a command ended early. Commands pass it on by `?`, and [`Stop::finish_command`] reports it.
#[derive(Debug)]
pub(super) enum Stop {
    /// There are findings. `file` is the only file to which they belong, if there is one.
    Found { findings: Vec<Diagnostic>, file: Option<String> },
    /// The command line is not valid.
    Usage(String),
    /// The system does not let us read standard input, write standard output or start a thread.
    Io(io::Error),
    /// Ctrl-C.
    Interrupted,
    /// The command has reported everything.
    Exit(CommandExit),
}

impl Stop {
    /// Sets the file of findings, unless it is known already.
    #[must_use]
    pub(super) fn about(self, path: &Path) -> Self {
        match self {
            Self::Found { findings, file: None } => {
                Self::Found { findings, file: Some(path.to_string_lossy().into_owned()) }
            }
            stop => stop,
        }
    }

    /// Reports what stopped the work on one file of several. Returns the exit code of that file, so that the
    /// next one can begin.
    ///
    /// # Errors
    /// Returns `self` if it also stops the work on the other files.
    pub(super) fn tell_of_one_file(self, args: &FindingArgs) -> Result<CommandExit, Self> {
        match self {
            Self::Found { findings, file } => {
                let mut err = io::stderr().lock();
                let seen = terminal::is_stderr_terminal();
                let shown = args.write_findings(&mut err, seen, &findings, file.as_deref());
                ignore_closed_pipe(shown)?;
                Ok(CommandExit::Errors)
            }
            Self::Exit(exit) => Ok(exit),
            stop => Err(stop),
        }
    }

    /// Reports what stopped a command. Returns its exit code.
    pub(super) fn finish_command(self, command: &str, args: Option<&FindingArgs>) -> CommandExit {
        let stop = match args {
            Some(args) => match self.tell_of_one_file(args) {
                Ok(exit) => return exit,
                Err(stop) => stop,
            },
            None => self,
        };
        match stop {
            Self::Found { findings, .. } => {
                // Only a defect of clsmith is found by a command that has no options for findings.
                eprintln!("clsmith {command}: {}", Failure::Found(findings));
                CommandExit::Errors
            }
            Self::Usage(problem) => {
                eprintln!("clsmith {command}: {problem}");
                CommandExit::Usage
            }
            // A reader that has seen enough (`clsmith ... | head`) is not our error, but the work was not
            // done either.
            Self::Io(error) if error.kind() == io::ErrorKind::BrokenPipe => CommandExit::NobodyReads,
            Self::Io(error) => {
                eprintln!("clsmith: {error}");
                CommandExit::Errors
            }
            Self::Interrupted => CommandExit::Interrupted,
            Self::Exit(exit) => exit,
        }
    }
}

impl From<Failure> for Stop {
    fn from(failure: Failure) -> Self {
        match failure {
            Failure::Found(findings) => findings.into(),
            Failure::Interrupted => Self::Interrupted,
        }
    }
}

impl From<Vec<Diagnostic>> for Stop {
    fn from(findings: Vec<Diagnostic>) -> Self {
        Self::Found { findings, file: None }
    }
}

impl From<Diagnostic> for Stop {
    fn from(found: Diagnostic) -> Self {
        vec![found].into()
    }
}

impl From<FindingPolicyError> for Stop {
    fn from(error: FindingPolicyError) -> Self {
        Self::Usage(error.to_string())
    }
}

impl From<io::Error> for Stop {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clsmith::diagnostic::codes;

    fn exit(stop: impl Into<Stop>) -> CommandExit {
        stop.into().finish_command("test", None)
    }

    #[test]
    fn every_stop_has_its_exit_code() {
        assert_eq!(exit(Failure::Interrupted), CommandExit::Interrupted);
        assert_eq!(exit(Stop::Usage("no such thing".to_owned())), CommandExit::Usage);
        assert_eq!(exit(io::Error::from(io::ErrorKind::BrokenPipe)), CommandExit::NobodyReads);
        assert_eq!(exit(io::Error::other("full")), CommandExit::Errors);
        assert_eq!(exit(Stop::Exit(CommandExit::Posted(7))), CommandExit::Posted(7));
    }

    #[test]
    fn the_first_file_that_is_said_stays() {
        let found = Diagnostic::new(codes::UNREADABLE, "gone");
        let stop = Stop::from(found).about(Path::new("a.cls")).about(Path::new("b.cls"));
        assert!(matches!(stop, Stop::Found { file: Some(file), .. } if file == "a.cls"));
    }
}

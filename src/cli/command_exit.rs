//! Exit codes, as the help documents them.

use std::process::ExitCode;

/// How a command ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum CommandExit {
    /// Nothing stands in the way.
    Done,
    /// `diff`: the meanings differ.
    Differ,
    /// Errors; the program they are in was not written.
    Errors,
    /// The command line is wrong.
    Usage,
    /// Ctrl-C.
    Interrupted,
    /// Whoever read the output went away before it was all written.
    NobodyReads,
    /// `hook`: the post's code, or the hook's own.
    Posted(i32),
}

impl CommandExit {
    /// Ends the process. Everything that has to be tidied up is gone by now.
    pub fn exit_process(self) -> ExitCode {
        match self {
            // Windows has codes beyond a byte, and cut to one 256 would be success.
            Self::Posted(code) => std::process::exit(code),
            exit => exit.into(),
        }
    }
}

impl From<CommandExit> for ExitCode {
    fn from(exit: CommandExit) -> Self {
        Self::from(match exit {
            CommandExit::Done => 0,
            CommandExit::Errors => 1,
            CommandExit::Usage => 2,
            CommandExit::Differ => 3,
            CommandExit::Interrupted => 130,
            CommandExit::NobodyReads => 141,
            CommandExit::Posted(code) => u8::try_from(code).unwrap_or(1),
        })
    }
}

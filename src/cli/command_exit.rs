//! This module holds exit codes, as the help documents them.

use std::process::ExitCode;

/// How a command ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(crate) enum CommandExit {
    /// The work is done.
    Done,
    /// `diff`: the meanings differ.
    Differ,
    /// There are errors. Nothing was written for the file in which they are.
    Errors,
    /// The command line is wrong.
    Usage,
    /// The command was stopped by Ctrl-C.
    Interrupted,
    /// The reader of the output went away before everything was written.
    NobodyReads,
    /// `hook` returns the code of the post, or its own.
    Posted(i32),
}

impl CommandExit {
    /// Returns the exit code for `main`. With the code of a post, it ends the process itself, which is
    /// allowed because all destructors have run by now.
    pub(crate) fn exit_process(self) -> ExitCode {
        match self {
            // On Windows, an exit code may be larger than a byte. `ExitCode` would cut 256 to 0, which is
            // success.
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

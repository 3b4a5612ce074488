//! Exit codes, as the help documents them.

use std::process::ExitCode;

/// How a command ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Exit {
    /// Nothing stands in the way.
    Done,
    /// `diff`: the meanings differ.
    Differ,
    /// Errors; nothing was written for the file they are in.
    Errors,
    /// The command line is wrong.
    Usage,
    /// Ctrl-C.
    Interrupted,
    /// Whoever read the output went away before it was all written.
    NobodyReads,
}

impl From<Exit> for ExitCode {
    fn from(exit: Exit) -> Self {
        Self::from(match exit {
            Exit::Done => 0,
            Exit::Errors => 1,
            Exit::Usage => 2,
            Exit::Differ => 3,
            Exit::Interrupted => 130,
            Exit::NobodyReads => 141,
        })
    }
}

//! This module finds out what the terminal can do.

use clap::ValueEnum;
use clsmith::report::to_safe_line;
use std::io::IsTerminal;

/// When to use colours.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum ColorMode {
    /// On a terminal, unless NO_COLOR is set
    Auto,
    /// Always
    Always,
    /// Never
    Never,
}

impl ColorMode {
    /// Returns whether to write colours to a stream that is a terminal or not.
    pub(super) fn is_wanted(self, is_terminal: bool) -> bool {
        match self {
            Self::Always => true,
            Self::Never => false,
            Self::Auto => is_terminal && std::env::var_os("NO_COLOR").is_none_or(|value| value.is_empty()),
        }
    }
}

/// Returns whether standard error is a terminal.
pub(super) fn is_stderr_terminal() -> bool {
    std::io::stderr().is_terminal()
}

/// Returns whether standard output is a terminal.
pub(super) fn is_stdout_terminal() -> bool {
    std::io::stdout().is_terminal()
}

/// Returns the columns to draw in: the value of COLUMNS, else 100.
pub(super) fn width_columns() -> usize {
    std::env::var("COLUMNS")
        .ok()
        .and_then(|columns| columns.parse().ok())
        .filter(|&width| width >= 40)
        .unwrap_or(100)
}

/// Returns whether lines and arrows may be other than ASCII: the locale is UTF-8, or not set.
pub(super) fn has_unicode() -> bool {
    let locale = ["LC_ALL", "LC_CTYPE", "LANG"]
        .into_iter()
        .filter_map(|name| std::env::var(name).ok())
        .find(|value| !value.is_empty());
    locale.is_none_or(|value| value.to_ascii_uppercase().replace('-', "").contains("UTF8"))
}

/// Returns a name that is safe to show. One from outside must not send commands to the terminal.
pub(super) fn escape_controls(name: &str) -> String {
    to_safe_line(name)
}

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

/// The number of columns for a stream that is no terminal. It is fixed, so that the output is the same
/// everywhere.
const FIXED_COLUMNS: usize = 100;

/// The least number of columns. With fewer, nothing would be readable.
const FEWEST_COLUMNS: usize = 40;

/// Returns the columns to draw in: the value of COLUMNS if it is set, else those of the terminal, else 100.
pub(super) fn width_columns(is_terminal: bool) -> usize {
    choose_columns(std::env::var("COLUMNS").ok(), is_terminal.then(measure_terminal).flatten())
}

/// Returns the columns of a terminal among the streams of the process.
fn measure_terminal() -> Option<usize> {
    terminal_size::terminal_size().map(|(width, _)| usize::from(width.0))
}

fn choose_columns(variable: Option<String>, measured: Option<usize>) -> usize {
    let asked = variable.and_then(|columns| columns.trim().parse().ok()).filter(|columns| *columns > 0);
    // A terminal without a size says 0.
    let measured = measured.filter(|columns| *columns > 0);
    asked.or(measured).unwrap_or(FIXED_COLUMNS).max(FEWEST_COLUMNS)
}

/// Returns whether lines and arrows may be other than ASCII: the locale is UTF-8, or not set.
pub(super) fn has_unicode() -> bool {
    let locale = ["LC_ALL", "LC_CTYPE", "LANG"]
        .into_iter()
        .filter_map(|name| std::env::var(name).ok())
        .find(|value| !value.is_empty());
    locale.is_none_or(|value| value.to_ascii_uppercase().replace('-', "").contains("UTF8"))
}

/// Returns a name that is safe to show, because the name of a file must not send commands to the terminal.
pub(super) fn escape_controls(name: &str) -> String {
    to_safe_line(name)
}

#[cfg(test)]
mod tests {
    use super::choose_columns;

    #[test]
    fn columns_are_asked_for_then_measured_then_fixed() {
        let asked = |text: &str| Some(text.to_owned());
        assert_eq!(choose_columns(asked("72"), Some(200)), 72);
        assert_eq!(choose_columns(None, Some(200)), 200);
        assert_eq!(choose_columns(None, None), 100);
        assert_eq!(choose_columns(asked("wide"), Some(60)), 60);
        assert_eq!(choose_columns(asked("0"), Some(0)), 100);
        assert_eq!(choose_columns(asked("3"), None), 40);
    }
}

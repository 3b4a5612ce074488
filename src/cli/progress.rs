//! This module shows the progress of a simulation on a terminal, with the remaining time.

use super::run_limits::{RunLimitWatch, RunLimits};
use super::terminal;
use clsmith::diagnostic::Failure;
use clsmith::output_files::Interrupt;
use clsmith::simulation_run::RunWatcher;
use clsmith::source::Source;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A bar on standard error. Nothing is drawn if it is no terminal, or if it is not wanted.
pub(super) struct CommandProgress {
    bar: ProgressBar,
    interrupt: Interrupt,
    limits: RunLimitWatch,
}

impl CommandProgress {
    pub(super) fn new(quiet: bool, interrupt: &Interrupt) -> Self {
        Self::with_limits(quiet, interrupt, RunLimits::default())
    }

    /// A bar of work that is stopped when it takes more than its limits.
    pub(super) fn with_limits(quiet: bool, interrupt: &Interrupt, limits: RunLimits) -> Self {
        let seen = terminal::is_stderr_terminal() && !quiet;
        let target = if seen { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(Some(0), target);
        let (template, marks) = if terminal::has_unicode() {
            ("{msg} {wide_bar} {percent:>3} %, {eta} left", "█▌ ")
        } else {
            ("{msg} [{wide_bar}] {percent:>3} %, {eta} left", "## ")
        };
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style.progress_chars(marks));
        }
        Self { bar, interrupt: interrupt.clone(), limits: RunLimitWatch::new(limits, "the program") }
    }

    /// Begins again with another name.
    pub(super) fn begin_bar(&self, name: &str) {
        self.bar.set_message(terminal::escape_controls(name));
        self.bar.reset();
    }

    /// The work on a program begins: its limits count from now on.
    pub(super) fn begin_program(&self, name: &str) {
        self.limits.begin_program(name);
        self.begin_bar(name);
    }

    /// Refuses a program whose size alone tells that it takes too much memory.
    pub(super) fn check_size(&self, source: &Source) -> Result<(), Failure> {
        self.limits.check_size(source)
    }

    /// Takes the bar away.
    pub(super) fn clear_bar(&self) {
        self.bar.finish_and_clear();
    }

    /// Returns a function that removes the bar, for the handler of Ctrl-C.
    pub(super) fn clear_on_ctrl_c(&self) -> impl Fn() + Send + 'static {
        let bar = self.bar.clone();
        move || bar.finish_and_clear()
    }
}

impl RunWatcher for CommandProgress {
    fn report_progress(&self, done: f64, whole: f64) {
        // Lengths are counted in tenths of a millimetre, so that short paths move the bar, too.
        let tenths = |length: f64| (length * 10.0) as u64;
        self.bar.set_length(tenths(whole).max(1));
        self.bar.set_position(tenths(done));
    }

    fn is_stop_requested(&self) -> bool {
        self.interrupt.is_raised()
    }

    fn check_stop(&self) -> Result<(), Failure> {
        if self.is_stop_requested() { Err(Failure::Interrupted) } else { self.limits.check_limits() }
    }

    fn memory_limit_bytes(&self) -> Option<u64> {
        self.limits.memory_bytes()
    }
}

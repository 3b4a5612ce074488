//! This module shows the progress of a simulation on a terminal, with the remaining time.

use super::terminal;
use clsmith::output_files::Interrupt;
use clsmith::simulation_run::RunWatcher;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A bar on standard error. Nothing is drawn if it is no terminal, or if it is not wanted.
pub struct CommandProgress {
    bar: ProgressBar,
    interrupt: Interrupt,
}

impl CommandProgress {
    pub fn new(quiet: bool, interrupt: &Interrupt) -> Self {
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
        Self { bar, interrupt: interrupt.clone() }
    }

    /// Begins again with another name.
    pub fn begin_bar(&self, name: &str) {
        self.bar.set_message(terminal::escape_controls(name));
        self.bar.reset();
    }

    /// Removes the bar.
    pub fn clear_bar(&self) {
        self.bar.finish_and_clear();
    }

    /// Returns a function that removes the bar, for the handler of Ctrl-C.
    pub fn clear_on_ctrl_c(&self) -> impl Fn() + Send + 'static {
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
}

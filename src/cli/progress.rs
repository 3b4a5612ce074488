//! How far a simulation is, with the time left, on a terminal.

use super::terminal;
use clsmith::machining::Watch;
use clsmith::write::Interrupt;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// A bar on standard error; nothing is drawn where that is no terminal, or nobody wants it.
pub struct Progress {
    bar: ProgressBar,
    interrupt: Interrupt,
}

impl Progress {
    pub fn new(quiet: bool, interrupt: &Interrupt) -> Self {
        let seen = terminal::errors_are_seen() && !quiet;
        let target = if seen { ProgressDrawTarget::stderr() } else { ProgressDrawTarget::hidden() };
        let bar = ProgressBar::with_draw_target(Some(0), target);
        let (template, marks) = if terminal::unicode() {
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
    pub fn begin(&self, name: &str) {
        self.bar.set_message(terminal::plain(name));
        self.bar.reset();
    }

    /// Takes the bar away.
    pub fn clear(&self) {
        self.bar.finish_and_clear();
    }

    /// What takes the bar away, for the handler of Ctrl-C.
    pub fn clearing(&self) -> impl Fn() + Send + 'static {
        let bar = self.bar.clone();
        move || bar.finish_and_clear()
    }
}

impl Watch for Progress {
    fn progress(&self, done: f64, whole: f64) {
        // Tenths of a millimetre, so that short paths move, too.
        let tenths = |length: f64| (length * 10.0) as u64;
        self.bar.set_length(tenths(whole).max(1));
        self.bar.set_position(tenths(done));
    }

    fn is_stopped(&self) -> bool {
        self.interrupt.is_raised()
    }
}

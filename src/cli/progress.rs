//! This module shows the progress of the work on a program: its phase, how far it is, and the remaining time.

use super::phase_track::PhaseTrack;
use super::progress_line::ProgressLines;
use super::run_limits::{RunLimitWatch, RunLimits};
use super::terminal;
use clap::{Args, ValueEnum};
use clsmith::diagnostic::Failure;
use clsmith::output_files::Interrupt;
use clsmith::simulation_run::{RunPhase, RunWatcher, WorkEstimate};
use clsmith::source::Source;
use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;

/// A simulation that takes no more seconds and no more bytes than this begins without a message.
const LONG_SECONDS: f64 = 10.0;
const LARGE_BYTES: u64 = 1 << 30;

/// No bar is shown for work that ends sooner.
pub(super) const BEFORE_BAR: Duration = Duration::from_millis(500);

/// The number of positions of a bar.
const TICKS: f64 = 10_000.0;

/// What is said besides findings.
#[derive(Debug, Clone, Copy, Args)]
pub(super) struct ProgressArgs {
    /// No summary and no progress, findings only
    #[arg(short, long)]
    pub quiet: bool,
    /// When to show progress: after half a second on a terminal, always, or never
    #[arg(long, value_enum, default_value = "auto", value_name = "WHEN")]
    progress: ProgressMode,
}

/// When to show progress.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum ProgressMode {
    /// After half a second, if standard error is a terminal
    Auto,
    /// Also where standard error is no terminal: as lines, from the beginning
    Always,
    /// Never
    Never,
}

/// Where progress is shown.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ProgressPlace {
    /// A bar on a terminal.
    Bar,
    /// Lines on standard error.
    Lines,
    /// Nowhere.
    Nowhere,
}

impl ProgressArgs {
    /// Returns where progress is shown.
    pub(super) fn place(self) -> ProgressPlace {
        match (self.progress, terminal::is_stderr_terminal()) {
            _ if self.quiet => ProgressPlace::Nowhere,
            (ProgressMode::Never, _) | (ProgressMode::Auto, false) => ProgressPlace::Nowhere,
            (ProgressMode::Always, false) => ProgressPlace::Lines,
            (ProgressMode::Auto | ProgressMode::Always, true) => ProgressPlace::Bar,
        }
    }
}

/// Shows progress on standard error as a bar or as lines, if that is wanted.
pub(super) struct CommandProgress {
    bar: ProgressBar,
    place: ProgressPlace,
    shown: Mutex<ShownProgress>,
    interrupt: Interrupt,
    limits: RunLimitWatch,
    /// How many simulations are expected besides those of a recipe's steps.
    simulations: usize,
    /// Whether nothing but findings is wanted.
    quiet: bool,
    /// Whether an estimate for this program may still be printed.
    tells_estimate: AtomicBool,
}

/// The program that is being processed, and the progress of it that was shown.
struct ShownProgress {
    name: String,
    track: PhaseTrack,
    lines: ProgressLines,
    /// Whether the work on the program goes on. A bar is only shown or removed while this lock is held.
    running: Arc<Mutex<bool>>,
}

impl CommandProgress {
    /// Makes the display for work that is stopped when it exceeds `limits`, or when `interrupt` is raised.
    pub(super) fn new(args: ProgressArgs, interrupt: &Interrupt, limits: RunLimits) -> Self {
        let bar = ProgressBar::with_draw_target(Some(TICKS as u64), ProgressDrawTarget::hidden());
        let (template, marks) = if terminal::has_unicode() {
            ("{msg} {wide_bar} {percent:>3} %, {eta} left", "█▌ ")
        } else {
            ("{msg} [{wide_bar}] {percent:>3} %, {eta} left", "## ")
        };
        if let Ok(style) = ProgressStyle::with_template(template) {
            bar.set_style(style.progress_chars(marks));
        }
        let shown = ShownProgress {
            name: String::new(),
            track: PhaseTrack::new(0),
            lines: ProgressLines::default(),
            running: Arc::default(),
        };
        Self {
            bar,
            place: args.place(),
            shown: Mutex::new(shown),
            interrupt: interrupt.clone(),
            limits: RunLimitWatch::new(limits, "the program"),
            simulations: 0,
            quiet: args.quiet,
            tells_estimate: AtomicBool::new(!args.quiet),
        }
    }

    /// Returns the display for work that is expected to simulate so often outside of a recipe's steps.
    #[must_use]
    pub(super) fn with_simulations(mut self, simulations: usize) -> Self {
        self.simulations = simulations;
        self
    }

    /// Begins the work on a program: its time limit counts from now on, and a bar appears if the work takes
    /// long.
    pub(super) fn begin_program(&self, name: &str) {
        self.limits.begin_program(name);
        self.tells_estimate.store(!self.quiet, Ordering::Relaxed);
        let running = Arc::new(Mutex::new(true));
        let mut shown = self.lock_shown();
        shown.name = terminal::escape_controls(name);
        shown.track = PhaseTrack::new(self.simulations);
        shown.lines = ProgressLines::default();
        if self.place == ProgressPlace::Bar {
            self.bar.reset();
            let (bar, running) = (self.bar.clone(), Arc::clone(&running));
            std::thread::spawn(move || {
                std::thread::sleep(BEFORE_BAR);
                let running = running.lock().unwrap_or_else(PoisonError::into_inner);
                if *running {
                    bar.set_draw_target(ProgressDrawTarget::stderr());
                    bar.enable_steady_tick(Duration::from_millis(200));
                }
            });
        }
        shown.running = running;
        drop(shown);
        self.begin_phase(RunPhase::Reading);
    }

    /// Reads a program, unless it takes more memory than is allowed; `-` is standard input.
    pub(super) fn read_program(&self, path: &Path) -> Result<Arc<Source>, Failure> {
        self.limits.read_program(path)
    }

    /// Refuses a file that is larger than the memory, before it is read.
    pub(super) fn check_file(&self, path: &Path) -> Result<(), Failure> {
        self.limits.check_file(path)
    }

    /// Refuses a program if its size alone shows that it needs too much memory.
    pub(super) fn check_size(&self, source: &Source) -> Result<(), Failure> {
        self.limits.check_size(source)
    }

    /// Removes the bar.
    pub(super) fn clear_bar(&self) {
        let running = Arc::clone(&self.lock_shown().running);
        let mut running = running.lock().unwrap_or_else(PoisonError::into_inner);
        *running = false;
        self.bar.disable_steady_tick();
        self.bar.finish_and_clear();
        self.bar.set_draw_target(ProgressDrawTarget::hidden());
    }

    /// Returns a function that removes the bar, for the handler of Ctrl-C.
    pub(super) fn clear_on_ctrl_c(&self) -> impl Fn() + Send + 'static {
        let bar = self.bar.clone();
        move || bar.finish_and_clear()
    }

    fn lock_shown(&self) -> MutexGuard<'_, ShownProgress> {
        self.shown.lock().unwrap_or_else(PoisonError::into_inner)
    }

    fn show_progress(&self, shown: &mut ShownProgress) {
        match self.place {
            ProgressPlace::Nowhere => {}
            ProgressPlace::Bar => self.bar.set_position((shown.track.fraction() * TICKS) as u64),
            ProgressPlace::Lines => shown.lines.show_line(&shown.name, &shown.track),
        }
    }
}

impl RunWatcher for CommandProgress {
    fn begin_phase(&self, phase: RunPhase) {
        let mut shown = self.lock_shown();
        shown.track.begin_phase(phase);
        self.bar.set_message(format!("{} {}", phase.name(), shown.name));
        self.show_progress(&mut shown);
    }

    fn report_progress(&self, done: f64, whole: f64) {
        let mut shown = self.lock_shown();
        if shown.track.report_progress(done, whole) {
            self.show_progress(&mut shown);
        }
    }

    fn report_estimate(&self, estimate: &WorkEstimate) {
        // A recipe may simulate several times, and one message is enough.
        let Some(told) = describe_long_run(estimate, rayon::current_num_threads()) else { return };
        if self.tells_estimate.swap(false, Ordering::Relaxed) {
            self.bar.suspend(|| eprintln!("clsmith: {told}"));
        }
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

/// Describes the time and the memory of work, if one of them is large.
fn describe_long_run(estimate: &WorkEstimate, threads: usize) -> Option<String> {
    let WorkEstimate { work, bytes, size, .. } = estimate;
    let seconds = estimate.estimate_seconds(threads);
    let long = seconds > LONG_SECONDS;
    if !long && *bytes <= LARGE_BYTES {
        return None;
    }
    let time = if long { format!("up to about {} and ", describe_seconds(seconds)) } else { String::new() };
    let memory = *bytes as f64 / LARGE_BYTES as f64;
    Some(format!("{work} will take {time}{memory:.1} GiB: {size}"))
}

/// Describes a rough time in words.
fn describe_seconds(seconds: f64) -> String {
    match seconds {
        seconds if seconds < 120.0 => format!("{seconds:.0} s"),
        seconds if seconds < 7200.0 => format!("{:.0} min", seconds / 60.0),
        seconds => format!("{:.0} h", seconds / 3600.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use clsmith::simulation_run::{Machining, SimulationRunOptions};

    fn cost(cell: f64, size: f64, passes: usize) -> WorkEstimate {
        let shop = format!(
            "stock: {{ block: {{ from: [0, 0, -10], to: [{size}, {size}, 0] }} }}\n\
             tools: [ {{ match: {{}}, diameter: 10, flute_length: 20, teeth: 4 }} ]\n"
        );
        let setup = Source::new("shop.yaml", shop.into_bytes()).unwrap();
        let setup = clsmith::setup::Setup::load(&setup).unwrap();
        let forth_and_back = format!("GOTO/{size},0,-2\nGOTO/-10,0,-2\n").repeat(passes);
        let part = format!("LOAD/TOOL,3\nRAPID\nGOTO/-10,0,-2\nFEDRAT/MMPM,1000.\n{forth_and_back}");
        let program = clsmith::parse::parse(&Source::new("a.cls", part.into_bytes()).unwrap(), None).program;
        let machining =
            Machining::new(&program, &setup, clsmith::program::LengthUnit::Mm, &mut Vec::new()).unwrap();
        machining.estimate_cost(&SimulationRunOptions::default().with_cell_mm(cell)).unwrap().to_estimate()
    }

    #[test]
    fn only_what_takes_much_is_told() {
        assert_eq!(describe_long_run(&cost(0.25, 100.0, 1), 1), None);
        let told = describe_long_run(&cost(0.02, 100.0, 1000), 1).unwrap();
        assert!(told.starts_with("the simulation will take up to about "), "{told}");
        assert!(told.contains("25000000 columns of 0.020 mm"), "{told}");
        assert!(describe_long_run(&cost(0.05, 600.0, 1), 8).unwrap().contains("take 1.1 GiB"));
    }
}

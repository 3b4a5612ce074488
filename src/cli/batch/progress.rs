//! This module shows progress bars of a batch: one for all files, and one for each file that runs. Findings
//! are printed as they come.

use crate::cli::closed_pipe::ignore_closed_pipe;
use crate::cli::finding_args::FindingArgs;
use crate::cli::phase_track::PhaseTrack;
use crate::cli::progress::{BEFORE_BAR, ProgressArgs, ProgressPlace};
use crate::cli::run_limits::{RunLimitWatch, RunLimits};
use crate::cli::terminal;
use clsmith::batch::{BatchRecord, BatchWatcher, FileOutcome, PlannedFile};
use clsmith::diagnostic::{Diagnostic, Failure};
use clsmith::output_files::Interrupt;
use clsmith::simulation_run::{self, RunPhase, SimulationBudget};
use indicatif::{MultiProgress, ProgressBar, ProgressDrawTarget, ProgressStyle};
use std::io;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, Mutex, PoisonError};
use std::time::Duration;

/// Bars on standard error. Nothing is drawn if it is no terminal, or if bars are not wanted.
pub(super) struct BatchProgress<'a> {
    all: MultiProgress,
    whole: ProgressBar,
    place: ProgressPlace,
    /// Whether the batch goes on. Bars are only shown or removed while this lock is held.
    running: Arc<Mutex<bool>>,
    done: AtomicUsize,
    failed: AtomicUsize,
    findings: &'a FindingArgs,
    interrupt: &'a Interrupt,
    limits: RunLimits,
    /// The memory of `--memory` in bytes, if it is given. The stock of one file may not take more.
    stock_bytes: Option<u64>,
}

impl<'a> BatchProgress<'a> {
    pub(super) fn new(
        progress: ProgressArgs,
        findings: &'a FindingArgs,
        interrupt: &'a Interrupt,
        (limits, stock_bytes): (RunLimits, Option<u64>),
    ) -> Self {
        let place = progress.place();
        let all = MultiProgress::with_draw_target(ProgressDrawTarget::hidden());
        let whole = all.add(ProgressBar::new(0));
        let running = Arc::new(Mutex::new(true));
        if place == ProgressPlace::Bar {
            let (all, running) = (all.clone(), Arc::clone(&running));
            std::thread::spawn(move || {
                std::thread::sleep(BEFORE_BAR);
                let running = running.lock().unwrap_or_else(PoisonError::into_inner);
                if *running {
                    all.set_draw_target(ProgressDrawTarget::stderr());
                }
            });
        }
        let failed = AtomicUsize::new(0);
        Self {
            all,
            whole,
            place,
            running,
            done: AtomicUsize::new(0),
            failed,
            findings,
            interrupt,
            limits,
            stock_bytes,
        }
    }

    /// Starts the bar of the whole batch. It counts bytes instead of files, because the time depends on them.
    pub(super) fn begin_files<'p>(&self, files: impl Iterator<Item = &'p PlannedFile>) {
        let (count, bytes) =
            files.fold((0, 0), |(count, bytes), file| (count + 1, bytes + progress_weight(file)));
        self.whole.set_length(bytes);
        let files = if count == 1 { "file" } else { "files" };
        set_bar_style(
            &self.whole,
            &format!("{count} {files} {{wide_bar}} {{percent:>3}} %, {{eta}} left{{msg}}"),
        );
    }

    /// Removes the bars.
    pub(super) fn clear_bars(&self) {
        let mut running = self.running.lock().unwrap_or_else(PoisonError::into_inner);
        *running = false;
        self.whole.finish_and_clear();
    }

    /// Returns a function that removes the bars, for the handler of Ctrl-C.
    pub(super) fn clear_on_ctrl_c(&self) -> impl Fn() + Send + 'static {
        let all = self.all.clone();
        move || {
            // Nothing can be done about a terminal that cannot be cleared.
            let _ = all.clear();
        }
    }

    /// Prints findings above the bars.
    fn show_findings(&self, found: &[Diagnostic], file: Option<&str>) {
        self.all.suspend(|| {
            let mut err = io::stderr().lock();
            // A closed standard error does not stop the batch, because the results contain the findings.
            let _ = ignore_closed_pipe(self.findings.write_findings(
                &mut err,
                terminal::is_stderr_terminal(),
                found,
                file,
            ));
        });
    }
}

impl BatchWatcher for BatchProgress<'_> {
    fn begin_file(&self, file: &PlannedFile) -> Box<dyn simulation_run::RunWatcher + '_> {
        let bar = self.all.add(ProgressBar::no_length());
        set_bar_style(&bar, "  {spinner} {msg}");
        bar.set_message(terminal::escape_controls(&file.input.to_string()));
        if self.place == ProgressPlace::Bar {
            bar.enable_steady_tick(Duration::from_millis(200));
        }
        let limits = RunLimitWatch::new(self.limits, &file.input.to_string());
        // Several programs share the memory, so none of them takes all of it for its stock.
        let stock_bytes = self.stock_bytes.map(|bytes| bytes.min(SimulationBudget::default().bytes));
        let track = Mutex::new(PhaseTrack::new(0));
        let name = terminal::escape_controls(&file.input.to_string());
        Box::new(FileBar { bar, name, track, interrupt: self.interrupt, limits, stock_bytes })
    }

    fn end_file(&self, file: &PlannedFile, record: &BatchRecord, findings: &[Diagnostic], _before: bool) {
        if record.outcome == FileOutcome::Failed {
            let failed = 1 + self.failed.fetch_add(1, Ordering::Relaxed);
            self.whole.set_message(format!(", {failed} failed"));
            self.show_findings(findings, Some(&file.input.to_string()));
        }
        self.whole.inc(progress_weight(file));
        let done = 1 + self.done.fetch_add(1, Ordering::Relaxed);
        if self.place == ProgressPlace::Lines {
            eprintln!("{}: {done} done", terminal::escape_controls(&file.input.to_string()));
        }
    }
}

/// The number of positions of a file's bar.
const TICKS: u64 = 1000;

/// Returns how much a file counts in the bar of the batch: its bytes and a constant, because an empty file
/// takes time, too.
fn progress_weight(file: &PlannedFile) -> u64 {
    file.size.saturating_add(4096)
}

fn set_bar_style(bar: &ProgressBar, template: &str) {
    let marks = if terminal::has_unicode() { "█▌ " } else { "## " };
    let ticks = if terminal::has_unicode() { "◐◓◑◒ " } else { "|/-\\ " };
    if let Ok(style) = ProgressStyle::with_template(template) {
        bar.set_style(style.progress_chars(marks).tick_chars(ticks));
    }
}

/// The bar of one file. It only spins at first, and grows once a phase reports its progress.
struct FileBar<'a> {
    bar: ProgressBar,
    name: String,
    track: Mutex<PhaseTrack>,
    interrupt: &'a Interrupt,
    limits: RunLimitWatch,
    stock_bytes: Option<u64>,
}

impl simulation_run::RunWatcher for FileBar<'_> {
    fn begin_phase(&self, phase: RunPhase) {
        let mut track = self.track.lock().unwrap_or_else(PoisonError::into_inner);
        track.begin_phase(phase);
        self.bar.set_message(format!("{} {}", phase.name(), self.name));
    }

    fn report_progress(&self, done: f64, whole: f64) {
        let mut track = self.track.lock().unwrap_or_else(PoisonError::into_inner);
        if track.report_progress(done, whole) {
            if self.bar.length().is_none() {
                set_bar_style(&self.bar, "  {spinner} {msg} {wide_bar} {percent:>3} %");
                self.bar.set_length(TICKS);
            }
            self.bar.set_position((track.fraction() * TICKS as f64) as u64);
        }
    }

    fn is_stop_requested(&self) -> bool {
        self.interrupt.is_raised()
    }

    fn check_stop(&self) -> Result<(), Failure> {
        if self.is_stop_requested() { Err(Failure::Interrupted) } else { self.limits.check_limits() }
    }

    fn memory_limit_bytes(&self) -> Option<u64> {
        self.stock_bytes
    }
}

impl Drop for FileBar<'_> {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

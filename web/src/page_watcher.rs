//! This module tells the worker how far the work is.

use clsmith::simulation_run::{RunPhase, RunWatcher};
use std::sync::atomic::{AtomicU32, Ordering};
use wasm_bindgen::prelude::wasm_bindgen;

#[wasm_bindgen]
extern "C" {
    /// Tells what is done from now on.
    #[wasm_bindgen(js_name = tellPhase)]
    fn tell_phase(phase: &str);

    /// Tells the done fraction of that.
    #[wasm_bindgen(js_name = tellFraction)]
    fn tell_fraction(fraction: f64);

    /// Tells what a defect says about itself.
    #[wasm_bindgen(js_name = tellDefect)]
    pub(crate) fn tell_defect(message: &str);
}

/// Passes progress on. Nobody can stop the work from here: the page ends the worker instead.
#[derive(Default)]
pub(crate) struct PageWatcher {
    /// The last percentage that was told.
    told: AtomicU32,
}

/// The memory that a simulation may take. A module has 4 GiB in all, for the program and the page as well.
const SIMULATION_BYTES: u64 = 3 << 29;

impl PageWatcher {
    /// Tells that the page is made.
    pub(crate) fn begin_drawing(&self) {
        tell_phase("drawing");
    }
}

impl RunWatcher for PageWatcher {
    fn begin_phase(&self, phase: RunPhase) {
        self.told.store(0, Ordering::Relaxed);
        match phase {
            RunPhase::Step { index, count } => {
                tell_phase(&format!("{}, step {} of {count}", phase.name(), index + 1))
            }
            phase => tell_phase(phase.name()),
        }
    }

    fn report_progress(&self, done: f64, whole: f64) {
        let fraction = if whole > 0.0 { (done / whole).clamp(0.0, 1.0) } else { 0.0 };
        let percent = (fraction * 100.0) as u32;
        if self.told.swap(percent, Ordering::Relaxed) != percent {
            tell_fraction(fraction);
        }
    }

    fn memory_limit_bytes(&self) -> Option<u64> {
        Some(SIMULATION_BYTES)
    }
}

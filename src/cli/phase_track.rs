//! This module turns the progress that a run reports, phase by phase, into one fraction that only grows.
//!
//! How often a run simulates is not known beforehand, because a step that proves its result simulates again.
//! So the part of the bar that is left for simulations of a step is halved by each of them, and the bar never
//! jumps back.

use clsmith::simulation_run::RunPhase;

/// Fractions of the bar: at `READ` reading has ended, at `WORKED` the steps or the only simulation have
/// ended, and at `CHECKED` only writing is left.
const READ: f64 = 0.05;
const WORKED: f64 = 0.85;
const CHECKED: f64 = 0.95;

/// How far a run on one program is.
#[derive(Debug, Clone)]
pub(super) struct PhaseTrack {
    phase: RunPhase,
    /// The largest fraction so far.
    fraction: f64,
    /// The fractions of the bar at which the phase begins and ends.
    from: f64,
    to: f64,
    /// The fraction at which the step ends that the phase belongs to.
    step_end: f64,
    /// How many simulations are still expected outside of steps.
    simulations_left: usize,
}

impl PhaseTrack {
    /// Makes the track of a run. `simulations` is how many simulations are expected outside of steps.
    pub(super) fn new(simulations: usize) -> Self {
        Self {
            phase: RunPhase::Reading,
            fraction: 0.0,
            from: 0.0,
            to: READ,
            step_end: WORKED,
            simulations_left: simulations,
        }
    }

    /// Begins the next phase of the work.
    pub(super) fn begin_phase(&mut self, phase: RunPhase) {
        let begin = self.fraction;
        match phase {
            RunPhase::Reading => self.take_part(begin, READ),
            RunPhase::Step { index, count } => {
                let place = |step: usize| READ + (WORKED - READ) * step as f64 / count.max(1) as f64;
                self.step_end = place(index + 1);
                self.take_part(place(index), self.step_end);
            }
            RunPhase::Simulating => {
                let end = self.step_end.max(begin);
                // Each simulation that is expected gets an equal part. One that is not expected gets half of
                // the rest.
                let parts = self.simulations_left.max(1) as f64;
                let to = match self.simulations_left {
                    0 => (begin + end) / 2.0,
                    _ => begin + (end - begin) / parts,
                };
                self.simulations_left = self.simulations_left.saturating_sub(1);
                self.take_part(begin, to);
            }
            RunPhase::Planning => self.take_part(begin, begin),
            RunPhase::Checking => {
                self.step_end = CHECKED;
                self.take_part(WORKED, CHECKED);
            }
            RunPhase::Writing => self.take_part(CHECKED, 1.0),
            // A phase that is not known here takes no part of the bar.
            _ => self.take_part(begin, begin),
        }
        self.phase = phase;
    }

    /// Notes that `done` of `whole` is done of the phase. Returns whether the fraction has grown.
    pub(super) fn report_progress(&mut self, done: f64, whole: f64) -> bool {
        let part = if whole > 0.0 { (done / whole).clamp(0.0, 1.0) } else { 0.0 };
        let reached = self.from + (self.to - self.from) * part;
        let grown = reached > self.fraction;
        self.fraction = self.fraction.max(reached);
        grown
    }

    /// Returns how much of the work is done, from 0 to 1. It never becomes less.
    pub(super) fn fraction(&self) -> f64 {
        self.fraction
    }

    /// Returns the phase that was begun last.
    pub(super) fn phase(&self) -> RunPhase {
        self.phase
    }

    fn take_part(&mut self, from: f64, to: f64) {
        self.fraction = self.fraction.max(from).min(1.0);
        self.from = self.fraction;
        self.to = to.max(self.from);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bar_never_jumps_back_whatever_a_run_does() {
        let steps = |index| RunPhase::Step { index, count: 3 };
        let phases = [
            RunPhase::Reading,
            steps(0),
            RunPhase::Simulating,
            RunPhase::Planning,
            RunPhase::Simulating,
            RunPhase::Simulating,
            steps(1),
            steps(2),
            RunPhase::Simulating,
            RunPhase::Checking,
            RunPhase::Simulating,
            RunPhase::Simulating,
            RunPhase::Writing,
        ];
        for simulations in 0..3 {
            let mut track = PhaseTrack::new(simulations);
            let mut last = 0.0;
            for phase in phases {
                track.begin_phase(phase);
                assert_eq!(track.phase(), phase);
                for done in [0.0, 1.0, 0.5, 4.0, 3.0, 10.0] {
                    track.report_progress(done, 10.0);
                    assert!(track.fraction() >= last && track.fraction() <= 1.0, "{phase:?} {track:?}");
                    last = track.fraction();
                }
            }
            assert_eq!(track.fraction(), 1.0);
        }
    }

    #[test]
    fn the_only_simulation_fills_nearly_the_whole_bar() {
        let mut track = PhaseTrack::new(1);
        track.begin_phase(RunPhase::Reading);
        track.begin_phase(RunPhase::Simulating);
        assert!(track.report_progress(1.0, 1.0));
        assert_eq!(track.fraction(), WORKED);
        assert!(!track.report_progress(0.5, 1.0));
        assert!(!track.report_progress(1.0, 0.0));
    }
}

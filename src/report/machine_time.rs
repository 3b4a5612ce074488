//! This module holds the times of a program on the machine of its setup, so that all reports tell the same.
//!
//! Where the axes of the machine or its corners are known, times come from the machine's model: look-ahead, corners,
//! axes, rapids from rest to rest. Else the time at feed has the acceleration of the setup if that is known, and rapids
//! go at the machine's rapid feed.

use crate::machine::{ProgramTime, time_program};
use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::program::{LengthUnit, Program};
use crate::setup::Setup;
use crate::transform::optimize_feed::PathTimer;
use std::sync::Arc;

/// The time of a motion on the machine, in s.
#[derive(Debug, Clone, Copy, Default)]
pub(in crate::report) struct MotionTime {
    /// How long it takes; `None` if that is not known.
    pub seconds: Option<f64>,
    /// How long the machine stands before it, or in its hole: for tool changes, starts of the spindle and dwells.
    pub standing_s: f64,
}

/// The times of all motions of a program.
#[derive(Debug, Clone)]
pub(in crate::report) struct MachineClock {
    /// The times of the motions that a path leads to, if the machine is known.
    motions: Option<Arc<Vec<MotionTime>>>,
    acceleration: Option<f64>,
    /// The time of the whole program by its parts, if the machine is known.
    pub(in crate::report) time: Option<ProgramTime>,
}

impl MachineClock {
    /// Computes the times of a program on the machine of a setup.
    pub(in crate::report) fn new(program: &Program, units: LengthUnit, setup: &Setup) -> Self {
        let acceleration = setup.machine.max_acceleration.map(|most| most.get());
        let Some(dynamics) = setup.machine.dynamics() else {
            return Self { motions: None, acceleration, time: None };
        };
        let mut time = time_program(program, units, &dynamics);
        let times = std::mem::take(&mut time.motions).into_iter().zip(std::mem::take(&mut time.standing));
        let moves = program.motions().map(|motion| motion.path != MotionPath::Start);
        let (mut motions, mut before_first) = (Vec::new(), 0.0);
        for ((seconds, standing_s), moves) in times.zip(moves) {
            before_first += standing_s;
            // No path leads to a first point; what the machine waits there it waits before the next motion.
            if moves {
                motions.push(MotionTime { seconds, standing_s: std::mem::take(&mut before_first) });
            }
        }
        if let Some(last) = motions.last_mut() {
            last.standing_s += before_first;
        }
        Self { motions: Some(Arc::new(motions)), acceleration, time: Some(time) }
    }

    /// Returns the time of a motion by its number among those that a path leads to; `else_s` where the machine is not known.
    pub(in crate::report) fn motion_seconds(&self, number: usize, else_s: Option<f64>) -> Option<f64> {
        match &self.motions {
            Some(motions) => motions.get(number).and_then(|time| time.seconds),
            None => else_s,
        }
    }

    /// Returns the time of a motion by its number among those that a path leads to; `None` where the machine is not known.
    pub(in crate::report) fn motion_time(&self, number: usize) -> Option<MotionTime> {
        self.motions.as_ref()?.get(number).copied()
    }

    /// Returns a timer to which nothing has been added.
    pub(in crate::report) fn start_timer(&self) -> GroupTimer {
        match &self.motions {
            Some(motions) => {
                let motions = Arc::clone(motions);
                GroupTimer::Machine { motions, feed: 0.0, rapid: Some(0.0), standing: 0.0 }
            }
            None => GroupTimer::Path(PathTimer::new(self.acceleration)),
        }
    }
}

/// Adds up the time of some motions.
#[derive(Debug, Clone)]
pub(in crate::report) enum GroupTimer {
    /// The machine is known.
    Machine { motions: Arc<Vec<MotionTime>>, feed: f64, rapid: Option<f64>, standing: f64 },
    /// At most the acceleration is known.
    Path(PathTimer),
}

impl GroupTimer {
    /// Adds a motion by its number among those that a path leads to, with its length in mm and its feed in mm/min.
    pub(in crate::report) fn add_motion(
        &mut self,
        program: &Program,
        motion: &Motion,
        number: usize,
        (length, feed): (f64, Option<f64>),
    ) {
        match self {
            Self::Path(timer) => timer.add_motion(program, motion, length, feed),
            Self::Machine { motions, feed, rapid, standing } => {
                let MotionTime { seconds, standing_s } = motions.get(number).copied().unwrap_or_default();
                *standing += standing_s;
                if motion.rapid {
                    *rapid = rapid.zip(seconds).map(|(sum, seconds)| sum + seconds);
                } else {
                    *feed += seconds.unwrap_or(0.0);
                }
            }
        }
    }

    /// Returns the time at feed in s; `None` if neither machine nor acceleration are known.
    pub(in crate::report) fn feed_seconds(&self) -> Option<f64> {
        match self {
            Self::Path(timer) => timer.seconds(),
            Self::Machine { feed, .. } => Some(*feed),
        }
    }

    /// Returns the time in s that the machine stands; `None` if it is not known.
    pub(in crate::report) fn standing_seconds(&self) -> Option<f64> {
        match self {
            Self::Path(_) => None,
            Self::Machine { standing, .. } => Some(*standing),
        }
    }

    /// Puts the time at rapid in place of the one at the machine's rapid feed, if the machine is known.
    pub(in crate::report) fn replace_rapid_seconds(&self, seconds: &mut Option<f64>) {
        if let Self::Machine { rapid, .. } = self {
            *seconds = *rapid;
        }
    }
}

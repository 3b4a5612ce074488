//! This module sums up lengths and times, motion by motion.

use crate::program::geometry::MotionPath;
use crate::program::motion::Motion;
use crate::program::{FeedUnit, LengthUnit};
use crate::report::table::{ColumnUnit, DisplayUnits};
use serde::Serialize;

/// Sums over motions. Lengths are in the file's unit, and times in seconds.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct MotionTotals {
    /// The number of motions. A first point is no motion, because no path leads to it.
    pub motions: usize,
    /// Length at feed.
    pub feed_length: f64,
    /// Length at rapid.
    pub rapid_length: f64,
    /// The time at feed, without acceleration and dwells, and without the motions whose time is not known.
    pub feed_seconds: f64,
    /// The same time with the machine's acceleration; `null` if the acceleration is not known.
    pub accelerated_seconds: Option<f64>,
    /// The time at rapid; `null` if the machine's rapid feed is not known.
    pub rapid_seconds: Option<f64>,
    /// The time in s that the machine stands for tool changes, starts of the spindle and dwells; `null` if the machine is not
    /// known.
    pub standing_seconds: Option<f64>,
    /// The motions at feed whose time is not known, with the reasons.
    pub unknown_time: UntimedMotions,
}

/// Motions at feed whose time is not known.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize)]
pub struct UntimedMotions {
    /// The number of motions.
    pub motions: usize,
    /// Their length.
    pub length: f64,
    /// How many of the motions have no feed programmed before them.
    pub no_feed: usize,
    /// How many of the motions have a feed per revolution without a speed in rev/min.
    pub no_spindle_speed: usize,
    /// How many of the motions have a feed of 0.
    pub zero_feed: usize,
}

/// The reason why a time is not known.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum UntimedReason {
    NoFeed,
    NoSpindleSpeed,
    ZeroFeed,
}

/// The length and the time of one motion.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MotionLengthAndTime {
    pub(super) rapid: bool,
    /// Whether a path leads to it: false for a first point.
    pub(super) moves: bool,
    pub(super) length: f64,
    pub(super) seconds: Result<f64, UntimedReason>,
}

impl MotionLengthAndTime {
    /// Returns length and time of a motion. `rapid` is the time of one unit of length at rapid, in seconds.
    pub(crate) fn from_motion(motion: &Motion, unit: LengthUnit, rapid: Option<f64>) -> Self {
        let length = motion.length();
        let moves = motion.path != MotionPath::Start;
        let seconds = match (moves, motion.rapid) {
            (false, _) => Ok(0.0),
            (true, true) => Ok(rapid.unwrap_or(0.0) * length),
            (true, false) => motion_seconds(motion, length, unit),
        };
        Self { rapid: motion.rapid, moves, length, seconds }
    }

    /// Returns the length in the file's unit.
    pub(crate) fn length(&self) -> f64 {
        self.length
    }
}

fn motion_seconds(motion: &Motion, length: f64, unit: LengthUnit) -> Result<f64, UntimedReason> {
    let feed = motion.feed.ok_or(UntimedReason::NoFeed)?;
    if feed.value <= 0.0 {
        return Err(UntimedReason::ZeroFeed);
    }
    if feed.unit_or_default() == FeedUnit::InverseTime {
        return Ok(60.0 / feed.value);
    }
    let rate = feed.mm_per_minute(unit, motion.spindle_rpm(), None).filter(|rate| *rate > 0.0);
    Ok(length * unit.mm_per_unit() / rate.ok_or(UntimedReason::NoSpindleSpeed)? * 60.0)
}

impl MotionTotals {
    /// Makes empty sums. `rapid_known` tells whether rapids have a time.
    pub(crate) fn new(rapid_known: bool) -> Self {
        Self { rapid_seconds: rapid_known.then_some(0.0), ..Self::default() }
    }

    /// Adds a motion.
    pub(crate) fn add_motion(&mut self, motion: &MotionLengthAndTime) {
        if !motion.moves {
            return;
        }
        self.motions += 1;
        if motion.rapid {
            self.rapid_length += motion.length;
            if let (Some(sum), Ok(seconds)) = (&mut self.rapid_seconds, motion.seconds) {
                *sum += seconds;
            }
            return;
        }
        self.feed_length += motion.length;
        let unknown = &mut self.unknown_time;
        match motion.seconds {
            Ok(seconds) => {
                self.feed_seconds += seconds;
                return;
            }
            Err(UntimedReason::NoFeed) => unknown.no_feed += 1,
            Err(UntimedReason::NoSpindleSpeed) => unknown.no_spindle_speed += 1,
            Err(UntimedReason::ZeroFeed) => unknown.zero_feed += 1,
        }
        unknown.motions += 1;
        unknown.length += motion.length;
    }

    /// Returns the sums in another unit of length.
    #[must_use]
    pub(in crate::report) fn converted(mut self, units: DisplayUnits) -> Self {
        for length in [&mut self.feed_length, &mut self.rapid_length, &mut self.unknown_time.length] {
            *length = units.convert(ColumnUnit::Length, *length);
        }
        self
    }

    /// Returns the length of the whole path.
    pub fn length(&self) -> f64 {
        self.feed_length + self.rapid_length
    }
}

//! This module sums lengths and times of motions.

use crate::program::LengthUnit;
use crate::program::motion::Motion;
use crate::report::motion_measure::measure_motion;

/// Lengths and time of a part of a program.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct PathSums {
    /// The length at feed, mm.
    pub feed_length_mm: f64,
    /// The length at rapid, mm.
    pub rapid_length_mm: f64,
    /// The time of the motions whose feed is known, s.
    pub seconds: f64,
    /// The motions whose feed is not known; a rapid is one where no setup tells the machine's rapid feed.
    pub untimed: usize,
}

impl PathSums {
    pub(super) fn of_motion(motion: &Motion, unit: LengthUnit, rapid_feed_mm_min: Option<f64>) -> Self {
        let measured = measure_motion(motion, unit, rapid_feed_mm_min);
        let (feed_length_mm, rapid_length_mm) =
            if measured.rapid { (0.0, measured.length_mm) } else { (measured.length_mm, 0.0) };
        Self {
            feed_length_mm,
            rapid_length_mm,
            seconds: measured.seconds.unwrap_or(0.0),
            untimed: usize::from(measured.seconds.is_none()),
        }
    }

    pub(super) fn add(&mut self, other: &Self) {
        self.feed_length_mm += other.feed_length_mm;
        self.rapid_length_mm += other.rapid_length_mm;
        self.seconds += other.seconds;
        self.untimed += other.untimed;
    }
}

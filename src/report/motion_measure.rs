//! This module measures the length, feed and time of a motion in the same way for all reports.

use crate::program::LengthUnit;
use crate::program::motion::Motion;

/// The measurements of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct MotionFeedAndTime {
    pub rapid: bool,
    /// The length of the path, mm.
    pub length_mm: f64,
    /// The feed of the tip in mm/min. For a rapid it is the machine's rapid feed.
    pub feed_mm_min: Option<f64>,
    /// The time at that feed in s, without acceleration; 0 for a path without length.
    pub seconds: Option<f64>,
}

/// Measures a motion. `units` is the unit of its lengths, and `rapid_feed` the machine's rapid feed, mm/min.
pub(crate) fn measure_motion(
    motion: &Motion,
    units: LengthUnit,
    rapid_feed: Option<f64>,
) -> MotionFeedAndTime {
    let length = motion.length();
    let length_mm = length * units.mm_per_unit();
    let feed_mm_min = if motion.rapid {
        rapid_feed
    } else {
        let rpm = motion.spindle_rpm().filter(|rpm| *rpm > 0.0);
        let feed = motion.feed.and_then(|feed| feed.mm_per_minute(units, rpm, Some(length)));
        feed.filter(|feed| *feed > 0.0)
    };
    let seconds = if length_mm > 0.0 { feed_mm_min.map(|feed| length_mm / feed * 60.0) } else { Some(0.0) };
    MotionFeedAndTime { rapid: motion.rapid, length_mm, feed_mm_min, seconds }
}

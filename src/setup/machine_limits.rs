//! This module holds the machine and its limits.

use crate::parameters::{LengthUnit, Positive};
use schemars::JsonSchema;
use serde::Deserialize;

/// The limits of a machine. A limit that is not known is `None`, and does not apply.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MachineLimits {
    /// The highest programmed feed, in mm/min.
    pub max_feed: Option<Positive>,
    /// The speed of rapid motions, in mm/min.
    pub rapid_feed: Option<Positive>,
    /// The largest change of feed along the path, in (mm/min)/s.
    pub max_acceleration: Option<Positive>,
}

impl MachineLimits {
    /// Returns the limits of this machine, and those of `base` where this one has none.
    pub(super) fn override_base(self, base: Self) -> Self {
        Self {
            max_feed: self.max_feed.or(base.max_feed),
            rapid_feed: self.rapid_feed.or(base.rapid_feed),
            max_acceleration: self.max_acceleration.or(base.max_acceleration),
        }
    }
}

/// The limits of a machine, in the file's unit.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Machine")]
pub(super) struct MachineText {
    /// The highest programmed feed, in the file's unit per minute.
    max_feed: Option<Positive>,
    /// The speed of rapid motions, in the file's unit per minute.
    rapid_feed: Option<Positive>,
    /// The largest change of feed along the path, in the file's unit per minute and second. With 1000, the
    /// machine needs 3 s from standstill to a feed of 3000.
    max_acceleration: Option<Positive>,
}

impl MachineText {
    /// Converts the limits to millimetres. Only numbers near the largest `f64` leave the range in the
    /// conversion, and these limit nothing.
    pub(super) fn check_limits(self, units: LengthUnit) -> MachineLimits {
        let to_mm = |value: Option<Positive>| {
            value.and_then(|value| Positive::new(value.get() * units.mm_per_unit()))
        };
        MachineLimits {
            max_feed: to_mm(self.max_feed),
            rapid_feed: to_mm(self.rapid_feed),
            max_acceleration: to_mm(self.max_acceleration),
        }
    }
}

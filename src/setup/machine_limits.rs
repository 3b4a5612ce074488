//! The machine and its limits.

use crate::parameters::{LengthUnit, Positive};
use schemars::JsonSchema;
use serde::Deserialize;

/// A machine's limits; what is not known is `None`, and does not limit.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct MachineLimits {
    /// Highest programmed feed, in mm/min.
    pub max_feed: Option<Positive>,
    /// Speed of rapid motions, in mm/min.
    pub rapid_feed: Option<Positive>,
    /// How fast the feed can change along the path, in (mm/min)/s.
    pub max_acceleration: Option<Positive>,
}

impl MachineLimits {
    /// This machine where it says something, `base` where it does not.
    pub(super) fn override_base(self, base: Self) -> Self {
        Self {
            max_feed: self.max_feed.or(base.max_feed),
            rapid_feed: self.rapid_feed.or(base.rapid_feed),
            max_acceleration: self.max_acceleration.or(base.max_acceleration),
        }
    }
}

/// A machine's limits, in the file's unit.
#[derive(Debug, Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(rename = "Machine")]
pub(super) struct MachineText {
    /// Highest programmed feed, in the file's unit per minute.
    max_feed: Option<Positive>,
    /// Speed of rapid motions, in the file's unit per minute.
    rapid_feed: Option<Positive>,
    /// How fast the feed can change along the path: in the file's unit per minute, each second. 1000 takes 3 s from a
    /// standstill to a feed of 3000.
    max_acceleration: Option<Positive>,
}

impl MachineText {
    /// In millimetres. Only numbers near the largest `f64` leave the range when converted; they limit nothing.
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

//! This module converts values from one unit to another.

use crate::program::{FeedUnit, LengthUnit};

/// The number of metres in a foot.
const METRES_PER_FOOT: f64 = 0.3048;

/// A conversion between two units that differ.
#[derive(Debug, Clone, Copy)]
pub(super) struct UnitConversion {
    /// The old unit.
    pub from: LengthUnit,
    /// The new one.
    pub to: LengthUnit,
}

impl UnitConversion {
    /// Converts a length, or a feed in units of the file. Dividing by 25.4 rounds once, where multiplying by
    /// 1/25.4 would round twice.
    pub(super) fn convert_length(self, value: f64) -> f64 {
        value * self.from.mm_per_unit() / self.to.mm_per_unit()
    }

    /// Returns how many decimals a number needs beyond its own. 0.01 mm is 0.0004 in, so two more keep half
    /// of the last decimal.
    pub(super) fn extra_decimals(self) -> usize {
        match self.to {
            LengthUnit::Inch => 2,
            LengthUnit::Mm => 0,
        }
    }

    /// Returns how a feed in a unit changes (`None` is the file's unit per minute): its new word where that
    /// changes, and whether its value is converted.
    pub(super) fn convert_feed_unit(self, unit: Option<FeedUnit>) -> (Option<FeedUnit>, bool) {
        let unit = unit.unwrap_or(FeedUnit::PerMinute);
        if unit.length_unit(self.from) != Some(self.from) {
            return (None, false);
        }
        let word = match (unit, self.to) {
            (FeedUnit::MmPerMinute, LengthUnit::Inch) => Some(FeedUnit::InchPerMinute),
            (FeedUnit::MmPerRevolution, LengthUnit::Inch) => Some(FeedUnit::InchPerRevolution),
            (FeedUnit::InchPerMinute, LengthUnit::Mm) => Some(FeedUnit::MmPerMinute),
            (FeedUnit::InchPerRevolution, LengthUnit::Mm) => Some(FeedUnit::MmPerRevolution),
            _ => None,
        };
        (word, true)
    }

    /// Converts a surface speed from m/min to ft/min, or back.
    pub(super) fn convert_surface_speed(self, value: f64) -> f64 {
        match self.to {
            LengthUnit::Inch => value / METRES_PER_FOOT,
            LengthUnit::Mm => value * METRES_PER_FOOT,
        }
    }
}

//! This module defines the units of columns, and is the only place where values are converted for the reader.
//!
//! The library measures in mm. A reader sees values in the unit of the program, or in the unit of
//! `--display-units` if it is given ([`DisplayUnits::of_program`]).

use super::text_format::{format_fixed, format_trimmed};
use crate::program::{LengthUnit, Program};
use std::borrow::Cow;

/// The unit of a column. It is a type and not a text, so that a table can be shown in another unit of length.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ColumnUnit {
    /// A count, a text, or a value whose unit is in the text or in another column.
    None,
    /// mm or inch.
    Length,
    /// mm2 or square inches.
    Area,
    /// mm3 or cubic inches.
    Volume,
    /// mm/min or inch/min.
    FeedPerMinute,
    /// mm3/min or cubic inches per minute.
    RemovalRate,
    /// Degrees.
    Angle,
    /// Seconds.
    Duration,
    /// Newtons.
    Force,
    /// Newton metres.
    Torque,
    /// Kilowatts.
    Power,
    /// Megapascals.
    Stress,
}

/// The unit of length that the values of a table are in, and the one that they are shown in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DisplayUnits {
    /// The unit of the values as they are computed.
    pub values_in: LengthUnit,
    /// The unit that a reader sees.
    pub shown_in: LengthUnit,
}

impl DisplayUnits {
    /// The units of values in mm that are shown in mm.
    pub const MM: Self = Self { values_in: LengthUnit::Mm, shown_in: LengthUnit::Mm };

    /// Makes units for values in a unit that are shown in the same unit.
    pub fn unconverted(unit: LengthUnit) -> Self {
        Self { values_in: unit, shown_in: unit }
    }

    /// Makes units for values in mm that are shown in another unit.
    pub fn from_mm(shown_in: LengthUnit) -> Self {
        Self { values_in: LengthUnit::Mm, shown_in }
    }

    /// Makes units for values in mm of a program whose lengths are in `program_unit`. They are shown in that
    /// unit, or in `asked` if a unit was asked for.
    pub fn of_program(program_unit: LengthUnit, asked: Option<LengthUnit>) -> Self {
        Self::from_mm(asked.unwrap_or(program_unit))
    }

    /// Makes units for values in mm of a program that a recipe changed. `recipe_unit` is the unit if neither
    /// the program nor its feeds state one.
    pub fn of_recipe(program: &Program, recipe_unit: LengthUnit, asked: Option<LengthUnit>) -> Self {
        let told = program.stated_length_unit().or_else(|| program.feed_length_unit());
        Self::of_program(told.unwrap_or(recipe_unit), asked)
    }

    /// Converts a value of a column to what the reader sees. A value that is not converted keeps every bit.
    pub(crate) fn convert(self, unit: ColumnUnit, value: f64) -> f64 {
        if self.values_in == self.shown_in {
            return value;
        }
        let factor = self.values_in.mm_per_unit() / self.shown_in.mm_per_unit();
        value * factor.powi(unit.length_exponent())
    }

    /// Returns how many decimals a shown value needs if the same value in mm has `decimals`. An inch is
    /// 10^1.4 mm, so a length in inches has one decimal more, an area three and a volume four.
    pub(crate) fn decimals(self, unit: ColumnUnit, decimals: usize) -> usize {
        let more = match unit.length_exponent() {
            1 => 1,
            2 => 3,
            3 => 4,
            _ => 0,
        };
        match self.shown_in {
            LengthUnit::Inch => decimals + more,
            LengthUnit::Mm => decimals,
        }
    }

    /// Returns a name for machines with the unit at its end: `cell_mm`.
    pub(crate) fn key(self, name: &'static str, unit: ColumnUnit) -> Cow<'static, str> {
        match unit.key_suffix(self.shown_in) {
            "" => Cow::Borrowed(name),
            suffix => Cow::Owned(format!("{name}{suffix}")),
        }
    }

    /// Returns a name for people with the unit behind it: `feed, mm/min`.
    pub(crate) fn title(self, name: &str, unit: ColumnUnit) -> String {
        match unit.marked_symbol(self.shown_in) {
            "" => name.to_owned(),
            symbol => format!("{name}, {symbol}"),
        }
    }

    /// Prints a value with its unit in a sentence: `12.30 mm`. `decimals` are those in mm.
    pub(crate) fn tell_fixed(self, unit: ColumnUnit, value: f64, decimals: usize) -> String {
        let number = format_fixed(self.convert(unit, value), self.decimals(unit, decimals));
        self.join_symbol(unit, number)
    }

    /// Prints a value with its unit in a sentence and without trailing zeros: `12.3 mm`. `most_decimals` are
    /// those in mm.
    pub(crate) fn tell_trimmed(self, unit: ColumnUnit, value: f64, most_decimals: usize) -> String {
        let number = format_trimmed(self.convert(unit, value), self.decimals(unit, most_decimals));
        self.join_symbol(unit, number)
    }

    fn join_symbol(self, unit: ColumnUnit, number: String) -> String {
        match unit.symbol(self.shown_in) {
            "" => number,
            symbol => format!("{number} {symbol}"),
        }
    }
}

/// By default, values are in mm and shown in mm.
impl Default for DisplayUnits {
    fn default() -> Self {
        Self::MM
    }
}

impl ColumnUnit {
    /// Returns the exponent of length in the unit: 3 for a volume, 0 for a force.
    fn length_exponent(self) -> i32 {
        match self {
            Self::Length | Self::FeedPerMinute => 1,
            Self::Area => 2,
            Self::Volume | Self::RemovalRate => 3,
            Self::None | Self::Angle | Self::Duration => 0,
            Self::Force | Self::Torque | Self::Power | Self::Stress => 0,
        }
    }

    /// Returns what the name of a column ends with in CSV heads and JSON keys: `_mm`.
    pub(crate) fn key_suffix(self, shown_in: LengthUnit) -> &'static str {
        use LengthUnit::{Inch, Mm};
        match (self, shown_in) {
            (Self::None, _) => "",
            (Self::Length, Mm) => "_mm",
            (Self::Length, Inch) => "_in",
            (Self::Area, Mm) => "_mm2",
            (Self::Area, Inch) => "_in2",
            (Self::Volume, Mm) => "_mm3",
            (Self::Volume, Inch) => "_in3",
            (Self::FeedPerMinute, Mm) => "_mm_min",
            (Self::FeedPerMinute, Inch) => "_in_min",
            (Self::RemovalRate, Mm) => "_mm3_min",
            (Self::RemovalRate, Inch) => "_in3_min",
            (Self::Angle, _) => "_deg",
            (Self::Duration, _) => "_s",
            (Self::Force, _) => "_n",
            (Self::Torque, _) => "_nm",
            (Self::Power, _) => "_kw",
            (Self::Stress, _) => "_mpa",
        }
    }

    /// Returns the unit as people write it in plain text: `mm3/min`. Durations print their unit beside each
    /// value.
    pub(crate) fn symbol(self, shown_in: LengthUnit) -> &'static str {
        use LengthUnit::{Inch, Mm};
        match (self, shown_in) {
            (Self::None | Self::Duration, _) => "",
            (Self::Length, Mm) => "mm",
            (Self::Length, Inch) => "in",
            (Self::Area, Mm) => "mm2",
            (Self::Area, Inch) => "in2",
            (Self::Volume, Mm) => "mm3",
            (Self::Volume, Inch) => "in3",
            (Self::FeedPerMinute, Mm) => "mm/min",
            (Self::FeedPerMinute, Inch) => "in/min",
            (Self::RemovalRate, Mm) => "mm3/min",
            (Self::RemovalRate, Inch) => "in3/min",
            (Self::Angle, _) => "degrees",
            (Self::Force, _) => "N",
            (Self::Torque, _) => "N m",
            (Self::Power, _) => "kW",
            (Self::Stress, _) => "MPa",
        }
    }

    /// Returns the unit as people write it where exponents can be raised: `mm³/min`.
    pub(crate) fn marked_symbol(self, shown_in: LengthUnit) -> &'static str {
        match self.symbol(shown_in) {
            "mm2" => "mm²",
            "mm3" => "mm³",
            "mm3/min" => "mm³/min",
            "in2" => "in²",
            "in3" => "in³",
            "in3/min" => "in³/min",
            symbol => symbol,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn values_in_mm_are_shown_in_inches() {
        let units = DisplayUnits { shown_in: LengthUnit::Inch, ..DisplayUnits::MM };
        let near = |a: f64, b: f64| (a - b).abs() < 1e-12;
        assert!(near(units.convert(ColumnUnit::Length, 25.4), 1.0));
        assert!(near(units.convert(ColumnUnit::FeedPerMinute, 508.0), 20.0));
        assert!(near(units.convert(ColumnUnit::Area, 645.16), 1.0));
        assert!(near(units.convert(ColumnUnit::RemovalRate, 16_387.064), 1.0));
        assert!(near(units.convert(ColumnUnit::Power, 2.5), 2.5), "not a length");
        assert_eq!(units.decimals(ColumnUnit::Length, 3), 4);
        assert_eq!(units.decimals(ColumnUnit::Volume, 1), 5);
        assert_eq!(units.decimals(ColumnUnit::Force, 1), 1);
    }

    #[test]
    fn values_in_inches_are_shown_in_mm() {
        let units = DisplayUnits { values_in: LengthUnit::Inch, shown_in: LengthUnit::Mm };
        assert!((units.convert(ColumnUnit::Length, 2.0) - 50.8).abs() < 1e-12);
        assert_eq!(units.decimals(ColumnUnit::Length, 4), 4, "decimals are those in mm");
        assert_eq!(units.tell_fixed(ColumnUnit::Length, 2.0, 1), "50.8 mm");
    }

    #[test]
    fn what_is_not_converted_keeps_every_bit() {
        for unit in [LengthUnit::Mm, LengthUnit::Inch] {
            let units = DisplayUnits::unconverted(unit);
            assert_eq!(units.convert(ColumnUnit::Volume, 0.1 + 0.2).to_bits(), (0.1f64 + 0.2).to_bits());
        }
    }
}

//! This module holds numbers with a range.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{self, Deserialize, Deserializer, Unexpected, Visitor};
use serde::{Serialize, Serializer};
use std::borrow::Cow;
use std::fmt;

/// Returns a length in mm as schemas state it for a default: `0.5 mm`.
pub(crate) fn describe_length_mm(length_mm: f64) -> String {
    format!("{length_mm} mm")
}

/// Writes a number type. The range is given as a phrase, as a check and as JSON schema keywords.
macro_rules! number {
    ($(#[$doc:meta])* $name:ident, $phrase:literal, |$value:ident| $fits:expr, { $($schema:tt)* }) => {
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, PartialOrd)]
        pub struct $name(f64);

        impl $name {
            #[doc = concat!("Makes ", $phrase, ". Returns `None` for other values.")]
            pub fn new($value: f64) -> Option<Self> {
                ($value.is_finite() && $fits).then_some(Self($value))
            }

            /// Returns the number.
            pub fn get(self) -> f64 {
                self.0
            }
        }

        impl<'de> Deserialize<'de> for $name {
            fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                deserializer.deserialize_any(NumberVisitor { phrase: $phrase, make: $name::new })
            }
        }

        impl Serialize for $name {
            fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.serialize_f64(self.0)
            }
        }

        impl fmt::Display for $name {
            fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
                self.0.fmt(f)
            }
        }

        impl JsonSchema for $name {
            fn inline_schema() -> bool {
                true
            }
            fn schema_name() -> Cow<'static, str> {
                stringify!($name).into()
            }
            fn json_schema(_: &mut SchemaGenerator) -> Schema {
                json_schema!({ "type": "number", $($schema)* })
            }
        }
    };
}

number! {
    /// A finite number greater than 0, for example a length, a feed or a diameter.
    Positive, "a number greater than 0", |value| value > 0.0, { "exclusiveMinimum": 0 }
}
number! {
    /// A finite number of 0 or more, for example a clearance, or a tolerance that may be zero.
    NonNegative, "a number, 0 or more", |value| value >= 0.0, { "minimum": 0 }
}
number! {
    /// Any finite number, for example a coordinate or an offset.
    Finite, "a number", |value| value.is_finite(), { }
}
number! {
    /// A fraction from 0 to 1, including both. For example, 50 % is 0.5.
    Fraction, "a number from 0 to 1", |value| (0.0..=1.0).contains(&value), { "minimum": 0, "maximum": 1 }
}
number! {
    /// A part of a whole that is there: above 0, at most 1.
    PositiveFraction, "a number above 0 and up to 1", |value| value > 0.0 && value <= 1.0,
    { "exclusiveMinimum": 0, "maximum": 1 }
}
number! {
    /// An angle in degrees, which may be any finite number.
    Degrees, "an angle in degrees", |value| value.is_finite(), { "x-unit": "degrees" }
}
number! {
    /// A factor greater than 0.
    Factor, "a factor greater than 0", |value| value > 0.0, { "exclusiveMinimum": 0 }
}

number! {
    /// An angle in degrees between a line and a plane or an axis to which it is never perpendicular, for
    /// example a taper or the bottom of a cutter.
    Slope, "an angle from 0 to below 90 degrees", |value| (0.0..90.0).contains(&value),
    { "minimum": 0, "exclusiveMaximum": 90, "x-unit": "degrees" }
}
number! {
    /// The full point angle of a drill in degrees. A flat bottom has 180.
    PointAngle, "an angle above 0 and up to 180 degrees", |value| value > 0.0 && value <= 180.0,
    { "exclusiveMinimum": 0, "maximum": 180, "x-unit": "degrees" }
}
number! {
    /// The helix angle of teeth in degrees. It is negative for a left-hand helix.
    HelixAngle, "an angle between -90 and 90 degrees", |value| value.abs() < 90.0,
    { "exclusiveMinimum": -90, "exclusiveMaximum": 90, "x-unit": "degrees" }
}

/// Adds the conversion to radians to types of angles in degrees.
macro_rules! radians {
    ($($name:ident)*) => {
        $(impl $name {
            /// Returns the angle in radians.
            pub fn radians(self) -> f64 {
                self.0.to_radians()
            }
        })*
    };
}
radians! { Degrees Slope PointAngle HelixAngle }

impl Fraction {
    /// The fraction 0.5 %.
    pub(crate) const HALF_PERCENT: Self = Self(0.005);
}

impl NonNegative {
    /// The number 1.
    pub const ONE: Self = Self(1.0);
}

/// Reads a number and checks its range at the number itself. A later check would make the error point at the
/// whole map.
struct NumberVisitor<T> {
    phrase: &'static str,
    make: fn(f64) -> Option<T>,
}

impl<T> NumberVisitor<T> {
    fn check_range<E: de::Error>(&self, value: f64, found: Unexpected<'_>) -> Result<T, E> {
        (self.make)(value).ok_or_else(|| E::invalid_value(found, &self.phrase))
    }
}

impl<T> Visitor<'_> for NumberVisitor<T> {
    type Value = T;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.phrase)
    }
    fn visit_f64<E: de::Error>(self, value: f64) -> Result<T, E> {
        self.check_range(value, Unexpected::Float(value))
    }
    fn visit_u64<E: de::Error>(self, value: u64) -> Result<T, E> {
        self.check_range(value as f64, Unexpected::Unsigned(value))
    }
    fn visit_i64<E: de::Error>(self, value: i64) -> Result<T, E> {
        self.check_range(value as f64, Unexpected::Signed(value))
    }
    fn visit_str<E: de::Error>(self, text: &str) -> Result<T, E> {
        Err(match suggest_number(text) {
            Some(help) => E::custom(format!("expected {}, found the text `{text}`\n{help}", self.phrase)),
            None => E::invalid_type(Unexpected::Str(text), &self),
        })
    }
}

/// Returns what to do about a text that is nearly a number.
fn suggest_number(text: &str) -> Option<String> {
    let text = text.trim();
    if let Ok(value) = text.parse::<f64>() {
        // YAML keeps a number as text if it is too large.
        if value.is_infinite() && text.contains(|c: char| c.is_ascii_digit()) {
            return Some("The number is too large.".to_owned());
        }
        if !value.is_finite() {
            return None;
        }
        return Some(format!("Write it without quotes: {text}."));
    }
    let point = text.replacen(',', ".", 1);
    if point != text && point.parse::<f64>().is_ok() {
        return Some(format!("Write a decimal point: {point}."));
    }
    let number = text.trim_end_matches(|c: char| !c.is_ascii_digit() && c != '.').trim_end();
    let unit = text.get(number.len()..)?.trim();
    if number.parse::<f64>().is_err() {
        return None;
    }
    Some(match unit {
        "%" => format!(
            "Write a percentage as a fraction of 1: {} for {number} %.",
            number.parse::<f64>().ok()? / 100.0
        ),
        "°" | "deg" => format!("Write only the number: {number}."),
        _ => format!("Write only the number: {number}. Units are set once for the whole file, by `units:`."),
    })
}

/// A whole number of 1 or more, for example of teeth or passes.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize)]
pub struct PositiveCount(u32);

impl PositiveCount {
    /// Makes a count. Returns `None` for 0.
    pub fn new(value: u32) -> Option<Self> {
        (value > 0).then_some(Self(value))
    }

    /// Returns the number.
    pub fn get(self) -> u32 {
        self.0
    }
}

impl<'de> Deserialize<'de> for PositiveCount {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let make = |value: f64| {
            let whole = value.fract() == 0.0 && (1.0..=f64::from(u32::MAX)).contains(&value);
            whole.then_some(Self(value as u32))
        };
        deserializer.deserialize_any(NumberVisitor { phrase: "a whole number, 1 or more", make })
    }
}

impl JsonSchema for PositiveCount {
    fn inline_schema() -> bool {
        true
    }
    fn schema_name() -> Cow<'static, str> {
        "Count".into()
    }
    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "integer", "minimum": 1, "maximum": u32::MAX })
    }
}

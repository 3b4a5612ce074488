//! Values that are right once they are read: numbers with a range, units, name patterns, paths.
//!
//! A parameter of type [`Positive`] needs no check in the transform that uses it. The check happens while the YAML is read,
//! so the error points at the number itself; the JSON schema tells editors the same range.

mod files;
mod numbers;
mod patterns;

pub use crate::program::LengthUnit;
pub use files::FilePath;
pub use numbers::{
    Count, Degrees, Factor, Finite, Fraction, HelixAngle, NonNegative, PointAngle, Positive, Slope,
};
pub use patterns::{BadGlob, Glob, ToolPattern};

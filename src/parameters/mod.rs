//! This module holds values that are valid once they are read: numbers with a range, units, name patterns and
//! paths.
//!
//! A parameter of type [`Positive`] needs no check in the transform that uses it. The check happens while the
//! YAML is read, so the error points at the number itself. The JSON schema gives editors the same range.
//!
//! ```
//! use clsmith::parameters::{Factor, NonNegative, Positive};
//!
//! assert_eq!(Positive::new(0.5).map(Positive::get), Some(0.5));
//! assert_eq!(Positive::new(0.0), None);
//! assert!(NonNegative::new(0.0).is_some() && Factor::new(f64::NAN).is_none());
//! ```

mod file_path;
mod name_patterns;
mod numbers;
mod similar_name;

pub use crate::program::LengthUnit;
pub use file_path::FilePath;
pub use name_patterns::{Glob, GlobError, ToolPattern};
pub(crate) use numbers::describe_length_mm;
pub use numbers::{
    Degrees, Factor, Finite, Fraction, HelixAngle, NonNegative, PointAngle, Positive, PositiveCount,
    PositiveFraction, Slope,
};
pub(crate) use similar_name::find_similar_name;

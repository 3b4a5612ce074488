//! This module holds values of cells before anything is printed.

use std::borrow::Cow;

/// The value in one cell, in the units that the table's values are in.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum TableValue<'r> {
    /// The value is not known or makes no sense here.
    Missing,
    /// A text, such as a name.
    Text(Cow<'r, str>),
    /// A yes or no.
    Flag(bool),
    /// A whole number.
    Count(usize),
    /// A number in the column's unit.
    Number(f64),
    /// The least and the greatest of several numbers in the column's unit.
    Range([f64; 2]),
    /// A time in seconds. If it leaves something out whose time is not known, it is a lower bound.
    Duration { seconds: f64, is_lower_bound: bool },
    /// A largest value in the column's unit and the place of the motion that has it.
    Peak { value: f64, place: PeakPlace },
    /// Several intervals in the column's unit.
    Intervals(&'r [[f64; 2]]),
    /// The index of an entry in another list, and the name that people know.
    Reference { index: Option<usize>, name: Cow<'r, str> },
}

/// The place of a largest value.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum PeakPlace {
    /// The line of a motion. It is `None` for a motion that a step has inserted.
    Line(Option<usize>),
    /// The line of a motion and the height of the layer in mm; a value of the whole motion has no height.
    Layer { line: usize, z_mm: Option<f64> },
}

impl<'r> TableValue<'r> {
    /// Makes a cell of a text that lives as long as the row.
    pub(crate) fn text(text: &'r str) -> Self {
        Self::Text(Cow::Borrowed(text))
    }

    /// Makes a cell of a time that leaves nothing out, or that is not known.
    pub(crate) fn duration(seconds: Option<f64>) -> Self {
        seconds.map_or(Self::Missing, |seconds| Self::Duration { seconds, is_lower_bound: false })
    }

    /// Returns whether nothing is known.
    pub(crate) fn is_missing(&self) -> bool {
        matches!(self, Self::Missing)
    }

    /// Returns the value as one number for comparisons, if it is one.
    pub(crate) fn as_number(&self) -> Option<f64> {
        match self {
            Self::Number(value) | Self::Peak { value, .. } => Some(*value),
            Self::Duration { seconds, .. } => Some(*seconds),
            Self::Count(count) => Some(*count as f64),
            Self::Missing
            | Self::Text(_)
            | Self::Flag(_)
            | Self::Range(_)
            | Self::Intervals(_)
            | Self::Reference { .. } => None,
        }
    }
}

impl From<f64> for TableValue<'_> {
    fn from(value: f64) -> Self {
        Self::Number(value)
    }
}

impl From<Option<f64>> for TableValue<'_> {
    fn from(value: Option<f64>) -> Self {
        value.map_or(Self::Missing, Self::Number)
    }
}

impl From<usize> for TableValue<'_> {
    fn from(count: usize) -> Self {
        Self::Count(count)
    }
}

impl From<Option<usize>> for TableValue<'_> {
    fn from(count: Option<usize>) -> Self {
        count.map_or(Self::Missing, Self::Count)
    }
}

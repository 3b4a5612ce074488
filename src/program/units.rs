//! This module holds the units of length, feed and spindle speed.

/// The millimetres in an inch.
pub(crate) const MM_PER_INCH: f64 = 25.4;

/// Unit of lengths.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[cfg_attr(
    feature = "simulation",
    derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema),
    serde(rename_all = "lowercase")
)]
pub enum LengthUnit {
    /// Millimetres.
    #[default]
    Mm,
    /// Inches.
    Inch,
}

impl std::fmt::Display for LengthUnit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Self::Mm => "mm",
            Self::Inch => "inch",
        })
    }
}

impl LengthUnit {
    /// Returns the millimetres in one unit.
    ///
    /// ```
    /// use clsmith::program::LengthUnit;
    ///
    /// assert_eq!(2.0 * LengthUnit::Inch.mm_per_unit(), 50.8);
    /// ```
    pub fn mm_per_unit(self) -> f64 {
        match self {
            Self::Mm => 1.0,
            Self::Inch => MM_PER_INCH,
        }
    }
}

/// The unit of a feed, as a word of the record gives it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[non_exhaustive]
pub enum FeedUnit {
    /// `MMPM`: mm/min.
    MmPerMinute,
    /// `MMPR`: mm/rev.
    MmPerRevolution,
    /// `IPM`: inch/min.
    InchPerMinute,
    /// `IPR`: inch/rev.
    InchPerRevolution,
    /// `PERMIN`: units of the file per minute.
    PerMinute,
    /// `PERREV`: units of the file per revolution.
    PerRevolution,
    /// `INVERS`, `INVTIM`: moves per minute (1/min).
    InverseTime,
}

impl FeedUnit {
    /// Returns the unit that a word of the standard names.
    pub fn from_word(word: &str) -> Option<Self> {
        Some(match word {
            "MMPM" => Self::MmPerMinute,
            "MMPR" => Self::MmPerRevolution,
            "IPM" => Self::InchPerMinute,
            "IPR" => Self::InchPerRevolution,
            "PERMIN" | "UPM" => Self::PerMinute,
            "PERREV" | "UPR" => Self::PerRevolution,
            "INVERS" | "INVERSE" | "INVTIM" => Self::InverseTime,
            _ => return None,
        })
    }

    /// Returns the word of the standard.
    pub fn word(self) -> &'static str {
        match self {
            Self::MmPerMinute => "MMPM",
            Self::MmPerRevolution => "MMPR",
            Self::InchPerMinute => "IPM",
            Self::InchPerRevolution => "IPR",
            Self::PerMinute => "PERMIN",
            Self::PerRevolution => "PERREV",
            Self::InverseTime => "INVERS",
        }
    }

    /// Returns whether the feed is per revolution of the spindle.
    pub fn is_per_revolution(self) -> bool {
        matches!(self, Self::MmPerRevolution | Self::InchPerRevolution | Self::PerRevolution)
    }

    /// Returns the unit of length in the feed: the one that its word names, else the file's; `None` for
    /// inverse time.
    pub fn length_unit(self, file: LengthUnit) -> Option<LengthUnit> {
        match self {
            Self::MmPerMinute | Self::MmPerRevolution => Some(LengthUnit::Mm),
            Self::InchPerMinute | Self::InchPerRevolution => Some(LengthUnit::Inch),
            Self::PerMinute | Self::PerRevolution => Some(file),
            Self::InverseTime => None,
        }
    }
}

/// A feed in force: its value and its unit, if the file gives one.
///
/// ```
/// use clsmith::program::{Feed, FeedUnit, LengthUnit};
///
/// let per_turn = Feed { value: 0.2, unit: Some(FeedUnit::MmPerRevolution) };
/// let feed = per_turn.mm_per_minute(LengthUnit::Mm, Some(5000.0), None);
/// assert_eq!(feed, Some(1000.0));
/// // A feed per revolution means nothing without a spindle speed.
/// assert_eq!(per_turn.mm_per_minute(LengthUnit::Mm, None, None), None);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Feed {
    /// The programmed value, in `unit`.
    pub value: f64,
    /// The unit that the file gives; `None` if no FEDRAT has named one yet (then units of the file per
    /// minute).
    pub unit: Option<FeedUnit>,
}

impl Feed {
    /// Returns the unit, or the default of the standard if the file names none.
    pub fn unit_or_default(self) -> FeedUnit {
        self.unit.unwrap_or(FeedUnit::PerMinute)
    }

    /// Returns the feed in mm/min. `spindle_rpm` (rev/min) is needed for feeds per revolution, and `length`,
    /// the length of the path in the file's unit, for inverse time. Returns `None` if what is needed is not
    /// known.
    pub fn mm_per_minute(
        self,
        file: LengthUnit,
        spindle_rpm: Option<f64>,
        length: Option<f64>,
    ) -> Option<f64> {
        let unit = self.unit_or_default();
        // An inverse-time feed counts motions per minute, so the speed is its value times the length.
        let Some(length_unit) = unit.length_unit(file) else {
            return length.map(|length| self.value * length * file.mm_per_unit());
        };
        let per_minute = if unit.is_per_revolution() { self.value * spindle_rpm? } else { self.value };
        Some(per_minute * length_unit.mm_per_unit())
    }
}

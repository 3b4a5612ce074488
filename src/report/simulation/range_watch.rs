//! This module notices cuts outside the range in which the coefficients of the material were measured.

use crate::diagnostic::{Diagnostic, codes};
use crate::report::table::{ColumnUnit, DisplayUnits};
use crate::report::text_format::{format_counted, format_trimmed};
use crate::setup::MaterialOrigin;

/// By what part a cut may be outside a range before it counts.
const SLACK_PART: f64 = 0.05;

/// Collects what is outside the ranges of a material.
#[derive(Debug, Default)]
pub(super) struct RangeWatch {
    /// The ranges: what is measured, its unit, and its range.
    ranges: Vec<(&'static str, &'static str, [f64; 2])>,
    /// For each range the number of cuts outside, and the farthest values.
    outside: Vec<(usize, [f64; 2])>,
}

impl RangeWatch {
    /// Watches the ranges of a material that was measured; an estimate has nothing to be outside of.
    pub(super) fn new(origin: Option<&MaterialOrigin>) -> Self {
        let Some(origin) = origin.filter(|origin| origin.residual_part.is_some()) else {
            return Self::default();
        };
        let all = [
            ("thickest chips", "mm", origin.chip_range_mm),
            ("cutting speeds", "m/min", origin.speed_range_m_min),
            ("axial depths", "mm", origin.depth_range_mm),
        ];
        let ranges: Vec<_> =
            all.into_iter().filter_map(|(what, unit, range)| Some((what, unit, range?))).collect();
        let outside = vec![(0, [f64::INFINITY, f64::NEG_INFINITY]); ranges.len()];
        Self { ranges, outside }
    }

    /// Looks at a cut: its thickest chip in mm, its speed in m/min and its depth in mm, as far as they are known.
    pub(super) fn check_cut(&mut self, chip: Option<f64>, speed: Option<f64>, depth: Option<f64>) {
        for ((what, _, [low, high]), (count, farthest)) in self.ranges.iter().zip(&mut self.outside) {
            let value = match *what {
                "thickest chips" => chip,
                "cutting speeds" => speed,
                _ => depth,
            };
            let is_outside =
                |value: &f64| *value < low * (1.0 - SLACK_PART) || *value > high * (1.0 + SLACK_PART);
            if let Some(value) = value.filter(is_outside) {
                *count += 1;
                *farthest = [farthest[0].min(value), farthest[1].max(value)];
            }
        }
    }

    /// Returns a finding for each range that cuts are outside of, with lengths as readers see them.
    pub(super) fn into_findings(self, units: DisplayUnits) -> impl Iterator<Item = Diagnostic> {
        let all = self.ranges.into_iter().zip(self.outside);
        all.filter(|(_, (count, _))| *count > 0).map(
            move |((what, unit, [low, high]), (count, [from, to]))| {
                let tell = |value: f64| match unit {
                    "mm" => units.tell_trimmed(ColumnUnit::Length, value, 3),
                    _ => format!("{} {unit}", format_trimmed(value, 1)),
                };
                let cuts = format_counted(count, "motion cuts", "motions cut");
                let message = format!(
                    "{cuts} with {what} of {} to {}, and the material was measured from {} to {}",
                    tell(from),
                    tell(to),
                    tell(low),
                    tell(high)
                );
                Diagnostic::new(codes::OUTSIDE_MEASURED, message)
            },
        )
    }
}

//! This module holds a measured row with what the fit says of it.

use super::MeasuredRow;
use crate::diagnostic::{Diagnostic, codes};
use crate::source::Source;
use std::sync::Arc;

/// A row and how it fits.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct CalibrationRow {
    /// What was measured.
    pub measured: MeasuredRow,
    /// The means by the fitted coefficients, N.
    pub fitted_n: [f64; 3],
    /// The power by the fitted coefficients, kW.
    pub fitted_kw: f64,
    /// How far the measurement is off the fit, as a part of it.
    pub residual_part: f64,
    /// The same for a fit without the row; `None` if that tells fewer coefficients apart.
    pub left_out_part: Option<f64>,
    /// The measured power, or the current above idle in its place, by what the fit explains, where the other rows are at 1.
    pub power_ratio: Option<f64>,
    /// Whether it does not fit the others, and was left out.
    pub is_outlier: bool,
    /// Whether its power stands out while its forces do not.
    pub is_likely_vibration: bool,
}

impl CalibrationRow {
    pub(super) fn has_forces(&self) -> bool {
        self.measured.force_n.iter().any(Option::is_some)
    }

    pub(super) fn tell_fault(&self, source: &Arc<Source>) -> Option<Diagnostic> {
        let percent = |part: f64| format!("{:.0} %", part * 100.0);
        let name = self.measured.name();
        if self.is_outlier {
            let off = percent(self.left_out_part.unwrap_or(self.residual_part));
            let message = format!("{name} does not fit the other rows: it is off by {off}, and was left out");
            let found = Diagnostic::new(codes::OUTLIER, message);
            return Some(found.with_label(source, self.measured.span, "left out of the fit"));
        }
        if self.is_likely_vibration {
            let more = percent(self.power_ratio.unwrap_or(1.0) - 1.0);
            let message =
                format!("{name} takes {more} more power than its mean force explains: likely a vibration");
            let found = Diagnostic::new(codes::LIKELY_VIBRATION, message);
            return Some(found.with_label(
                source,
                self.measured.span,
                "its forces are in the fit, its power is not",
            ));
        }
        None
    }
}

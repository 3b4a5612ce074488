//! This module converts the text of a setup into values in millimetres and collects its faults.

use super::YamlLocation;
use crate::diagnostic::{Diagnostic, DiagnosticCode, Failure, codes};
use crate::parameters::{LengthUnit, Positive};

/// The largest number of faults that are reported. More are of little use, and each costs reading the file
/// again.
const MOST_FAULTS: usize = 20;

/// A kilometre in millimetres. A larger number is a mistake, and the simulation does not have to handle it.
const LARGEST_LENGTH_MM: f64 = 1e6;

/// A micrometre in millimetres. No tool and no stock is smaller.
pub(super) const SMALLEST_SIZE_MM: f64 = 1e-3;

/// Reads the `setup` of a recipe or of a setup file.
pub(super) struct SetupReader {
    pub units: LengthUnit,
    found: Vec<Diagnostic>,
}

impl SetupReader {
    pub(super) fn new(units: LengthUnit) -> Self {
        Self { units, found: Vec::new() }
    }

    /// Returns a length in millimetres.
    pub(super) fn length_mm(&mut self, value: f64, place: impl FnOnce() -> YamlLocation) -> f64 {
        let value_mm = value * self.units.mm_per_unit();
        if value_mm.abs() <= LARGEST_LENGTH_MM {
            return value_mm;
        }
        self.add_fault(place, "this is more than a kilometre", "too large", "Compare it with `units:`.");
        // Reading goes on with a harmless number, so that one run finds all faults of the file.
        LARGEST_LENGTH_MM.copysign(value_mm)
    }

    /// Returns the size of something in millimetres.
    pub(super) fn size_mm(&mut self, value: Positive, place: impl Fn() -> YamlLocation) -> f64 {
        let value_mm = self.length_mm(value.get(), &place);
        if value.get() * self.units.mm_per_unit() < SMALLEST_SIZE_MM {
            self.add_fault(place, "this is less than a micrometre", "too small", "Compare it with `units:`.");
        }
        value_mm
    }

    /// Returns a size that may be missing, in millimetres. It stands at `key` of `place`.
    pub(super) fn optional_size_mm(
        &mut self,
        value: Option<Positive>,
        place: &YamlLocation,
        key: &'static str,
    ) -> Option<f64> {
        value.map(|value| self.size_mm(value, || place.at_key(key)))
    }

    /// Returns a length that may be missing, in millimetres. It stands at `key` of `place`.
    pub(super) fn optional_length_mm(
        &mut self,
        value: Option<f64>,
        place: &YamlLocation,
        key: &'static str,
    ) -> Option<f64> {
        value.map(|value| self.length_mm(value, || place.at_key(key)))
    }

    /// Adds the fault of a value.
    pub(super) fn add_fault(
        &mut self,
        place: impl FnOnce() -> YamlLocation,
        message: impl Into<String>,
        label: &str,
        help: impl Into<String>,
    ) {
        if self.found.len() < MOST_FAULTS {
            let place = place();
            let fault = Diagnostic::new(codes::BAD_VALUE, message).with_help(help);
            self.found.push(fault.with_label(place.source(), place.value_span(), label));
        }
    }

    /// Adds a fault that lies in a key and not in its value, with the other keys that contradict it.
    pub(super) fn add_key_fault(
        &mut self,
        code: DiagnosticCode,
        message: String,
        help: &str,
        keys: &[(YamlLocation, &str)],
    ) {
        if self.found.len() < MOST_FAULTS {
            let fault = Diagnostic::new(code, message).with_help(help);
            self.found.push(keys.iter().fold(fault, |fault, (place, label)| {
                fault.with_label(place.source(), place.key_span(), *label)
            }));
        }
    }

    /// Returns the value, or the faults if there are any.
    pub(super) fn finish_value<T>(mut self, value: T) -> Result<T, Failure> {
        if self.found.is_empty() {
            return Ok(value);
        }
        // Faults are found in the order of the checks, but people mend a file from top to bottom.
        self.found.sort_by_key(|diagnostic| diagnostic.labels.first().map(|label| label.span));
        Err(self.found.into())
    }
}

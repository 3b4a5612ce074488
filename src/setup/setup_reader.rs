//! What turns a setup's text into values in millimetres, and collects what is wrong with it.

use super::YamlLocation;
use crate::diagnostic::{Diagnostic, DiagnosticCode, Failure, codes};
use crate::parameters::{LengthUnit, Positive};

/// Who made more mistakes than this fixes the first ones first; each costs a reading of the file.
const MOST: usize = 20;

/// A kilometre in millimetres: whoever writes more has mixed up something, and the simulation need not cope with it.
const LARGEST: f64 = 1e6;

/// A micrometre in millimetres: no tool and no stock is smaller.
pub(super) const SMALLEST: f64 = 1e-3;

/// Reads one recipe's or setup file's `setup`.
pub(super) struct SetupReader {
    pub units: LengthUnit,
    found: Vec<Diagnostic>,
}

impl SetupReader {
    pub fn new(units: LengthUnit) -> Self {
        Self { units, found: Vec::new() }
    }

    /// A length in millimetres.
    pub fn length_mm(&mut self, value: f64, place: impl FnOnce() -> YamlLocation) -> f64 {
        let value_mm = value * self.units.mm_per_unit();
        if value_mm.abs() <= LARGEST {
            return value_mm;
        }
        self.add_fault(place, "this is more than a kilometre", "too large", "Compare it with `units:`.");
        LARGEST.copysign(value_mm)
    }

    /// The size of something in millimetres.
    pub fn size_mm(&mut self, value: Positive, place: impl Fn() -> YamlLocation) -> f64 {
        let value_mm = self.length_mm(value.get(), &place);
        if value.get() * self.units.mm_per_unit() < SMALLEST {
            self.add_fault(place, "this is less than a micrometre", "too small", "Compare it with `units:`.");
        }
        value_mm
    }

    /// A size that may be missing, in millimetres; it stands at `key` of `place`.
    pub fn optional_size_mm(
        &mut self,
        value: Option<Positive>,
        place: &YamlLocation,
        key: &'static str,
    ) -> Option<f64> {
        value.map(|value| self.size_mm(value, || place.at_key(key)))
    }

    /// A length that may be missing, in millimetres; it stands at `key` of `place`.
    pub fn optional_length_mm(
        &mut self,
        value: Option<f64>,
        place: &YamlLocation,
        key: &'static str,
    ) -> Option<f64> {
        value.map(|value| self.length_mm(value, || place.at_key(key)))
    }

    /// Adds a fault of a value.
    pub fn add_fault(
        &mut self,
        place: impl FnOnce() -> YamlLocation,
        message: impl Into<String>,
        label: &str,
        help: impl Into<String>,
    ) {
        if self.found.len() < MOST {
            let place = place();
            let fault = Diagnostic::new(codes::BAD_VALUE, message).with_help(help);
            self.found.push(fault.with_label(place.source(), place.value_span(), label));
        }
    }

    /// Adds a fault that lies in a key rather than in its value, with other keys that it goes against.
    pub fn add_key_fault(
        &mut self,
        code: DiagnosticCode,
        message: String,
        help: &str,
        keys: &[(YamlLocation, &str)],
    ) {
        if self.found.len() < MOST {
            let fault = Diagnostic::new(code, message).with_help(help);
            self.found.push(keys.iter().fold(fault, |fault, (place, label)| {
                fault.with_label(place.source(), place.key_span(), *label)
            }));
        }
    }

    /// The value, unless something was wrong.
    pub fn finish_value<T>(mut self, value: T) -> Result<T, Failure> {
        if self.found.is_empty() {
            return Ok(value);
        }
        self.found.sort_by_key(|diagnostic| diagnostic.labels.first().map(|label| label.span));
        Err(self.found.into())
    }
}

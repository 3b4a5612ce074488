//! What turns a setup's text into values in millimetres, and collects what is wrong with it.

use super::Place;
use crate::diagnostic::{Code, Diagnostic, codes};
use crate::values::{LengthUnit, Positive};

/// Who made more mistakes than this fixes the first ones first; each costs a reading of the file.
const MOST: usize = 20;

/// A kilometre in millimetres: whoever writes more has mixed up something, and the simulation need not cope with it.
const LARGEST: f64 = 1e6;

/// A micrometre in millimetres: no tool and no stock is smaller.
pub(super) const SMALLEST: f64 = 1e-3;

/// Reads one recipe's or setup file's `setup`.
pub(super) struct Reader {
    pub units: LengthUnit,
    found: Vec<Diagnostic>,
}

impl Reader {
    pub fn new(units: LengthUnit) -> Self {
        Self { units, found: Vec::new() }
    }

    /// A length in millimetres.
    pub fn mm(&mut self, value: f64, place: impl FnOnce() -> Place) -> f64 {
        let mm = value * self.units.in_mm();
        if mm.abs() <= LARGEST {
            return mm;
        }
        self.fault(place, "this is more than a kilometre", "too large", "Compare it with `units:`.");
        LARGEST.copysign(mm)
    }

    /// The size of something in millimetres.
    pub fn size(&mut self, value: Positive, place: impl Fn() -> Place) -> f64 {
        let mm = self.mm(value.get(), &place);
        if value.get() * self.units.in_mm() < SMALLEST {
            self.fault(place, "this is less than a micrometre", "too small", "Compare it with `units:`.");
        }
        mm
    }

    /// A size that may be missing, in millimetres; it stands at `key` of `place`.
    pub fn size_at(&mut self, value: Option<Positive>, place: &Place, key: &'static str) -> Option<f64> {
        value.map(|value| self.size(value, || place.key(key)))
    }

    /// A length that may be missing, in millimetres; it stands at `key` of `place`.
    pub fn mm_at(&mut self, value: Option<f64>, place: &Place, key: &'static str) -> Option<f64> {
        value.map(|value| self.mm(value, || place.key(key)))
    }

    /// Adds a fault of a value.
    pub fn fault(
        &mut self,
        place: impl FnOnce() -> Place,
        message: impl Into<String>,
        label: &str,
        help: impl Into<String>,
    ) {
        if self.found.len() < MOST {
            let place = place();
            let fault = Diagnostic::new(codes::BAD_VALUE, message).help(help);
            self.found.push(fault.label(place.source(), place.span(), label));
        }
    }

    /// Adds a fault that lies in a key rather than in its value, with other keys that it goes against.
    pub fn key_fault(&mut self, code: Code, message: String, help: &str, keys: &[(Place, &str)]) {
        if self.found.len() < MOST {
            let fault = Diagnostic::new(code, message).help(help);
            self.found.push(
                keys.iter().fold(fault, |fault, (place, label)| {
                    fault.label(place.source(), place.key_span(), *label)
                }),
            );
        }
    }

    /// The value, unless something was wrong.
    pub fn end<T>(mut self, value: T) -> Result<T, Vec<Diagnostic>> {
        if self.found.is_empty() {
            return Ok(value);
        }
        self.found.sort_by_key(|diagnostic| diagnostic.labels.first().map(|label| label.span));
        Err(self.found)
    }
}

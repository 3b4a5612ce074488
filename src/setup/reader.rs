//! What turns a setup's text into values in millimetres, and collects what is wrong with it.

use super::Place;
use crate::diagnostic::{Code, Diagnostic, codes};
use crate::values::LengthUnit;

/// Who made more mistakes than this fixes the first ones first; each costs a reading of the file.
const MOST: usize = 20;

/// A kilometre in millimetres: whoever writes more has mixed up something, and the simulation need not cope with it.
const LARGEST: f64 = 1e6;

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
        0.0
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

//! PTC Creo NCL.

use super::{ArcMove, Draft, Writer};
use crate::program::{LengthUnit, MotionClass};
use nalgebra::Point3;

/// Ten decimals for coordinates, six for the rest; blanks around the slash and behind commas.
#[derive(Default)]
pub(super) struct Creo {
    text: String,
    unit: &'static str,
}

impl Creo {
    fn line(&mut self, line: impl AsRef<str>) {
        self.text.push_str(line.as_ref());
        self.text.push('\n');
    }
}

impl Writer for Creo {
    fn begin(&mut self, draft: &Draft) {
        let inch = draft.units == LengthUnit::Inch;
        self.unit = if inch { "IPM" } else { "MMPM" };
        self.line("$$*          Pro/CLfile  Version 11.0 - 11.0.0.0");
        self.line(format!("$$-> MFGNO / {}", draft.name));
        self.line(format!("PARTNO / {}", draft.name));
        self.line("$$-> FEATNO / 1");
        self.line(format!("PPRINT / {}", draft.operation));
        self.line("MACHIN / UNCX01, 1");
        self.line("$$-> CUTCOM_GEOMETRY_TYPE / OUTPUT_ON_CENTER");
        self.line(if inch { "UNITS / INCHES" } else { "UNITS / MM" });
        self.line(format!("PPRINT / {}", draft.tool.name));
        self.line(format!("LOADTL / {}", draft.tool.number));
        self.line(format!("$$-> CUTTER / {:.6}", draft.tool.diameter));
        self.line("$$-> CSYS / 1.0000000000, 0.0000000000, 0.0000000000, 0.0000000000,  $");
        self.line("            0.0000000000, 1.0000000000, 0.0000000000, 0.0000000000,  $");
        self.line("            0.0000000000, 0.0000000000, 1.0000000000, 0.0000000000");
        if let Some(speed) = draft.spindle {
            self.line(format!("SPINDL / RPM, {speed:.6},  CLW"));
        }
        if draft.coolant {
            self.line("COOLNT / ON");
        }
    }

    /// Creo marks no motions.
    fn class(&mut self, _: MotionClass) {}

    fn feed(&mut self, feed: f64) {
        self.line(format!("FEDRAT / {feed:.6},  {}", self.unit));
    }

    fn rapid(&mut self, to: Point3<f64>) {
        // With its blank behind.
        self.line("RAPID ");
        Writer::line(self, to);
    }

    fn line(&mut self, to: Point3<f64>) {
        Creo::line(self, format!("GOTO / {:.10}, {:.10}, {:.10}", to.x, to.y, to.z));
    }

    /// Nobody has measured how Creo's arcs turn: what comes back from this is a straight motion, which reading back refuses.
    fn arc(&mut self, arc: &ArcMove) {
        Writer::line(self, arc.to);
    }

    fn end(&mut self, draft: &Draft) -> Vec<u8> {
        if draft.spindle.is_some() {
            self.line("SPINDL / OFF");
        }
        if draft.coolant {
            self.line("COOLNT / OFF");
        }
        self.line("$$-> END / ");
        self.line("FINI ");
        std::mem::take(&mut self.text).into_bytes()
    }
}

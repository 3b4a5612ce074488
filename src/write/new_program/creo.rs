//! This module writes PTC Creo NCL.

use super::{ArcMove, DialectWriter, ProgramDraft};
use crate::program::{LengthUnit, MotionClass};
use nalgebra::Point3;

/// Writes PTC Creo NCL: ten decimals for coordinates and six for other numbers, with blanks around the slash
/// and behind commas.
#[derive(Default)]
pub(super) struct CreoWriter {
    text: String,
    unit: &'static str,
}

impl CreoWriter {
    fn push_line(&mut self, line: impl AsRef<str>) {
        self.text.push_str(line.as_ref());
        self.text.push('\n');
    }
}

impl DialectWriter for CreoWriter {
    fn write_start(&mut self, draft: &ProgramDraft) {
        let inch = draft.units == LengthUnit::Inch;
        self.unit = if inch { "IPM" } else { "MMPM" };
        self.push_line("$$*          Pro/CLfile  Version 11.0 - 11.0.0.0");
        self.push_line(format!("$$-> MFGNO / {}", draft.name));
        self.push_line(format!("PARTNO / {}", draft.name));
        self.push_line("$$-> FEATNO / 1");
        self.push_line(format!("PPRINT / {}", draft.operation));
        self.push_line("MACHIN / UNCX01, 1");
        self.push_line("$$-> CUTCOM_GEOMETRY_TYPE / OUTPUT_ON_CENTER");
        self.push_line(if inch { "UNITS / INCHES" } else { "UNITS / MM" });
        self.push_line(format!("PPRINT / {}", draft.tool.name));
        self.push_line(format!("LOADTL / {}", draft.tool.number));
        self.push_line(format!("$$-> CUTTER / {:.6}", draft.tool.diameter));
        self.push_line("$$-> CSYS / 1.0000000000, 0.0000000000, 0.0000000000, 0.0000000000,  $");
        self.push_line("            0.0000000000, 1.0000000000, 0.0000000000, 0.0000000000,  $");
        self.push_line("            0.0000000000, 0.0000000000, 1.0000000000, 0.0000000000");
        if let Some(speed) = draft.spindle {
            self.push_line(format!("SPINDL / RPM, {speed:.6},  CLW"));
        }
        if draft.coolant {
            self.push_line("COOLNT / ON");
        }
    }

    /// Does nothing, since Creo does not mark motions.
    fn write_class(&mut self, _: MotionClass) {}

    fn write_feed(&mut self, feed: f64) {
        self.push_line(format!("FEDRAT / {feed:.6},  {}", self.unit));
    }

    fn write_rapid(&mut self, to: Point3<f64>) {
        // Creo writes a blank behind this word.
        self.push_line("RAPID ");
        DialectWriter::write_line(self, to);
    }

    fn write_line(&mut self, to: Point3<f64>) {
        CreoWriter::push_line(self, format!("GOTO / {:.10}, {:.10}, {:.10}", to.x, to.y, to.z));
    }

    /// Writes a straight motion, since nobody has measured the direction of Creo's arcs. Reading back then
    /// refuses the program.
    fn write_arc(&mut self, arc: &ArcMove) {
        DialectWriter::write_line(self, arc.to);
    }

    fn write_end(&mut self, draft: &ProgramDraft) -> Vec<u8> {
        if draft.spindle.is_some() {
            self.push_line("SPINDL / OFF");
        }
        if draft.coolant {
            self.push_line("COOLNT / OFF");
        }
        self.push_line("$$-> END / ");
        self.push_line("FINI ");
        std::mem::take(&mut self.text).into_bytes()
    }
}

//! This module writes Siemens NX CLSF.

use super::{ArcMove, DialectWriter, ProgramDraft};
use crate::program::{LengthUnit, MotionClass};
use nalgebra::Point3;

/// Writes Siemens NX CLSF: four decimals for lengths and seven for vectors, without exception in the measured
/// files.
#[derive(Default)]
pub(super) struct NxWriter {
    text: String,
    unit: &'static str,
    diameter: f64,
    corner: f64,
    begun: bool,
}

impl NxWriter {
    fn push_line(&mut self, line: impl AsRef<str>) {
        self.text.push_str(line.as_ref());
        self.text.push('\n');
    }
}

impl DialectWriter for NxWriter {
    fn write_start(&mut self, draft: &ProgramDraft) {
        let tool = &draft.tool;
        self.unit = if draft.units == LengthUnit::Inch { "IPM" } else { "MMPM" };
        (self.diameter, self.corner) = (tool.diameter, tool.corner_radius);
        self.push_line(format!("TOOL PATH/{},TOOL,{}", draft.operation, tool.name));
        let (diameter, corner, length) = (tool.diameter, tool.corner_radius, tool.length);
        self.push_line(format!("TLDATA/MILL,{diameter:.4},{corner:.4},{length:.4},0.0000,0.0000"));
        self.push_line(
            "MSYS/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000",
        );
        self.push_line("$$ centerline data");
        self.push_line("PAINT/PATH");
        self.push_line("PAINT/SPEED,10");
        // NX writes a blank behind these two lines.
        self.push_line(format!("LOAD/TOOL,{0},ADJUST,{0} ", tool.number));
        if let Some(speed) = draft.spindle {
            self.push_line(format!("SPINDL/RPM,{speed},CLW "));
        }
        if draft.coolant {
            self.push_line("COOLNT/ON");
        }
    }

    fn write_class(&mut self, class: MotionClass) {
        let color = match class {
            MotionClass::Approach => 186,
            MotionClass::Rapid | MotionClass::Drill => 211,
            MotionClass::Engage => 42,
            MotionClass::Cut => 31,
            MotionClass::StepOver => 36,
            MotionClass::Retract => 37,
        };
        self.push_line(format!("PAINT/COLOR,{color}"));
    }

    fn write_feed(&mut self, feed: f64) {
        self.push_line(format!("FEDRAT/{},{feed:.4}", self.unit));
    }

    fn write_rapid(&mut self, to: Point3<f64>) {
        self.push_line("RAPID");
        DialectWriter::write_line(self, to);
    }

    fn write_line(&mut self, to: Point3<f64>) {
        // The axis is printed at the first point and stays in force.
        let axis = if self.begun { "" } else { ",0.0000000,0.0000000,1.0000000" };
        self.begun = true;
        NxWriter::push_line(self, format!("GOTO/{:.4},{:.4},{:.4}{axis}", to.x, to.y, to.z));
    }

    fn write_arc(&mut self, arc: &ArcMove) {
        // The printed axis is left-hand: the arc is clockwise about it. Zero must not become minus zero.
        let axis = arc.axis.map(|value| if value == 0.0 { 0.0 } else { -value });
        let (centre, radius) = (arc.centre, (arc.from - arc.centre).norm());
        let (diameter, corner) = (self.diameter, self.corner);
        self.push_line(format!(
            "CIRCLE/{:.4},{:.4},{:.4},{:.7},{:.7},{:.7},{radius:.4},0.0600,0.5000,{diameter:.4},{corner:.4}",
            centre.x, centre.y, centre.z, axis.x, axis.y, axis.z
        ));
        DialectWriter::write_line(self, arc.to);
    }

    fn write_end(&mut self, draft: &ProgramDraft) -> Vec<u8> {
        if draft.coolant {
            self.push_line("COOLNT/OFF");
        }
        for line in ["PAINT/SPEED,10", "PAINT/TOOL,NOMORE", "END-OF-PATH"] {
            self.push_line(line);
        }
        std::mem::take(&mut self.text).into_bytes()
    }
}

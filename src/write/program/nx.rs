//! Siemens NX CLSF.

use super::{ArcMove, Draft, Writer};
use crate::program::{LengthUnit, MotionClass};
use nalgebra::Point3;

/// Four decimals for lengths, seven for vectors, without exception in what was measured.
#[derive(Default)]
pub(super) struct Nx {
    text: String,
    unit: &'static str,
    diameter: f64,
    corner: f64,
    begun: bool,
}

impl Nx {
    fn line(&mut self, line: impl AsRef<str>) {
        self.text.push_str(line.as_ref());
        self.text.push('\n');
    }
}

impl Writer for Nx {
    fn begin(&mut self, draft: &Draft) {
        let tool = &draft.tool;
        self.unit = if draft.units == LengthUnit::Inch { "IPM" } else { "MMPM" };
        (self.diameter, self.corner) = (tool.diameter, tool.corner_radius);
        self.line(format!("TOOL PATH/{},TOOL,{}", draft.operation, tool.name));
        let (diameter, corner, length) = (tool.diameter, tool.corner_radius, tool.length);
        self.line(format!("TLDATA/MILL,{diameter:.4},{corner:.4},{length:.4},0.0000,0.0000"));
        self.line("MSYS/0.0000,0.0000,0.0000,1.0000000,0.0000000,0.0000000,0.0000000,1.0000000,0.0000000");
        self.line("$$ centerline data");
        self.line("PAINT/PATH");
        self.line("PAINT/SPEED,10");
        // NX leaves a blank behind these two.
        self.line(format!("LOAD/TOOL,{0},ADJUST,{0} ", tool.number));
        if let Some(speed) = draft.spindle {
            self.line(format!("SPINDL/RPM,{speed},CLW "));
        }
        if draft.coolant {
            self.line("COOLNT/ON");
        }
    }

    fn class(&mut self, class: MotionClass) {
        let color = match class {
            MotionClass::Approach => 186,
            MotionClass::Rapid | MotionClass::Drill => 211,
            MotionClass::Engage => 42,
            MotionClass::Cut => 31,
            MotionClass::StepOver => 36,
            MotionClass::Retract => 37,
        };
        self.line(format!("PAINT/COLOR,{color}"));
    }

    fn feed(&mut self, feed: f64) {
        self.line(format!("FEDRAT/{},{feed:.4}", self.unit));
    }

    fn rapid(&mut self, to: Point3<f64>) {
        self.line("RAPID");
        Writer::line(self, to);
    }

    fn line(&mut self, to: Point3<f64>) {
        // The axis stands at the first point and stays in force.
        let axis = if self.begun { "" } else { ",0.0000000,0.0000000,1.0000000" };
        self.begun = true;
        Nx::line(self, format!("GOTO/{:.4},{:.4},{:.4}{axis}", to.x, to.y, to.z));
    }

    fn arc(&mut self, arc: &ArcMove) {
        // The printed axis is left-hand: the arc is clockwise about it. Zero must not become minus zero.
        let axis = arc.axis.map(|value| if value == 0.0 { 0.0 } else { -value });
        let (centre, radius) = (arc.centre, (arc.from - arc.centre).norm());
        let (diameter, corner) = (self.diameter, self.corner);
        self.line(format!(
            "CIRCLE/{:.4},{:.4},{:.4},{:.7},{:.7},{:.7},{radius:.4},0.0600,0.5000,{diameter:.4},{corner:.4}",
            centre.x, centre.y, centre.z, axis.x, axis.y, axis.z
        ));
        Writer::line(self, arc.to);
    }

    fn end(&mut self, draft: &Draft) -> Vec<u8> {
        if draft.coolant {
            self.line("COOLNT/OFF");
        }
        for line in ["PAINT/SPEED,10", "PAINT/TOOL,NOMORE", "END-OF-PATH"] {
            self.line(line);
        }
        std::mem::take(&mut self.text).into_bytes()
    }
}

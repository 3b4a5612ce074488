//! This module writes CATIA V5 APT.

use super::{ArcMove, DialectWriter, ProgramDraft};
use crate::program::{LengthUnit, MotionClass};
use nalgebra::Point3;

/// Writes CATIA V5 APT: five decimals in eleven columns for coordinates, six for axes, and four in ten
/// columns for feeds and speeds.
#[derive(Default)]
pub(super) struct CatiaWriter {
    text: String,
    unit: &'static str,
    tolerance: f64,
    /// Whether the last motion was an arc.
    in_arcs: bool,
}

impl CatiaWriter {
    fn push_line(&mut self, line: impl AsRef<str>) {
        self.text.push_str(line.as_ref());
        self.text.push('\n');
    }

    fn push_comment_rule(&mut self) {
        self.push_line("$$ -----------------------------------------------------------------");
    }
}

impl DialectWriter for CatiaWriter {
    fn write_start(&mut self, draft: &ProgramDraft) {
        let tool = &draft.tool;
        self.unit = if draft.units == LengthUnit::Inch { "IPM" } else { "MMPM" };
        self.tolerance = draft.tolerance;
        self.push_comment_rule();
        self.push_line("$$     CATIA APT VERSION 1.0");
        self.push_comment_rule();
        self.push_line(format!("$$ {}", draft.name));
        self.push_line(format!("$$  {}", draft.operation));
        self.push_line("$$*CATIA0");
        self.push_line(format!("$$ {}", draft.name));
        self.push_line("$$     1.00000     0.00000     0.00000     0.00000");
        self.push_line("$$     0.00000     1.00000     0.00000     0.00000");
        self.push_line("$$     0.00000     0.00000     1.00000     0.00000");
        self.push_line(format!("PARTNO {}", draft.name));
        self.push_line("$$ OPERATION NAME : Tool Change.1");
        self.push_line("$$  Start generation of : Tool Change.1");
        self.push_line("TLAXIS/ 0.000000, 0.000000, 1.000000");
        self.push_line("$$ TOOLCHANGEBEGINNING");
        let (diameter, corner) = (tool.diameter, tool.corner_radius);
        let across = (diameter / 2.0 - corner).max(0.0);
        self.push_line(format!(
            "CUTTER/{diameter:10.6},{corner:10.6},{across:10.6},{corner:10.6},  0.000000,$"
        ));
        self.push_line(format!("         0.000000,{:10.6}", tool.length));
        self.push_line(format!("TOOLNO/{},{diameter:12.6}", tool.number));
        self.push_line(format!("TPRINT/{}", tool.name));
        self.push_line(format!("LOADTL/{}", tool.number));
        self.push_line("$$ TOOLCHANGEEND");
        self.push_line("$$  End of generation of : Tool Change.1");
        self.push_line(format!("$$ OPERATION NAME : {}", draft.operation));
        self.push_line(format!("$$  Start generation of : {}", draft.operation));
        self.push_line(format!("LOADTL/{},1", tool.number));
        if let Some(speed) = draft.spindle {
            self.push_line(format!("SPINDL/{speed:10.4},RPM,CLW"));
        }
        if draft.coolant {
            self.push_line("COOLNT/ON");
        }
    }

    /// Does nothing, since CATIA does not mark motions.
    fn write_class(&mut self, _: MotionClass) {}

    fn write_feed(&mut self, feed: f64) {
        self.push_line(format!("FEDRAT/{feed:10.4},{}", self.unit));
    }

    fn write_rapid(&mut self, to: Point3<f64>) {
        self.push_line("RAPID");
        DialectWriter::write_line(self, to);
    }

    fn write_line(&mut self, to: Point3<f64>) {
        self.in_arcs = false;
        CatiaWriter::push_line(self, format!("GOTO  /{:11.5},{:11.5},{:11.5}", to.x, to.y, to.z));
    }

    fn write_arc(&mut self, arc: &ArcMove) {
        // Only the first of several arcs is announced with its tolerances.
        if !self.in_arcs {
            self.push_line(format!("INTOL /{:11.5}", self.tolerance));
            self.push_line("OUTTOL/    0.00000");
            self.push_line("AUTOPS");
            self.in_arcs = true;
        }
        let (centre, to) = (arc.centre, arc.to);
        // INDIRV is the start tangent: the axis cross the spoke to the start.
        let start = arc.axis.cross(&(arc.from - centre)).try_normalize(0.0).unwrap_or_default();
        // Adding zero makes zero of minus zero.
        let start = start.map(|value| (value * 1e5).round() / 1e5 + 0.0);
        let radius = (arc.from - centre).norm();
        self.push_line(format!("INDIRV/{:11.5},{:11.5},{:11.5}", start.x, start.y, start.z));
        let (x, y, z) = (centre.x, centre.y, centre.z);
        self.push_line(format!("TLON,GOFWD/      (CIRCLE/{x:13.5},{y:13.5},{z:13.5},$"));
        self.push_line(format!("{radius:14.5}),ON,(LINE/{x:13.5},{y:13.5},{z:13.5},$"));
        self.push_line(format!("                       {:13.5},{:13.5},{:13.5})", to.x, to.y, to.z));
    }

    fn write_end(&mut self, draft: &ProgramDraft) -> Vec<u8> {
        self.push_line(format!("$$  End of generation of : {}", draft.operation));
        if draft.coolant {
            self.push_line("COOLNT/OFF");
        }
        if draft.spindle.is_some() {
            self.push_line("SPINDL/OFF");
        }
        // Every file of this system ends with an empty line.
        for line in ["REWIND/0", "END", ""] {
            self.push_line(line);
        }
        std::mem::take(&mut self.text).into_bytes()
    }
}

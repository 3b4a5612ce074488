//! CATIA V5 APT.

use super::{ArcMove, Draft, Writer};
use crate::program::{LengthUnit, MotionClass};
use nalgebra::Point3;

/// Five decimals in eleven columns for coordinates, six for axes, four in ten columns for feeds and speeds.
#[derive(Default)]
pub(super) struct Catia {
    text: String,
    unit: &'static str,
    tolerance: f64,
    /// Whether an arc was the last motion.
    in_arcs: bool,
}

impl Catia {
    fn line(&mut self, line: impl AsRef<str>) {
        self.text.push_str(line.as_ref());
        self.text.push('\n');
    }

    fn comment_rule(&mut self) {
        self.line("$$ -----------------------------------------------------------------");
    }
}

impl Writer for Catia {
    fn begin(&mut self, draft: &Draft) {
        let tool = &draft.tool;
        self.unit = if draft.units == LengthUnit::Inch { "IPM" } else { "MMPM" };
        self.tolerance = draft.tolerance;
        self.comment_rule();
        self.line("$$     CATIA APT VERSION 1.0");
        self.comment_rule();
        self.line(format!("$$ {}", draft.name));
        self.line(format!("$$  {}", draft.operation));
        self.line("$$*CATIA0");
        self.line(format!("$$ {}", draft.name));
        self.line("$$     1.00000     0.00000     0.00000     0.00000");
        self.line("$$     0.00000     1.00000     0.00000     0.00000");
        self.line("$$     0.00000     0.00000     1.00000     0.00000");
        self.line(format!("PARTNO {}", draft.name));
        self.line("$$ OPERATION NAME : Tool Change.1");
        self.line("$$  Start generation of : Tool Change.1");
        self.line("TLAXIS/ 0.000000, 0.000000, 1.000000");
        self.line("$$ TOOLCHANGEBEGINNING");
        let (diameter, corner) = (tool.diameter, tool.corner_radius);
        let across = (diameter / 2.0 - corner).max(0.0);
        self.line(format!("CUTTER/{diameter:10.6},{corner:10.6},{across:10.6},{corner:10.6},  0.000000,$"));
        self.line(format!("         0.000000,{:10.6}", tool.length));
        self.line(format!("TOOLNO/{},{diameter:12.6}", tool.number));
        self.line(format!("TPRINT/{}", tool.name));
        self.line(format!("LOADTL/{}", tool.number));
        self.line("$$ TOOLCHANGEEND");
        self.line("$$  End of generation of : Tool Change.1");
        self.line(format!("$$ OPERATION NAME : {}", draft.operation));
        self.line(format!("$$  Start generation of : {}", draft.operation));
        self.line(format!("LOADTL/{},1", tool.number));
        if let Some(speed) = draft.spindle {
            self.line(format!("SPINDL/{speed:10.4},RPM,CLW"));
        }
        if draft.coolant {
            self.line("COOLNT/ON");
        }
    }

    /// CATIA marks no motions.
    fn class(&mut self, _: MotionClass) {}

    fn feed(&mut self, feed: f64) {
        self.line(format!("FEDRAT/{feed:10.4},{}", self.unit));
    }

    fn rapid(&mut self, to: Point3<f64>) {
        self.line("RAPID");
        Writer::line(self, to);
    }

    fn line(&mut self, to: Point3<f64>) {
        self.in_arcs = false;
        Catia::line(self, format!("GOTO  /{:11.5},{:11.5},{:11.5}", to.x, to.y, to.z));
    }

    fn arc(&mut self, arc: &ArcMove) {
        if !self.in_arcs {
            self.line(format!("INTOL /{:11.5}", self.tolerance));
            self.line("OUTTOL/    0.00000");
            self.line("AUTOPS");
            self.in_arcs = true;
        }
        let (centre, to) = (arc.centre, arc.to);
        let start = arc.axis.cross(&(arc.from - centre)).try_normalize(0.0).unwrap_or_default();
        // Adding zero makes plus zero of minus zero.
        let start = start.map(|value| (value * 1e5).round() / 1e5 + 0.0);
        let radius = (arc.from - centre).norm();
        self.line(format!("INDIRV/{:11.5},{:11.5},{:11.5}", start.x, start.y, start.z));
        let (x, y, z) = (centre.x, centre.y, centre.z);
        self.line(format!("TLON,GOFWD/      (CIRCLE/{x:13.5},{y:13.5},{z:13.5},$"));
        self.line(format!("{radius:14.5}),ON,(LINE/{x:13.5},{y:13.5},{z:13.5},$"));
        self.line(format!("                       {:13.5},{:13.5},{:13.5})", to.x, to.y, to.z));
    }

    fn end(&mut self, draft: &Draft) -> Vec<u8> {
        self.line(format!("$$  End of generation of : {}", draft.operation));
        if draft.coolant {
            self.line("COOLNT/OFF");
        }
        if draft.spindle.is_some() {
            self.line("SPINDL/OFF");
        }
        // An empty line ends every file of this system.
        for line in ["REWIND/0", "END", ""] {
            self.line(line);
        }
        std::mem::take(&mut self.text).into_bytes()
    }
}

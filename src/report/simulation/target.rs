//! What is left against the part that shall be.

use super::Simulated;
use crate::diagnostic::{Diagnostic, codes};
use crate::report::round::micro;
use crate::sim::{Difference, Mesh};
use serde::Serialize;

/// How what is left differs from the target. What is within the tolerance in some direction does not count.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Compared {
    /// What the target is called.
    pub file: String,
    /// The tolerance, mm.
    #[serde(serialize_with = "micro")]
    pub tolerance_mm: f64,
    /// Material of the target that is gone.
    pub gouge: Differing,
    /// Material that is left and not in the target.
    pub excess: Differing,
}

/// Material on one side only.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Differing {
    /// Its volume, mm3.
    #[serde(serialize_with = "micro")]
    pub volume_mm3: f64,
    /// Columns with it.
    pub columns: usize,
    /// Where it is thickest along z.
    pub thickest: Option<Thickest>,
}

/// The thickest piece along z.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Thickest {
    /// Its thickness, mm.
    #[serde(serialize_with = "micro")]
    pub mm: f64,
    /// Where, in mm: of a gouge the lower end, of excess the upper one.
    pub at: [f64; 3],
}

impl Simulated {
    /// Looks at what is left against a target in mm; a gouge is a finding ([`codes::GOUGE`]), excess is only reported. Without a
    /// tolerance (mm) it is the distance of columns. `name` is what the target is called.
    pub fn compare(&mut self, target: &Mesh, name: &str, tolerance: Option<f64>) {
        let layout = *self.left.layout();
        let tolerance_mm = tolerance.unwrap_or(layout.cell);
        // Both are on one grid, so that they can be compared.
        let found = Difference::beyond(&self.left, &target.columns(layout), tolerance_mm).unwrap_or_default();
        let thickest = |piece: Option<(f64, [f64; 3])>| {
            piece.map(|(mm, at)| Thickest { mm, at: at.map(crate::report::round::rounded) })
        };
        let compared = Compared {
            file: name.to_owned(),
            tolerance_mm,
            gouge: Differing {
                volume_mm3: found.gouge_mm3,
                columns: found.columns_gouged,
                thickest: thickest(found.deepest_gouge),
            },
            excess: Differing {
                volume_mm3: found.excess_mm3,
                columns: found.columns_in_excess,
                thickest: thickest(found.highest_excess),
            },
        };
        if let Some(Thickest { mm, at: [x, y, z] }) = compared.gouge.thickest {
            let message = format!(
                "{:.3} mm3 of the target {name} are gone, the thickest piece with {mm:.3} mm along z at x {x:.3}, y {y:.3}, z {z:.3} mm",
                compared.gouge.volume_mm3,
            );
            self.findings.push(Diagnostic::new(codes::GOUGE, message));
        }
        self.findings.extend(self.outside(target, name, tolerance_mm));
        self.target = Some(compared);
    }

    /// A target that no cut can bring out of this stock, because it stands out of its box.
    fn outside(&self, target: &Mesh, name: &str, tolerance: f64) -> Option<Diagnostic> {
        let layout = self.left.layout();
        let (low, high) = target.bounds();
        let sizes = [layout.columns, layout.rows].map(|count| count as f64 * layout.cell);
        let beside = low.into_iter().zip(high).zip(layout.origin).zip(sizes);
        let out = beside.map(|(((low, high), origin), size)| {
            let start = origin - layout.cell / 2.0;
            (start - low).max(high - start - size)
        });
        let out = out.fold(0.0, f64::max);
        (out > tolerance.max(layout.cell)).then(|| {
            let message = format!("the target {name} stands {out:.3} mm out of the stock in x or y");
            let help = "Target and program must stand in the same coordinates and unit.";
            Diagnostic::new(codes::GOUGE, message).help(help)
        })
    }
}

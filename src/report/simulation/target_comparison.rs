//! This module compares the remaining stock with the target part.

use super::SimulationReport;
use crate::diagnostic::{Diagnostic, codes};
use crate::number::format_named_point;
use crate::stock::{GridMismatch, Mesh, TargetDeviation};

/// How the remaining stock differs from the target part. A piece counts only if some of it is further than
/// the tolerance from the other solid in every direction.
#[derive(Debug, Clone, PartialEq)]
pub struct TargetComparison {
    /// The name of the target.
    pub file: String,
    /// The tolerance, mm.
    pub tolerance_mm: f64,
    /// Material of the target that was removed.
    pub gouge: TargetMismatch,
    /// Remaining material that is not in the target.
    pub excess: TargetMismatch,
}

/// Material that only one of the two solids has.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TargetMismatch {
    /// Its volume, mm3.
    pub volume_mm3: f64,
    /// The number of columns with such material.
    pub columns: usize,
    /// The place where it is thickest along z.
    pub thickest: Option<ThickestMismatch>,
}

/// The thickest piece along z.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ThickestMismatch {
    /// Its thickness, mm.
    pub thickness_mm: f64,
    /// The point in mm: the lower end of a gouge, or the upper end of excess.
    pub at_mm: [f64; 3],
}

impl SimulationReport {
    /// Compares the remaining stock with a target in mm. A gouge is a finding ([`codes::GOUGE`]), and excess
    /// is only reported. Without a tolerance (mm), it is the distance between columns. `name` is the name of
    /// the target.
    pub fn compare_with_target(&mut self, target: &Mesh, name: &str, tolerance_mm: Option<f64>) {
        let layout = *self.left.grid();
        let tolerance_mm = tolerance_mm.unwrap_or(layout.cell_mm);
        // Both are on the same grid, so a lack of memory is the only possible error.
        let measured = target.to_dexels(layout).map_err(GridMismatch::from).and_then(|columns| {
            let measured = TargetDeviation::measure_by_distance(&self.left, &columns, tolerance_mm)?;
            Ok((measured, columns))
        });
        let found = match measured {
            Ok((found, columns)) => {
                let layout = self.states.as_ref().map(|states| states.layout);
                self.deviations_mm = layout.map(|layout| layout.deviation_from_target(&self.left, &columns));
                found
            }
            Err(error) => {
                let message = format!("the target {name} cannot be compared: {error}");
                self.findings.push(Diagnostic::new(codes::MEMORY_LIMIT, message));
                return;
            }
        };
        let thickest = |piece: Option<(f64, [f64; 3])>| {
            piece.map(|(mm, at)| ThickestMismatch {
                thickness_mm: mm,
                at_mm: at.map(crate::report::rounding::round_to_micro),
            })
        };
        let compared = TargetComparison {
            file: name.to_owned(),
            tolerance_mm,
            gouge: TargetMismatch {
                volume_mm3: found.gouge_mm3,
                columns: found.columns_gouged,
                thickest: thickest(found.deepest_gouge),
            },
            excess: TargetMismatch {
                volume_mm3: found.excess_mm3,
                columns: found.columns_in_excess,
                thickest: thickest(found.highest_excess),
            },
        };
        if let Some(ThickestMismatch { thickness_mm: mm, at_mm: at }) = compared.gouge.thickest {
            let message = format!(
                "{:.3} mm3 of the target {name} were removed; the thickest piece has {mm:.3} mm along z at {} mm",
                compared.gouge.volume_mm3,
                format_named_point(at, 3),
            );
            self.findings.push(Diagnostic::new(codes::GOUGE, message));
        }
        self.findings.extend(self.find_target_outside_stock(target, name, tolerance_mm));
        self.target = Some(compared);
    }

    /// Reports a target that no cut can produce from this stock, because it extends beyond the box of the
    /// stock.
    fn find_target_outside_stock(&self, target: &Mesh, name: &str, tolerance: f64) -> Option<Diagnostic> {
        let layout = self.left.grid();
        let (low, high) = target.bounds();
        let sizes = [layout.columns, layout.rows].map(|count| count as f64 * layout.cell_mm);
        let beside = low.into_iter().zip(high).zip(layout.origin_mm).zip(sizes);
        let out = beside.map(|(((low, high), origin), size)| {
            let start = origin - layout.cell_mm / 2.0;
            (start - low).max(high - start - size)
        });
        let out = out.fold(0.0, f64::max);
        (out > tolerance.max(layout.cell_mm)).then(|| {
            let message = format!("the target {name} extends {out:.3} mm beyond the stock in x or y");
            let help = "Target and program must have the same coordinates and unit.";
            Diagnostic::new(codes::GOUGE, message).with_help(help)
        })
    }
}

//! This module sums up chips and finds their largest values.

use super::{ChipLayerRow, ChipRow};

/// A largest value with its place.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChipPeak {
    /// The value.
    pub value: f64,
    /// The line of the motion.
    pub line: usize,
    /// The height of the layer in mm. It is `None` for a whole motion.
    pub z_mm: Option<f64>,
}

/// The sums over all motions that ran, including those before the requested lines. Volumes are in mm3.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ChipTotals {
    /// The volume of the workpiece before the run.
    pub stock_mm3: f64,
    /// The volume of all chips.
    pub chips_mm3: f64,
    /// The material that was inside the cutter where a motion began. It is part of no chip.
    pub inside_mm3: f64,
    /// The volume of the workpiece after the run.
    pub left_mm3: f64,
    /// The number of motions that ran.
    pub motions: usize,
    /// The number of motions that were not cut, or only in part.
    pub skipped: usize,
}

/// The sums over the requested motions of an operation.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OperationChips {
    /// Its name. It is empty if the file has none.
    pub name: String,
    /// The first tool that moves in it.
    pub tool: String,
    /// The number of motions.
    pub motions: usize,
    /// The number of motions at feed with a chip.
    pub cutting: usize,
    /// Volume of all that was removed, mm3, also by rapids.
    pub volume_mm3: f64,
    /// The largest chip of a motion, mm3.
    pub chip_mm3: Option<ChipPeak>,
    /// The largest area on a layer, mm2.
    pub area_mm2: Option<ChipPeak>,
    /// The thickest chip of a tooth, mm.
    pub chip_thickness_mm: Option<ChipPeak>,
    /// The largest engagement on a layer, degrees.
    pub engaged_deg: Option<ChipPeak>,
    /// The largest number of separate pieces on a layer.
    pub pieces: Option<ChipPeak>,
}

impl OperationChips {
    /// Adds a motion. What a rapid takes of the material is a crash and no chip: it counts in the volume alone.
    pub(super) fn add_motion(&mut self, row: &ChipRow) {
        self.motions += 1;
        self.volume_mm3 += row.volume_mm3;
        if row.rapid {
            return;
        }
        self.cutting += usize::from(row.volume_mm3 > 0.0);
        raise_peak(&mut self.chip_mm3, row.volume_mm3, row.line, None);
        for layer in &row.layers {
            let at = |largest: &mut Option<ChipPeak>, value: f64| {
                raise_peak(
                    largest,
                    value,
                    row.line,
                    Some(crate::report::rounding::round_to_micro(layer.z_mm)),
                );
            };
            let ChipLayerRow { area_mm2, chip_thickness_mm, count, .. } = layer;
            at(&mut self.area_mm2, *area_mm2);
            at(&mut self.chip_thickness_mm, chip_thickness_mm.unwrap_or(0.0));
            at(&mut self.engaged_deg, layer.engaged_deg());
            at(&mut self.pieces, *count as f64);
        }
    }
}

impl OperationChips {
    /// Returns the largest values of several operations. Of equal values, the first in the order of the file
    /// counts. A largest number of pieces of 1 is left out, because it is the normal case.
    pub(super) fn largest_of(operations: &[Self]) -> Self {
        let most = |of: fn(&Self) -> Option<ChipPeak>| {
            let all = operations.iter().filter_map(of);
            all.reduce(|a, b| if b.value > a.value { b } else { a })
        };
        Self {
            chip_mm3: most(|sums| sums.chip_mm3),
            area_mm2: most(|sums| sums.area_mm2),
            chip_thickness_mm: most(|sums| sums.chip_thickness_mm),
            engaged_deg: most(|sums| sums.engaged_deg),
            pieces: most(|sums| sums.pieces).filter(|most| most.value > 1.0),
            ..Self::default()
        }
    }
}

fn raise_peak(largest: &mut Option<ChipPeak>, value: f64, line: usize, z: Option<f64>) {
    if value > largest.map_or(0.0, |largest| largest.value) {
        *largest = Some(ChipPeak { value, line, z_mm: z });
    }
}

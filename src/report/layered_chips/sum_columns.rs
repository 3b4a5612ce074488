//! This module defines the columns of sums over chips: name, unit, value and printing.

use super::{ChipPeak, ChipTotals, OperationChips};
use crate::report::table::{Column, ColumnUnit, PeakPlace, TableValue};

/// Returns the sums of the run as columns, in the order of the JSON.
pub(super) fn totals_columns() -> [Column<ChipTotals>; 6] {
    use ColumnUnit as Unit;
    [
        Column::new("stock", Unit::Volume, |totals: &ChipTotals| totals.stock_mm3.into()).decimals(1),
        Column::new("chips", Unit::Volume, |totals: &ChipTotals| totals.chips_mm3.into()).decimals(1),
        Column::new("inside", Unit::Volume, |totals: &ChipTotals| totals.inside_mm3.into()).decimals(1),
        Column::new("left", Unit::Volume, |totals: &ChipTotals| totals.left_mm3.into()).decimals(1),
        Column::new("motions", Unit::None, |totals: &ChipTotals| totals.motions.into()),
        Column::new("skipped", Unit::None, |totals: &ChipTotals| totals.skipped.into()),
    ]
}

/// Returns the sums of an operation as columns, in the order of text and JSON.
pub(super) fn operation_columns() -> [Column<OperationChips>; 10] {
    use ColumnUnit as Unit;
    [
        Column::new("name", Unit::None, |sums: &OperationChips| TableValue::text(&sums.name))
            .titled("operation")
            .left_aligned(),
        Column::new("tool", Unit::None, |sums: &OperationChips| TableValue::text(&sums.tool)).left_aligned(),
        Column::new("motions", Unit::None, |sums: &OperationChips| sums.motions.into()),
        Column::new("cutting", Unit::None, |sums: &OperationChips| sums.cutting.into()),
        Column::new("volume", Unit::Volume, |sums: &OperationChips| sums.volume_mm3.into())
            .titled("")
            .decimals(1),
        Column::new("chip", Unit::Volume, |sums: &OperationChips| peak(sums.chip_mm3))
            .titled("largest")
            .worded_as("largest chip", 4)
            .decimals(3),
        Column::new("area", Unit::Area, |sums: &OperationChips| peak(sums.area_mm2))
            .titled("")
            .worded_as("largest area on a layer", 4)
            .decimals(3),
        Column::new("chip_thickness", Unit::Length, |sums: &OperationChips| peak(sums.chip_thickness_mm))
            .titled("chip")
            .worded_as("thickest chip of a tooth", 4)
            .decimals(4),
        Column::new("engaged", Unit::Angle, |sums: &OperationChips| peak(sums.engaged_deg))
            .worded_as("largest engagement", 1)
            .decimals(1),
        Column::new("pieces", Unit::None, |sums: &OperationChips| peak(sums.pieces))
            .worded_as("most separate pieces", 0)
            .decimals(0),
    ]
}

fn peak(peak: Option<ChipPeak>) -> TableValue<'static> {
    peak.map_or(TableValue::Missing, |peak| TableValue::Peak {
        value: peak.value,
        place: PeakPlace::Layer { line: peak.line, z_mm: peak.z_mm },
    })
}

//! This module defines the columns of the sums of a simulation: name, unit, value and printing.

use super::{OperationSums, SimulationPeak, SimulationSums};
use crate::report::table::{Column, ColumnUnit, PeakPlace, TableValue};

impl AsRef<SimulationSums> for SimulationSums {
    fn as_ref(&self) -> &SimulationSums {
        self
    }
}

impl AsRef<SimulationSums> for OperationSums {
    fn as_ref(&self) -> &SimulationSums {
        &self.sums
    }
}

/// Returns the columns that name the operation of the sums and its tool.
pub(super) fn operation_columns() -> [Column<OperationSums>; 2] {
    [
        Column::new("operation", ColumnUnit::None, |row: &OperationSums| TableValue::text(&row.name))
            .left_aligned(),
        Column::new("tool", ColumnUnit::None, |row: &OperationSums| TableValue::text(&row.tool))
            .left_aligned(),
    ]
}

/// Returns the sums as columns, in the order of the JSON.
pub(super) fn sum_columns<R: AsRef<SimulationSums>>() -> Vec<Column<R>> {
    let mut columns = path_columns().to_vec();
    columns.extend(load_columns());
    columns
}

fn path_columns<R: AsRef<SimulationSums>>() -> [Column<R>; 10] {
    use ColumnUnit as Unit;
    [
        Column::new("motions", Unit::None, |row: &R| row.as_ref().motions.into()),
        Column::new("cutting", Unit::None, |row: &R| row.as_ref().cutting.into()),
        Column::new("feed", Unit::Length, |row: &R| row.as_ref().feed_mm.into())
            .titled("at feed")
            .decimals(1),
        Column::new("rapid", Unit::Length, |row: &R| row.as_ref().rapid_mm.into())
            .titled("at rapid")
            .decimals(1),
        Column::new("feed_time", Unit::Duration, |row: &R| TableValue::Duration {
            seconds: row.as_ref().feed_seconds,
            // A time that leaves out motions is a lower bound.
            is_lower_bound: row.as_ref().untimed > 0,
        })
        .titled("time without acceleration")
        .old_json_key("feed_seconds"),
        Column::new("accelerated_time", Unit::Duration, |row: &R| {
            row.as_ref().accelerated_seconds.map_or(TableValue::Missing, |seconds| TableValue::Duration {
                seconds,
                is_lower_bound: row.as_ref().untimed > 0,
            })
        })
        .titled("time with acceleration")
        .old_json_key("accelerated_seconds"),
        Column::new("untimed", Unit::None, |row: &R| row.as_ref().untimed.into()),
        Column::new("rapid_time", Unit::Duration, |row: &R| TableValue::duration(row.as_ref().rapid_seconds))
            .titled("time")
            .old_json_key("rapid_seconds"),
        Column::new("standing_time", Unit::Duration, |row: &R| {
            TableValue::duration(row.as_ref().standing_seconds)
        })
        .titled("time standing")
        .old_json_key("standing_seconds"),
        Column::new("removed", Unit::Volume, |row: &R| row.as_ref().removed_mm3.into())
            .titled("")
            .decimals(1),
    ]
}

fn load_columns<R: AsRef<SimulationSums>>() -> [Column<R>; 12] {
    use ColumnUnit as Unit;
    [
        Column::new("chip_thickness", Unit::Length, |row: &R| peak(row.as_ref().chip_thickness_mm))
            .titled("chip")
            .worded_as("thickest chip", 4)
            .decimals(4),
        Column::new("chip_thickness_bound", Unit::Length, |row: &R| {
            peak(row.as_ref().chip_thickness_bound_mm)
        })
        .titled("chip at most")
        .worded_as("thickest chip at most", 4)
        .decimals(4),
        Column::new("removal_rate_peak", Unit::RemovalRate, |row: &R| {
            peak(row.as_ref().removal_rate_mm3_min)
        })
        .titled("peak")
        .worded_as("largest removal rate", 0)
        .decimals(0),
        Column::new("axial_depth", Unit::Length, |row: &R| peak(row.as_ref().axial_depth_mm))
            .titled("deep")
            .decimals(2),
        Column::new("radial_depth", Unit::Length, |row: &R| peak(row.as_ref().radial_depth_mm))
            .titled("wide")
            .decimals(2),
        Column::new("force_peak", Unit::Force, |row: &R| peak(row.as_ref().force_n))
            .titled("peak")
            .worded_as("largest force", 0)
            .decimals(0),
        Column::new("torque_peak", Unit::Torque, |row: &R| peak(row.as_ref().torque_nm))
            .titled("peak")
            .worded_as("largest torque", 2)
            .decimals(2),
        Column::new("power_peak", Unit::Power, |row: &R| peak(row.as_ref().power_kw))
            .titled("peak")
            .worded_as("largest power", 3)
            .decimals(3),
        Column::new("bending_peak", Unit::Force, |row: &R| peak(row.as_ref().bending_n))
            .titled("bending")
            .worded_as("largest force across the tool", 0)
            .decimals(0),
        Column::new("deflection_peak", Unit::Length, |row: &R| peak(row.as_ref().deflection_mm))
            .titled("bent")
            .worded_as("largest deflection of a tool", 4)
            .decimals(4),
        Column::new("bending_stress_peak", Unit::Stress, |row: &R| peak(row.as_ref().bending_stress_mpa))
            .titled("stress")
            .worded_as("largest bending stress", 0)
            .decimals(0),
        Column::new("surface_error_peak", Unit::Length, |row: &R| peak(row.as_ref().surface_error_mm))
            .titled("wall off")
            .worded_as("largest error of a wall by deflection", 4)
            .decimals(4),
    ]
}

fn peak(peak: Option<SimulationPeak>) -> TableValue<'static> {
    peak.map_or(TableValue::Missing, |peak| TableValue::Peak {
        value: peak.value,
        place: PeakPlace::Line(peak.line),
    })
}

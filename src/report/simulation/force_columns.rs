//! This module defines the columns of cutting forces: name, unit and value. Every name says whether it is a mean or a peak.

use crate::engagement::ToolBending;
use crate::report::table::{Column, ColumnUnit};
use crate::simulation_run::MotionForces;

/// A row that may have forces.
pub(in crate::report) trait ForceRow {
    /// Returns the forces; `None` if they are not known.
    fn forces(&self) -> Option<&MotionForces>;
}

/// A value of the forces.
type ForceValue = fn(&MotionForces) -> Option<f64>;

/// The columns of forces but those of the largest values of a motion: names, units and values.
const MEANS: [(&str, ColumnUnit, ForceValue); 17] = [
    ("fx_mean", ColumnUnit::Force, |forces| Some(forces.mean_n[0])),
    ("fy_mean", ColumnUnit::Force, |forces| Some(forces.mean_n[1])),
    ("fz_mean", ColumnUnit::Force, |forces| Some(forces.mean_n[2])),
    ("fx_min", ColumnUnit::Force, |forces| Some(forces.least_n[0])),
    ("fx_max", ColumnUnit::Force, |forces| Some(forces.largest_n[0])),
    ("fy_min", ColumnUnit::Force, |forces| Some(forces.least_n[1])),
    ("fy_max", ColumnUnit::Force, |forces| Some(forces.largest_n[1])),
    ("fz_min", ColumnUnit::Force, |forces| Some(forces.least_n[2])),
    ("fz_max", ColumnUnit::Force, |forces| Some(forces.largest_n[2])),
    ("f_feed_mean", ColumnUnit::Force, |forces| forces.has_heading.then_some(forces.tool_mean_n[0])),
    ("f_normal_mean", ColumnUnit::Force, |forces| forces.has_heading.then_some(forces.tool_mean_n[1])),
    ("f_axial_mean", ColumnUnit::Force, |forces| Some(forces.tool_mean_n[2])),
    ("f_resultant_mean", ColumnUnit::Force, |forces| Some(forces.resultant_mean_n())),
    ("bending_mean", ColumnUnit::Force, |forces| Some(forces.bending_mean_n())),
    ("bending_peak", ColumnUnit::Force, |forces| Some(forces.bending_peak_n)),
    ("torque_mean", ColumnUnit::Torque, |forces| Some(forces.torque_mean_nm)),
    ("power_mean", ColumnUnit::Power, |forces| Some(forces.power_mean_kw)),
];

/// Returns the columns of forces for rows of some kind, without those of [`peak_columns`].
pub(in crate::report) fn force_columns<R: ForceRow>() -> Vec<Column<R>> {
    fn column<R: ForceRow, const N: usize>(row: &R) -> Option<f64> {
        let (_, _, value) = MEANS.get(N)?;
        row.forces().and_then(value)
    }
    macro_rules! columns {
        ($($number:literal)*) => {
            vec![$(Column::new(MEANS[$number].0, MEANS[$number].1, |row: &R| column::<R, $number>(row).into())),*]
        };
    }
    columns!(0 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16)
}

/// Returns the columns of the largest resultant, torque and power of a place.
pub(in crate::report) fn peak_columns<R: ForceRow>() -> [Column<R>; 3] {
    [
        Column::new("f_resultant_peak", ColumnUnit::Force, |row: &R| {
            row.forces().map(|forces| forces.resultant_peak_n).into()
        }),
        Column::new("torque_peak", ColumnUnit::Torque, |row: &R| {
            row.forces().map(|forces| forces.torque_peak_nm).into()
        }),
        Column::new("power_peak", ColumnUnit::Power, |row: &R| {
            row.forces().map(|forces| forces.power_peak_kw).into()
        }),
    ]
}

/// Returns the columns of how the tool bends, which stand behind all others. Surface errors are above 0 where material stays.
pub(super) fn bending_columns<R: ForceRow>() -> [Column<R>; 5] {
    fn bending<R: ForceRow>(row: &R) -> Option<ToolBending> {
        row.forces().and_then(|forces| forces.bending)
    }
    [
        Column::new("deflection_mean", ColumnUnit::Length, |row: &R| {
            bending(row).map(|bending| bending.deflection_mean_length_mm()).into()
        }),
        Column::new("deflection_peak", ColumnUnit::Length, |row: &R| {
            bending(row).map(|bending| bending.deflection_peak_mm).into()
        }),
        Column::new("bending_stress_peak", ColumnUnit::Stress, |row: &R| {
            bending(row).map(|bending| bending.stress_peak_mpa).into()
        }),
        Column::new("surface_error_left_peak", ColumnUnit::Length, |row: &R| {
            bending(row).and_then(|bending| bending.wall_error_mm[0]).into()
        }),
        Column::new("surface_error_right_peak", ColumnUnit::Length, |row: &R| {
            bending(row).and_then(|bending| bending.wall_error_mm[1]).into()
        }),
    ]
}

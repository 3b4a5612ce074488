//! This module defines the columns of motions and of their layers: name, unit, value and printing.

use super::{ChipLayerRow, ChipMoment, ChipRow};
use crate::report::simulation::{ForceRow, force_columns, peak_columns};
use crate::report::table::{Column, ColumnUnit, TableValue};
use crate::simulation_run::MotionForces;

/// A layer of a motion: a row of the CSV.
pub(super) struct ChipLayerOfMotion<'a> {
    pub motion: &'a ChipRow,
    pub layer: &'a ChipLayerRow,
    /// The part of the motion, if parts were asked for.
    pub moment: Option<&'a ChipMoment>,
}

impl ForceRow for ChipMoment {
    fn forces(&self) -> Option<&MotionForces> {
        self.forces.as_ref()
    }
}

impl ForceRow for ChipLayerOfMotion<'_> {
    fn forces(&self) -> Option<&MotionForces> {
        self.moment?.forces.as_ref()
    }
}

impl AsRef<ChipRow> for ChipRow {
    fn as_ref(&self) -> &ChipRow {
        self
    }
}

impl AsRef<ChipRow> for ChipLayerOfMotion<'_> {
    fn as_ref(&self) -> &ChipRow {
        self.motion
    }
}

impl AsRef<ChipLayerRow> for ChipLayerRow {
    fn as_ref(&self) -> &ChipLayerRow {
        self
    }
}

impl AsRef<ChipLayerRow> for ChipLayerOfMotion<'_> {
    fn as_ref(&self) -> &ChipLayerRow {
        self.layer
    }
}

/// Returns the columns of a motion, in the order of the JSON. Sums over its layers are only in the JSON,
/// because a row of the CSV is one layer.
pub(super) fn motion_columns<R: AsRef<ChipRow>>() -> [Column<R>; 9] {
    use ColumnUnit as Unit;
    [
        Column::new("line", Unit::None, |row: &R| row.as_ref().line.into()),
        Column::new("operation", Unit::None, |row: &R| TableValue::text(&row.as_ref().operation)),
        Column::new("tool", Unit::None, |row: &R| TableValue::text(&row.as_ref().tool)),
        Column::new("rapid", Unit::None, |row: &R| TableValue::Flag(row.as_ref().rapid)).only_in_json(),
        Column::new("length", Unit::Length, |row: &R| row.as_ref().length_mm.into()),
        Column::new("feed", Unit::FeedPerMinute, |row: &R| row.as_ref().feed_mm_min.into()),
        Column::new("volume", Unit::Volume, |row: &R| row.as_ref().volume_mm3.into()).only_in_json(),
        Column::new("inside", Unit::Volume, |row: &R| row.as_ref().inside_mm3.into()).only_in_json(),
        Column::new("chip_thickness", Unit::Length, |row: &R| row.as_ref().chip_thickness_mm.into())
            .only_in_json(),
    ]
}

/// Returns the columns of a layer, in the order of the CSV and the JSON. Values that follow from others
/// (volume, pieces, engaged angle) are only in the CSV.
pub(super) fn layer_columns<R: AsRef<ChipLayerRow>>() -> [Column<R>; 9] {
    use ColumnUnit as Unit;
    [
        Column::new("z", Unit::Length, |row: &R| row.as_ref().z_mm.into()).old_json_key("z"),
        Column::new("thickness", Unit::Length, |row: &R| row.as_ref().thickness_mm.into()),
        Column::new("area", Unit::Area, |row: &R| row.as_ref().area_mm2.into()),
        Column::new("volume", Unit::Volume, |row: &R| {
            let layer = row.as_ref();
            (layer.area_mm2 * layer.thickness_mm).into()
        })
        .only_in_csv(),
        Column::new("inside", Unit::Area, |row: &R| row.as_ref().inside_mm2.into()),
        Column::new("pieces", Unit::None, |row: &R| row.as_ref().count.into()).only_in_csv(),
        Column::new("chip_thickness", Unit::Length, |row: &R| row.as_ref().chip_thickness_mm.into()),
        Column::new("engaged", Unit::Angle, |row: &R| row.as_ref().known_engagement_deg().into())
            .only_in_csv(),
        Column::new("arcs", Unit::Angle, |row: &R| TableValue::Intervals(&row.as_ref().arcs_deg)),
    ]
}

/// Returns the columns that a row of the CSV has behind the others where parts of motions were asked for: the part, and the
/// forces in its middle.
pub(super) fn moment_of_layer_columns<'a>() -> Vec<Column<ChipLayerOfMotion<'a>>> {
    use ColumnUnit as Unit;
    type Row<'a> = ChipLayerOfMotion<'a>;
    let mut columns = vec![
        Column::new("moment", Unit::None, |row: &Row<'a>| row.moment.map(|moment| moment.number).into()),
        Column::new("along_from", Unit::Length, |row: &Row<'a>| {
            row.moment.map(|moment| moment.along_mm[0]).into()
        }),
        Column::new("along_to", Unit::Length, |row: &Row<'a>| {
            row.moment.map(|moment| moment.along_mm[1]).into()
        }),
    ];
    columns.extend(force_columns());
    columns.extend(peak_columns());
    columns
}

/// Returns the columns of a part of a motion in the JSON.
pub(super) fn moment_columns() -> Vec<Column<ChipMoment>> {
    use ColumnUnit as Unit;
    let mut columns = vec![
        Column::new("moment", Unit::None, |row: &ChipMoment| row.number.into()),
        Column::new("along_from", Unit::Length, |row: &ChipMoment| row.along_mm[0].into()),
        Column::new("along_to", Unit::Length, |row: &ChipMoment| row.along_mm[1].into()),
        Column::new("volume", Unit::Volume, |row: &ChipMoment| row.volume_mm3.into()),
        Column::new("chip_thickness", Unit::Length, |row: &ChipMoment| row.chip_thickness_mm.into()),
    ];
    columns.extend(force_columns());
    columns.extend(peak_columns());
    columns
}

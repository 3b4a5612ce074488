//! This module converts statistics to another unit of length than the file's.

use super::{
    FeedRow, LengthUnitOrigin, MotionBoundingBox, MotionTotals, ProgramStats, ReportedRange,
    ResolvedLengthUnit, ToolStats,
};
use crate::program::LengthUnit;
use crate::report::table::{ColumnUnit, DisplayUnits};

impl ResolvedLengthUnit {
    /// Returns the conversion from this unit to another one, and the unit of the converted values. Returns
    /// `None` if there is nothing to convert.
    pub(in crate::report) fn show_in(self, shown_in: Option<LengthUnit>) -> Option<(DisplayUnits, Self)> {
        let shown_in = shown_in.filter(|shown_in| *shown_in != self.unit)?;
        let units = DisplayUnits { values_in: self.unit, shown_in };
        Some((units, Self { unit: shown_in, from: LengthUnitOrigin::Shown }))
    }
}

impl ProgramStats {
    /// Converts all lengths and feeds to the unit that a reader wants to see; `None` leaves them in the
    /// file's unit. Feeds in `feeds` stay as they are programmed.
    #[must_use]
    pub fn shown_in(mut self, unit: Option<LengthUnit>) -> Self {
        let Some((units, shown)) = self.units.show_in(unit) else { return self };
        self.file_units = Some(std::mem::replace(&mut self.units, shown));
        let length = |value: &mut f64| *value = units.convert(ColumnUnit::Length, *value);
        let optional = |value: &mut Option<f64>| value.iter_mut().for_each(length);
        let feed = |range: &mut Option<ReportedRange>| {
            for value in range.iter_mut().flat_map(|range| [&mut range.min, &mut range.max]) {
                *value = units.convert(ColumnUnit::FeedPerMinute, *value);
            }
        };
        let bounds = |bounds: &mut Option<MotionBoundingBox>| {
            bounds
                .iter_mut()
                .flat_map(|bounds| bounds.min.iter_mut().chain(&mut bounds.max))
                .for_each(length);
        };
        let totals = |totals: &mut MotionTotals| *totals = totals.converted(units);
        totals(&mut self.totals);
        self.classes.iter_mut().for_each(|class| totals(&mut class.totals));
        self.feeds.iter_mut().for_each(|FeedRow { length: value, .. }| length(value));
        feed(&mut self.feed);
        bounds(&mut self.box_of_feed);
        bounds(&mut self.box_of_all);
        self.frames.iter_mut().flat_map(|frame| &mut frame.origin).for_each(length);
        for tool in &mut self.tools {
            totals(&mut tool.totals);
            let ToolStats { diameter, nose_radius, corner_radius, length, flute_length, .. } = tool;
            [diameter, nose_radius, corner_radius, length, flute_length].into_iter().for_each(optional);
        }
        for operation in &mut self.operations {
            totals(&mut operation.totals);
            feed(&mut operation.feed);
        }
        self
    }
}

//! This module draws chip thickness and feed over time.
//!
//! There are two panels one above the other, as in the paper on block-by-block correction (Kiselev, Jukov,
//! Deev): the criterion, which is the thickest chip of each motion, and the feed. Several programs may be
//! drawn over each other.

use super::SimulationReport;
use crate::report::plot::{CurvePanel, PlotCurve, PlotSegment, draw_curve_panels};
use crate::report::table::{ColumnUnit, DisplayUnits};
use std::io;

/// A program in a drawing.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ProgramTimeSeries {
    /// The name of the program.
    pub name: String,
    /// The units that the drawing shows; those of the last program count.
    pub units: DisplayUnits,
    /// Its motions along time.
    pub moments: Vec<PlottedMotion>,
}

/// A motion along time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PlottedMotion {
    /// The time at which it begins, s.
    pub from_s: f64,
    /// The time at which it ends, s.
    pub to_s: f64,
    /// The thickest chip, mm.
    pub chip_thickness_mm: Option<f64>,
    /// The feed in mm/min. It is `None` in a rapid.
    pub feed_mm_min: Option<f64>,
}

impl SimulationReport {
    /// Returns the motions over time: that of the machine where it is known, without what it stands. A motion of unknown time is left out, for example a rapid of a machine
    /// without a known rapid feed.
    pub fn to_time_series(&self, name: impl Into<String>) -> ProgramTimeSeries {
        let mut at = 0.0;
        let timed = self.motions.rows.iter().filter_map(|row| {
            let seconds = row.machine_seconds.or(row.seconds).filter(|seconds| *seconds > 0.0)?;
            let from = at;
            at += seconds;
            let feed_mm_min = row.feed_mm_min.filter(|_| !row.rapid);
            Some(PlottedMotion {
                from_s: from,
                to_s: at,
                chip_thickness_mm: row.cut_load(row.chip_thickness_mm),
                feed_mm_min,
            })
        });
        ProgramTimeSeries { name: name.into(), units: self.units, moments: timed.collect() }
    }
}

/// Draws programs as SVG. All but the last are drawn as thin grey lines over it: usually the program before, and the
/// program after.
///
/// # Errors
/// Returns the errors of the drawing library. A drawing in memory has none.
pub fn draw_time_series(series: &[ProgramTimeSeries]) -> io::Result<String> {
    let units = series.last().map_or(DisplayUnits::MM, |last| last.units);
    let panel = |up: &str, unit: ColumnUnit, value: fn(&PlottedMotion) -> Option<f64>| {
        let shown = |moment: &PlottedMotion| value(moment).map(|value| units.convert(unit, value));
        CurvePanel {
            up: units.title(up, unit),
            from_zero: true,
            curves: series.iter().map(|series| build_curve(series, shown)).collect(),
        }
    };
    draw_curve_panels(
        "time, s",
        &[
            panel("thickest chip", ColumnUnit::Length, |moment| moment.chip_thickness_mm),
            panel("feed", ColumnUnit::FeedPerMinute, |moment| moment.feed_mm_min),
        ],
    )
}

fn build_curve(series: &ProgramTimeSeries, value: impl Fn(&PlottedMotion) -> Option<f64>) -> PlotCurve {
    let segment = |moment: &PlottedMotion| PlotSegment {
        from: moment.from_s,
        to: moment.to_s,
        values: value(moment).map(|value| [value; 2]),
    };
    PlotCurve { name: series.name.clone(), segments: series.moments.iter().map(segment).collect() }
}

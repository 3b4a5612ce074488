//! This module makes the times of a machine from a log of timed blocks: [`read_timing_log`] reads it, and
//! [`MeasuredTimes`] says what the setup shall have.

mod timing_log;

pub use timing_log::{TimingLog, read_timing_log};

use crate::machine::{FittedTiming, fit_axis_rapid, fit_corner_constant, fit_path_acceleration};
use crate::presentation::to_safe_line;
use crate::report::text_format::format_short;
use crate::report::to_json_text;
use serde::Serialize;
use std::fmt::Write as _;

/// What timed blocks say about a machine.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasuredTimes {
    /// Version of the JSON structure: 1.
    pub version: u32,
    /// The constant of the corner law, in s by the root of mm/s.
    pub corner_constant: Option<MeasuredTiming>,
    /// The acceleration along the path, in mm/s2.
    pub path_acceleration: Option<MeasuredTiming>,
    /// The axes at rapid.
    pub axes: Vec<MeasuredAxis>,
}

/// A value, and how well it fits.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct MeasuredTiming {
    /// The value.
    pub value: f64,
    /// How many blocks it comes from.
    pub blocks: usize,
    /// The largest difference between a time and its fit, in s.
    pub largest_error_s: f64,
}

/// An axis at rapid.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct MeasuredAxis {
    /// Its name.
    pub name: String,
    /// Its speed per minute; `None` where all blocks have one length.
    pub rapid: Option<f64>,
    /// Its acceleration per s2.
    pub acceleration: Option<MeasuredTiming>,
}

impl MeasuredTimes {
    /// Fits the times of a log.
    pub fn from_log(log: &TimingLog) -> Self {
        let timing = |fitted: FittedTiming, blocks: usize| MeasuredTiming {
            value: fitted.value,
            blocks,
            largest_error_s: fitted.largest_error_s,
        };
        let axes = log.rapids.iter().map(|(name, strokes)| {
            let fitted = fit_axis_rapid(strokes);
            MeasuredAxis {
                name: name.clone(),
                rapid: fitted.map(|(rapid, _)| rapid),
                acceleration: fitted.map(|(_, fitted)| timing(fitted, strokes.len())),
            }
        });
        Self {
            version: 1,
            corner_constant: fit_corner_constant(&log.corners)
                .map(|fitted| timing(fitted, log.corners.len())),
            path_acceleration: fit_path_acceleration(&log.strokes)
                .map(|fitted| timing(fitted, log.strokes.len())),
            axes: axes.collect(),
        }
    }

    /// Returns the lines of a setup, with how well they fit.
    pub fn to_text(&self) -> String {
        let mut out = "machine:\n".to_owned();
        let fit = |timing: &MeasuredTiming| {
            format!("{} blocks, within {} ms", timing.blocks, format_short(timing.largest_error_s * 1000.0))
        };
        if let Some(timing) = &self.corner_constant {
            let _ = writeln!(out, "  corner_constant: {:.6}   # {}", timing.value, fit(timing));
        }
        if let Some(timing) = &self.path_acceleration {
            let per_minute = timing.value * 60.0;
            let _ = writeln!(
                out,
                "  max_acceleration: {per_minute:.0}   # {} mm/s2; {}",
                format_short(timing.value),
                fit(timing)
            );
        }
        for axis in &self.axes {
            let name = to_safe_line(&axis.name);
            let _ = match (axis.rapid, &axis.acceleration) {
                (Some(rapid), Some(timing)) => {
                    writeln!(
                        out,
                        "  # {name}: rapid: {rapid:.0}, acceleration: {:.0}   # {}",
                        timing.value,
                        fit(timing)
                    )
                }
                _ => {
                    writeln!(out, "  # {name}: blocks of two lengths at least say its rapid and acceleration")
                }
            };
        }
        out
    }

    /// Returns the values as a JSON document.
    pub fn to_json(&self) -> String {
        to_json_text(self)
    }
}

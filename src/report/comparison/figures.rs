//! This module sums up the motions of an operation or a program: lengths, times and largest loads.

use crate::report::motion_measure::MotionFeedAndTime;
use crate::report::simulation::MotionRow;

/// A largest value with the motion that has it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ComparisonPeak {
    /// The value.
    pub value: f64,
    /// The index of the motion. First points are not counted.
    pub motion: usize,
}

/// Sums and extremes over motions.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct ComparisonFigures {
    /// The number of motions.
    pub motions: usize,
    /// Length at feed, mm.
    pub feed_mm: f64,
    /// Length at rapid, mm.
    pub rapid_mm: f64,
    /// The time at feed in s, without the motions whose time is not known.
    pub feed_seconds: f64,
    /// The same time with the machine's acceleration, s. It is `None` if the acceleration is not known.
    pub accelerated_seconds: Option<f64>,
    /// The number of motions at feed whose time is not known.
    pub untimed: usize,
    /// The time at rapid in s. It is `None` if the machine's rapid feed is not known.
    pub rapid_seconds: Option<f64>,
    /// The time in s that the machine stands for tool changes, starts of the spindle and dwells; `None` if the machine is not
    /// known.
    pub standing_seconds: Option<f64>,
    /// Slowest and fastest feed, mm/min.
    pub feed_range_mm_min: Option<[f64; 2]>,
    /// Thickest chip, mm.
    pub chip_thickness_mm: Option<ComparisonPeak>,
    /// An upper bound of the thickest chip, mm.
    pub chip_thickness_bound_mm: Option<ComparisonPeak>,
    /// Largest removal rate, mm3/min, as the mean over a window of path.
    pub removal_rate_mm3_min: Option<ComparisonPeak>,
    /// Largest force, N.
    pub force_n: Option<ComparisonPeak>,
    /// Largest torque, N m.
    pub torque_nm: Option<ComparisonPeak>,
    /// Largest power, kW.
    pub power_kw: Option<ComparisonPeak>,
    /// Largest force across the tool axis, N.
    pub bending_n: Option<ComparisonPeak>,
    /// Largest deflection of a tool's tip, mm.
    pub deflection_mm: Option<ComparisonPeak>,
    /// Largest bending stress of a tool, MPa.
    pub bending_stress_mpa: Option<ComparisonPeak>,
    /// Largest error of a wall by deflection, whatever its sign, mm.
    pub surface_error_mm: Option<ComparisonPeak>,
}

impl ComparisonFigures {
    pub(super) fn new(rapid_known: bool) -> Self {
        Self { rapid_seconds: rapid_known.then_some(0.0), ..Self::default() }
    }

    /// Returns the time on the machine with all that it stands, in s. `None` if the machine is not known.
    pub fn machine_seconds(&self) -> Option<f64> {
        Some(self.accelerated_seconds? + self.rapid_seconds? + self.standing_seconds?)
    }

    /// Adds a motion. `row` is its row in the simulation, if there was one.
    pub(super) fn add_motion(&mut self, motion: usize, moved: &MotionFeedAndTime, row: Option<&MotionRow>) {
        self.motions += 1;
        if moved.rapid {
            self.rapid_mm += moved.length_mm;
            self.rapid_seconds = self.rapid_seconds.zip(moved.seconds).map(|(sum, more)| sum + more);
        } else {
            self.feed_mm += moved.length_mm;
            self.feed_seconds += moved.seconds.unwrap_or(0.0);
            self.untimed += usize::from(moved.seconds.is_none());
            if let Some(feed) = moved.feed_mm_min {
                let [low, high] = self.feed_range_mm_min.unwrap_or([feed; 2]);
                self.feed_range_mm_min = Some([low.min(feed), high.max(feed)]);
            }
        }
        // A rapid through material is a crash and not a cut, so its loads are no peaks of the program's cuts.
        let Some(row) = row.filter(|row| !row.rapid) else { return };
        let raise = |peak: &mut Option<ComparisonPeak>, value: Option<f64>| {
            if let Some(value) = value.filter(|value| peak.is_none_or(|peak| *value > peak.value)) {
                *peak = Some(ComparisonPeak { value, motion });
            }
        };
        raise(&mut self.chip_thickness_mm, row.chip_thickness_mm);
        raise(&mut self.chip_thickness_bound_mm, row.chip_thickness_bound_mm);
        raise(&mut self.removal_rate_mm3_min, row.peak_removal_rate_mm3_min);
        raise(&mut self.force_n, row.force_n);
        raise(&mut self.torque_nm, row.torque_nm);
        raise(&mut self.power_kw, row.power_kw);
        raise(&mut self.bending_n, row.bending_n());
        raise(&mut self.deflection_mm, row.deflection_mm());
        raise(&mut self.bending_stress_mpa, row.bending_stress_mpa());
        raise(&mut self.surface_error_mm, row.surface_error_mm());
    }
}

//! This module sums up motions and finds their peaks.

use super::MotionRow;

/// A largest value with the line of the motion that has it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SimulationPeak {
    /// The value.
    pub value: f64,
    /// The line; `null` for a motion that a step has inserted.
    pub line: Option<usize>,
}

/// Sums and peaks over motions. A peak is `null` if nothing is cut, or if its value is not known.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct SimulationSums {
    /// The number of motions.
    pub motions: usize,
    /// The number of motions that remove material.
    pub cutting: usize,
    /// Length at feed, mm.
    pub feed_mm: f64,
    /// Length at rapid, mm.
    pub rapid_mm: f64,
    /// The time at feed in s, without acceleration and dwells, and without the motions whose time is not
    /// known.
    pub feed_seconds: f64,
    /// The same time with the machine's acceleration, s; `null` if the acceleration is not known.
    pub accelerated_seconds: Option<f64>,
    /// The number of motions at feed whose time is not known.
    pub untimed: usize,
    /// Time at rapid, s; `null` when the machine's rapid feed is not known.
    pub rapid_seconds: Option<f64>,
    /// The time in s that the machine stands for tool changes, starts of the spindle and dwells; `null` if the machine is not
    /// known.
    pub standing_seconds: Option<f64>,
    /// Removed volume, mm3.
    pub removed_mm3: f64,
    /// Thickest chip, mm.
    pub chip_thickness_mm: Option<SimulationPeak>,
    /// An upper bound of the thickest chip, mm.
    pub chip_thickness_bound_mm: Option<SimulationPeak>,
    /// Largest removal rate over a window of path, mm3/min
    /// ([`super::SimulationAccuracy::removal_window_mm`]).
    pub removal_rate_mm3_min: Option<SimulationPeak>,
    /// Deepest cut along the axis, mm.
    pub axial_depth_mm: Option<SimulationPeak>,
    /// Widest cut, mm.
    pub radial_depth_mm: Option<SimulationPeak>,
    /// Largest force, N.
    pub force_n: Option<SimulationPeak>,
    /// Largest torque, N m.
    pub torque_nm: Option<SimulationPeak>,
    /// Largest power, kW.
    pub power_kw: Option<SimulationPeak>,
    /// Largest force across the tool axis, N.
    pub bending_n: Option<SimulationPeak>,
    /// Largest deflection of a tool's tip, mm.
    pub deflection_mm: Option<SimulationPeak>,
    /// Largest bending stress of a tool, MPa.
    pub bending_stress_mpa: Option<SimulationPeak>,
    /// Largest error of a wall by deflection, whatever its sign, mm.
    pub surface_error_mm: Option<SimulationPeak>,
}

/// The sums of an operation.
#[derive(Debug, Clone, PartialEq)]
pub struct OperationSums {
    /// Its name. It is empty if the file has none.
    pub name: String,
    /// The first tool that moves in it: its number if it is known, else its name.
    pub tool: String,
    /// Its sums.
    pub sums: SimulationSums,
}

impl SimulationSums {
    /// Makes empty sums. `rapid_known` tells whether rapids have a time.
    pub(super) fn new(rapid_known: bool) -> Self {
        Self { rapid_seconds: rapid_known.then_some(0.0), ..Self::default() }
    }

    /// Adds a motion that removed a volume.
    pub(super) fn add_motion(&mut self, row: &MotionRow, removed_mm3: f64) {
        self.motions += 1;
        self.cutting += usize::from(removed_mm3 > 0.0);
        self.removed_mm3 += removed_mm3;
        if row.rapid {
            self.rapid_mm += row.length_mm;
            self.rapid_seconds = self.rapid_seconds.zip(row.seconds).map(|(sum, seconds)| sum + seconds);
        } else {
            self.feed_mm += row.length_mm;
            self.feed_seconds += row.seconds.unwrap_or(0.0);
            self.untimed += usize::from(row.seconds.is_none());
        }
        // A rapid through material is a crash and not a cut, so its loads are no peaks of the program's cuts.
        if row.rapid {
            return;
        }
        self.raise_chips(row);
        let raise = |peak: &mut Option<SimulationPeak>, value: Option<f64>| raise_peak(peak, value, row.line);
        raise(&mut self.axial_depth_mm, row.axial_depth_mm);
        raise(&mut self.radial_depth_mm, row.radial_depth_mm);
        raise(&mut self.force_n, row.force_n);
        raise(&mut self.torque_nm, row.torque_nm);
        raise(&mut self.power_kw, row.power_kw);
        raise(&mut self.bending_n, row.bending_n());
        raise(&mut self.deflection_mm, row.deflection_mm());
        raise(&mut self.bending_stress_mpa, row.bending_stress_mpa());
        raise(&mut self.surface_error_mm, row.surface_error_mm());
    }

    /// Forgets the thickest chips, which are then raised anew.
    pub(super) fn forget_chips(&mut self) {
        self.chip_thickness_mm = None;
        self.chip_thickness_bound_mm = None;
    }

    /// Raises the thickest chips to those of a motion; a rapid has none.
    pub(super) fn raise_chips(&mut self, row: &MotionRow) {
        if !row.rapid {
            raise_peak(&mut self.chip_thickness_mm, row.chip_thickness_mm, row.line);
            raise_peak(&mut self.chip_thickness_bound_mm, row.chip_thickness_bound_mm, row.line);
        }
    }

    /// Adds the largest removal rate of a motion, which is only known after the last motion.
    pub(super) fn add_removal_peak(&mut self, row: &MotionRow) {
        raise_peak(&mut self.removal_rate_mm3_min, row.peak_removal_rate_mm3_min, row.line);
    }
}

fn raise_peak(peak: &mut Option<SimulationPeak>, value: Option<f64>, line: Option<usize>) {
    let value = value.filter(|value| *value > peak.map_or(0.0, |peak| peak.value));
    *peak = value.map(|value| SimulationPeak { value, line }).or(*peak);
}

//! This module holds the forces of a motion: means over its time, and extremes over all revolutions.

use crate::engagement::{EdgeThicknessMap, SectionForces, ToolBending};
use crate::program::record::SpindleDirection;
use std::f64::consts::TAU;

/// The feed and the speed with which a motion cuts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CuttingSpeed {
    /// The feed in mm/min.
    pub feed_mm_min: f64,
    /// The spindle speed in rev/min.
    pub rpm: f64,
    /// The sense of the spindle.
    pub direction: SpindleDirection,
}

/// The forces on the workpiece while a motion cuts, in N and N m. Axes are those of the workpiece frame, which is the frame
/// of the program's first motion.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct MotionForces {
    /// Means ahead, to the left and along the tool axis away from the tip, over the motion's time.
    pub tool_mean_n: [f64; 3],
    /// Whether there is an ahead on all of the motion: a plunge has none.
    pub has_heading: bool,
    /// Means in the axes.
    pub mean_n: [f64; 3],
    /// The least values in the axes, over all revolutions.
    pub least_n: [f64; 3],
    /// The largest values in the axes.
    pub largest_n: [f64; 3],
    /// The largest resultant.
    pub resultant_peak_n: f64,
    /// The largest part across the tool axis.
    pub bending_peak_n: f64,
    /// The mean torque.
    pub torque_mean_nm: f64,
    /// The largest torque.
    pub torque_peak_nm: f64,
    /// The mean power, kW.
    pub power_mean_kw: f64,
    /// The largest power of a place, as its mean over a revolution, kW.
    pub power_peak_kw: f64,
    /// How the tool bends; `None` if the setup does not say how stiff it is.
    pub bending: Option<ToolBending>,
}

impl MotionForces {
    /// Returns the length of the mean force.
    pub fn resultant_mean_n(&self) -> f64 {
        let [x, y, z] = self.mean_n;
        x.hypot(y).hypot(z)
    }

    /// Returns the length of the mean force's part across the tool axis.
    pub fn bending_mean_n(&self) -> f64 {
        let [ahead, left, _] = self.tool_mean_n;
        ahead.hypot(left)
    }

    /// Returns the forces of a motion in air, of a tool of which is known how stiff it is or not.
    pub(crate) fn in_air(is_beam: bool) -> Self {
        let bending = is_beam.then(ToolBending::default);
        Self { has_heading: true, bending, ..Self::default() }
    }

    pub(super) fn of_place(forces: &SectionForces, has_heading: bool, rpm: f64) -> Self {
        let power_kw = forces.torque_mean_nm * TAU * rpm / 60_000.0;
        Self {
            tool_mean_n: forces.tool_mean_n,
            has_heading,
            mean_n: forces.mean_n,
            least_n: forces.least_n,
            largest_n: forces.largest_n,
            resultant_peak_n: forces.resultant_peak_n,
            bending_peak_n: forces.bending_peak_n,
            torque_mean_nm: forces.torque_mean_nm,
            torque_peak_nm: forces.torque_peak_nm,
            power_mean_kw: power_kw,
            power_peak_kw: power_kw,
            bending: forces.bending,
        }
    }
}

/// The forces of places, each with its part of the time, become those of a motion.
#[derive(Debug, Default)]
pub(super) struct ForceAverage {
    pub sum: Option<MotionForces>,
    time: f64,
}

impl ForceAverage {
    pub(super) fn add(&mut self, place: &MotionForces, time: f64) {
        let Some(sum) = &mut self.sum else {
            (self.sum, self.time) = (Some(*place), time);
            return;
        };
        let part = time / (self.time + time);
        let blend = |sum: &mut f64, value: f64| *sum += (value - *sum) * part;
        sum.tool_mean_n.iter_mut().zip(place.tool_mean_n).for_each(|(sum, value)| blend(sum, value));
        sum.mean_n.iter_mut().zip(place.mean_n).for_each(|(sum, value)| blend(sum, value));
        blend(&mut sum.torque_mean_nm, place.torque_mean_nm);
        blend(&mut sum.power_mean_kw, place.power_mean_kw);
        sum.least_n.iter_mut().zip(place.least_n).for_each(|(sum, value)| *sum = sum.min(value));
        sum.largest_n.iter_mut().zip(place.largest_n).for_each(|(sum, value)| *sum = sum.max(value));
        sum.resultant_peak_n = sum.resultant_peak_n.max(place.resultant_peak_n);
        sum.bending_peak_n = sum.bending_peak_n.max(place.bending_peak_n);
        sum.torque_peak_nm = sum.torque_peak_nm.max(place.torque_peak_nm);
        sum.power_peak_kw = sum.power_peak_kw.max(place.power_peak_kw);
        sum.has_heading &= place.has_heading;
        if let Some((bending, place)) = sum.bending.as_mut().zip(place.bending) {
            bending.add_place(&place, part);
        }
        self.time += time;
    }
}

/// The forces on a stretch inside a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct ForceStretch {
    /// Where it begins and ends, mm from the start of the motion.
    pub along_mm: [f64; 2],
    /// The forces in its middle.
    pub forces: MotionForces,
}

/// The forces over one revolution at the middle of a motion.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ToothPeriod {
    /// For each rotation the angle in degrees from a tooth straight ahead, the force on the workpiece in N, and the torque in
    /// N m.
    pub rotations: Vec<(f64, [f64; 3], f64)>,
    /// The forces there.
    pub forces: MotionForces,
}

/// The chips on edges in the middle of a motion.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct EdgeMoment {
    /// The tip, mm in the workpiece frame.
    pub tip_mm: [f64; 3],
    /// The unit vectors of the workpiece frame ahead, to the left as seen from the holder, and along the axis away from the
    /// tip.
    pub frame: [[f64; 3]; 3],
    /// The meridian of the cutter as a polyline from the tip upwards: distances from the axis and heights, mm.
    pub outline_mm: Vec<[f64; 2]>,
    /// The thickness over edges and rotations.
    pub map: EdgeThicknessMap,
}

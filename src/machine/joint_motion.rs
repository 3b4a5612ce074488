//! This module measures a motion by its axes: how far the tip leaves the line, and how fast it may be.

use super::axis_time::rest_to_rest_s;
use super::joint_values::JointValues;
use super::kinematic_chain::KinematicChain;
use crate::engagement::axis_on_shortest_turn;
use crate::program::geometry::Pose;
use nalgebra::{Point3, Vector3};

/// The largest step of a rotary axis between two places that are looked at, in degrees, and the least number of
/// places. Between two places, a sine is then no further from its largest value than 0.02 %.
const LARGEST_LOOK_DEG: f64 = 2.0;
const LEAST_LOOKS: usize = 8;
const MOST_LOOKS: usize = 720;

/// How the machine goes from one pose to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisInterpolation {
    /// With tool-centre-point control: the tip runs evenly on the straight line, the rotary axes turn evenly, and the
    /// linear axes follow.
    TipControlled,
    /// Without: all axes run evenly, and the tip leaves the line.
    JointLinear,
}

/// What the axes ask of a motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct AxisDemand {
    /// The least time that the largest speeds of the axes allow, in s.
    pub least_s: f64,
    /// The axis that decides, as a place in [`KinematicChain::axes`]; `None` where nothing moves.
    pub axis: Option<usize>,
}

/// A motion between two poses of which the values of all axes are known.
#[derive(Debug, Clone, Copy)]
pub struct JointMotion<'c> {
    /// The machine.
    pub chain: &'c KinematicChain,
    /// The values at the start.
    pub from: JointValues,
    /// The values at the end.
    pub to: JointValues,
    /// The tips at start and end in the workpiece frame, mm.
    pub tips: [Point3<f64>; 2],
}

impl JointMotion<'_> {
    /// Returns the steps of the rotary axes in degrees.
    pub fn rotary_steps(&self) -> [f64; 2] {
        let [first, second] = self.to.rotaries;
        [first - self.from.rotaries[0], second - self.from.rotaries[1]]
    }

    /// Returns the length of the line between the tips in mm.
    pub fn tip_length_mm(&self) -> f64 {
        (self.tips[1] - self.tips[0]).norm()
    }

    /// Returns the tip in the workpiece frame at a share of the motion, from 0 to 1, with all axes linear.
    pub fn joint_linear_tip(&self, share: f64) -> Point3<f64> {
        self.chain.locate_tool(&self.from.interpolate(&self.to, share)).0
    }

    /// Returns the largest distance in mm of the tip from the straight line between both tips if all axes are linear.
    /// For a small angle `a` about an axis at the distance `r` it is about `r a^2 / 8`.
    pub fn tip_sag_mm(&self) -> f64 {
        if self.rotary_steps().iter().all(|step| *step == 0.0) {
            return 0.0;
        }
        let distance = |share: f64| distance_to_segment(&self.joint_linear_tip(share), &self.tips);
        let looks = self.count_looks();
        let (mut best, mut most) = (0, 0.0);
        for look in 0..=looks {
            let found = distance(look as f64 / looks as f64);
            if found > most {
                (best, most) = (look, found);
            }
        }
        // The largest place is refined between its neighbours, by thirds.
        let mut low = best.saturating_sub(1) as f64 / looks as f64;
        let mut high = (best + 1).min(looks) as f64 / looks as f64;
        for _ in 0..24 {
            let (left, right) = (low + (high - low) / 3.0, high - (high - low) / 3.0);
            let (at_left, at_right) = (distance(left), distance(right));
            most = most.max(at_left).max(at_right);
            if at_left < at_right { low = left } else { high = right }
        }
        most
    }

    /// Returns the largest angle in degrees between the tool axis as the rotary axes turn it, evenly, and as it would turn the
    /// shortest way between both ends. Near the pole the rotary axes take it over a wide cone.
    pub fn axis_swing_deg(&self) -> f64 {
        if self.rotary_steps().iter().all(|step| *step == 0.0) {
            return 0.0;
        }
        let pose = |joints: &JointValues| {
            let (point, axis) = self.chain.locate_tool(joints);
            Pose { point, axis }
        };
        let ends = [pose(&self.from), pose(&self.to)];
        let looks = self.count_looks();
        let swing = |look: usize| {
            let share = look as f64 / looks as f64;
            let there = pose(&self.from.interpolate(&self.to, share)).axis;
            there.angle(&axis_on_shortest_turn(&ends[0], &ends[1], share)).to_degrees()
        };
        (1..looks).map(swing).fold(0.0, f64::max)
    }

    /// Returns what the largest speeds of the axes ask of the motion.
    pub fn axis_demand(&self, interpolation: AxisInterpolation) -> AxisDemand {
        let turns = self.rotary_steps().iter().any(|step| *step != 0.0);
        let looks = match interpolation {
            AxisInterpolation::TipControlled if turns => self.count_looks(),
            _ => 0,
        };
        let mut demand = AxisDemand { least_s: 0.0, axis: None };
        for look in 0..=looks {
            let rates = match looks {
                0 => self.linear_rates(),
                _ => self.linear_rates_at(look as f64 / looks as f64),
            };
            let rates = self.chain.order_values(&rates, &self.rotary_steps());
            for (place, (axis, rate)) in self.chain.axes().iter().zip(&rates).enumerate() {
                let seconds = 60.0 * rate.abs() / axis.max_speed;
                if seconds > demand.least_s {
                    demand = AxisDemand { least_s: seconds, axis: Some(place) };
                }
            }
        }
        demand
    }

    /// Returns the time in s as a rapid: every axis from rest to rest by itself, and the slowest counts.
    pub fn rapid_s(&self) -> f64 {
        let steps = self.chain.order_values(&self.linear_rates(), &self.rotary_steps());
        let times = self.chain.axes().iter().zip(steps).map(|(axis, step)| {
            rest_to_rest_s(step.abs(), axis.rapid / 60.0, Some(axis.acceleration), axis.jerk)
        });
        times.fold(0.0, f64::max)
    }

    /// Returns the largest acceleration along the path in mm/s2 and jerk in mm/s3 that no axis forbids on a motion that
    /// is even in all axes. `None` where nothing limits them.
    pub fn path_dynamics(&self) -> (Option<f64>, Option<f64>) {
        let length = self.tip_length_mm();
        let steps = self.chain.order_values(&self.linear_rates(), &self.rotary_steps());
        let least = |limit: &dyn Fn(&super::MachineAxis) -> Option<f64>| {
            let axes = self.chain.axes().iter().zip(&steps);
            let limits = axes.filter(|(_, step)| step.abs() > 0.0);
            let limits = limits.filter_map(|(axis, step)| Some(limit(axis)? * length / step.abs()));
            limits.reduce(f64::min)
        };
        (least(&|axis| Some(axis.acceleration)), least(&|axis| axis.jerk))
    }

    /// Returns the steps of the linear axes in mm.
    fn linear_rates(&self) -> [f64; 3] {
        let mut steps = self.to.linears;
        for (step, from) in steps.iter_mut().zip(self.from.linears) {
            *step -= from;
        }
        steps
    }

    /// Returns how fast the linear axes move at a share of the motion, in mm per motion, with the tip on its line.
    fn linear_rates_at(&self, share: f64) -> [f64; 3] {
        const STEP: f64 = 1e-4;
        let at = |share: f64| {
            let tip = self.tips[0] + (self.tips[1] - self.tips[0]) * share;
            let rotaries = self.from.interpolate(&self.to, share).rotaries;
            self.chain.solve_linears(rotaries, &tip).map(Vector3::from)
        };
        match (at(share - STEP), at(share + STEP)) {
            (Some(before), Some(after)) => ((after - before) / (2.0 * STEP)).into(),
            _ => self.linear_rates(),
        }
    }

    fn count_looks(&self) -> usize {
        let [first, second] = self.rotary_steps().map(f64::abs);
        ((first.max(second) / LARGEST_LOOK_DEG).ceil() as usize).clamp(LEAST_LOOKS, MOST_LOOKS)
    }
}

fn distance_to_segment(point: &Point3<f64>, [start, end]: &[Point3<f64>; 2]) -> f64 {
    let (way, to_point) = (end - start, point - start);
    let length = way.norm_squared();
    let share = if length > 0.0 { (to_point.dot(&way) / length).clamp(0.0, 1.0) } else { 0.0 };
    (to_point - way * share).norm()
}

//! This module finds the rotary values that give the tool a direction, in closed form.
//!
//! Relative to the workpiece the tool axis is `R(u1, t1) R(u2, t2) d`, whatever stands in the table and whatever in
//! the head: `u1` is the axis next to the workpiece, `d` the tool at zero, and the angles are the axis values, negative
//! for table axes. The component along `u1` depends on `t2` alone and gives two solutions that lie to both sides of
//! the angle `t2` at which it is largest; `t1` then brings both components across `u1` together. Where these vanish,
//! at the pole, `t1` is free.

use super::machine_axis::{AxisMount, MachineAxis};
use nalgebra::{Unit, Vector3};
use std::f64::consts::PI;
use std::ops::Deref;

/// The angle from the first rotary axis below which the tool is at a pole, in degrees.
pub const POLE_ANGLE_DEG: f64 = 1e-6;

/// How far a direction may lie beyond what can be reached, in radians: vectors are printed with few decimals.
const REACH_SLACK: f64 = 1e-6;

/// A pair of rotary values that gives the tool a direction, in degrees from -180 to below 180.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RotarySolution {
    /// The value of the first and the second rotary axis; 0 where the machine has none.
    pub values: [f64; 2],
    /// Whether the first value is free, because the tool lies along the first axis.
    pub is_pole: bool,
    /// On which side of its pole value the second axis stands: 1, -1, or 0 at the pole and where there is no second.
    pub side: i8,
}

/// The solutions for one direction: none to two.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RotarySolutions {
    count: usize,
    solutions: [RotarySolution; 2],
}

impl RotarySolutions {
    const NOTHING: RotarySolution = RotarySolution { values: [0.0; 2], is_pole: false, side: 0 };
    const NONE: Self = Self { count: 0, solutions: [Self::NOTHING; 2] };

    fn single(solution: RotarySolution) -> Self {
        Self { count: 1, solutions: [solution, Self::NOTHING] }
    }

    fn pair(solutions: [RotarySolution; 2]) -> Self {
        Self { count: 2, solutions }
    }
}

impl Deref for RotarySolutions {
    type Target = [RotarySolution];

    fn deref(&self) -> &[RotarySolution] {
        self.solutions.get(..self.count).unwrap_or_default()
    }
}

/// What the rotary axes of a chain have in common for all directions.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum RotaryGeometry {
    /// No rotary axis: the tool has one direction.
    None(Vector3<f64>),
    /// One rotary axis.
    One(OneRotary),
    /// Two of them.
    Two(TwoRotaries),
}

/// One rotary axis: the tool is on a cone about it.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct OneRotary {
    axis: Vector3<f64>,
    sense: f64,
    tool: Vector3<f64>,
}

/// Two rotary axes. `high` and `low` are the tool axes behind the second rotary with the largest and the least
/// component along the first.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TwoRotaries {
    axis: Vector3<f64>,
    senses: [f64; 2],
    /// The angle of the second rotary at `high`.
    high_angle: f64,
    /// Half the way from `low` to `high`, along the first axis.
    amplitude: f64,
    /// The squared distances of `high` from the first axis' direction, and of `low` from the opposite one.
    high_gap: f64,
    low_gap: f64,
    /// Two directions across the first axis: that in which the tool goes at `high`, and the other one.
    across: [Vector3<f64>; 2],
    /// The radius of the circle of the tool about the second rotary.
    radius: f64,
    /// Along `across[1]`: where `high` and `low` lie, and half the way between them.
    high_across: f64,
    low_across: f64,
    half_across: f64,
}

impl RotaryGeometry {
    pub(super) fn new(rotaries: &[&MachineAxis], tool: &Unit<Vector3<f64>>) -> Self {
        let sense = |axis: &MachineAxis| if axis.mount == AxisMount::Table { -1.0 } else { 1.0 };
        match *rotaries {
            [] => Self::None(**tool),
            [one] => Self::One(OneRotary { axis: *one.direction, sense: sense(one), tool: **tool }),
            [first, second, ..] => {
                let axes = [*first.direction, *second.direction];
                Self::Two(TwoRotaries::new(axes, [sense(first), sense(second)], tool))
            }
        }
    }

    /// Returns the solutions for a unit vector.
    pub(super) fn solve_direction(&self, wanted: &Vector3<f64>) -> RotarySolutions {
        match self {
            Self::None(tool) => {
                let reached = tool.cross(wanted).norm().atan2(tool.dot(wanted)) <= REACH_SLACK;
                match reached {
                    true => RotarySolutions::single(RotarySolutions::NOTHING),
                    false => RotarySolutions::NONE,
                }
            }
            Self::One(one) => one.solve_direction(wanted),
            Self::Two(two) => two.solve_direction(wanted),
        }
    }

    /// Returns the angle between a unit vector and the first rotary axis, in either sense, in degrees. `None` without
    /// a rotary axis.
    pub(super) fn pole_angle_deg(&self, wanted: &Vector3<f64>) -> Option<f64> {
        let axis = match self {
            Self::None(_) => return None,
            Self::One(one) => &one.axis,
            Self::Two(two) => &two.axis,
        };
        Some(axis.cross(wanted).norm().atan2(axis.dot(wanted).abs()).to_degrees())
    }

    /// Returns whether the tool can come to lie along the first of two rotary axes.
    pub(super) fn has_pole(&self) -> bool {
        match self {
            Self::Two(two) => two.is_high_pole() || two.is_low_pole(),
            _ => false,
        }
    }
}

impl OneRotary {
    fn solve_direction(&self, wanted: &Vector3<f64>) -> RotarySolutions {
        let angle = |vector: &Vector3<f64>| self.axis.cross(vector).norm().atan2(self.axis.dot(vector));
        if (angle(wanted) - angle(&self.tool)).abs() > REACH_SLACK {
            return RotarySolutions::NONE;
        }
        let across = self.axis.cross(&self.tool);
        // The tool's own part across the axis is `across` turned back by 90 degrees.
        let turned = across.dot(wanted).atan2(across.cross(&self.axis).dot(wanted));
        let values = [to_half_turn((self.sense * turned).to_degrees()), 0.0];
        RotarySolutions::single(RotarySolution { values, is_pole: false, side: 0 })
    }
}

impl TwoRotaries {
    fn new([first, second]: [Vector3<f64>; 2], senses: [f64; 2], tool: &Vector3<f64>) -> Self {
        let along = second * second.dot(tool);
        let (spoke, lead) = (tool - along, second.cross(tool));
        let high_angle = first.dot(&lead).atan2(first.dot(&spoke));
        let (sine, cosine) = high_angle.sin_cos();
        // The part of the tool across the second axis at the largest component, and a quarter turn later.
        let (top, later) = (spoke * cosine + lead * sine, lead * cosine - spoke * sine);
        let (high, low) = (along + top, along - top);
        let side = later.try_normalize(0.0).unwrap_or_default();
        let across = [side, first.cross(&side)];
        let component = |vector: &Vector3<f64>| across[1].dot(vector);
        Self {
            axis: first,
            senses,
            high_angle,
            amplitude: first.dot(&top),
            high_gap: (high - first).norm_squared(),
            low_gap: (low + first).norm_squared(),
            across,
            radius: spoke.norm(),
            high_across: component(&high),
            low_across: component(&low),
            half_across: component(&top),
        }
    }

    fn is_high_pole(&self) -> bool {
        self.high_gap.sqrt() < POLE_ANGLE_DEG.to_radians()
    }

    fn is_low_pole(&self) -> bool {
        self.low_gap.sqrt() < POLE_ANGLE_DEG.to_radians()
    }

    fn solve_direction(&self, wanted: &Vector3<f64>) -> RotarySolutions {
        // With the angle `a` from the highest place, sin2(a / 2) and cos2(a / 2). The differences of squared
        // distances keep their digits where those of cosines lose them: near the pole.
        let from_high = ((wanted - self.axis).norm_squared() - self.high_gap) / (4.0 * self.amplitude);
        let from_low = ((wanted + self.axis).norm_squared() - self.low_gap) / (4.0 * self.amplitude);
        if from_high.min(from_low) < 0.0 && !self.is_nearly_reached(wanted) {
            return RotarySolutions::NONE;
        }
        let at_pole = |gap: Vector3<f64>| gap.norm() < POLE_ANGLE_DEG.to_radians();
        let pole = match () {
            () if self.is_high_pole() && at_pole(wanted - self.axis) => Some(0.0),
            () if self.is_low_pole() && at_pole(wanted + self.axis) => Some(PI),
            () => None,
        };
        if let Some(turn) = pole {
            let value = to_half_turn((self.senses[1] * (self.high_angle + turn)).to_degrees());
            return RotarySolutions::single(RotarySolution { values: [0.0, value], is_pole: true, side: 0 });
        }
        let (high, low) = (from_high.clamp(0.0, 1.0), from_low.clamp(0.0, 1.0));
        let turn = 2.0 * high.sqrt().atan2(low.sqrt());
        let ahead = 2.0 * self.radius * (high * low).sqrt();
        let beside = match high < 0.5 {
            true => self.high_across - 2.0 * high * self.half_across,
            false => self.low_across + 2.0 * low * self.half_across,
        };
        let goal = wanted - self.axis * self.axis.dot(wanted);
        let goal = self.across[1].dot(&goal).atan2(self.across[0].dot(&goal));
        let start = beside.atan2(ahead);
        let make = |side: f64, start: f64| {
            let angles = [self.senses[0] * (goal - start), self.senses[1] * (self.high_angle + side * turn)];
            let values = angles.map(|angle| to_half_turn(angle.to_degrees()));
            RotarySolution { values, is_pole: false, side: side as i8 }
        };
        RotarySolutions::pair([make(1.0, start), make(-1.0, PI - start)])
    }

    /// Returns whether a direction lies beyond the reach by no more than printed decimals explain.
    fn is_nearly_reached(&self, wanted: &Vector3<f64>) -> bool {
        let angle = self.axis.cross(wanted).norm().atan2(self.axis.dot(wanted));
        let least = 2.0 * (self.high_gap.sqrt() / 2.0).min(1.0).asin();
        let most = PI - 2.0 * (self.low_gap.sqrt() / 2.0).min(1.0).asin();
        angle >= least - REACH_SLACK && angle <= most + REACH_SLACK
    }
}

/// Returns an angle in degrees by full turns from -180 to below 180.
pub(super) fn to_half_turn(degrees: f64) -> f64 {
    if (-180.0..180.0).contains(&degrees) {
        return degrees;
    }
    let turned = degrees - 360.0 * (degrees / 360.0).round();
    if turned >= 180.0 { turned - 360.0 } else { turned }
}

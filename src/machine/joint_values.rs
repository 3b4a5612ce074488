//! This module converts between poses of the tool and values of the axes, with the rotary values given.

use super::kinematic_chain::{ChainLink, KinematicChain};
use super::rotary_geometry::RotarySolutions;
use nalgebra::{Matrix3, Point3, Vector3};

/// The values of all axes at one pose.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct JointValues {
    /// The rotary axes in degrees, the one next to the workpiece first; 0 where the machine has none.
    pub rotaries: [f64; 2],
    /// The linear axes in mm, in the order of the chain.
    pub linears: [f64; 3],
}

impl JointValues {
    /// Returns the values between this and another pose with all axes linear in `share`, from 0 to 1.
    #[must_use]
    pub fn interpolate(&self, to: &Self, share: f64) -> Self {
        let mix = |from: f64, to: f64| from + (to - from) * share;
        let mut mixed = *self;
        for (value, to) in mixed.rotaries.iter_mut().zip(to.rotaries) {
            *value = mix(*value, to);
        }
        for (value, to) in mixed.linears.iter_mut().zip(to.linears) {
            *value = mix(*value, to);
        }
        mixed
    }
}

/// Sine and cosine of both rotary values.
type SineCosine = [(f64, f64); 2];

fn turned_by([first, second]: [f64; 2]) -> SineCosine {
    let of = |degrees: f64| if degrees == 0.0 { (0.0, 1.0) } else { degrees.to_radians().sin_cos() };
    [of(first), of(second)]
}

/// Turns a vector about a direction.
fn turn_vector(vector: &Vector3<f64>, about: &Vector3<f64>, (sine, cosine): (f64, f64)) -> Vector3<f64> {
    vector * cosine + about.cross(vector) * sine + about * (about.dot(vector) * (1.0 - cosine))
}

/// Carries a point along the links of one side; `slide` and `turned` are what slides and turns do.
fn carry_along(
    links: &[ChainLink],
    turned: &SineCosine,
    start: Vector3<f64>,
    mut slide: impl FnMut(usize, &Vector3<f64>),
    mut turn: impl FnMut(&Vector3<f64>, (f64, f64)),
) -> Vector3<f64> {
    let mut at = start;
    for link in links {
        match link {
            ChainLink::Slide(slot, direction) => slide(*slot, direction),
            ChainLink::Turn(slot, about, point) => {
                let Some(angle) = turned.get(*slot) else { continue };
                at = point + turn_vector(&(at - point), about, *angle);
                turn(about, *angle);
            }
        }
    }
    at
}

impl KinematicChain {
    /// Returns the rotary values that give the tool a direction of the workpiece, told by a unit vector, whatever the
    /// limits. None means that the direction cannot be reached.
    pub fn solve_rotaries(&self, axis: &Vector3<f64>) -> RotarySolutions {
        self.geometry.solve_direction(axis)
    }

    /// Returns the angle between a unit vector and the first rotary axis, in either sense, in degrees. `None` without
    /// a rotary axis.
    pub fn pole_angle_deg(&self, axis: &Vector3<f64>) -> Option<f64> {
        self.geometry.pole_angle_deg(axis)
    }

    /// Returns whether there is a direction of the tool at which the first of two rotary axes is free.
    pub fn has_pole(&self) -> bool {
        self.geometry.has_pole()
    }

    /// Returns the values of the linear axes that bring the tip to a point of the workpiece, in mm, with the rotary
    /// axes at these values. `None` where the linear axes lie in one plane then.
    pub fn solve_linears(&self, rotaries: [f64; 2], tip: &Point3<f64>) -> Option<[f64; 3]> {
        let (way, directions) = self.carry_to_frame(&turned_by(rotaries), &tip.coords);
        let inverse = match &self.fixed_directions {
            Some(inverse) => *inverse,
            None => directions.try_inverse()?,
        };
        Some((inverse * way).into())
    }

    /// Returns the way from the tip with all linear axes at 0 to a point of the workpiece, both in the machine, and
    /// the directions in which the linear axes take the tool there, as columns.
    pub(super) fn carry_to_frame(
        &self,
        turned: &SineCosine,
        tip: &Vector3<f64>,
    ) -> (Vector3<f64>, Matrix3<f64>) {
        if self.fixed_directions.is_some() {
            let skip = (|_: usize, _: &Vector3<f64>| {}, |_: &Vector3<f64>, _: (f64, f64)| {});
            let point = carry_along(&self.table_links, turned, *tip, skip.0, skip.1);
            let tool = carry_along(&self.head_links, turned, Vector3::zeros(), skip.0, skip.1);
            return (point - tool, Matrix3::identity());
        }
        let mut directions = Matrix3::zeros();
        let mut carry = |links: &[ChainLink], start: Vector3<f64>, sense: f64| {
            let side = std::cell::RefCell::new(Matrix3::<f64>::zeros());
            let end = carry_along(
                links,
                turned,
                start,
                |slot, direction| side.borrow_mut().set_column(slot, &(direction * sense)),
                |about, angle| {
                    let mut side = side.borrow_mut();
                    for mut column in side.column_iter_mut() {
                        let turned = turn_vector(&column.clone_owned(), about, angle);
                        column.copy_from(&turned);
                    }
                },
            );
            directions += side.into_inner();
            end
        };
        let point = carry(&self.table_links, *tip, -1.0);
        let tool = carry(&self.head_links, Vector3::zeros(), 1.0);
        (point - tool, directions)
    }

    /// Returns the tip and the tool axis in the workpiece frame.
    pub fn locate_tool(&self, joints: &JointValues) -> (Point3<f64>, Vector3<f64>) {
        let turned = turned_by(joints.rotaries);
        let (mut tip, mut axis) = (Vector3::zeros(), *self.tool_axis());
        let value = |slot: usize| joints.linears.get(slot).copied().unwrap_or_default();
        for link in &self.head_links {
            match link {
                ChainLink::Slide(slot, direction) => tip += direction * value(*slot),
                ChainLink::Turn(slot, about, point) => {
                    let Some(angle) = turned.get(*slot) else { continue };
                    tip = point + turn_vector(&(tip - point), about, *angle);
                    axis = turn_vector(&axis, about, *angle);
                }
            }
        }
        // From the frame to the workpiece, every table axis is undone, the outermost first.
        for link in self.table_links.iter().rev() {
            match link {
                ChainLink::Slide(slot, direction) => tip -= direction * value(*slot),
                ChainLink::Turn(slot, about, point) => {
                    let Some((sine, cosine)) = turned.get(*slot) else { continue };
                    tip = point + turn_vector(&(tip - point), about, (-sine, *cosine));
                    axis = turn_vector(&axis, about, (-sine, *cosine));
                }
            }
        }
        (tip.into(), axis)
    }

    /// Returns the distance of a tip from the zero of the workpiece in mm up to which no linear axis can be outside its
    /// limits, whatever the rotary values.
    pub(super) fn safe_reach_mm(&self) -> f64 {
        let Some(inverse) = &self.fixed_directions else { return -1.0 };
        // A turn about a point takes a point no further from the zero than twice the point's distance.
        let points = self.table_links.iter().chain(&self.head_links).map(|link| match link {
            ChainLink::Turn(_, _, point) => 2.0 * point.norm(),
            ChainLink::Slide(..) => 0.0,
        });
        let swing: f64 = points.sum();
        let reaches = self.linear_axes().zip(inverse.row_iter()).filter_map(|(axis, row)| {
            let [low, high] = axis.limits?;
            Some((-low).min(high) / row.norm() - swing)
        });
        reaches.fold(f64::INFINITY, f64::min)
    }

    /// Returns the axes outside their limits, as places in [`KinematicChain::axes`].
    pub fn find_axes_outside(&self, joints: &JointValues) -> Vec<usize> {
        let values = self.order_values(&joints.linears, &joints.rotaries);
        let outside = |(axis, value): (&super::MachineAxis, &f64)| !axis.allows_value(*value);
        let places = self.axes().iter().zip(&values).map(outside).enumerate();
        places.filter_map(|(place, outside)| outside.then_some(place)).collect()
    }
}

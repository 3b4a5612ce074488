//! This module finds the spindle speeds of a lathe that keeps its surface speed: the spindle turns faster where the
//! work is thinner, up to its limit.
//!
//! With a feed per revolution, the time of a piece of path is its length times the time of one revolution, which grows
//! with the radius: `max(1 / limit, 2 pi r / v)`. Lines and arcs are integrated in closed form.

use super::state_machine::Motions;
use crate::program::geometry::{CircularArc, MotionPath, Pose, SAME_POINT};
use crate::program::record::ToolWord;
use crate::program::turning::UndescribedTool;
use crate::program::{LengthUnit, TurningPlane};
use nalgebra::Point3;
use std::f64::consts::{PI, TAU};

/// The spindle speeds in rev/min that a surface speed makes on one motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceSpindleSpeed {
    /// The speed that makes the motion's time at its feed per revolution.
    pub mean: f64,
    /// The lowest speed, at the largest radius.
    pub lowest: f64,
    /// The highest speed, at the smallest radius; infinite where the motion meets the axis and nothing limits it.
    pub highest: f64,
}

/// The minutes of one revolution at a radius: `slope` times the radius, and `least` at least.
#[derive(Debug, Clone, Copy)]
struct RevolutionTime {
    slope: f64,
    least: f64,
}

impl Motions<'_> {
    /// Returns the speeds that a lathe's surface speed makes on a motion. What is no lathe, or runs along the axis
    /// without a limit, has none.
    pub(super) fn find_surface_speed(
        &mut self,
        from: &Pose,
        to: &Pose,
        path: &MotionPath,
    ) -> Option<SurfaceSpindleSpeed> {
        let spindle = self.state.spindle.as_deref()?;
        let metres = spindle.surface_metres().filter(|metres| *metres > 0.0)?;
        let least = spindle.max_rpm.map_or(0.0, f64::recip);
        let data = self.state.tool.as_ref().and_then(|tool| tool.data.as_ref());
        let turns = match data {
            Some(data) => {
                data.word.is_no_mill() || (data.word == ToolWord::Cutter && data.corner_radius.is_none())
            }
            None => true,
        };
        let described = data.is_some();
        if !turns || (!described && !self.may_undescribed_tool_turn()) {
            return None;
        }
        let program = self.program;
        let plane = *self.turning_plane.get_or_insert_with(|| program.plane_of_points());
        let plane = plane.filter(|plane| plane.offset(from.point) == 0.0 && plane.offset(to.point) == 0.0)?;
        let unit = self.file_length_unit();
        let slope = TAU * unit.mm_per_unit() / 1000.0 / metres;
        RevolutionTime { slope, least }.find_speeds(plane, from.point, to.point, path)
    }
}

impl Motions<'_> {
    /// Returns whether the tool in force, which nothing describes, may be a lathe's. Holes are those of a drill, and a
    /// program that never calls a tool says nothing of its machine.
    fn may_undescribed_tool_turn(&mut self) -> bool {
        let program = self.program;
        match *self.undescribed.get_or_insert_with(|| program.judge_undescribed_tools()) {
            UndescribedTool::Turns => true,
            UndescribedTool::MayTurn => self.state.cycle.is_none() && self.state.tool.is_some(),
            UndescribedTool::Mills => false,
        }
    }

    /// Returns the file's unit of lengths: the one that it states, else that of its feeds.
    pub(super) fn file_length_unit(&mut self) -> LengthUnit {
        let program = self.program;
        *self.length_unit.get_or_insert_with(|| {
            program.stated_length_unit().or_else(|| program.feed_length_unit()).unwrap_or_default()
        })
    }
}

impl RevolutionTime {
    /// Returns the time of one revolution.
    fn at(self, radius: f64) -> f64 {
        (self.slope * radius.abs()).max(self.least)
    }

    /// Returns the radius up to which the spindle has its highest speed.
    fn limit_radius(self) -> f64 {
        self.least / self.slope
    }

    fn find_speeds(
        self,
        plane: TurningPlane,
        from: Point3<f64>,
        to: Point3<f64>,
        path: &MotionPath,
    ) -> Option<SurfaceSpindleSpeed> {
        let radius = |point: Point3<f64>| plane.signed_radius(point);
        let (mean, low, high) = match path {
            MotionPath::Arc(arc) if arc.rise.abs() <= SAME_POINT && arc.sweep > 0.0 => {
                ArcRadii::new(plane, arc).mean_and_range(self)
            }
            MotionPath::Arc(_) | MotionPath::Spline(_) => {
                self.mean_of_chords(plane, &path.sample_points(from, to))
            }
            MotionPath::Line | MotionPath::Start => {
                let (from, to) = (radius(from), radius(to));
                (self.mean_of_line(from, to), from.min(to), from.max(to))
            }
        };
        let nearest = if low <= 0.0 && high >= 0.0 { 0.0 } else { low.abs().min(high.abs()) };
        let farthest = low.abs().max(high.abs());
        (mean > 0.0).then(|| SurfaceSpindleSpeed {
            mean: mean.recip(),
            lowest: self.at(farthest).recip(),
            highest: self.at(nearest).recip(),
        })
    }

    /// Returns the mean time of a revolution on a line between two radii, which may be on both sides of the axis.
    fn mean_of_line(self, from: f64, to: f64) -> f64 {
        if (to - from).abs() <= SAME_POINT {
            return self.at((from + to) / 2.0);
        }
        // The antiderivative of the time over the radius.
        let limit = self.limit_radius();
        let integral = |radius: f64| {
            let beyond = (radius.abs() - limit).max(0.0);
            let within = radius.abs().min(limit);
            radius.signum() * (self.least * within + self.slope * (limit + beyond / 2.0) * beyond)
        };
        (integral(to) - integral(from)) / (to - from)
    }

    /// Returns the mean time of a revolution on a polyline, and its smallest and largest radius.
    fn mean_of_chords(self, plane: TurningPlane, points: &[Point3<f64>]) -> (f64, f64, f64) {
        let (mut sum, mut length) = (0.0, 0.0);
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for pair in points.windows(2) {
            let [one, next] = pair else { continue };
            let chord = (next - one).norm();
            let [from, to] = [one, next].map(|point| plane.signed_radius(*point));
            sum += chord * self.mean_of_line(from, to);
            length += chord;
            (low, high) = (low.min(from).min(to), high.max(from).max(to));
        }
        (if length > 0.0 { sum / length } else { 0.0 }, low, high)
    }
}

/// The radius along an arc: `center + amplitude cos(angle)`, from one angle to another.
struct ArcRadii {
    center: f64,
    amplitude: f64,
    from: f64,
    to: f64,
}

impl ArcRadii {
    fn new(plane: TurningPlane, arc: &CircularArc) -> Self {
        let along = |vector: nalgebra::Vector3<f64>| plane.signed_radius(vector.into());
        let across = arc.start - arc.center;
        let spoke = across - arc.axis.into_inner() * arc.axis.dot(&across);
        let (cosine, sine) = (along(spoke), along(arc.axis.cross(&spoke)));
        let start = -sine.atan2(cosine);
        Self {
            center: plane.signed_radius(arc.center) + along(across - spoke),
            amplitude: cosine.hypot(sine),
            from: start,
            to: start + arc.sweep,
        }
    }

    fn at(&self, angle: f64) -> f64 {
        self.center + self.amplitude * angle.cos()
    }

    /// Returns the angles of the arc at which the radius is one of some values, both ends too, in order.
    fn angles_of(&self, radii: &[f64]) -> Vec<f64> {
        let mut angles = vec![self.from, self.to];
        for radius in radii {
            let cosine = (radius - self.center) / self.amplitude;
            if !(-1.0..=1.0).contains(&cosine) {
                continue;
            }
            for angle in [cosine.acos(), -cosine.acos()] {
                let mut angle = angle + ((self.from - angle) / TAU).ceil() * TAU;
                while angle < self.to {
                    angles.push(angle);
                    angle += TAU;
                }
            }
        }
        angles.sort_by(f64::total_cmp);
        angles
    }

    /// Returns the mean time of a revolution, and the smallest and the largest radius.
    fn mean_and_range(&self, time: RevolutionTime) -> (f64, f64, f64) {
        let limit = time.limit_radius();
        // Between these angles the time is either constant or a cosine.
        let angles = self.angles_of(&[0.0, limit, -limit]);
        let mut sum = 0.0;
        for pair in angles.windows(2) {
            let [from, to] = pair else { continue };
            let middle = self.at((from + to) / 2.0);
            sum += if middle.abs() <= limit {
                time.least * (to - from)
            } else {
                let integral = self.center * (to - from) + self.amplitude * (to.sin() - from.sin());
                time.slope * integral * middle.signum()
            };
        }
        let turning = self.angles_of(&[self.center + self.amplitude, self.center - self.amplitude]);
        let radii = turning.iter().map(|angle| self.at(*angle));
        let (low, high) = radii.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), radius| {
            (low.min(radius), high.max(radius))
        });
        debug_assert!(self.to - self.from < 1e6 * PI, "arcs have few turns");
        (sum / (self.to - self.from), low, high)
    }
}

//! This module holds what one look at a step needs, close together in memory: tests look at many steps that they then
//! need not know more of.

use super::cutter_contour::CutterContour;
use super::cutter_pose::PointLine;
use super::swept_step::SweptStep;
use nalgebra::Vector3;

/// A disc around a step as it is seen from above, and its lowest height: x, y, radius, z.
pub(super) type StepFootprint = [f64; 4];

/// Returns whether a step with a footprint stands beside or above a place: x, y, radius, and the highest z.
#[inline]
pub(super) fn is_beside([a, b, reach, lowest]: &StepFootprint, [x, y, radius, highest]: &[f64; 4]) -> bool {
    let (dx, dy, sum) = (x - a, y - b, radius + reach);
    lowest > highest || dx * dx + dy * dy > sum * sum
}

/// What a look at a step needs.
#[derive(Debug, Clone)]
pub(super) struct StepGlance {
    /// No point of the step is below this height.
    pub bottom: f64,
    /// The tip at half the step's chord.
    middle: Vector3<f64>,
    /// The axis at half the step.
    axis: Vector3<f64>,
    /// The tip's way over half the step.
    way: Vector3<f64>,
    /// How the cutter turns over half the step, radians about the axes of the frame.
    turned: Vector3<f64>,
    turn: f64,
    way_length: f64,
    /// How far the tip's path is from its chord, at the most, mm.
    pub deviation: f64,
    pub cutter: usize,
    /// Whether a look is the best first question: there is no closed form.
    pub is_looked_at: bool,
}

/// What one look at a step tells about all points near a line: the tangent plane of the cutter's gap, half the times
/// at half the step.
///
/// In the cutter's frame a point moves with the time and with the step. The gap is convex, so that it stays above its
/// tangent plane, and what the point's way bends is told by its second derivatives: the turn squared times the
/// distance plus twice the turn times the tip's way, and for both together the turn times the line's way.
#[derive(Debug, Clone, Copy)]
pub(super) struct TangentLook {
    pub gap: f64,
    gradient: Vector3<f64>,
    /// How the gap grows along the tangent plane over half the step.
    pub slide_growth: f64,
    turn: f64,
    distance: f64,
    way: f64,
}

impl TangentLook {
    /// Returns a gap in mm that no point of a line falls below. At half the times it is `apart` from the line that was
    /// looked at; `travel` is its way from then to the last time.
    #[inline]
    pub(super) fn least_gap(&self, apart: &Vector3<f64>, travel: &Vector3<f64>) -> f64 {
        let flat =
            self.gap + self.gradient.dot(apart) - self.gradient.dot(travel).abs() - self.slide_growth.abs();
        if self.turn == 0.0 {
            return flat;
        }
        let (beside, travelled) = (apart.norm(), travel.norm());
        let farthest = self.distance + beside + travelled + self.way;
        let bend = (self.turn * farthest + 2.0 * self.way) / 8.0 + (travelled + beside) / 2.0;
        flat - self.turn * bend
    }

    /// Returns whether all points of the line that was looked at are further than `bound` mm from the sweep at all
    /// times of `need`.
    #[inline]
    pub(super) fn surely_leaves(&self, line: &PointLine, need: [f64; 2], bound: f64) -> bool {
        let travel = line.travel * ((need[1] - need[0]) / 2.0);
        self.gap > bound && self.least_gap(&Vector3::zeros(), &travel) > bound
    }
}

impl StepGlance {
    /// Makes the glance of a step with a footprint.
    pub(super) fn new(step: &SweptStep, footprint: &StepFootprint) -> Self {
        let way = (step.tips[1] - step.tips[0]) / 2.0;
        let lowest = step.tips[0].z.min(step.tips[1].z);
        Self {
            bottom: if step.is_upright() { lowest - step.path_deviation } else { footprint[3] },
            middle: (step.tips[0] + step.tips[1]) / 2.0,
            axis: step.middle_axis,
            way,
            turned: step.turn_axis * (step.turn / 2.0),
            turn: step.turn,
            way_length: 2.0 * way.norm(),
            deviation: step.path_deviation + step.side_deviation,
            cutter: step.cutter,
            is_looked_at: step.flat.is_none() && (step.turn > 0.0 || !step.is_level),
        }
    }

    /// Looks at the step from a line, half the times at half the step. `aside` is how much further from the axis
    /// its points count as, mm.
    #[inline]
    pub(super) fn look_from(
        &self,
        contour: &CutterContour,
        line: &PointLine,
        [from, to]: [f64; 2],
        aside: f64,
    ) -> TangentLook {
        let apart = line.at((from + to) / 2.0) - self.middle;
        let z = apart.dot(&self.axis);
        let across = apart - self.axis * z;
        let squared = across.norm_squared();
        let from_axis = squared.sqrt();
        let r = (from_axis + aside).max(0.0);
        let (gap, slopes) = contour.gap_in_plane(r, z);
        let outwards = if r > 0.0 && from_axis > 0.0 { slopes[0] / from_axis } else { 0.0 };
        let gradient = across * outwards + self.axis * slopes[1];
        if self.turn == 0.0 {
            let slide_growth = -gradient.dot(&self.way);
            return TangentLook { gap, gradient, slide_growth, turn: 0.0, distance: 0.0, way: 0.0 };
        }
        let slide = self.way + self.turned.cross(&apart);
        TangentLook {
            gap,
            gradient,
            slide_growth: -gradient.dot(&slide),
            turn: self.turn,
            distance: (squared + z * z).sqrt(),
            way: self.way_length,
        }
    }
}

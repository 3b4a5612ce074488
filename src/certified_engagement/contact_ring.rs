//! This module finds the arcs of one ring of a cutter's surface that are material at one moment.
//!
//! A ring is a circle, and the parts of it that the sweep of a step or the air around the stock takes are found as the times
//! are at which a point on it would be there: in closed form for steps across the ring's axis, to
//! [`MATERIAL_TOLERANCE_MM`] for others. What is left cuts.

use super::certified_program::{CertifiedProgram, SearchedStep};
use super::contour_element::ContourElement;
use super::cover_test::{CoverBuffers, MATERIAL_TOLERANCE_MM};
use super::cutter_pose::{PointArc, PointLine, PointPath};
use super::stock_gap::HullMargin;
use super::surface_patch::surface_point;
use super::swept_step::SweptStep;
use super::time_union::{find_uncovered, span_of};
use nalgebra::Vector3;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Shares below this count as none.
pub(super) const LEAST_SHARE: f64 = 1e-5;
/// The longest arc that is one path, radians.
const MOST_PATH_RAD: f64 = 3.5;
/// The smallest ring that has directions, mm.
const LEAST_RADIUS_MM: f64 = 1e-6;

/// The arcs of a ring, in order.
pub(super) type RingArcs = Vec<[f64; 2]>;

/// What is needed for the rings of a step at one moment.
pub(super) struct RingTracer<'a> {
    program: &'a CertifiedProgram,
    step: &'a SweptStep,
    time: f64,
    heading: f64,
    /// The earlier steps, and runs of them, near the cutter; those first that took a part of the last ring.
    candidates: Vec<u32>,
    buffers: CoverBuffers,
    highest_mm: f64,
}

impl<'a> RingTracer<'a> {
    /// Collects the earlier steps near the cutter at a time of a step.
    pub(super) fn new(
        program: &'a CertifiedProgram,
        own: &SearchedStep<'a>,
        time: f64,
        heading: f64,
    ) -> Option<Self> {
        let step = own.step;
        let contour = program.cutters().get(step.cutter)?;
        let over = own.first_sweep + (time * f64::from(own.sweep_count) - 1e-9).max(0.0) as u32;
        let axis = step.turned(&step.to_world(0, &Vector3::z()), time);
        let tip = step.place_of(&Vector3::zeros(), time);
        let (top, radius) = (program.stock_top(), contour.radius_mm());
        // Above this height all of a ring is above the stock.
        let leaning = radius * (1.0 - axis.z * axis.z).max(0.0).sqrt();
        let highest_mm = if axis.z > 0.05 {
            ((top - tip.z + leaning) / axis.z).clamp(0.0, contour.height_mm())
        } else {
            contour.height_mm()
        };
        let mut low = Vector3::repeat(f64::INFINITY);
        let mut high = Vector3::repeat(f64::NEG_INFINITY);
        for center in [tip, tip + axis * highest_mm] {
            let across = axis.map(|part| radius * (1.0 - part * part).max(0.0).sqrt());
            low = low.inf(&(center - across));
            high = high.sup(&(center + across));
        }
        let mut candidates = Vec::new();
        program.find_steps(&[low, high], [over, own.first_sweep], &mut candidates);
        Some(Self { program, step, time, heading, candidates, buffers: CoverBuffers::default(), highest_mm })
    }

    /// Returns the height above the tip up to which the cutter may touch the stock, mm.
    pub(super) fn highest_mm(&self) -> f64 {
        self.highest_mm
    }

    /// Returns the arcs of a ring on which the surface advances into material. `parts` are those of its share
    /// ([`super::ContactSection::share_parts`]).
    pub(super) fn trace(&mut self, element: &ContourElement, parameter: f64, parts: [f64; 3]) -> RingArcs {
        let Some([from, to]) = advancing_window(parts) else { return Vec::new() };
        let radius = element.point(parameter)[0];
        let mut arcs: RingArcs = Vec::new();
        if radius < LEAST_RADIUS_MM {
            // A ring that is a point cuts as a whole or not at all.
            let point = self.place_at(element, parameter, from);
            let still = PointPath::Line(PointLine::still(point));
            arcs.extend(
                self.find_material(&still, [point.x, point.y, 0.0, point.z]).first().map(|_| [from, to]),
            );
            return arcs;
        }
        // A path on a circle is less than a whole turn.
        let count = ((to - from) / MOST_PATH_RAD).ceil().max(1.0);
        for number in 0..count as u32 {
            let at = |number: u32| from + (to - from) * f64::from(number) / count;
            let [begin, end] = [at(number), at(number + 1)];
            let [center, first, second] = self.circle_from(element, parameter, begin);
            let path = PointPath::Arc(PointArc { center, first, second, angle: end - begin });
            let highest = center.z + first.z.hypot(second.z);
            let found = self.find_material(&path, [center.x, center.y, radius, highest]);
            for [since, until] in found {
                let arc = [since, until].map(|time| begin + (end - begin) * time);
                match arcs.last_mut().filter(|last| last[1] >= arc[0]) {
                    Some(last) => last[1] = arc[1],
                    None => arcs.push(arc),
                }
            }
        }
        arcs
    }

    /// Returns a point of the surface in the workpiece frame.
    fn place_at(&self, element: &ContourElement, parameter: f64, angle: f64) -> Vector3<f64> {
        self.step.place_of(&surface_point(element, parameter, self.heading + angle, 0.0), self.time)
    }

    /// Returns the centre of a ring, and from there its points at an angle and a quarter turn later.
    fn circle_from(&self, element: &ContourElement, parameter: f64, angle: f64) -> [Vector3<f64>; 3] {
        let quarters = [0.0, 1.0, 2.0].map(|quarter| angle + quarter * FRAC_PI_2);
        let [first, second, opposite] = quarters.map(|angle| self.place_at(element, parameter, angle));
        let center = (first + opposite) / 2.0;
        [center, first - center, second - center]
    }

    /// Returns the parts of a path, from 0 to 1, that are in the stock and in no earlier sweep. `place` is a disc around the
    /// path's places and their greatest height.
    fn find_material(&mut self, path: &PointPath, place: [f64; 4]) -> Vec<[f64; 2]> {
        let mut buffers = std::mem::take(&mut self.buffers);
        buffers.times.clear();
        let program = self.program;
        program.add_outside_stock(path.as_slice(), [0.0, 1.0], HullMargin::default(), &mut buffers);
        find_uncovered(&mut buffers.times, [0.0, 1.0], 0.0, &mut buffers.uncovered);
        let mut need = span_of(&buffers.uncovered);
        let [x, y, radius, highest] = place;
        let margin = MATERIAL_TOLERANCE_MM + program.guard_mm;
        let place = [x, y, radius + margin, highest + margin];
        let mut deciding = 0;
        for at in 0..self.candidates.len() {
            let (Some(left), Some(candidate)) = (need, self.candidates.get(at).copied()) else { break };
            if program.is_far(candidate, &place) {
                continue;
            }
            let known = buffers.times.len();
            program.add_possible_cover(path, left, &[candidate], &mut buffers);
            if buffers.times.len() > known {
                find_uncovered(&mut buffers.times, left, 0.0, &mut buffers.uncovered);
                need = span_of(&buffers.uncovered);
                // What covers here most likely covers beside it, too.
                if let Some(front) = self.candidates.get_mut(deciding..=at) {
                    front.rotate_right(1);
                    deciding += 1;
                }
            }
        }
        let found = if need.is_some() { buffers.uncovered.clone() } else { Vec::new() };
        self.buffers = buffers;
        found
    }
}

/// Returns the angles between which a share a + b cos + c sin is above 0; `None` where it is nowhere.
fn advancing_window([still, ahead, left]: [f64; 3]) -> Option<[f64; 2]> {
    let most = ahead.hypot(left);
    if still + most <= LEAST_SHARE {
        return None;
    }
    let toward = if most > 0.0 { left.atan2(ahead) } else { 0.0 };
    if still >= most {
        return Some([toward - PI, toward - PI + TAU]);
    }
    let half = (-still / most).clamp(-1.0, 1.0).acos();
    Some([toward - half, toward + half])
}

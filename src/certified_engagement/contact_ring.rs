//! This module finds the arcs of one ring of a cutter's surface that are material at one moment.
//!
//! How deep a point is in material, or how far from it, is at most 1-Lipschitz: it is the largest of the stock's gap and of
//! the negative gaps of all earlier sweeps. So an arc of that length can be passed at once, and arcs end where the depth
//! changes its sign.

use super::certified_program::{CertifiedProgram, SearchedStep};
use super::contour_element::ContourElement;
use super::cover_test::MATERIAL_TOLERANCE_MM;
use super::surface_patch::surface_point;
use super::swept_step::SweptStep;
use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};

/// Shares below this count as none.
pub(super) const LEAST_SHARE: f64 = 1e-5;
/// The shortest and the longest arc that is passed at once, radians. What is narrower than the first, 0.46 degrees, may be
/// missed where the surface is within 4e-3 radii of a boundary of the material; then a mean force lacks at most what an edge
/// in such an arc has.
const STEP_RAD: [f64; 2] = [8e-3, 0.5];
/// The shortest arc at the ends of the window in which the surface advances, radians: skimming cuts of finishing passes lie
/// at the cutter's side. From there the shortest arc grows with the distance from the end.
const END_STEP_RAD: f64 = 1e-4;
/// By what part of the distance from an end of the window it grows.
const END_GROWTH: f64 = 0.5;
/// The angle to which ends of arcs are found, radians.
const PRECISION_RAD: f64 = 2e-5;
/// The most rounds of the search for an end.
const MOST_ROUNDS: usize = 40;
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
    /// The earlier steps, and runs of them, near the cutter.
    candidates: Vec<u32>,
    /// Those that may decide at a ring, lately deciding ones first.
    ring_candidates: Vec<u32>,
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
        Some(Self { program, step, time, heading, candidates, ring_candidates: Vec::new(), highest_mm })
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
        if radius < LEAST_RADIUS_MM {
            self.ring_candidates.clone_from(&self.candidates);
            let is_material = self.depth_at(element, parameter, from) < 0.0;
            return if is_material { vec![[from, to]] } else { Vec::new() };
        }
        self.choose_ring_candidates(element, parameter);
        let mut arcs = Vec::new();
        let (mut at, mut depth) = (from, self.depth_at(element, parameter, from));
        let mut begin = (depth < 0.0).then_some(from);
        while at < to {
            let shortest = (END_GROWTH * (at - from).min(to - at)).clamp(END_STEP_RAD, STEP_RAD[0]);
            let next = (at + (depth.abs() / radius).clamp(shortest, STEP_RAD[1])).min(to);
            let deeper = self.depth_at(element, parameter, next);
            if (depth < 0.0) != (deeper < 0.0) {
                let end = self.find_end(element, parameter, [at, next], [depth, deeper]);
                match begin.take() {
                    Some(begin) => arcs.push([begin, end]),
                    None => begin = Some(end),
                }
            }
            (at, depth) = (next, deeper);
        }
        arcs.extend(begin.map(|begin| [begin, to]));
        arcs.retain(|[begin, end]| end > begin);
        arcs
    }

    /// Returns the angle between two at which the depth changes its sign, by false position (Illinois variant).
    fn find_end(
        &mut self,
        element: &ContourElement,
        parameter: f64,
        [mut low, mut high]: [f64; 2],
        [mut at_low, mut at_high]: [f64; 2],
    ) -> f64 {
        let is_material = at_low < 0.0;
        for _ in 0..MOST_ROUNDS {
            if high - low <= PRECISION_RAD {
                break;
            }
            let guess = low + (high - low) * (at_low / (at_low - at_high)).clamp(0.02, 0.98);
            let depth = self.depth_at(element, parameter, guess);
            if (depth < 0.0) == is_material {
                (low, at_low) = (guess, depth);
                at_high *= 0.5;
            } else {
                (high, at_high) = (guess, depth);
                at_low *= 0.5;
            }
            if depth.abs() < MATERIAL_TOLERANCE_MM {
                return guess;
            }
        }
        (low + high) / 2.0
    }

    /// Chooses the candidates that may be nearer to a ring than what an arc passes at once.
    fn choose_ring_candidates(&mut self, element: &ContourElement, parameter: f64) {
        let [radius, height] = element.point(parameter);
        let axis = self.step.turned(&self.step.to_world(0, &Vector3::z()), self.time);
        let center = self.step.place_of(&Vector3::new(0.0, 0.0, height), self.time);
        let enough = STEP_RAD[1] * radius + MATERIAL_TOLERANCE_MM;
        // All points of the ring are within its radius from the centre, and no higher than its highest one.
        let highest = center.z + radius * axis.xy().norm();
        let place = [center.x, center.y, radius, highest];
        self.ring_candidates.clear();
        let program = self.program;
        let near = self.candidates.iter().copied().filter(|candidate| {
            let distance = program.distance_from_footprint(*candidate, &place);
            distance.is_none_or(|distance| distance <= enough)
        });
        self.ring_candidates.extend(near);
    }

    /// Returns how far a point of the surface is from material (above 0) or how deep it is in it, at the least, mm; of what is
    /// farther or deeper than an arc passes at once, only that.
    fn depth_at(&mut self, element: &ContourElement, parameter: f64, angle: f64) -> f64 {
        let body = surface_point(element, parameter, self.heading + angle, 0.0);
        let point = self.step.place_of(&body, self.time);
        let stock = self.program.stock.iter().map(|body| body.gap(&point)).fold(f64::INFINITY, f64::min);
        let enough = STEP_RAD[1] * element.point(parameter)[0];
        let mut depth = (stock + MATERIAL_TOLERANCE_MM).max(-enough);
        if depth > enough {
            return depth;
        }
        let place = [point.x, point.y, MATERIAL_TOLERANCE_MM, point.z + MATERIAL_TOLERANCE_MM];
        let mut deciding = None;
        for (number, candidate) in self.ring_candidates.iter().enumerate() {
            let covered =
                MATERIAL_TOLERANCE_MM - self.program.least_gap_of(*candidate, &point, &place, -depth);
            if covered > depth {
                depth = covered;
                deciding = Some(number);
                // As soon as one covers the point deep enough nothing else is asked.
                if depth > enough {
                    break;
                }
            }
        }
        // What decides here most likely decides beside it, too, and then the others need only a look at their footprints.
        if let Some(front) = deciding.and_then(|number| self.ring_candidates.get_mut(..=number)) {
            front.rotate_right(1);
        }
        depth
    }
}

impl CertifiedProgram {
    /// Returns the gap of a point to a step or a run of steps, mm. Where it is surely above `most`, any number above that
    /// may be returned.
    fn least_gap_of(&self, number: u32, point: &Vector3<f64>, place: &[f64; 4], most: f64) -> f64 {
        if let Some(distance) = self.distance_from_footprint(number, place)
            && distance > most
        {
            return distance;
        }
        let members = self.exact_parts_of(number);
        if members.len() <= 1 {
            let Some((step, contour)) = self.step_and_contour(number) else { return f64::INFINITY };
            return step.gap_of(contour, point);
        }
        // Steps of a run are asked one by one: each is closed form where its chord would have to be searched, and most are
        // told by their footprints.
        let mut least = f64::INFINITY;
        for member in members {
            let distance = self.distance_from_footprint(member, place);
            if distance.is_some_and(|distance| distance > most.min(least)) {
                continue;
            }
            if let Some((step, contour)) = self.step_and_contour(member) {
                least = least.min(step.gap_of(contour, point));
            }
        }
        least
    }

    /// Returns how far a place surely is from a step, mm, if its disc or its lowest height tells.
    fn distance_from_footprint(&self, number: u32, [x, y, radius, highest]: &[f64; 4]) -> Option<f64> {
        let [a, b, reach, lowest] = self.footprint_of_step(number)?;
        // A root is quicker than `hypot`, and millimetres neither overflow nor vanish.
        let beside = ((x - a).powi(2) + (y - b).powi(2)).sqrt() - radius - reach;
        Some(beside.max(lowest - highest))
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

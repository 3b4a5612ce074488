//! This module finds what of a cutter's surface cuts at one moment of a block: rows along the edge, each with the arcs
//! around the axis on which the surface advances into material. Forces are sums over these arcs.
//!
//! A row's arcs are those of one ring of the surface. Rings are placed where arcs change along the edge, down to
//! [`LEAST_ROW_MM`], so that the ends of an engagement are cut at their place and not at whole rows or bins.

use super::advance::AdvanceField;
use super::certified_program::{CertifiedProgram, SearchedStep};
use super::contact_ring::{RingArcs, RingTracer};
use super::contour_element::ContourElement;
use nalgebra::Vector3;

/// Rows whose neighbours' arcs are of another number are divided down to this length, mm.
const LEAST_ROW_MM: f64 = 2e-3;
/// The same as a part of the engaged height.
const LEAST_ROW_PART: f64 = 5e-4;
/// The largest angle between the ends of arcs of rings that follow each other, radians.
const MOST_CHANGE_RAD: f64 = 0.1;
/// The most rings of one element.
const MOST_RINGS: usize = 96;
/// The largest angle that the normal turns between the first rings, radians.
const FIRST_TURN_RAD: f64 = 0.2;
/// How far from their ends elements are looked at first, as a part of their length: at a corner it is open whose
/// surface it is.
const INWARDS: f64 = 1e-5;

/// What of a cutter's surface cuts at one moment.
#[derive(Debug, Clone, PartialEq)]
pub struct ContactSection {
    /// The rows from the tip upwards; none in air.
    pub rows: Vec<SectionRow>,
    /// The unit vectors of the workpiece frame ahead, to the left as seen from the holder, and along the axis away from
    /// the tip. Where the tip moves along the axis only, ahead is some direction across it.
    pub frame: [Vector3<f64>; 3],
    /// Whether the tip, or where it stands the turning axis, moves across the axis, so that there is an ahead.
    pub has_heading: bool,
    /// The speed of the tip ahead and along the axis, as a part of the speed that the feed refers to.
    pub tip_speed: [f64; 2],
    /// The direction ahead and to the left in which a turning axis lets points at the height of 1 mm advance, times its
    /// speed.
    pub spin: [f64; 2],
}

/// A part of the contour on which the same arcs cut.
#[derive(Debug, Clone, PartialEq)]
pub struct SectionRow {
    /// The element of the contour.
    pub element: ContourElement,
    /// The range of the element's parameter.
    pub range: [f64; 2],
    /// The arcs in radians from ahead, positive to the left. They do not overlap; the second end of one may be beyond
    /// half a turn.
    pub arcs: Vec<[f64; 2]>,
}

impl ContactSection {
    /// Returns three numbers a, b and c: at an angle around the axis the share of the surface at a parameter of an element is
    /// a + b cos(angle) + c sin(angle).
    pub fn share_parts(&self, element: &ContourElement, parameter: f64) -> [f64; 3] {
        let ([r, z], [sin, up]) = (element.point(parameter), element.normal(parameter));
        let arm = z * sin - r * up;
        let [ahead, along] = self.tip_speed;
        [up * along, sin * ahead + arm * self.spin[0], arm * self.spin[1]]
    }

    /// Refers shares to the speed of a motion as it is programmed. `pace` is the speed of the tip by that one.
    #[must_use]
    pub fn at_pace(mut self, pace: f64) -> Self {
        self.tip_speed = self.tip_speed.map(|part| part * pace);
        self.spin = self.spin.map(|part| part * pace);
        self
    }

    /// Returns whether nothing cuts.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }
}

impl CertifiedProgram {
    /// Returns what cuts at a time of a block, from 0 to 1. Returns `None` for a block that does not exist or does not move.
    pub fn find_contact_section(&self, block: usize, time: f64) -> Option<ContactSection> {
        let steps = self.searched_steps(block);
        let own = steps.iter().find(|own| time <= own.time_part[1]).or(steps.last())?;
        let [from, to] = own.time_part;
        let within = ((time - from) / (to - from)).clamp(0.0, 1.0);
        self.find_step_section(own, within)
    }

    fn find_step_section(&self, own: &SearchedStep<'_>, time: f64) -> Option<ContactSection> {
        let step = own.step;
        let contour = self.cutters().get(step.cutter)?;
        let (tip, spin) = AdvanceField::new(step, own.reference).velocities_at(time);
        let across = tip.xy();
        let has_heading = across.norm() > 1e-9 || spin.norm() > 1e-12;
        let heading = if across.norm() > 1e-9 {
            across.y.atan2(across.x)
        } else if spin.norm() > 1e-12 {
            spin.y.atan2(spin.x)
        } else {
            0.0
        };
        let (sin, cos) = heading.sin_cos();
        let turned = |vector: Vector3<f64>| step.turned(&step.to_world(0, &vector), time);
        let mut section = ContactSection {
            rows: Vec::new(),
            frame: [
                turned(Vector3::new(cos, sin, 0.0)),
                turned(Vector3::new(-sin, cos, 0.0)),
                turned(Vector3::z()),
            ],
            has_heading,
            tip_speed: [across.norm(), tip.z],
            spin: [spin.x * cos + spin.y * sin, spin.y * cos - spin.x * sin],
        };
        if !self.is_near_stock(&step.bounds(contour, self.stock_top())) {
            return Some(section);
        }
        let mut tracer = RingTracer::new(self, own, time, heading)?;
        let highest = tracer.highest_mm();
        for element in contour.elements() {
            add_rows(&mut section, element, highest, &mut tracer);
        }
        Some(section)
    }
}

/// A ring that was looked at: its parameter and its arcs.
type KnownRing = (f64, RingArcs);

/// Adds the rows of one element up to a height above the tip.
fn add_rows(
    section: &mut ContactSection,
    element: &ContourElement,
    highest_mm: f64,
    tracer: &mut RingTracer<'_>,
) {
    let Some(range) = range_below(element, highest_mm) else { return };
    let (turn, length) = match element {
        ContourElement::Line { .. } => (0.0, (range[1] - range[0]) * element.length_per_unit()),
        ContourElement::Arc { radius, .. } => (range[1] - range[0], (range[1] - range[0]) * radius),
    };
    if length <= 0.0 || !may_advance(section, element, range) {
        return;
    }
    let least = LEAST_ROW_MM.max(length * LEAST_ROW_PART) / length * (range[1] - range[0]);
    let count = ((turn / FIRST_TURN_RAD).ceil() as usize).max(3);
    let inset = (range[1] - range[0]) * INWARDS;
    let first = |number: usize| {
        let at = range[0] + (range[1] - range[0]) * number as f64 / count as f64;
        at.clamp(range[0] + inset, range[1] - inset)
    };
    // The rings that were looked at wait from the top downwards; the last one that is settled is compared with the next.
    let mut waiting: Vec<KnownRing> = Vec::new();
    for number in (0..=count).rev() {
        waiting.push(trace_ring(section, element, first(number), tracer));
    }
    let Some(mut below) = waiting.pop() else { return };
    let mut rings = waiting.len() + 1;
    let mut from = range[0];
    while let Some(above) = waiting.pop() {
        let is_short = above.0 - below.0 <= least || rings >= MOST_RINGS;
        if !is_short && is_unlike(&below.1, &above.1) {
            let middle = trace_ring(section, element, (below.0 + above.0) / 2.0, tracer);
            rings += 1;
            waiting.push(above);
            waiting.push(middle);
            continue;
        }
        let to = (below.0 + above.0) / 2.0;
        push_row(section, element, [from, to], std::mem::replace(&mut below, above).1);
        from = to;
    }
    push_row(section, element, [from, range[1]], below.1);
}

/// Adds a row, or lengthens the last one if its arcs are the same.
fn push_row(section: &mut ContactSection, element: &ContourElement, range: [f64; 2], arcs: RingArcs) {
    if arcs.is_empty() || range[1] <= range[0] {
        return;
    }
    match section.rows.last_mut() {
        Some(last) if last.arcs == arcs && last.element == *element && last.range[1] == range[0] => {
            last.range[1] = range[1];
        }
        _ => section.rows.push(SectionRow { element: *element, range, arcs }),
    }
}

fn trace_ring(
    section: &ContactSection,
    element: &ContourElement,
    parameter: f64,
    tracer: &mut RingTracer<'_>,
) -> KnownRing {
    let parts = section.share_parts(element, parameter);
    (parameter, tracer.trace(element, parameter, parts))
}

/// Returns whether a share above 0 is possible on an element.
fn may_advance(section: &ContactSection, element: &ContourElement, range: [f64; 2]) -> bool {
    range.iter().any(|at| {
        let [still, ahead, left] = section.share_parts(element, *at);
        still + ahead.hypot(left) > super::contact_ring::LEAST_SHARE
    })
}

/// Returns the part of an element's range that is below a height above the tip.
fn range_below(element: &ContourElement, highest_mm: f64) -> Option<[f64; 2]> {
    let [from, to] = element.range();
    let [low, high] = [element.point(from)[1], element.point(to)[1]];
    if low > highest_mm {
        return None;
    }
    let is_high_line = matches!(element, ContourElement::Line { .. }) && high > highest_mm && high > low;
    Some([from, if is_high_line { from + (to - from) * (highest_mm - low) / (high - low) } else { to }])
}

/// Returns whether the arcs of two rings differ by more than a sum over them may.
fn is_unlike(one: &RingArcs, other: &RingArcs) -> bool {
    one.len() != other.len()
        || one.iter().flatten().zip(other.iter().flatten()).any(|(a, b)| (a - b).abs() > MOST_CHANGE_RAD)
}

//! This module traces the outline of one section: the ellipse without the parts that the ends of the flutes
//! cut off.

use super::rim_directions::RimDirections;
use crate::layered_chips::boundary_diagram::time_segments::TimeSegment;
use crate::layered_chips::section_family::{DiagramCurve, GRAZES, SectionFamily};
use crate::layered_chips::trig_polynomial::TrigPolynomial;
use std::f64::consts::TAU;

/// The relation of an end of the flutes to the ellipse.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FluteEndCut {
    /// The end cuts nothing off.
    Free,
    /// The end cuts everything off.
    All,
    /// A chord is part of the boundary.
    Chord,
}

/// The relation of both ends: bottom, then top.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct FluteEndCuts([FluteEndCut; 2]);

impl FluteEndCuts {
    /// The relation as a section alone determines it, without the proof of a diagram.
    pub(super) const SEEN: Self = Self([FluteEndCut::Chord, FluteEndCut::Chord]);

    /// Returns the relation that holds during a whole segment of time.
    pub(super) fn over_segment(family: &SectionFamily, stretch: &TimeSegment) -> Self {
        Self([DiagramCurve::Bottom, DiagramCurve::Top].map(|curve| {
            if curve == DiagramCurve::Top && !family.has_top() {
                return FluteEndCut::Free;
            }
            if stretch.tracks.iter().any(|track| track.curve == curve) {
                return FluteEndCut::Chord;
            }
            let TrigPolynomial([constant, ..]) = family.curve_at(curve, 0.5 * (stretch.t[0] + stretch.t[1]));
            // Without a root, the sign of the constant decides.
            if constant > GRAZES { FluteEndCut::Free } else { FluteEndCut::All }
        }))
    }
}

/// Returns the angles between which a curve `k0 + k1 cos + k2 sin` is negative. If there is no sign change,
/// `Err` says whether all angles are negative (`true`) or none.
fn negative_angle_range(curve: &TrigPolynomial<f64>) -> Result<[f64; 2], bool> {
    let TrigPolynomial([k0, k1, k2, ..]) = *curve;
    let swing = k1.hypot(k2);
    if k0.abs() >= swing {
        return Err(k0 <= GRAZES);
    }
    // The curve is k0 + swing cos(theta - phi), and is negative around the angle opposite to phi.
    let middle = k2.atan2(k1) + 0.5 * TAU;
    let half = (k0 / swing).acos();
    Ok([middle - half, middle + half])
}

/// Returns the section at a time, counter-clockwise, or an empty list if there is none. `nodes` are further
/// angles at which it has vertices.
pub(super) fn trace_outline(
    family: &SectionFamily,
    rim: &RimDirections,
    t: f64,
    cuts: FluteEndCuts,
    nodes: &[f64],
) -> Vec<[f64; 2]> {
    let ellipse = family.ellipse_at(t);
    find_outline_vertices(family, rim, t, cuts, nodes)
        .into_iter()
        .map(|corner| ellipse.point_towards(corner.direction))
        .collect()
}

/// Returns the section at a time, and the caps that `nodes` add to the section without them. A cap is between
/// the vertices before and behind its nodes.
pub(super) fn trace_outline_with_caps(
    family: &SectionFamily,
    rim: &RimDirections,
    t: f64,
    cuts: FluteEndCuts,
    nodes: &[f64],
) -> (Vec<[f64; 2]>, Vec<Vec<[f64; 2]>>) {
    let ellipse = family.ellipse_at(t);
    let corners = find_outline_vertices(family, rim, t, cuts, nodes);
    let start = corners.iter().position(|corner| !corner.is_node).unwrap_or_default();
    let mut caps: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut cap: Vec<[f64; 2]> = Vec::new();
    for corner in corners.iter().cycle().skip(start).take(corners.len() + 1) {
        let place = ellipse.point_towards(corner.direction);
        cap.push(place);
        if !corner.is_node {
            let done = std::mem::replace(&mut cap, vec![place]);
            caps.extend((done.len() > 2).then_some(done));
        }
    }
    (corners.iter().map(|corner| ellipse.point_towards(corner.direction)).collect(), caps)
}

/// A vertex of a section.
struct OutlineVertex {
    angle: f64,
    direction: [f64; 2],
    is_node: bool,
}

impl OutlineVertex {
    fn at_angle(angle: f64, is_node: bool) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { angle, direction: [cos, sin], is_node }
    }
}

/// Finds the vertices of a section, sorted by angle: the rim's directions, the nodes, and the ends of chords.
fn find_outline_vertices(
    family: &SectionFamily,
    rim: &RimDirections,
    t: f64,
    cuts: FluteEndCuts,
    nodes: &[f64],
) -> Vec<OutlineVertex> {
    let mut removed: Vec<[f64; 2]> = Vec::new();
    for (curve, cut) in [DiagramCurve::Bottom, DiagramCurve::Top].into_iter().zip(cuts.0) {
        match cut {
            FluteEndCut::Free => {}
            FluteEndCut::All => return Vec::new(),
            FluteEndCut::Chord if curve == DiagramCurve::Top && !family.has_top() => {}
            FluteEndCut::Chord => match negative_angle_range(&family.curve_at(curve, t)) {
                Ok(angles) => removed.push(angles),
                Err(true) => return Vec::new(),
                Err(false) => {}
            },
        }
    }
    let kept = |angle: f64| {
        removed.iter().all(|[from, to]| (angle - from).rem_euclid(TAU) > to - from || to - from >= TAU)
    };
    let around = rim.directions_between(-1e-9, TAU - 1e-9);
    let around = around.map(|(angle, direction)| OutlineVertex { angle, direction, is_node: false });
    let mut corners: Vec<OutlineVertex> = Vec::with_capacity(rim.direction_count() + nodes.len() + 4);
    corners.extend(around.chain(nodes.iter().map(|angle| OutlineVertex::at_angle(*angle, true))));
    corners.retain(|corner| kept(corner.angle));
    for angle in removed.iter().flatten() {
        // An end of one chord that the other chord has cut off is not a vertex.
        let others = removed.iter().filter(|ends| !ends.contains(angle));
        let inside = others.clone().any(|[from, to]| (angle - from).rem_euclid(TAU) <= to - from);
        if !inside {
            corners.push(OutlineVertex {
                angle: angle.rem_euclid(TAU),
                ..OutlineVertex::at_angle(*angle, false)
            });
        }
    }
    corners.sort_by(|a, b| a.angle.total_cmp(&b.angle));
    corners.dedup_by(|a, b| (a.angle - b.angle).abs() < 1e-9);
    corners
}

//! The outline of one section: the ellipse with what the ends of the flutes cut off.

use super::rim::Rim;
use crate::chips::diagram::stretch::Stretch;
use crate::chips::family::{Curve, Family};
use crate::chips::trig::Trig;
use std::f64::consts::TAU;

/// Heights (as a share of the radius) at which an upright end of the flutes lies in the layer: the layer is then beyond it.
pub(in crate::chips) const GRAZES: f64 = 1e-9;

/// How an end of the flutes stands to the ellipse.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cut {
    /// It cuts nothing off.
    Free,
    /// It cuts everything off.
    All,
    /// A chord is the border.
    Chord,
}

/// What both ends do: bottom, top.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Cuts([Cut; 2]);

impl Cuts {
    /// As a section alone shows them.
    pub const SEEN: Self = Self([Cut::Chord, Cut::Chord]);

    /// As they are all through a stretch.
    pub fn of(family: &Family, stretch: &Stretch) -> Self {
        Self([Curve::Bottom, Curve::Top].map(|curve| {
            if curve == Curve::Top && !family.has_top() {
                return Cut::Free;
            }
            if stretch.tracks.iter().any(|track| track.curve == curve) {
                return Cut::Chord;
            }
            let Trig([constant, ..]) = family.curve(curve, 0.5 * (stretch.t[0] + stretch.t[1]));
            // Without a root the constant decides.
            if constant > GRAZES { Cut::Free } else { Cut::All }
        }))
    }
}

/// The angles from which to which a curve `k0 + k1 cos + k2 sin` is negative; `Err` tells whether all are (`true`) or none.
fn cut_off(curve: &Trig<f64>) -> Result<[f64; 2], bool> {
    let Trig([k0, k1, k2, ..]) = *curve;
    let swing = k1.hypot(k2);
    if k0.abs() >= swing {
        return Err(k0 <= GRAZES);
    }
    let middle = k2.atan2(k1) + 0.5 * TAU;
    let half = (k0 / swing).acos();
    Ok([middle - half, middle + half])
}

/// The section at a time, counter-clockwise; empty where there is none. `nodes` are further angles at which it has corners.
pub(super) fn outline(family: &Family, rim: &Rim, t: f64, cuts: Cuts, nodes: &[f64]) -> Vec<[f64; 2]> {
    let ellipse = family.ellipse(t);
    corners(family, rim, t, cuts, nodes).into_iter().map(|corner| ellipse.point(corner.direction)).collect()
}

/// The section at a time, and what `nodes` add to the one without: a piece between the corners before and behind.
pub(super) fn outline_with_caps(
    family: &Family,
    rim: &Rim,
    t: f64,
    cuts: Cuts,
    nodes: &[f64],
) -> (Vec<[f64; 2]>, Vec<Vec<[f64; 2]>>) {
    let ellipse = family.ellipse(t);
    let corners = corners(family, rim, t, cuts, nodes);
    let start = corners.iter().position(|corner| !corner.is_node).unwrap_or_default();
    let mut caps: Vec<Vec<[f64; 2]>> = Vec::new();
    let mut cap: Vec<[f64; 2]> = Vec::new();
    for corner in corners.iter().cycle().skip(start).take(corners.len() + 1) {
        let place = ellipse.point(corner.direction);
        cap.push(place);
        if !corner.is_node {
            let done = std::mem::replace(&mut cap, vec![place]);
            caps.extend((done.len() > 2).then_some(done));
        }
    }
    (corners.iter().map(|corner| ellipse.point(corner.direction)).collect(), caps)
}

/// A corner of a section.
struct Corner {
    angle: f64,
    direction: [f64; 2],
    is_node: bool,
}

impl Corner {
    fn at(angle: f64, is_node: bool) -> Self {
        let (sin, cos) = angle.sin_cos();
        Self { angle, direction: [cos, sin], is_node }
    }
}

fn corners(family: &Family, rim: &Rim, t: f64, cuts: Cuts, nodes: &[f64]) -> Vec<Corner> {
    let mut removed: Vec<[f64; 2]> = Vec::new();
    for (curve, cut) in [Curve::Bottom, Curve::Top].into_iter().zip(cuts.0) {
        match cut {
            Cut::Free => {}
            Cut::All => return Vec::new(),
            Cut::Chord if curve == Curve::Top && !family.has_top() => {}
            Cut::Chord => match cut_off(&family.curve(curve, t)) {
                Ok(angles) => removed.push(angles),
                Err(true) => return Vec::new(),
                Err(false) => {}
            },
        }
    }
    let kept = |angle: f64| {
        removed.iter().all(|[from, to]| (angle - from).rem_euclid(TAU) > to - from || to - from >= TAU)
    };
    let around = rim.between(-1e-9, TAU - 1e-9);
    let around = around.map(|(angle, direction)| Corner { angle, direction, is_node: false });
    let mut corners: Vec<Corner> = Vec::with_capacity(rim.count() + nodes.len() + 4);
    corners.extend(around.chain(nodes.iter().map(|angle| Corner::at(*angle, true))));
    corners.retain(|corner| kept(corner.angle));
    for angle in removed.iter().flatten() {
        // An end of one chord that the other has cut off is no corner.
        let others = removed.iter().filter(|ends| !ends.contains(angle));
        let inside = others.clone().any(|[from, to]| (angle - from).rem_euclid(TAU) <= to - from);
        if !inside {
            corners.push(Corner { angle: angle.rem_euclid(TAU), ..Corner::at(*angle, false) });
        }
    }
    corners.sort_by(|a, b| a.angle.total_cmp(&b.angle));
    corners.dedup_by(|a, b| (a.angle - b.angle).abs() < 1e-9);
    corners
}

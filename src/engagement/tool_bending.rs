//! This module computes how cutting forces bend a tool: the deflection of its tip, the stress at the steps of its shank, and
//! what the deflection leaves on walls.
//!
//! Each element of an edge presses where it is, so no point of attack is assumed. A flank finishes a wall where an edge passes
//! the side of the cutter, 90 degrees from ahead: what the tool is bent across the path at that moment, at the height of that
//! edge, is the error of the wall (Kline, DeVor and Shareef, J. Engineering for Industry 104 (1982), 272-278).

use super::section_forces::EdgeForceModel;
use super::section_nodes::{EdgeNode, PAIR};
use crate::certified_engagement::{ContactSection, ContourElement};
use crate::cutter::ToolBeam;
use std::f64::consts::FRAC_PI_2;

/// How far an arc may end before the side of the cutter and still finish a wall there, radians.
const BESIDE_WALL_RAD: f64 = 0.02;
/// How far inside the arc the edge is looked at, radians.
const INSIDE_RAD: f64 = 1e-5;
/// The sine of the normal's angle from which on a straight part of the contour is a flank: a taper up to 30 degrees.
const FLANK_SIN: f64 = 0.866;
/// The heights at which the error of a wall is looked at.
const WALL_HEIGHTS: u32 = 5;
/// How far inside a row the lowest and highest of them are, as a part of its height.
const INWARDS: f64 = 1e-6;

/// How a tool bends while it cuts.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[non_exhaustive]
pub struct ToolBending {
    /// The mean deflection of its tip ahead and to the left, mm.
    pub deflection_mean_mm: [f64; 2],
    /// The largest deflection of its tip across the axis, mm.
    pub deflection_peak_mm: f64,
    /// The largest bending stress, MPa.
    pub stress_peak_mpa: f64,
    /// The errors of the walls to the left and to the right of the path, mm: the largest over heights and teeth, above 0 where
    /// material stays and below 0 where too much is cut. `None` where a side finishes no wall with a flank.
    pub wall_error_mm: [Option<f64>; 2],
}

impl ToolBending {
    /// Returns the length of the mean deflection, mm.
    pub fn deflection_mean_length_mm(&self) -> f64 {
        let [ahead, left] = self.deflection_mean_mm;
        ahead.hypot(left)
    }

    /// Takes in what happens at another place, which has a part of the time of both.
    pub(crate) fn add_place(&mut self, place: &Self, part: f64) {
        let means = self.deflection_mean_mm.iter_mut().zip(place.deflection_mean_mm);
        means.for_each(|(mean, value)| *mean += (value - *mean) * part);
        self.deflection_peak_mm = self.deflection_peak_mm.max(place.deflection_peak_mm);
        self.stress_peak_mpa = self.stress_peak_mpa.max(place.stress_peak_mpa);
        let walls = self.wall_error_mm.iter_mut().zip(place.wall_error_mm);
        walls.for_each(|(error, value)| keep_larger(error, value));
    }
}

/// Keeps the error that is farther from 0.
fn keep_larger(error: &mut Option<f64>, other: Option<f64>) {
    if let Some(value) = other
        && error.is_none_or(|error| error.abs() < value.abs())
    {
        *error = Some(value);
    }
}

/// Fills in by how much the tool bends at a height for 1 N on each part of the edge.
pub(super) fn weigh_nodes(nodes: &mut [EdgeNode], beam: Option<&ToolBeam>, at_mm: f64) {
    let Some(beam) = beam else { return };
    for node in nodes {
        // The beam's line is cubic in the height, which two points integrate over a straight edge.
        let low = node.height_mm - node.half_height_mm;
        let gives = PAIR.map(|part| beam.deflection_mm_per_n(at_mm, low + 2.0 * part * node.half_height_mm));
        node.give_mm_per_n = gives.iter().sum::<f64>() / 2.0;
    }
}

impl EdgeForceModel {
    /// Returns the errors of the walls to the left and to the right of the path, mm.
    pub(super) fn find_wall_errors(
        &self,
        section: &ContactSection,
        nodes: &[EdgeNode],
        beam: &ToolBeam,
        advance: f64,
    ) -> [Option<f64>; 2] {
        let mut errors = [None; 2];
        let mut weighed = nodes.to_vec();
        for (side, error) in [1.0, -1.0].into_iter().zip(&mut errors) {
            for (height_mm, wall_rad) in list_wall_places(section, side) {
                weigh_nodes(&mut weighed, Some(beam), height_mm);
                // An edge at this height stands at the wall when its tooth has turned so far.
                let lag = height_mm * self.lag_rad_per_mm();
                for trail in self.list_passing_teeth() {
                    let turned = trail + lag - self.sense() * wall_rad;
                    let bent = self.bend_at_rotation(section, &weighed, turned, advance);
                    // The force on the workpiece is the opposite of that on the tool: where it points to the wall, the tool
                    // bends away from it, and material stays.
                    keep_larger(error, Some(bent * side));
                }
            }
        }
        errors
    }
}

/// Lists the heights of flanks that finish a wall on a side (1 left, -1 right), each with the angle from ahead at which they do.
fn list_wall_places(section: &ContactSection, side: f64) -> Vec<(f64, f64)> {
    let mut ranges = Vec::new();
    for row in &section.rows {
        let ContourElement::Line { normal: [sin, _], .. } = &row.element else { continue };
        let arcs = row.arcs.iter().map(|[from, to]| if side > 0.0 { [*from, *to] } else { [-to, -from] });
        let end = arcs.filter_map(|[from, to]| {
            let reaches = to >= FRAC_PI_2 - BESIDE_WALL_RAD && from < FRAC_PI_2 - BESIDE_WALL_RAD;
            reaches.then_some(to.min(FRAC_PI_2) - INSIDE_RAD)
        });
        if *sin >= FLANK_SIN
            && let Some(end) = end.reduce(f64::max)
        {
            let [low, high] = row.range.map(|at| row.element.point(at)[1]);
            ranges.push(([low, high], end * side));
        }
    }
    let low = ranges.iter().map(|([low, _], _)| *low).fold(f64::INFINITY, f64::min);
    let high = ranges.iter().map(|([_, high], _)| *high).fold(f64::NEG_INFINITY, f64::max);
    let inset = (high - low) * INWARDS;
    let place = |number: u32| {
        let at = low + (high - low) * f64::from(number) / f64::from(WALL_HEIGHTS - 1);
        let at = at.clamp(low + inset, high - inset);
        let (_, angle) = ranges.iter().find(|([low, high], _)| *low <= at && at <= *high)?;
        Some((at, *angle))
    };
    if high > low { (0..WALL_HEIGHTS).filter_map(place).collect() } else { Vec::new() }
}

//! This module maps the chip thickness over edges: along each edge, and over one revolution of the spindle.
//!
//! What cuts is a [`ContactSection`]. An edge at an angle psi from ahead whose surface advances by a share of the feed cuts
//! `share * feed / n` divided among the teeth (Kiselev, Jukov and Deev's thickness along edges, with the teeth of
//! [`Teeth::edge_chip_thickness_mm`](crate::cutter::Teeth::edge_chip_thickness_mm)). On the flank of a straight slot that is
//! `f_z cos psi`.

use super::section_forces::EdgeForceModel;
use crate::certified_engagement::{ContactSection, ContourElement, CutterContour};
use std::f64::consts::TAU;

/// A place on every edge.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct EdgePoint {
    /// Its distance from the tip along the meridian, mm.
    pub along_mm: f64,
    /// Its height above the tip, mm.
    pub height_mm: f64,
    /// Its distance from the axis, mm.
    pub radius_mm: f64,
}

/// The chips of one tooth over a revolution.
#[derive(Debug, Clone, PartialEq)]
pub struct ToothThickness {
    /// The number of the tooth, from 1.
    pub tooth: usize,
    /// For each rotation and in it for each point the thickness, mm; 0 where the edge does not cut.
    pub thickness_mm: Vec<f64>,
}

/// The chip thickness over edges at one place of a path.
#[derive(Debug, Clone, PartialEq)]
pub struct EdgeThicknessMap {
    /// The points, in the middles of equal parts of the meridian from the lowest one that cuts to the highest.
    pub points: Vec<EdgePoint>,
    /// The angles by which the spindle has turned since the tip of the first tooth was straight ahead, radians.
    pub rotations_rad: Vec<f64>,
    /// The teeth: all, or the first one where the others cut the same chips later.
    pub teeth: Vec<ToothThickness>,
    /// The angles by which the tips of all teeth trail the first one, radians.
    pub trails_rad: Vec<f64>,
    /// By how much an edge lags behind its tip, radians per mm of height.
    pub lag_rad_per_mm: f64,
    /// 1 for a spindle that turns clockwise, else -1.
    pub sense: f64,
}

/// A point of the edge with what its thickness needs.
struct MappedPoint<'s> {
    point: EdgePoint,
    arcs: &'s [[f64; 2]],
    share: [f64; 3],
    radial: f64,
}

impl EdgeThicknessMap {
    /// Returns the angle from ahead, positive to the left, at which the edge of a tooth stands at a height; radians.
    pub fn edge_angle_rad(&self, trail_rad: f64, rotation_rad: f64, height_mm: f64) -> f64 {
        self.sense * (trail_rad - rotation_rad + self.lag_rad_per_mm * height_mm)
    }

    /// Returns the largest thickness with its tooth, rotation and point, by their indices; `None` in air.
    pub fn find_thickest(&self) -> Option<(f64, [usize; 3])> {
        let points = self.points.len().max(1);
        let of_teeth = self.teeth.iter().enumerate().flat_map(|(tooth, found)| {
            let numbered = found.thickness_mm.iter().enumerate();
            numbered.map(move |(index, thickness)| (*thickness, [tooth, index / points, index % points]))
        });
        // The first of equal ones counts.
        of_teeth
            .filter(|(thickness, _)| *thickness > 0.0)
            .reduce(|most, next| if next.0 > most.0 + 1e-12 { next } else { most })
    }
}

impl EdgeForceModel {
    /// Maps the chip thickness over the edges of a cutter with this contour, at a feed in mm/min and a spindle speed in
    /// rev/min (above 0), at evenly spaced rotations and points.
    pub fn map_edge_thickness(
        &self,
        section: &ContactSection,
        contour: &CutterContour,
        [feed_mm_min, rpm]: [f64; 2],
        [rotations, points]: [usize; 2],
    ) -> EdgeThicknessMap {
        let mapped = list_points(section, contour, points.max(1));
        let rotations_rad: Vec<f64> =
            (0..rotations).map(|number| TAU * number as f64 / rotations as f64).collect();
        let mut map = EdgeThicknessMap {
            points: mapped.iter().map(|mapped| mapped.point).collect(),
            rotations_rad,
            teeth: Vec::new(),
            trails_rad: self.teeth().trail_angles_rad(),
            lag_rad_per_mm: self.lag_rad_per_mm(),
            sense: self.sense(),
        };
        let advance = feed_mm_min / rpm;
        let distinct = if self.teeth().is_even() { 1 } else { map.trails_rad.len() };
        map.teeth = (0..distinct)
            .map(|tooth| {
                let trail = map.trails_rad.get(tooth).copied().unwrap_or(0.0);
                let chip_at = |rotation: f64, at: &MappedPoint<'_>| {
                    let share = at.share_at(map.edge_angle_rad(trail, rotation, at.point.height_mm));
                    // An edge that does not cut has no chip, whatever its runout.
                    share.map_or(0.0, |share| {
                        self.teeth().edge_chip_thickness_mm(tooth, advance * share, at.radial)
                    })
                };
                let thickness_mm = map
                    .rotations_rad
                    .iter()
                    .flat_map(|rotation| mapped.iter().map(move |at| (*rotation, at)))
                    .map(|(rotation, at)| chip_at(rotation, at));
                ToothThickness { tooth: tooth + 1, thickness_mm: thickness_mm.collect() }
            })
            .collect();
        map
    }
}

impl MappedPoint<'_> {
    /// Returns the share of the feed by which the surface advances at an angle from ahead, if it cuts there.
    fn share_at(&self, angle: f64) -> Option<f64> {
        let is_in = |[from, to]: &[f64; 2]| (angle - from).rem_euclid(TAU) < to - from;
        let [still, ahead, left] = self.share;
        let share = still + ahead * angle.cos() + left * angle.sin();
        (share > 0.0 && self.arcs.iter().any(is_in)).then_some(share)
    }
}

/// Lists points between the lowest and the highest place that cuts; along the whole contour in air.
fn list_points<'s>(
    section: &'s ContactSection,
    contour: &CutterContour,
    count: usize,
) -> Vec<MappedPoint<'s>> {
    let mut whole = 0.0;
    let mut starts: Vec<(f64, &ContourElement)> = Vec::new();
    for element in contour.elements() {
        let [from, to] = element.range();
        starts.push((whole, element));
        whole += (to - from) * element.length_per_unit();
    }
    let along = |row_element: &ContourElement, at: f64| {
        let start = starts.iter().find(|(_, element)| *element == row_element);
        start.map(|(start, element)| start + (at - element.range()[0]) * element.length_per_unit())
    };
    let ends = section.rows.iter().flat_map(|row| row.range.map(|at| along(&row.element, at)));
    let [low, high] =
        ends.flatten().fold([f64::INFINITY, 0.0_f64], |[low, high], end| [low.min(end), high.max(end)]);
    let [low, high] = if low < high { [low, high] } else { [0.0, whole] };
    let place = |number: usize| {
        let along_mm = low + (high - low) * (number as f64 + 0.5) / count as f64;
        let (start, element) = starts.iter().rev().find(|(start, _)| *start <= along_mm)?;
        let parameter = element.range()[0] + (along_mm - start) / element.length_per_unit();
        let row = section
            .rows
            .iter()
            .find(|row| row.element == **element && (row.range[0]..=row.range[1]).contains(&parameter));
        let [radius_mm, height_mm] = element.point(parameter);
        Some(MappedPoint {
            point: EdgePoint { along_mm, height_mm, radius_mm },
            arcs: row.map_or(&[], |row| &row.arcs),
            share: section.share_parts(element, parameter),
            radial: element.normal(parameter)[0],
        })
    };
    (0..count).filter_map(place).collect()
}

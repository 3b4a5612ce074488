//! This module makes the passes plane by plane: the line that the ball follows in a plane, and the path of
//! its tip.

use super::chain_cutting;
use super::pass_planes::PassPlanes;
use crate::surface::drop_cutter::DropCutter;
use crate::surface::mesh_section::VerticalMeshSections;
use crate::surface::profile::{Chain, ChordSide, Point, compensate_profile, fit_chords};

/// The depth below the floor that counts as rounding, mm.
const LEVEL: f64 = 1e-7;

/// The data for making paths in planes; lengths are in mm.
pub(super) struct PassMaker {
    pub planes: PassPlanes,
    pub radius_mm: f64,
    /// The largest distance of a path from the exact one.
    pub tolerance_mm: f64,
    pub arcs: bool,
    /// The height below which the tip never goes.
    pub floor_mm: f64,
}

/// The passes in one plane, from lower to higher u.
#[derive(Debug, Clone)]
pub(super) struct PlaneSlice {
    /// The position of the plane, with the user's sign.
    pub offset_mm: f64,
    /// The line that was followed in the plane; `None` if the mesh in space was followed.
    pub ground: Option<Chain>,
    /// The paths of the tip.
    pub tips: Vec<Chain>,
}

impl PassMaker {
    /// Makes the paths over a profile.
    pub(super) fn tips_over_profile(&self, profile: &Chain) -> Vec<Chain> {
        let upward = if profile.start().u <= profile.end().u { profile.clone() } else { profile.reversed() };
        let Ok(tip) = compensate_profile(&upward, self.radius_mm) else { return Vec::new() };
        self.simplify_tips(chain_cutting::cut_chain(&tip, &[], self.floor_mm, |at| {
            at.z >= self.floor_mm - LEVEL
        }))
    }

    /// Makes the slice of a mesh from its line in the plane alone.
    pub(super) fn slice_in_plane(&self, sections: &VerticalMeshSections, offset_mm: f64) -> PlaneSlice {
        // The holes are bridged far below, so that one envelope covers the whole plane.
        let stretches = self.section_chains(sections, offset_mm);
        let Some(ground) = bridge_holes(&stretches, self.radius_mm) else {
            return PlaneSlice { offset_mm, ground: None, tips: Vec::new() };
        };
        let ranges = self.find_tip_ranges(&stretches);
        let tips = compensate_profile(&ground, self.radius_mm).map_or(Vec::new(), |tip| {
            let ends: Vec<f64> = ranges.iter().flat_map(|(from, to)| [*from, *to]).collect();
            // Between two parts of the line, what is further than the ball goes for each of them is left out.
            let upright = if ranges.len() > 1 { ends.as_slice() } else { &[] };
            let inside =
                |u: f64| ranges.len() < 2 || ranges.iter().any(|(from, to)| (*from..=*to).contains(&u));
            chain_cutting::cut_chain(&tip, upright, self.floor_mm, |at| {
                at.z >= self.floor_mm - LEVEL && inside(at.u)
            })
        });
        PlaneSlice { offset_mm, ground: Some(ground), tips: self.simplify_tips(tips) }
    }

    /// Makes the slice of a mesh with heights over the whole mesh.
    pub(super) fn slice_over_mesh(
        &self,
        sections: &VerticalMeshSections,
        cutter: &DropCutter,
        offset_mm: f64,
    ) -> PlaneSlice {
        let mut tips = Vec::new();
        // Fitting arcs needs most of the tolerance, so the path itself gets a quarter of it.
        let share = if self.arcs { 0.25 } else { 1.0 };
        for (from, to) in self.find_tip_ranges(&self.section_chains(sections, offset_mm)) {
            let ends = [from, to].map(|u| {
                let [x, y, _] = self.planes.point_at(offset_mm, u, 0.0);
                [x, y]
            });
            // A path over a mesh stays within three quarters of the tolerance that it is given, so it may get
            // a little more.
            for run in cutter.follow_line(&ends, self.tolerance_mm * share * 1.25) {
                let flat: Vec<Point> = run
                    .iter()
                    .map(|[x, y, z]| Point::new(self.planes.distance_along([*x, *y]), *z))
                    .collect();
                let Ok(tip) = Chain::from_points(&flat) else { continue };
                tips.extend(chain_cutting::cut_chain(&tip, &[], self.floor_mm, |at| {
                    at.z >= self.floor_mm - LEVEL
                }));
            }
        }
        if self.arcs {
            tips = tips
                .iter()
                .filter_map(|tip| {
                    fit_chords(tip, self.tolerance_mm * (1.0 - share), true, ChordSide::Both).ok()
                })
                .collect();
        }
        PlaneSlice { offset_mm, ground: None, tips }
    }

    /// Replaces tip paths by few chords and arcs within the tolerance.
    fn simplify_tips(&self, tips: Vec<Chain>) -> Vec<Chain> {
        tips.iter()
            .filter_map(|tip| fit_chords(tip, self.tolerance_mm, self.arcs, ChordSide::Both).ok())
            .collect()
    }

    /// Returns the mesh's line in a plane as chains.
    fn section_chains(&self, sections: &VerticalMeshSections, offset: f64) -> Vec<Chain> {
        let polyline = |points: &Vec<[f64; 2]>| {
            let points: Vec<Point> = points.iter().map(|[u, z]| Point::new(*u, *z)).collect();
            Chain::from_points(&points).ok()
        };
        sections.section_at(self.planes.offset_to_left(offset)).iter().filter_map(polyline).collect()
    }

    /// Returns the range of u that the tip covers for each chain, where the ball touches its free ends.
    /// Ranges that overlap are merged.
    fn find_tip_ranges(&self, stretches: &[Chain]) -> Vec<(f64, f64)> {
        let mut ranges: Vec<(f64, f64)> = Vec::new();
        for stretch in stretches {
            let Ok(tip) = compensate_profile(stretch, self.radius_mm) else { continue };
            let (from, to) = (tip.start().u.min(tip.end().u), tip.start().u.max(tip.end().u));
            match ranges.last_mut().filter(|last| from <= last.1) {
                Some(last) => last.1 = last.1.max(to),
                None => ranges.push((from, to)),
            }
        }
        ranges
    }
}

/// Joins chains to one. Over the holes between them it goes so deep that no ball reaches it.
fn bridge_holes(stretches: &[Chain], radius: f64) -> Option<Chain> {
    let lowest = stretches.iter().flat_map(Chain::vertices).map(|at| at.z).fold(f64::INFINITY, f64::min);
    let deep = lowest - 3.0 * radius;
    let mut points: Vec<Point> = Vec::new();
    for stretch in stretches {
        if let Some(last) = points.last().copied() {
            points.extend([Point::new(last.u, deep), Point::new(stretch.start().u, deep)]);
        }
        points.extend(stretch.vertices());
    }
    Chain::from_points(&points).ok()
}

//! This module computes the area that the cutter covers on a layer between two poses.
//!
//! A point that is covered, but not at the beginning, was entered at some time through the section's edge
//! where the edge advances. So the covered area is the first section together with the images of the
//! diagram's advancing regions. In each region (`advancing_bands`) f has one sign, so the region maps to the
//! plane without folding, and the image of its boundary winds around a point as often as the edge enters it.
//! The covered area is everything that any of these boundaries winds around: one union by the nonzero rule,
//! wherever the envelope crosses itself.

mod advancing_bands;
mod rim_directions;
mod section_outline;
mod time_slices;

pub use rim_directions::RimDirections;

use super::boundary_diagram::BoundaryDiagram;
use super::boundary_diagram::time_segments::TimeSegment;
use super::layer_ellipse::LayerEllipse;
use super::section_family::{DiagramCurve, SectionFamily};
use super::trig_polynomial::TrigPolynomial;
use advancing_bands::TrackRoot;
use section_outline::{FluteEndCuts, trace_outline, trace_outline_with_caps};

/// The number of slices for a diagram that is not resolved. A turn of one radian at a distance of 50 mm is
/// then missed by 0.4 micrometres.
const SLICES: usize = 128;

/// The area that a cutter covers on one layer between two poses. Boundaries are closed, have points x, y in
/// mm, and do not repeat their first point.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LayerSweptArea {
    /// The section at the first pose. It is convex and counter-clockwise, and empty if the cutter does not
    /// reach the layer.
    pub first: Vec<[f64; 2]>,
    /// The section at the last pose, likewise.
    pub last: Vec<[f64; 2]>,
    /// The boundaries of everything that the edge enters. An area is covered if they wind around it at all
    /// (their winding numbers are nowhere negative). Parts of `first` may be covered again.
    pub advancing: Vec<Vec<[f64; 2]>>,
    /// The data that determine the two sections; `None` if they are not known.
    pub seams: Option<[SectionSeam; 2]>,
    /// The parts that the ends of the envelope's branches, which are vertices of `first`, add along its
    /// boundary.
    pub caps: Vec<Vec<[f64; 2]>>,
}

/// All data that a section depends on, except for the ends of the envelope's branches. A step that continues
/// another one begins with the seam with which that one ended, to the bit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionSeam {
    ellipse: LayerEllipse,
    ends: [Option<TrigPolynomial<f64>>; 2],
    cuts: FluteEndCuts,
    directions: usize,
}

impl LayerSweptArea {
    /// Computes the area that the family of a diagram covers. Points are on the true boundaries; chords
    /// between them are within the rim's tolerance. If the diagram is not resolved, slices are used: see
    /// [`LayerSweptArea::from_slices`].
    pub fn new(diagram: &BoundaryDiagram, rim: &RimDirections) -> Self {
        let family = diagram.family();
        if !diagram.is_resolved() {
            return time_slices::sweep_by_slices(family, rim, SLICES);
        }
        let stretches = diagram.time_segments();
        let roots: Vec<Vec<TrackRoot<'_>>> =
            stretches.iter().map(|stretch| TrackRoot::roots_of_segment(family, stretch)).collect();
        let (Some(begin), Some(end)) = (stretches.first(), stretches.last()) else { return Self::default() };
        let cuts = [begin, end].map(|stretch| FluteEndCuts::over_segment(family, stretch));
        let [before, behind] = cuts;
        let (first, caps) =
            trace_outline_with_caps(family, rim, 0.0, before, &branch_node_angles(None, roots.first()));
        let mut cover = Self {
            first,
            last: trace_outline(family, rim, 1.0, behind, &branch_node_angles(roots.last(), None)),
            advancing: Vec::new(),
            seams: Some([
                SectionSeam::at_time(family, rim, 0.0, before),
                SectionSeam::at_time(family, rim, 1.0, behind),
            ]),
            caps,
        };
        let mut before: Option<(&TimeSegment, &Vec<TrackRoot<'_>>)> = None;
        for (index, (stretch, here)) in stretches.iter().zip(&roots).enumerate() {
            let bottom = branch_node_angles(before.map(|(_, roots)| roots), Some(here));
            let top = branch_node_angles(Some(here), roots.get(index + 1));
            if let Some((before, _)) = before {
                // The section itself closes the gap that the resolution of the event leaves. It also is what
                // appears at once if the bottom of a vertical cutter reaches the layer.
                let (old, new) =
                    (FluteEndCuts::over_segment(family, before), FluteEndCuts::over_segment(family, stretch));
                cover.add_boundary(trace_outline(family, rim, stretch.t[0], new, &bottom));
                if old != new {
                    cover.add_boundary(trace_outline(family, rim, stretch.t[0], old, &bottom));
                }
            }
            advancing_bands::add_advancing_boundaries(
                family,
                rim,
                stretch,
                here,
                [&bottom, &top],
                &mut cover.advancing,
            );
            before = Some((stretch, here));
        }
        cover
    }

    /// Computes the same area without a diagram, from convex hulls of the sections at the ends of equal
    /// slices of time. This is exact while the axis does not turn. Otherwise a slice is off by the square of
    /// its turn times an eighth of the distance from the tip.
    pub fn from_slices(family: &SectionFamily, rim: &RimDirections, slices: usize) -> Self {
        time_slices::sweep_by_slices(family, rim, slices)
    }

    /// Returns the sections at `count + 1` evenly spaced times, for a union by brute force.
    pub fn sections_at_slices(
        family: &SectionFamily,
        rim: &RimDirections,
        count: usize,
    ) -> Vec<Vec<[f64; 2]>> {
        time_slices::trace_slice_sections(family, rim, count)
    }

    fn add_boundary(&mut self, border: Vec<[f64; 2]>) {
        if border.len() > 2 {
            self.advancing.push(border);
        }
    }

    /// Returns whether nothing is entered.
    pub fn is_empty(&self) -> bool {
        self.advancing.is_empty()
    }
}

impl SectionSeam {
    /// Makes the seam of a section. The velocity does not matter for the section, so it is set to zero.
    fn at_time(family: &SectionFamily, rim: &RimDirections, t: f64, cuts: FluteEndCuts) -> Self {
        let ellipse = LayerEllipse { velocity: [0.0; 2], ..family.ellipse_at(t) };
        let ends = [DiagramCurve::Bottom, DiagramCurve::Top]
            .map(|curve| family.has_curve(curve).then(|| family.curve_at(curve, t)));
        Self { ellipse, ends, cuts, directions: rim.direction_count() }
    }
}

/// Returns the angles of the envelope's branches where one segment of time ends and another begins. The
/// boundaries on both sides have vertices there, so each must have the vertices of both.
fn branch_node_angles(before: Option<&Vec<TrackRoot<'_>>>, behind: Option<&Vec<TrackRoot<'_>>>) -> Vec<f64> {
    let edges = |roots: Option<&Vec<TrackRoot<'_>>>, end: fn([f64; 2]) -> f64| -> Vec<f64> {
        let roots = roots.into_iter().flatten().filter(|root| root.curve() == DiagramCurve::Edge);
        roots.map(|root| end(root.end_angles()).rem_euclid(std::f64::consts::TAU)).collect()
    };
    let mut angles = edges(before, |[_, end]| end);
    angles.extend(edges(behind, |[begin, _]| begin));
    angles.sort_by(f64::total_cmp);
    angles.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    angles
}

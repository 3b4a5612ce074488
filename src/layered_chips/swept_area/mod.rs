//! The area that the cutter covers on a layer between two places.
//!
//! Whatever is covered but not at the beginning was entered at some time through the section's edge where that advances. So the covered
//! area is the first section together with the images of the diagram's advancing regions. Each region (`bands`) maps to the plane
//! without folding, f having one sign in it: its border's image winds around a point as often as the edge enters it, and the union is
//! what any of the borders winds around.

mod advancing_bands;
mod rim_directions;
mod section_outline;
mod time_slices;

pub use rim_directions::RimDirections;
pub use section_outline::FluteEndCut;
pub(super) use section_outline::GRAZES;

use super::boundary_diagram::BoundaryDiagram;
use super::boundary_diagram::time_segments::TimeSegment;
use super::layer_ellipse::LayerEllipse;
use super::section_family::{DiagramCurve, SectionFamily};
use super::trig_polynomial::TrigPolynomial;
use advancing_bands::TrackRoot;
use section_outline::{FluteEndCuts, trace_outline, trace_outline_with_caps};

/// Slices for a diagram that is not resolved: a turn of a radian with a lever of 50 mm is missed by 0.4 micrometres.
const SLICES: usize = 128;

/// What a cutter covers on one layer between two places. Closed borders of x, y in mm; none repeats its first point.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct LayerSweptArea {
    /// The section at the first place: convex, counter-clockwise; empty where the cutter does not reach the layer.
    pub first: Vec<[f64; 2]>,
    /// The section at the last place, likewise.
    pub last: Vec<[f64; 2]>,
    /// Borders of everything that the edge enters on its way; an area is covered where they wind around it at all (their
    /// winding numbers are nowhere negative). Parts of `first` may be covered again.
    pub advancing: Vec<Vec<[f64; 2]>>,
    /// How both sections came about; `None` where that is not known.
    pub seams: Option<[SectionSeam; 2]>,
    /// What the ends of the envelope's branches, which are corners of `first`, add to it: parts of it along its border.
    pub caps: Vec<Vec<[f64; 2]>>,
}

/// All that a section depends on but for the ends of the envelope's branches. A step that goes on from another one begins with the seam
/// that the other one ended with, to the bit.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionSeam {
    ellipse: LayerEllipse,
    ends: [Option<TrigPolynomial<f64>>; 2],
    cuts: FluteEndCuts,
    directions: usize,
}

impl LayerSweptArea {
    /// What the family of a diagram covers. Points lie on the true borders; chords between them are within the rim's tolerance. From
    /// slices where the diagram is not resolved: see [`LayerSweptArea::from_slices`].
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
                // The section itself closes whatever the resolution of the event leaves open, and is what appears at once when an upright
                // cutter's bottom reaches the layer.
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

    /// The same without a diagram: hulls of the sections at the ends of equal slices of time. Exact where the axis stands; else a slice
    /// misses by the square of what the axis turns in it, times an eighth of the lever.
    pub fn from_slices(family: &SectionFamily, rim: &RimDirections, slices: usize) -> Self {
        time_slices::sweep_by_slices(family, rim, slices)
    }

    /// The sections at `count + 1` evenly spaced times, for a union by brute force.
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

    /// Whether nothing is entered.
    pub fn is_empty(&self) -> bool {
        self.advancing.is_empty()
    }
}

impl SectionSeam {
    fn at_time(family: &SectionFamily, rim: &RimDirections, t: f64, cuts: FluteEndCuts) -> Self {
        let ellipse = LayerEllipse { velocity: [0.0; 2], ..family.ellipse_at(t) };
        let ends = [DiagramCurve::Bottom, DiagramCurve::Top]
            .map(|curve| family.has_curve(curve).then(|| family.curve_at(curve, t)));
        Self { ellipse, ends, cuts, directions: rim.direction_count() }
    }
}

/// Angles of the envelope's branches where one stretch ends and another begins: corners of borders on both sides, which must be corners of
/// both.
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

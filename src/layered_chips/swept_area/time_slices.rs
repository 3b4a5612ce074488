//! This module computes the covered area from slices of time, for diagrams that are not resolved and as a
//! check of those that are.

use super::section_outline::{FluteEndCuts, trace_outline};
use super::{LayerSweptArea, RimDirections};
use crate::layered_chips::section_family::SectionFamily;
use geo::{ConvexHull, MultiPoint};

/// Returns the sections at the ends of the slices.
pub(super) fn trace_slice_sections(
    family: &SectionFamily,
    rim: &RimDirections,
    slices: usize,
) -> Vec<Vec<[f64; 2]>> {
    let slices = slices.max(1);
    let section =
        |index: usize| trace_outline(family, rim, index as f64 / slices as f64, FluteEndCuts::SEEN, &[]);
    (0..=slices).map(section).collect()
}

/// Computes the area as the convex hulls of the sections at both ends of each slice.
pub(super) fn sweep_by_slices(family: &SectionFamily, rim: &RimDirections, slices: usize) -> LayerSweptArea {
    let mut sections = trace_slice_sections(family, rim, slices).into_iter();
    let first = sections.next().unwrap_or_default();
    let mut last = first.clone();
    let mut advancing = Vec::new();
    for next in sections {
        let points: Vec<geo::Point> =
            last.iter().chain(&next).map(|place| geo::Point::from(*place)).collect();
        // A section that appears or disappears within the slice counts as present during the whole slice.
        let hull = MultiPoint(points).convex_hull();
        let mut border: Vec<[f64; 2]> =
            hull.exterior().points().map(|point| [point.x(), point.y()]).collect();
        border.pop();
        if border.len() > 2 {
            advancing.push(border);
        }
        last = next;
    }
    LayerSweptArea { first, last, advancing, ..LayerSweptArea::default() }
}

//! This module holds facets in a binary tree in which every node has an upper bound for the height of a
//! cutter on it.
//!
//! A node has a box seen from above, and a plane that nothing in the node exceeds. The bottom of a cutter is
//! convex, so it is above its tangent plane at any of its points. The upper plane minus a tangent plane, at
//! the highest corner of the box, is therefore a bound of the tip's height. Where the two planes are nearly
//! parallel, as at contacts, the error of the bound is of second order. So few nodes besides those of the
//! contact are examined.

use super::cutter_shape::DropCutterShape;
use super::facet_contact::Facet;
use std::ops::Range;

/// The most facets of a leaf.
const LEAF: usize = 3;

/// The steepest plane of a node. One sharp edge must not tilt the plane over a whole box.
const STEEPEST: f64 = 4.0;

/// The largest sine of the angle at which a tangent plane of the cutter is used. A vertical tangent plane at
/// the radius would give no bound.
const LEAN: f64 = 0.98;

/// A node of the tree, with the box around it and the plane above it.
#[derive(Debug, Clone, Copy)]
pub(super) struct FacetTreeNode {
    middle: [f64; 2],
    half: [f64; 2],
    slope: [f64; 2],
    /// The height of the plane over the middle of the box.
    top: f64,
    /// The index of the first of two neighbouring children, or of the first facet.
    next: u32,
    /// The number of facets of a leaf; 0 for other nodes.
    facets: u32,
}

/// The children of a node, by index.
pub(super) enum NodeChildren {
    Nodes(usize, usize),
    Facets(Range<usize>),
}

impl FacetTreeNode {
    /// Returns the children of this node.
    pub(super) fn children(&self) -> NodeChildren {
        let next = self.next as usize;
        match self.facets {
            0 => NodeChildren::Nodes(next, next + 1),
            facets => NodeChildren::Facets(next..next + facets as usize),
        }
    }

    /// Returns an upper bound of the tip's height over everything in this node, or minus infinity if nothing
    /// of it is under the cutter.
    #[inline]
    pub(super) fn tip_height_bound(&self, cutter: &DropCutterShape, [x, y]: [f64; 2]) -> f64 {
        let [dx, dy] = [self.middle[0] - x, self.middle[1] - y];
        let [ox, oy] = [(dx.abs() - self.half[0]).max(0.0), (dy.abs() - self.half[1]).max(0.0)];
        if ox * ox + oy * oy > cutter.reach_mm() * cutter.reach_mm() {
            return f64::NEG_INFINITY;
        }
        let r = (dx * dx + dy * dy).sqrt();
        let (corner, across) = (cutter.corner_radius_mm(), r - cutter.flat_radius_mm());
        let (mut top, mut tilt) = (self.top, 0.0);
        // The tangent plane of the cutter's corner at the box's middle, or at the steepest angle that is
        // used.
        if across > 0.0 && corner > 0.0 {
            let sine = (across / corner).min(LEAN);
            let cosine = (1.0 - sine * sine).sqrt();
            let rise = sine / cosine;
            top -= corner * (1.0 - cosine) + rise * (across - corner * sine);
            tilt = rise / r;
        }
        // The difference of the two planes is linear, so its maximum over the box is at a corner.
        top + (self.slope[0] - tilt * dx).abs() * self.half[0]
            + (self.slope[1] - tilt * dy).abs() * self.half[1]
    }
}

/// Sorts facets into leaves and builds the tree above them, with the root first.
pub(super) fn build_tree(facets: &mut [Facet]) -> Vec<FacetTreeNode> {
    let mut nodes = Vec::with_capacity(facets.len());
    if !facets.is_empty() {
        nodes.push(bounding_node(facets));
        grow_tree(facets, 0, 0, &mut nodes);
    }
    nodes
}

/// Adds the nodes below a node. The two children of a node are neighbours, because they are examined
/// together.
fn grow_tree(facets: &mut [Facet], first: usize, own: usize, nodes: &mut Vec<FacetTreeNode>) {
    let (count, next) = (facets.len(), nodes.len());
    let Some(parent) = nodes.get_mut(own) else { return };
    if count <= LEAF {
        (parent.next, parent.facets) = (first as u32, count as u32);
        return;
    }
    parent.next = next as u32;
    let axis = widest_axis(facets);
    let half = count / 2;
    facets.select_nth_unstable_by(half, |a, b| tripled_center(a, axis).total_cmp(&tripled_center(b, axis)));
    let (left, right) = facets.split_at_mut(half);
    nodes.extend([bounding_node(left), bounding_node(right)]);
    grow_tree(left, first, next, nodes);
    grow_tree(right, first + half, next + 1, nodes);
}

/// Returns three times the centre of a facet along an axis.
fn tripled_center(facet: &Facet, axis: usize) -> f64 {
    facet.corners.iter().filter_map(|corner| corner.get(axis)).sum()
}

/// Returns the axis along which the facets are furthest apart. This includes z, so that the bottom of a part
/// is separated from its top.
fn widest_axis(facets: &[Facet]) -> usize {
    let width = |axis: usize| {
        let (low, high) =
            facets.iter().fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high): (f64, f64), facet| {
                let center = tripled_center(facet, axis);
                (low.min(center), high.max(center))
            });
        high - low
    };
    let [x, y, z] = [0, 1, 2].map(width);
    match (x >= y, x >= z, y >= z) {
        (true, true, _) => 0,
        (false, _, true) => 1,
        _ => 2,
    }
}

/// Makes a node around some facets: the box, and a level or a tilted plane above them.
fn bounding_node(facets: &[Facet]) -> FacetTreeNode {
    let corners = || facets.iter().flat_map(|facet| facet.corners);
    let (mut low, mut high) = ([f64::INFINITY; 2], [f64::NEG_INFINITY; 2]);
    let (mut area, mut turn) = (0.0, [0.0; 2]);
    let mut highest = f64::NEG_INFINITY;
    for facet in facets {
        let [[ax, ay, _], [bx, by, _], [cx, cy, _]] = facet.corners;
        let weight = (bx - ax) * (cy - ay) - (by - ay) * (cx - ax);
        area += weight;
        turn = [turn[0] + weight * facet.slope[0], turn[1] + weight * facet.slope[1]];
        for [x, y, z] in facet.corners {
            low = [low[0].min(x), low[1].min(y)];
            high = [high[0].max(x), high[1].max(y)];
            highest = highest.max(z);
        }
    }
    let middle = [f64::midpoint(low[0], high[0]), f64::midpoint(low[1], high[1])];
    let half = [(high[0] - low[0]) / 2.0, (high[1] - low[1]) / 2.0];
    let level = FacetTreeNode { middle, half, slope: [0.0; 2], top: highest, next: 0, facets: 0 };
    // The tilted plane has the mean slope of the facets, weighted by their areas seen from above.
    let mean = turn.map(|turn| turn / area);
    let steep = mean[0].hypot(mean[1]);
    if !(steep > 0.0 && steep < f64::INFINITY) {
        return level;
    }
    let slope = mean.map(|mean| mean * (STEEPEST / steep).min(1.0));
    let above = |[x, y, z]: [f64; 3]| z - slope[0] * (x - middle[0]) - slope[1] * (y - middle[1]);
    let top = corners().map(above).fold(f64::NEG_INFINITY, f64::max);
    let reach = top + slope[0].abs() * half[0] + slope[1].abs() * half[1];
    // A tilted plane may be a little higher than the highest vertex and still give the better bound where the
    // cutter has the same slope.
    let depth = half[0].max(half[1]) * steep.min(STEEPEST);
    if reach <= highest + depth { FacetTreeNode { slope, top, ..level } } else { level }
}

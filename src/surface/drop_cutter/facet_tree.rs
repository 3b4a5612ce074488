//! Facets in a binary tree in which every node knows how high a cutter can stand on it at most.
//!
//! A node has its box from above, and a plane that nothing in it is above. The bottom of a cutter is convex, so it is above its tangent
//! plane at any of its points. Upper plane minus tangent plane, at the box's highest corner, is therefore a bound on the tip's
//! height. Where the two are nearly parallel, which is where contacts are, it is as good as second order: few nodes beside those of
//! the contact are looked at.

use super::cutter_shape::DropCutterShape;
use super::facet_contact::Facet;
use std::ops::Range;

/// Facets of a leaf at most.
const LEAF: usize = 3;

/// Planes of nodes are no steeper: one sharp edge must not tilt a plane over a whole box.
const STEEPEST: f64 = 4.0;

/// Sine of the lean at which tangent planes are laid at most: upright at the radius they would say nothing.
const LEAN: f64 = 0.98;

/// A node of the tree, the box around it, and the plane above it.
#[derive(Debug, Clone, Copy)]
pub(super) struct FacetTreeNode {
    middle: [f64; 2],
    half: [f64; 2],
    slope: [f64; 2],
    /// Height of the plane over the box's middle.
    top: f64,
    /// The first of two children beside each other, or the first facet.
    next: u32,
    /// Facets of a leaf; 0 of other nodes.
    facets: u32,
}

/// What is below a node, by number.
pub(super) enum NodeChildren {
    Nodes(usize, usize),
    Facets(Range<usize>),
}

impl FacetTreeNode {
    /// What is below this node.
    pub(super) fn children(&self) -> NodeChildren {
        let next = self.next as usize;
        match self.facets {
            0 => NodeChildren::Nodes(next, next + 1),
            facets => NodeChildren::Facets(next..next + facets as usize),
        }
    }

    /// The tip's height over anything in this node is no more; minus infinity where nothing of it is under the cutter.
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
        if across > 0.0 && corner > 0.0 {
            let sine = (across / corner).min(LEAN);
            let cosine = (1.0 - sine * sine).sqrt();
            let rise = sine / cosine;
            top -= corner * (1.0 - cosine) + rise * (across - corner * sine);
            tilt = rise / r;
        }
        top + (self.slope[0] - tilt * dx).abs() * self.half[0]
            + (self.slope[1] - tilt * dy).abs() * self.half[1]
    }
}

/// Sorts facets into leaves and makes the tree above them, the root first.
pub(super) fn build_tree(facets: &mut [Facet]) -> Vec<FacetTreeNode> {
    let mut nodes = Vec::with_capacity(facets.len());
    if !facets.is_empty() {
        nodes.push(bounding_node(facets));
        grow_tree(facets, 0, 0, &mut nodes);
    }
    nodes
}

/// Puts what is below a node behind all others: children beside each other, for they are looked at together.
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

/// Three times a facet's middle along an axis.
fn tripled_center(facet: &Facet, axis: usize) -> f64 {
    facet.corners.iter().filter_map(|corner| corner.get(axis)).sum()
}

/// The axis along which facets are farthest apart; also z, so that a bottom parts from its top.
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
    // The mean slope of what is seen from above, when that makes the plane lower at its highest corner.
    let mean = turn.map(|turn| turn / area);
    let steep = mean[0].hypot(mean[1]);
    if !(steep > 0.0 && steep < f64::INFINITY) {
        return level;
    }
    let slope = mean.map(|mean| mean * (STEEPEST / steep).min(1.0));
    let above = |[x, y, z]: [f64; 3]| z - slope[0] * (x - middle[0]) - slope[1] * (y - middle[1]);
    let top = corners().map(above).fold(f64::NEG_INFINITY, f64::max);
    let reach = top + slope[0].abs() * half[0] + slope[1].abs() * half[1];
    // A tilted plane may stand a little above the highest corner and still be the better one where the cutter leans alike.
    let depth = half[0].max(half[1]) * steep.min(STEEPEST);
    if reach <= highest + depth { FacetTreeNode { slope, top, ..level } } else { level }
}

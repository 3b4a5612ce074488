//! Cutters lowered onto a mesh: the height at which the tip first touches.
//!
//! A cutter at (x, y) touches at the point of the mesh where `z - h(r)` is largest: `r` is the point's distance from the axis and
//! `h` the height of the cutter's bottom above its tip there ([`DropCutterShape::height_at`]). Over a facet or an edge that is a concave
//! function, so its largest value is in closed form inside, or at the border: on facets, then edges, then vertices. Triangles
//! count whichever way they face: in a closed mesh one that faces down always lies under one that faces up.

mod ball_clearance;
mod cutter_shape;
mod facet_contact;
mod facet_tree;
mod line_contact;
mod path_deviation;
mod path_following;
mod simplify;
mod triangle_columns;

pub use ball_clearance::{BallClearanceField, PathClearance};
pub use cutter_shape::{CutterShapeError, DropCutterShape};
pub use path_deviation::{PathDeviation, measure_deviation};

use crate::sim::Mesh;
use facet_contact::{Facet, HighestTouch};
use facet_tree::{FacetTreeNode, NodeChildren};

/// A cutter and a mesh, sorted so that a height takes microseconds.
#[derive(Debug, Clone)]
pub struct DropCutter {
    cutter: DropCutterShape,
    /// A leaf's facets stand together.
    facets: Vec<Facet>,
    /// The first is the root.
    nodes: Vec<FacetTreeNode>,
}

/// Where a lowered cutter stands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DropPosition {
    /// Height of the cutter's tip, mm.
    pub tip_z: f64,
    /// The point of the mesh that it touches, mm; one of them where there are several.
    pub contact: [f64; 3],
    /// Unit normal there, out of the material and never downwards: a facet's own, at an edge or vertex the cutter's.
    pub normal: [f64; 3],
}

impl DropCutter {
    /// Sorts a mesh's triangles for a cutter. Takes n log n time, and some 200 bytes a triangle.
    pub fn new(mesh: &Mesh, cutter: DropCutterShape) -> Self {
        let mut facets: Vec<Facet> =
            mesh.triangle_vertices().map(|corners| Facet::new(corners, &cutter)).collect();
        let nodes = facet_tree::build_tree(&mut facets);
        Self { cutter, facets, nodes }
    }

    /// The cutter.
    pub fn cutter(&self) -> DropCutterShape {
        self.cutter
    }

    /// The lowest height of the tip over (x, y), mm, at which no part of the mesh is inside the cutter (which goes on upwards
    /// without end). None where no triangle lies under the cutter; material that only its side touches, less than 1e-6 mm from the
    /// radius, is not under it, so a cutter may go along a wall.
    ///
    /// Exact to 1e-9 mm along the surface's normal for coordinates of some metres.
    pub fn drop_at(&self, x: f64, y: f64) -> Option<DropPosition> {
        let mut best = HighestTouch::NONE;
        let root = self.nodes.first()?;
        if root.tip_height_bound(&self.cutter, [x, y]) > best.tip {
            self.lower_onto_node(0, [x, y], &mut best);
        }
        (best.tip > f64::NEG_INFINITY).then(|| DropPosition {
            tip_z: best.tip,
            contact: best.contact,
            normal: best.unit_normal(&self.cutter, [x, y]),
        })
    }

    /// Looks at everything below a node that can be higher than the best so far, the more promising child first.
    fn lower_onto_node(&self, at: usize, place: [f64; 2], best: &mut HighestTouch) {
        let Some(node) = self.nodes.get(at) else { return };
        let (first, second) = match node.children() {
            NodeChildren::Nodes(first, second) => (first, second),
            NodeChildren::Facets(leaf) => {
                for facet in self.facets.get(leaf).unwrap_or_default() {
                    facet.raise_touch(&self.cutter, place, best);
                }
                return;
            }
        };
        let bound = |child: usize| {
            self.nodes.get(child).map_or(f64::NEG_INFINITY, |node| node.tip_height_bound(&self.cutter, place))
        };
        let (mut one, mut other) = ((bound(first), first), (bound(second), second));
        if one.0 < other.0 {
            (one, other) = (other, one);
        }
        for (bound, child) in [one, other] {
            if bound > best.tip {
                self.lower_onto_node(child, place, best);
            }
        }
    }
}

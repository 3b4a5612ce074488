//! This module lowers cutters onto a mesh: it finds the height at which the tip first touches.
//!
//! A cutter at (x, y) touches the point of the mesh where `z - h(r)` is largest. Here `r` is the point's
//! distance from the axis, and `h` is the height of the cutter's bottom above its tip there
//! ([`DropCutterShape::height_at`]). Over a facet or an edge this is a concave function. So its maximum has a
//! closed form in the interior, or is on the boundary: facets come first, then edges, then vertices.
//! Triangles count whichever direction they face: in a closed mesh a triangle that faces down is always below
//! one that faces up.

mod ball_clearance;
mod cutter_shape;
mod facet_contact;
mod facet_tree;
mod line_contact;
mod path_deviation;
mod path_following;
mod simplify;
mod triangle_boxes;
mod triangle_columns;

pub(crate) use ball_clearance::BallClearanceField;
pub use cutter_shape::{CutterShapeError, DropCutterShape};
pub use path_deviation::{CutterClearanceField, PathDeviation, measure_deviation};

use crate::stock::{AirClip, Mesh};
use facet_contact::{Facet, HighestTouch};
use facet_tree::{FacetTreeNode, NodeChildren};

/// A cutter and a mesh that is sorted so that a height takes microseconds.
///
/// ```
/// use clsmith::stock::Mesh;
/// use clsmith::internals::surface::drop_cutter::{DropCutter, DropCutterShape};
///
/// // A slope of 45 degrees: the lower face of a tetrahedron does not matter to a cutter from above.
/// let corners = vec![[0.0, 0.0, 0.0], [40.0, 0.0, 0.0], [0.0, 40.0, 0.0], [0.0, 40.0, 40.0]];
/// let wedge = Mesh::new(corners, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])?;
/// let cutter = DropCutter::new(&wedge, DropCutterShape::ball(6.0)?);
/// let there = cutter.drop_at(10.0, 15.0).expect("the wedge is below");
/// assert!(there.contact_mm[2] > 0.0 && there.tip_z_mm < there.contact_mm[2]);
/// assert!(cutter.drop_at(100.0, 100.0).is_none());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct DropCutter {
    cutter: DropCutterShape,
    /// The facets; those of one leaf are together.
    facets: Vec<Facet>,
    /// The nodes of the tree; the first one is the root.
    nodes: Vec<FacetTreeNode>,
    /// Where triangles may be under the cutter.
    air: AirClip,
}

/// The position of a lowered cutter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct DropPosition {
    /// The height of the cutter's tip, mm.
    pub tip_z_mm: f64,
    /// The point of the mesh that it touches, mm; if there are several, one of them.
    pub contact_mm: [f64; 3],
    /// The unit normal there, which points out of the material and never downwards. On a facet it is the
    /// facet's normal, at an edge or vertex the cutter's.
    pub normal: [f64; 3],
}

impl DropCutter {
    /// Sorts a mesh's triangles for a cutter. For n triangles this takes n log n time and about 200 n bytes.
    pub fn new(mesh: &Mesh, cutter: DropCutterShape) -> Self {
        let mut facets: Vec<Facet> =
            mesh.triangle_vertices().map(|corners| Facet::new(corners, &cutter)).collect();
        let nodes = facet_tree::build_tree(&mut facets);
        let air = AirClip::around_from_above(mesh.bounds(), cutter.radius_mm());
        Self { cutter, facets, nodes, air }
    }

    /// Returns the cutter.
    pub fn cutter(&self) -> DropCutterShape {
        self.cutter
    }

    /// Returns the box outside of which no triangle is under the cutter.
    pub fn surroundings(&self) -> AirClip {
        self.air
    }

    /// Returns the lowest height of the tip over (x, y), mm, at which no part of the mesh is inside the
    /// cutter, which extends upwards without end. Returns `None` if no triangle is under the cutter. Material
    /// that only the side touches, less than 1e-6 mm inside the radius, is not under the cutter, so a cutter
    /// may move along a wall.
    ///
    /// The result is exact to 1e-9 mm along the surface's normal for coordinates of some metres.
    pub fn drop_at(&self, x: f64, y: f64) -> Option<DropPosition> {
        let mut best = HighestTouch::NONE;
        let root = self.nodes.first()?;
        if root.tip_height_bound(&self.cutter, [x, y]) > best.tip {
            self.lower_onto_node(0, [x, y], &mut best);
        }
        (best.tip > f64::NEG_INFINITY).then(|| DropPosition {
            tip_z_mm: best.tip,
            contact_mm: best.contact,
            normal: best.unit_normal(&self.cutter, [x, y]),
        })
    }

    /// Examines everything below a node that can be higher than the highest touch so far. The child with the
    /// higher bound comes first.
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

//! This module holds triangles in a binary tree of boxes, for distances in space.
//!
//! The tree of [`super::facet_tree`] lowers cutters and knows their shape. This one only knows boxes, so what is measured
//! with it is an independent proof.

use nalgebra::Vector3;

/// The most triangles of a leaf.
const LEAF: usize = 4;

/// A box around triangles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct TriangleBox {
    /// The lowest and the highest coordinates.
    pub low: Vector3<f64>,
    pub high: Vector3<f64>,
}

/// A node of the tree: two neighbouring children from `next`, or `count` triangles from `next`.
#[derive(Debug, Clone, Copy)]
struct BoxNode {
    around: TriangleBox,
    next: u32,
    count: u32,
}

/// Triangles in a tree of boxes. Those of one leaf are together.
#[derive(Debug, Clone)]
pub(super) struct TriangleBoxes {
    triangles: Vec<[Vector3<f64>; 3]>,
    nodes: Vec<BoxNode>,
}

impl TriangleBox {
    fn around(triangles: &[[Vector3<f64>; 3]]) -> Self {
        let none = Vector3::repeat(f64::INFINITY);
        let corners = triangles.iter().flatten();
        let (low, high) =
            corners.fold((none, -none), |(low, high), corner| (low.inf(corner), high.sup(corner)));
        Self { low, high }
    }
}

impl TriangleBoxes {
    /// Sorts triangles, in n log n time.
    pub(super) fn new(mut triangles: Vec<[Vector3<f64>; 3]>) -> Self {
        let mut nodes = Vec::with_capacity(triangles.len());
        if !triangles.is_empty() {
            nodes.push(BoxNode { around: TriangleBox::around(&triangles), next: 0, count: 0 });
            grow_tree(&mut triangles, 0, 0, &mut nodes);
        }
        Self { triangles, nodes }
    }

    /// Gives triangles to `examine` as long as their box may matter. `bound` is a lower bound of the value of all
    /// triangles in a box, and `examine` returns the value below which a bound must be. Boxes with lower bounds come
    /// first.
    pub(super) fn examine_nearest(
        &self,
        bound: &dyn Fn(&TriangleBox) -> f64,
        enough: &mut f64,
        examine: &mut dyn FnMut(&[Vector3<f64>; 3]) -> f64,
    ) {
        if self.nodes.first().is_some_and(|root| bound(&root.around) < *enough) {
            self.examine_node(0, bound, enough, examine);
        }
    }

    fn examine_node(
        &self,
        at: usize,
        bound: &dyn Fn(&TriangleBox) -> f64,
        enough: &mut f64,
        examine: &mut dyn FnMut(&[Vector3<f64>; 3]) -> f64,
    ) {
        let Some(node) = self.nodes.get(at) else { return };
        let next = node.next as usize;
        if node.count > 0 {
            for triangle in self.triangles.get(next..next + node.count as usize).unwrap_or_default() {
                if bound(&TriangleBox::around(std::slice::from_ref(triangle))) < *enough {
                    *enough = examine(triangle);
                }
            }
            return;
        }
        let value = |child: usize| self.nodes.get(child).map_or(f64::INFINITY, |node| bound(&node.around));
        let (mut one, mut other) = ((value(next), next), (value(next + 1), next + 1));
        if other.0 < one.0 {
            (one, other) = (other, one);
        }
        for (value, child) in [one, other] {
            if value < *enough {
                self.examine_node(child, bound, enough, examine);
            }
        }
    }
}

/// Adds the nodes below a node whose triangles begin at `first`.
fn grow_tree(triangles: &mut [[Vector3<f64>; 3]], first: usize, own: usize, nodes: &mut Vec<BoxNode>) {
    let (count, next) = (triangles.len(), nodes.len());
    let Some(parent) = nodes.get_mut(own) else { return };
    if count <= LEAF {
        (parent.next, parent.count) = (first as u32, count as u32);
        return;
    }
    parent.next = next as u32;
    let center = |triangle: &[Vector3<f64>; 3]| triangle.iter().sum::<Vector3<f64>>();
    let none = Vector3::repeat(f64::INFINITY);
    let (low, high) =
        triangles.iter().map(center).fold((none, -none), |(low, high), at| (low.inf(&at), high.sup(&at)));
    let axis = (high - low).imax();
    let along = |triangle: &[Vector3<f64>; 3]| center(triangle).get(axis).copied().unwrap_or_default();
    let half = count / 2;
    triangles.select_nth_unstable_by(half, |one, other| along(one).total_cmp(&along(other)));
    let (left, right) = triangles.split_at_mut(half);
    let node = |side: &[[Vector3<f64>; 3]]| BoxNode { around: TriangleBox::around(side), next: 0, count: 0 };
    nodes.extend([node(left), node(right)]);
    grow_tree(left, first, next, nodes);
    grow_tree(right, first + half, next + 1, nodes);
}

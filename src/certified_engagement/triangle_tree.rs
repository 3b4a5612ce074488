//! This module holds a tree of boxes over triangles: the nearest point, the winding number, and how far
//! triangles near a place reach in a direction.

use nalgebra::Vector3;

/// The number of triangles of a leaf.
const LEAF: usize = 4;
/// A node further away than so many of its radii counts as one dipole in the winding number.
const FAR: f64 = 3.0;

/// A node: a box, what its triangles add to winding numbers from afar, and its triangles or children.
#[derive(Debug, Clone)]
struct TreeNode {
    low: Vector3<f64>,
    high: Vector3<f64>,
    /// The sum of the triangles' area vectors, and the middle of their areas.
    area: Vector3<f64>,
    center: Vector3<f64>,
    radius: f64,
    from: usize,
    to: usize,
    /// The node behind all of this node's children; the first child is the next node.
    after: usize,
    is_leaf: bool,
}

/// The tree. Nodes are in the order of a walk.
#[derive(Debug, Clone)]
pub(super) struct TriangleTree {
    triangles: Vec<[Vector3<f64>; 3]>,
    nodes: Vec<TreeNode>,
}

fn centroid([a, b, c]: &[Vector3<f64>; 3]) -> Vector3<f64> {
    (a + b + c) / 3.0
}

fn area_of([a, b, c]: &[Vector3<f64>; 3]) -> Vector3<f64> {
    (b - a).cross(&(c - a)) / 2.0
}

impl TriangleTree {
    /// Makes the tree of at least one triangle.
    pub(super) fn new(triangles: &[[Vector3<f64>; 3]]) -> Self {
        let mut tree = Self { triangles: triangles.to_vec(), nodes: Vec::new() };
        tree.build(0, triangles.len());
        tree
    }

    fn build(&mut self, from: usize, to: usize) {
        let Some(part) = self.triangles.get_mut(from..to) else { return };
        let mut low = Vector3::repeat(f64::INFINITY);
        let mut high = Vector3::repeat(f64::NEG_INFINITY);
        let (mut area, mut center, mut size) = (Vector3::zeros(), Vector3::zeros(), 0.0);
        for triangle in part.iter() {
            for corner in triangle {
                low = low.inf(corner);
                high = high.sup(corner);
            }
            let own = area_of(triangle);
            area += own;
            center += centroid(triangle) * own.norm();
            size += own.norm();
        }
        let center = if size > 0.0 { center / size } else { (low + high) / 2.0 };
        let radius = part.iter().flatten().map(|corner| (corner - center).norm()).fold(0.0, f64::max);
        let is_leaf = part.len() <= LEAF;
        let at = self.nodes.len();
        if !is_leaf {
            let extent = high - low;
            let axis = extent.imax();
            let middle = part.len() / 2;
            let along = |triangle: &[Vector3<f64>; 3]| centroid(triangle).get(axis).copied().unwrap_or(0.0);
            part.select_nth_unstable_by(middle, |a, b| along(a).total_cmp(&along(b)));
        }
        self.nodes.push(TreeNode { low, high, area, center, radius, from, to, after: 0, is_leaf });
        if !is_leaf {
            let middle = from + (to - from) / 2;
            self.build(from, middle);
            self.build(middle, to);
        }
        let after = self.nodes.len();
        if let Some(node) = self.nodes.get_mut(at) {
            node.after = after;
        }
    }

    /// Returns the box around all triangles.
    pub(super) fn bounds(&self) -> [Vector3<f64>; 2] {
        self.nodes.first().map_or([Vector3::zeros(); 2], |node| [node.low, node.high])
    }

    fn leaf(&self, node: &TreeNode) -> &[[Vector3<f64>; 3]] {
        self.triangles.get(node.from..node.to).unwrap_or_default()
    }

    /// Returns the distance of the nearest point of all triangles, and that point.
    pub(super) fn nearest(&self, point: &Vector3<f64>) -> (f64, Vector3<f64>) {
        let mut best = (f64::INFINITY, *point);
        // A first guess from the nearer one of two children, all the way down, spares most of the walk.
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            if node.is_leaf {
                self.nearest_in_leaf(node, point, &mut best);
                break;
            }
            let first = at + 1;
            let second = self.nodes.get(first).map_or(first, |child| child.after);
            let apart =
                |number: usize| self.nodes.get(number).map_or(f64::INFINITY, |node| squared_to(node, point));
            at = if apart(first) <= apart(second) { first } else { second };
        }
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            if squared_to(node, point) >= best.0 {
                at = node.after;
                continue;
            }
            if node.is_leaf {
                self.nearest_in_leaf(node, point, &mut best);
            }
            at += 1;
        }
        (best.0.sqrt(), best.1)
    }

    fn nearest_in_leaf(&self, node: &TreeNode, point: &Vector3<f64>, best: &mut (f64, Vector3<f64>)) {
        for triangle in self.leaf(node) {
            let near = nearest_of_triangle(triangle, point);
            let squared = (near - point).norm_squared();
            if squared < best.0 {
                *best = (squared, near);
            }
        }
    }

    /// Returns the winding number of a point: 1 inside, 0 outside, to a few hundredths.
    pub(super) fn winding(&self, point: &Vector3<f64>) -> f64 {
        let mut sum = 0.0;
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            let offset = node.center - point;
            let distance = offset.norm();
            if distance > FAR * node.radius {
                sum += node.area.dot(&offset) / (distance * distance * distance);
                at = node.after;
                continue;
            }
            if node.is_leaf {
                sum += self.leaf(node).iter().map(|triangle| solid_angle(triangle, point)).sum::<f64>();
            }
            at += 1;
        }
        sum / (4.0 * std::f64::consts::PI)
    }

    /// Returns how far the triangles within a distance of a place reach in a direction: the largest product of
    /// their corners with it; minus infinity if there are none.
    pub(super) fn farthest_along(
        &self,
        place: &Vector3<f64>,
        distance: f64,
        direction: &Vector3<f64>,
    ) -> f64 {
        let mut farthest = f64::NEG_INFINITY;
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            let corner = node.low.zip_zip_map(&node.high, direction, |low, high, part| {
                if part >= 0.0 { high * part } else { low * part }
            });
            if squared_to(node, place) > distance * distance || corner.sum() <= farthest {
                at = node.after;
                continue;
            }
            if node.is_leaf {
                for triangle in self.leaf(node) {
                    if (nearest_of_triangle(triangle, place) - place).norm() <= distance {
                        let most = triangle.iter().map(|corner| corner.dot(direction));
                        farthest = most.fold(farthest, f64::max);
                    }
                }
            }
            at += 1;
        }
        farthest
    }
}

fn squared_to(node: &TreeNode, point: &Vector3<f64>) -> f64 {
    let beyond = (node.low - point).sup(&(point - node.high)).sup(&Vector3::zeros());
    beyond.norm_squared()
}

/// Returns the angle in space of a triangle as seen from a point (van Oosterom and Strackee).
fn solid_angle(triangle: &[Vector3<f64>; 3], point: &Vector3<f64>) -> f64 {
    let [a, b, c] = triangle.map(|corner| corner - point);
    let (x, y, z) = (a.norm(), b.norm(), c.norm());
    let below = x * y * z + a.dot(&b) * z + b.dot(&c) * x + c.dot(&a) * y;
    2.0 * a.dot(&b.cross(&c)).atan2(below)
}

/// Returns the point of a triangle that is nearest to a point (Ericson, Real-Time Collision Detection).
fn nearest_of_triangle([a, b, c]: &[Vector3<f64>; 3], point: &Vector3<f64>) -> Vector3<f64> {
    let (ab, ac, ap) = (b - a, c - a, point - a);
    let (d1, d2) = (ab.dot(&ap), ac.dot(&ap));
    if d1 <= 0.0 && d2 <= 0.0 {
        return *a;
    }
    let bp = point - b;
    let (d3, d4) = (ab.dot(&bp), ac.dot(&bp));
    if d3 >= 0.0 && d4 <= d3 {
        return *b;
    }
    let vc = d1 * d4 - d3 * d2;
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 && d1 - d3 > 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    let cp = point - c;
    let (d5, d6) = (ab.dot(&cp), ac.dot(&cp));
    if d6 >= 0.0 && d5 <= d6 {
        return *c;
    }
    let vb = d5 * d2 - d1 * d6;
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 && d2 - d6 > 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    let va = d3 * d6 - d5 * d4;
    if va <= 0.0 && d4 >= d3 && d5 >= d6 && (d4 - d3) + (d5 - d6) > 0.0 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    let sum = va + vb + vc;
    if sum <= 0.0 {
        return *a;
    }
    a + ab * (vb / sum) + ac * (vc / sum)
}

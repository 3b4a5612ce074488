//! This module cuts a mesh by level planes.
//!
//! Vertices in a plane count as above it, as if the plane were lower by an infinitesimal amount. So a plane
//! never meets a vertex. The point where it meets an edge is computed from the edge alone, from its lower end
//! to its upper one. So the sections of neighbouring triangles meet to the last bit, and their segments form
//! closed boundaries.

use crate::stock::Mesh;

/// A directed segment of a section, with the material to its left.
type DirectedSegment = [[f64; 2]; 2];

/// A mesh whose triangles are sorted by the level planes that they may meet.
pub(super) struct LevelMeshSections {
    corners: Vec<[[f64; 3]; 3]>,
    /// The triangles that may meet each plane.
    met: Vec<Vec<u32>>,
}

impl LevelMeshSections {
    /// Sorts the triangles of a mesh for planes at ascending heights. Time and memory grow with the number of
    /// triangles and the planes that each one meets.
    pub(super) fn new(mesh: &Mesh, heights: &[f64]) -> Self {
        let corners: Vec<[[f64; 3]; 3]> = mesh.triangle_vertices().collect();
        let mut met = vec![Vec::new(); heights.len()];
        for (index, [[_, _, a], [_, _, b], [_, _, c]]) in corners.iter().enumerate() {
            let (low, high) = (a.min(*b).min(*c), a.max(*b).max(*c));
            let [first, last] = [low, high].map(|end| heights.partition_point(|height| *height <= end));
            for triangles in met.iter_mut().take(last).skip(first) {
                triangles.push(index as u32);
            }
        }
        Self { corners, met }
    }

    /// Returns the closed boundaries in the plane with this number; they go counter-clockwise around
    /// material.
    pub(super) fn section_at(&self, number: usize, height: f64) -> Vec<Vec<[f64; 2]>> {
        let met = self.met.get(number).into_iter().flatten();
        let triangles = met.filter_map(|index| self.corners.get(*index as usize));
        chain_boundaries(triangles.filter_map(|corners| cut_triangle(corners, height)).collect())
    }
}

/// Returns the segment in which a plane meets a triangle.
fn cut_triangle(corners: &[[f64; 3]; 3], height: f64) -> Option<DirectedSegment> {
    let [a, b, c] = *corners;
    let (mut up, mut down) = (None, None);
    for [from, to] in [[a, b], [b, c], [c, a]] {
        match [from, to].map(|[_, _, z]| z >= height) {
            [false, true] => up = Some(intersect_edge(from, to, height)),
            [true, false] => down = Some(intersect_edge(to, from, height)),
            _ => {}
        }
    }
    // Seen from outside, the triangle's part above the plane begins at the edge that goes up and ends at the
    // edge that goes down. The inside is behind the triangle, so the material is to the left of the segment
    // in the opposite direction.
    Some([down?, up?]).filter(|[from, to]| from != to)
}

/// Returns where an edge, given from its lower end to its upper one, meets a plane. Minus zero becomes zero,
/// so that equal points are equal bit by bit.
fn intersect_edge([x0, y0, z0]: [f64; 3], [x1, y1, z1]: [f64; 3], height: f64) -> [f64; 2] {
    let share = (height - z0) / (z1 - z0);
    [x0 + (x1 - x0) * share, y0 + (y1 - y0) * share].map(|at| at + 0.0)
}

/// Chains segments to closed boundaries. At every point equally many segments begin and end, so each chain
/// leads back to its beginning.
fn chain_boundaries(mut pieces: Vec<DirectedSegment>) -> Vec<Vec<[f64; 2]>> {
    let order =
        |a: &[f64; 2], b: &[f64; 2]| a.iter().zip(b).map(|(a, b)| a.total_cmp(b)).find(|order| order.is_ne());
    let order = |a: &[f64; 2], b: &[f64; 2]| order(a, b).unwrap_or(std::cmp::Ordering::Equal);
    pieces.sort_unstable_by(|a, b| order(&a[0], &b[0]).then(order(&a[1], &b[1])));
    // For each first segment at a point: the index from which on an unused segment with the same beginning
    // may be found.
    let mut next: Vec<usize> = (0..pieces.len()).collect();
    let mut used = vec![false; pieces.len()];
    let mut found = Vec::new();
    for start in 0..pieces.len() {
        let mut border = Vec::new();
        let mut at = Some(start);
        while let Some(index) = at.filter(|index| used.get(*index) == Some(&false)) {
            let Some([from, to]) = pieces.get(index) else { break };
            border.push(*from);
            if let Some(used) = used.get_mut(index) {
                *used = true;
            }
            let first = pieces.partition_point(|[other, _]| order(other, to).is_lt());
            // All segments before `free` are used.
            let free = next.get(first).copied().unwrap_or(first);
            let more = pieces.iter().enumerate().skip(free).take_while(|(_, [other, _])| other == to);
            at = more.map(|(index, _)| index).find(|index| used.get(*index) == Some(&false));
            if let Some((next, at)) = next.get_mut(first).zip(at) {
                *next = at;
            }
        }
        if border.len() >= 3 {
            found.push(border);
        }
    }
    found
}

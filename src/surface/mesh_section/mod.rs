//! Vertical sections of a mesh: its topmost line in a plane.
//!
//! Corners within 1e-9 mm of the plane are counted to one of its sides, and in a second look to the other: two sections next to the
//! plane, and the top of both is the closed solid's. So a wall in the plane has its top, whichever side the solid is on.
//! A place where an edge goes through is computed from the edge alone and from its lower side to its upper, so neighbouring triangles meet
//! to the last bit.

mod envelope;

use crate::sim::Mesh;
use envelope::SectionSegment;

/// A corner this near to a plane lies in it, mm: some rounding at coordinates of metres.
const IN_PLANE: f64 = 1e-9;

/// Slabs at most: a bound on memory for mixed sizes of triangles.
const SLABS: usize = 1 << 20;

/// A mesh sorted for sections by parallel planes.
///
/// A plane holds the z direction and a direction u at `angle` from x; `offset` is its distance from the origin to the left of u:
/// (x, y) = u (cos, sin) + offset (-sin, cos).
#[derive(Debug, Clone)]
pub struct VerticalMeshSections {
    direction: [f64; 2],
    low: f64,
    width: f64,
    slabs: Vec<Vec<u32>>,
    /// Corners as u, offset, z.
    triangles: Vec<[[f64; 3]; 3]>,
}

impl VerticalMeshSections {
    /// Sorts a mesh's triangles for planes at an angle from x, radians. Takes time and memory in proportion to them.
    pub fn new(mesh: &Mesh, angle: f64) -> Self {
        let (sin, cos) = angle.sin_cos();
        let turned = |[x, y, z]: [f64; 3]| [x * cos + y * sin, y * cos - x * sin, z];
        let triangles: Vec<[[f64; 3]; 3]> =
            mesh.triangle_vertices().map(|corners| corners.map(turned)).collect();
        let (mut low, mut high, mut wide) = (f64::INFINITY, f64::NEG_INFINITY, 0.0);
        for triangle in &triangles {
            let (from, to) = triangle_offset_range(triangle);
            (low, high, wide) = (low.min(from), high.max(to), wide + (to - from));
        }
        // As wide as a triangle on the average, so that most are in two.
        let width = (wide / triangles.len() as f64).max((high - low) / SLABS as f64).max(IN_PLANE);
        let mut slabs = vec![Vec::new(); ((high - low) / width) as usize + 1];
        for (index, triangle) in triangles.iter().enumerate() {
            let (from, to) = triangle_offset_range(triangle);
            let [first, last] =
                [from - IN_PLANE, to + IN_PLANE].map(|v| ((v - low) / width).max(0.0) as usize);
            for slab in slabs.iter_mut().take(last + 1).skip(first) {
                slab.push(index as u32);
            }
        }
        Self { direction: [cos, sin], low, width, slabs, triangles }
    }

    /// The direction of u: a unit vector in x and y.
    pub fn direction(&self) -> [f64; 2] {
        self.direction
    }

    /// The point in space of a point (u, z) in the plane at an offset.
    pub fn point_at(&self, offset: f64, [u, z]: [f64; 2]) -> [f64; 3] {
        let [cos, sin] = self.direction;
        [u * cos - offset * sin, u * sin + offset * cos, z]
    }

    /// Least and largest offset of the mesh.
    pub fn offset_range(&self) -> (f64, f64) {
        self.triangles
            .iter()
            .map(triangle_offset_range)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (from, to)| (low.min(from), high.max(to)))
    }

    /// The topmost line of the mesh in the plane at an offset, mm: chains of (u, z) with u never falling, one for each stretch with
    /// material, in order. Steps are upright pieces. A mesh that only touches the plane with a vertex or a level edge across has none.
    pub fn section_at(&self, offset: f64) -> Vec<Vec<[f64; 2]>> {
        let slab = (offset - self.low) / self.width;
        // Also none when the offset is not a number. An offset a rounding beyond the last slab's end is looked for in it.
        if !(slab >= -1.0 && slab <= self.slabs.len() as f64 + 1.0) {
            return Vec::new();
        }
        let slab = (slab.max(0.0) as usize).min(self.slabs.len().saturating_sub(1));
        let mut pieces: Vec<SectionSegment> = Vec::new();
        let indices = self.slabs.get(slab).into_iter().flatten();
        for triangle in indices.filter_map(|index| self.triangles.get(*index as usize)) {
            let before = cut_triangle(triangle, offset, |v| v >= offset - IN_PLANE);
            let behind = cut_triangle(triangle, offset, |v| v > offset + IN_PLANE);
            pieces.extend(before);
            // The same when no corner is in the plane.
            pieces.extend(behind.filter(|_| before != behind));
        }
        envelope::chain_segments(envelope::find_upper_envelope(&pieces))
    }
}

/// The topmost line of a mesh in one vertical plane: see [`VerticalMeshSections::section_at`], which is faster for several.
pub fn section_mesh(mesh: &Mesh, angle: f64, offset: f64) -> Vec<Vec<[f64; 2]>> {
    VerticalMeshSections::new(mesh, angle).section_at(offset)
}

/// Least and largest offset.
fn triangle_offset_range(triangle: &[[f64; 3]; 3]) -> (f64, f64) {
    let [a, b, c] = triangle.map(|[_, v, _]| v);
    (a.min(b).min(c), a.max(b).max(c))
}

/// The piece in which a plane cuts a triangle whose corners are beyond it or not, if there is one that is not upright.
fn cut_triangle(
    triangle: &[[f64; 3]; 3],
    offset: f64,
    beyond: impl Fn(f64) -> bool,
) -> Option<SectionSegment> {
    let [a, b, c] = *triangle;
    let mut ends = [[a, b], [b, c], [c, a]].into_iter().filter_map(|[from, to]| {
        let [before, behind] = match (beyond(from[1]), beyond(to[1])) {
            (false, true) => [from, to],
            (true, false) => [to, from],
            _ => return None,
        };
        let share = ((offset - before[1]) / (behind[1] - before[1])).clamp(0.0, 1.0);
        // Exact at both ends.
        let meet = |from: f64, to: f64| if share >= 1.0 { to } else { from + (to - from) * share };
        Some([meet(before[0], behind[0]), meet(before[2], behind[2])])
    });
    SectionSegment::new(ends.next()?, ends.next()?)
}

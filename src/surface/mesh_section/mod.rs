//! This module cuts a mesh by vertical planes and returns its topmost line in each plane.
//!
//! Vertices within 1e-9 mm of the plane count to one side of it, and in a second pass to the other side. This
//! gives two sections next to the plane, and the upper envelope of both is that of the closed solid. So a
//! wall in the plane has its top in the result, whichever side the solid is on. The point where the plane
//! meets an edge is computed from the edge alone, from its lower side to its upper side, so neighbouring
//! triangles meet to the last bit.

mod envelope;

use crate::stock::Mesh;
use envelope::SectionSegment;

/// The distance within which a vertex is in a plane, mm. It is a few roundings at coordinates of metres.
const IN_PLANE: f64 = 1e-9;

/// The most slabs, which bounds the memory for triangles of mixed sizes.
const SLABS: usize = 1 << 20;

/// A mesh that is sorted for sections by parallel vertical planes.
///
/// A plane contains the z direction and a direction u at `angle` from x. `offset` is its distance from the
/// origin to the left of u: (x, y) = u (cos, sin) + offset (-sin, cos).
#[derive(Debug, Clone)]
pub struct VerticalMeshSections {
    direction: [f64; 2],
    low: f64,
    width: f64,
    slabs: Vec<Vec<u32>>,
    /// The vertices of each triangle as u, offset and z.
    triangles: Vec<[[f64; 3]; 3]>,
}

impl VerticalMeshSections {
    /// Sorts a mesh's triangles for planes at an angle from x, radians. Time and memory grow in proportion to
    /// their number.
    pub fn new(mesh: &Mesh, angle_rad: f64) -> Self {
        let (sin, cos) = angle_rad.sin_cos();
        let turned = |[x, y, z]: [f64; 3]| [x * cos + y * sin, y * cos - x * sin, z];
        let triangles: Vec<[[f64; 3]; 3]> =
            mesh.triangle_vertices().map(|corners| corners.map(turned)).collect();
        let (mut low, mut high, mut wide) = (f64::INFINITY, f64::NEG_INFINITY, 0.0);
        for triangle in &triangles {
            let (from, to) = triangle_offset_range(triangle);
            (low, high, wide) = (low.min(from), high.max(to), wide + (to - from));
        }
        // A slab is as wide as a triangle on average, so that most triangles are in two slabs.
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

    /// Returns the direction of u: a unit vector in x and y.
    pub fn direction(&self) -> [f64; 2] {
        self.direction
    }

    /// Returns the point in space of a point (u, z) in the plane at an offset.
    pub fn point_at(&self, offset_mm: f64, [u, z]: [f64; 2]) -> [f64; 3] {
        let [cos, sin] = self.direction;
        [u * cos - offset_mm * sin, u * sin + offset_mm * cos, z]
    }

    /// Returns the least and the largest offset of the mesh.
    pub fn offset_range(&self) -> (f64, f64) {
        self.triangles
            .iter()
            .map(triangle_offset_range)
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), (from, to)| (low.min(from), high.max(to)))
    }

    /// Returns the topmost line of the mesh in the plane at an offset, mm: chains of (u, z) whose u never
    /// falls, one for each part with material, in order. Steps are vertical segments. A mesh that only
    /// touches the plane with a vertex or a level edge across it has none.
    pub fn section_at(&self, offset_mm: f64) -> Vec<Vec<[f64; 2]>> {
        let slab = (offset_mm - self.low) / self.width;
        // The condition is also false if the offset is not a number. An offset slightly beyond the last slab
        // belongs to it.
        if !(slab >= -1.0 && slab <= self.slabs.len() as f64 + 1.0) {
            return Vec::new();
        }
        let slab = (slab.max(0.0) as usize).min(self.slabs.len().saturating_sub(1));
        let mut pieces: Vec<SectionSegment> = Vec::new();
        let indices = self.slabs.get(slab).into_iter().flatten();
        for triangle in indices.filter_map(|index| self.triangles.get(*index as usize)) {
            let before = cut_triangle(triangle, offset_mm, |v| v >= offset_mm - IN_PLANE);
            let behind = cut_triangle(triangle, offset_mm, |v| v > offset_mm + IN_PLANE);
            pieces.extend(before);
            // Both are the same if no vertex is in the plane.
            pieces.extend(behind.filter(|_| before != behind));
        }
        envelope::chain_segments(envelope::find_upper_envelope(&pieces))
    }
}

/// Returns the topmost line of a mesh in one vertical plane; see [`VerticalMeshSections::section_at`], which
/// is faster for several planes.
///
/// ```
/// use clsmith::stock::Mesh;
/// use clsmith::internals::surface::mesh_section::section_mesh;
///
/// let corners = vec![[0.0, 0.0, 0.0], [8.0, 0.0, 0.0], [0.0, 8.0, 0.0], [0.0, 0.0, 8.0]];
/// let tetrahedron = Mesh::new(corners, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]])?;
/// // The vertical plane along x at y = 2.
/// let lines = section_mesh(&tetrahedron, 0.0, 2.0);
/// let highest = lines.iter().flatten().map(|[_, z]| *z).fold(f64::MIN, f64::max);
/// assert!((highest - 6.0).abs() < 1e-9);
/// # Ok::<(), clsmith::stock::MeshError>(())
/// ```
pub fn section_mesh(mesh: &Mesh, angle_rad: f64, offset_mm: f64) -> Vec<Vec<[f64; 2]>> {
    VerticalMeshSections::new(mesh, angle_rad).section_at(offset_mm)
}

/// Returns the least and the largest offset of a triangle.
fn triangle_offset_range(triangle: &[[f64; 3]; 3]) -> (f64, f64) {
    let [a, b, c] = triangle.map(|[_, v, _]| v);
    (a.min(b).min(c), a.max(b).max(c))
}

/// Returns the segment in which a plane cuts a triangle, if there is one that is not vertical. `beyond` says
/// on which side of the plane an offset is.
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
        // The values are exact at both ends.
        let meet = |from: f64, to: f64| if share >= 1.0 { to } else { from + (to - from) * share };
        Some([meet(before[0], behind[0]), meet(before[2], behind[2])])
    });
    SectionSegment::new(ends.next()?, ends.next()?)
}

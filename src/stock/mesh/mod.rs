//! This module holds closed triangle meshes: a casting as stock, or the target part.

mod closed_check;
mod mesh_dexels;
mod stl;

use crate::number::format_point;
use crate::stock::NoMemory;
use crate::stock::axis_box::{AxisBox, FARTHEST};

/// A closed triangle mesh in mm. A point is inside where the winding number of the surface is not zero: so
/// nested or overlapping shells are one solid, and a shell that is turned inside out within another one is a
/// hollow.
///
/// ```
/// use clsmith::stock::{Mesh, MeshError};
///
/// let corners = vec![[0.0, 0.0, 0.0], [6.0, 0.0, 0.0], [0.0, 6.0, 0.0], [0.0, 0.0, 6.0]];
/// let faces = vec![[0, 2, 1], [0, 1, 3], [0, 3, 2], [1, 2, 3]];
/// let tetrahedron = Mesh::new(corners.clone(), faces)?;
/// assert!((tetrahedron.volume_mm3() - 36.0).abs() < 1e-9);
/// // A face is missing.
/// let open = Mesh::new(corners, vec![[0, 2, 1], [0, 1, 3], [0, 3, 2]]);
/// assert!(matches!(open, Err(MeshError::Open { edges: 3, .. })));
/// # Ok::<(), clsmith::stock::MeshError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

/// The reason why bytes or triangles are not a mesh that bounds a solid.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum MeshError {
    /// The file is not an STL file, or it is damaged.
    #[error("this is no STL that can be read: {reason}")]
    Stl {
        /// The reader's message.
        reason: String,
    },
    /// The length of a binary STL file does not fit the number of triangles that it states.
    #[error("a binary STL of {triangles} triangles has {expected} bytes, but this file has {found}")]
    Length {
        /// The number of triangles that the file states.
        triangles: u32,
        /// The length in bytes that this number needs.
        expected: u64,
        /// The length of the file in bytes.
        found: u64,
    },
    /// There is no triangle, or there are only triangles without area.
    #[error("there is no triangle in it")]
    Empty,
    /// A triangle has a coordinate that is not finite or lies farther out than any workpiece.
    #[error("triangle {triangle} has a coordinate that is not finite, or farther than {FARTHEST:e} mm")]
    NotFinite {
        /// The triangle's number, counted from 1.
        triangle: usize,
    },
    /// There is no memory for the triangles.
    #[error(transparent)]
    NoMemory(#[from] NoMemory),
    /// A triangle names a vertex that does not exist.
    #[error("triangle {triangle} names a vertex that does not exist")]
    Vertex {
        /// The triangle's number, counted from 1.
        triangle: usize,
    },
    /// The surface has holes, so it has no inside.
    #[error(
        "the surface is not closed: {edges} edges have a triangle on one side only, one of them at {}",
        format_point(*at, 3)
    )]
    Open {
        /// The number of edges that have a triangle on one side only.
        edges: usize,
        /// The middle of one of them, mm.
        at: [f64; 3],
    },
    /// Neighbouring triangles disagree about which side is outside.
    #[error(
        "neighbouring triangles face opposite sides at {edges} edges, one of them at {}",
        format_point(*at, 3)
    )]
    Turned {
        /// The number of edges at which this is so.
        edges: usize,
        /// The middle of one of them, mm.
        at: [f64; 3],
    },
}

impl Mesh {
    /// Makes a mesh from vertices in mm and triangles whose vertices go counter-clockwise seen from outside.
    /// Two vertices are the same only if they have the same index. Triangles that name a vertex twice are
    /// left out.
    ///
    /// # Errors
    /// Returns an error unless the triangles pass every edge equally often in both directions. An edge
    /// parallel to an axis may meet several shorter ones.
    pub fn new(mut vertices: Vec<[f64; 3]>, mut triangles: Vec<[u32; 3]>) -> Result<Self, MeshError> {
        for (index, triangle) in triangles.iter().enumerate() {
            for vertex in triangle {
                let vertex = vertices.get(*vertex as usize);
                let vertex = vertex.ok_or(MeshError::Vertex { triangle: index + 1 })?;
                if !vertex.iter().all(|value| value.abs() <= FARTHEST) {
                    return Err(MeshError::NotFinite { triangle: index + 1 });
                }
            }
        }
        triangles.retain(|[a, b, c]| a != b && b != c && c != a);
        if triangles.is_empty() {
            return Err(MeshError::Empty);
        }
        // Edges are compared bit by bit, so minus zero becomes zero.
        vertices.iter_mut().flatten().for_each(|value| *value += 0.0);
        let mesh = Self { vertices, triangles };
        closed_check::check_closed(&mesh)?;
        Ok(mesh)
    }

    /// Returns the corners of all triangles, mm, counter-clockwise seen from outside.
    pub(crate) fn triangle_corners(&self) -> impl Iterator<Item = [[f64; 3]; 3]> + '_ {
        self.triangle_vertices()
    }

    /// Returns the vertices, mm.
    pub(crate) fn vertices(&self) -> &[[f64; 3]] {
        &self.vertices
    }

    /// Returns the triangles, as places in the vertices.
    pub(crate) fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }

    /// Returns the number of triangles.
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// Returns the lowest and the highest vertex of the box around the mesh, mm.
    pub fn bounds(&self) -> AxisBox {
        let mut bounds = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for corners in self.triangle_vertices() {
            for corner in corners {
                let [x, y, z] = corner;
                let ([x0, y0, z0], [x1, y1, z1]) = bounds;
                bounds = ([x0.min(x), y0.min(y), z0.min(z)], [x1.max(x), y1.max(y), z1.max(z)]);
            }
        }
        bounds
    }

    /// Returns the same mesh with every length multiplied by a factor, for a file in inches.
    ///
    /// # Errors
    /// Returns an error if the factor is not positive or a coordinate would not be finite.
    pub fn scaled(&self, factor: f64) -> Result<Self, MeshError> {
        let factor = if factor > 0.0 { factor } else { f64::NAN };
        let vertices = self.vertices.iter().map(|vertex| vertex.map(|value| value * factor)).collect();
        Self::new(vertices, self.triangles.clone())
    }

    /// Returns the volume by the divergence theorem, mm3. It is exact for shells that do not overlap, and
    /// negative for a shell that is turned inside out.
    pub fn volume_mm3(&self) -> f64 {
        let volume = |[a, b, c]: [[f64; 3]; 3]| {
            let [a, b, c] = [a, b, c].map(nalgebra::Vector3::from);
            // The signed volume of the tetrahedron from the origin to the triangle.
            a.dot(&b.cross(&c)) / 6.0
        };
        self.triangle_vertices().map(volume).sum()
    }

    /// Returns the vertices of every triangle, mm, counter-clockwise seen from outside.
    pub(crate) fn triangle_vertices(&self) -> impl Iterator<Item = [[f64; 3]; 3]> + '_ {
        self.triangles.iter().map(|triangle| self.vertices_of(*triangle))
    }

    /// Returns the vertices of one triangle.
    fn vertices_of(&self, triangle: [u32; 3]) -> [[f64; 3]; 3] {
        triangle.map(|vertex| {
            let vertex = self.vertices.get(vertex as usize);
            debug_assert!(vertex.is_some(), "all indices were checked when the mesh was made");
            vertex.copied().unwrap_or_default()
        })
    }
}

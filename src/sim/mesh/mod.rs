//! Closed triangle meshes: a casting as stock, or the part that shall come out.

mod closed_check;
mod mesh_dexels;
mod stl;

use super::body::FARTHEST;

/// A closed mesh; mm. Inside is where shells wind around: nested or overlapping ones are one solid, one turned inside out inside
/// another is a hollow.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

/// Why bytes or triangles are no mesh that bounds a solid.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeshError {
    /// No STL, or a damaged one.
    #[error("this is no STL that can be read: {reason}")]
    Stl {
        /// What the reader says.
        reason: String,
    },
    /// A binary STL whose length is not what its own count of triangles asks for.
    #[error("a binary STL of {triangles} triangles has {expected} bytes, but this file has {found}")]
    Length {
        /// The count in its head.
        triangles: u32,
        /// What the length would be.
        expected: u64,
        /// What it is.
        found: u64,
    },
    /// No triangle, or only triangles without area.
    #[error("there is no triangle in it")]
    Empty,
    /// A corner that is no point, or farther away than any workpiece reaches.
    #[error("triangle {triangle} has a coordinate that is not finite, or farther than {FARTHEST:e} mm")]
    NotFinite {
        /// Which one, counted from 1.
        triangle: usize,
    },
    /// A triangle that names a vertex which does not exist.
    #[error("triangle {triangle} names a vertex that does not exist")]
    Vertex {
        /// Which one, counted from 1.
        triangle: usize,
    },
    /// It has holes, so nothing is inside.
    #[error(
        "the surface is not closed: {edges} edges have a triangle on one side only, one of them at {}",
        format_point(at)
    )]
    Open {
        /// How many edges.
        edges: usize,
        /// Middle of one of them.
        at: [f64; 3],
    },
    /// Neighbours disagree about which side is outside.
    #[error(
        "neighbouring triangles face opposite sides at {edges} edges, one of them at {}",
        format_point(at)
    )]
    Turned {
        /// How many edges.
        edges: usize,
        /// Middle of one of them.
        at: [f64; 3],
    },
}

fn format_point([x, y, z]: &[f64; 3]) -> String {
    format!("({x:.3}, {y:.3}, {z:.3})")
}

impl Mesh {
    /// A mesh from vertices (mm) and triangles that go counter-clockwise seen from outside. Vertices are the same only when their
    /// index is. Triangles that name a vertex twice are left out.
    ///
    /// # Errors
    /// Unless every edge is passed as often one way as the other. An edge parallel to an axis may meet several shorter ones.
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
        // Minus zero is zero, also bit by bit.
        vertices.iter_mut().flatten().for_each(|value| *value += 0.0);
        let mesh = Self { vertices, triangles };
        closed_check::check_closed(&mesh)?;
        Ok(mesh)
    }

    /// How many triangles.
    pub fn triangle_count(&self) -> usize {
        self.triangles.len()
    }

    /// Lower and upper corner of the box around it.
    pub fn bounds(&self) -> ([f64; 3], [f64; 3]) {
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

    /// The same with every length multiplied, for a file in inches.
    ///
    /// # Errors
    /// When the factor is not positive or a coordinate would not be finite.
    pub fn scaled(&self, factor: f64) -> Result<Self, MeshError> {
        let factor = if factor > 0.0 { factor } else { f64::NAN };
        let vertices = self.vertices.iter().map(|vertex| vertex.map(|value| value * factor)).collect();
        Self::new(vertices, self.triangles.clone())
    }

    /// Volume by the divergence theorem, mm3: exact for shells that do not overlap, negative for one turned inside out.
    pub fn volume_mm3(&self) -> f64 {
        let volume = |[a, b, c]: [[f64; 3]; 3]| {
            let [a, b, c] = [a, b, c].map(nalgebra::Vector3::from);
            a.dot(&b.cross(&c)) / 6.0
        };
        self.triangle_vertices().map(volume).sum()
    }

    /// The corners of every triangle, mm, counter-clockwise seen from outside.
    pub(crate) fn triangle_vertices(&self) -> impl Iterator<Item = [[f64; 3]; 3]> + '_ {
        self.triangles.iter().map(|triangle| self.vertices_of(*triangle))
    }

    fn vertices_of(&self, triangle: [u32; 3]) -> [[f64; 3]; 3] {
        // All indices were checked when the mesh was made.
        triangle.map(|vertex| self.vertices.get(vertex as usize).copied().unwrap_or_default())
    }
}

//! This module holds the frame in which layers are z = const, and sees stock and tools from it.

use super::stack::LayerStackError;
use crate::engagement::PathPiece;
use crate::program::geometry::Pose;
use crate::stock::{Mesh, SolidBody, Stock};
use nalgebra::{Matrix3, Point3, Vector3};
use std::sync::Arc;

/// The length of the difference of two unit vectors below which they count as the same direction. It moves a point at
/// 100 m by 0.0001 mm.
const SAME_DIRECTION: f64 = 1e-9;

/// The triangles of a block over its corners, which are numbered by bits: 1 for high x, 2 for high y, 4 for high z. They go
/// counter-clockwise seen from outside.
const BLOCK_TRIANGLES: [[u32; 3]; 12] = [
    [0, 2, 3],
    [0, 3, 1],
    [4, 5, 7],
    [4, 7, 6],
    [0, 1, 5],
    [0, 5, 4],
    [2, 6, 7],
    [2, 7, 3],
    [0, 4, 6],
    [0, 6, 2],
    [1, 3, 7],
    [1, 7, 5],
];

/// A frame with the origin of the workpiece frame and other axes. Layers lie across its z.
///
/// ```
/// use clsmith::layered_chips::LayerFrame;
/// use nalgebra::{Point3, Vector3};
///
/// let frame = LayerFrame::across(&Vector3::x()).expect("a direction");
/// // Layers lie across the workpiece's x; in them, y and z are what x and y usually are.
/// assert_eq!(frame.from_workpiece(&Point3::new(1.0, 2.0, 3.0)), Point3::new(2.0, 3.0, 1.0));
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayerFrame {
    /// The axes in the workpiece frame, as rows.
    rows: Matrix3<f64>,
}

impl LayerFrame {
    /// The workpiece frame itself.
    pub const WORKPIECE: Self = Self { rows: Matrix3::new(1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0) };

    /// Makes the frame whose z is this direction and whose x is as near to the workpiece's x as possible, or near to its
    /// y if the direction is nearer to x than 30 degrees. Returns `None` for a direction without length.
    pub fn across(direction: &Vector3<f64>) -> Option<Self> {
        let z = direction.try_normalize(1e-12)?;
        let near = if z.x.abs() > 0.75_f64.sqrt() { Vector3::y() } else { Vector3::x() };
        Self::with_axes(&near, &z)
    }

    /// Makes the frame whose z is a direction and whose x is as near to another one as possible. Returns `None` if they do
    /// not tell it: one has no length, or both are the same.
    pub fn with_axes(x: &Vector3<f64>, z: &Vector3<f64>) -> Option<Self> {
        let z = z.try_normalize(1e-12)?;
        if (z - Vector3::z()).norm() < SAME_DIRECTION && (x - Vector3::x()).norm() < SAME_DIRECTION {
            return Some(Self::WORKPIECE);
        }
        let x = (x - z * x.dot(&z)).try_normalize(1e-9)?;
        let y = z.cross(&x);
        Some(Self { rows: Matrix3::from_rows(&[x.transpose(), y.transpose(), z.transpose()]) })
    }

    /// Returns its axes x, y and z in the workpiece frame.
    pub fn axes(&self) -> [[f64; 3]; 3] {
        [0, 1, 2].map(|row| Vector3::from(self.rows.row(row).transpose()).into())
    }

    /// Returns whether it is the workpiece frame.
    pub fn is_workpiece(&self) -> bool {
        *self == Self::WORKPIECE
    }

    /// Returns a point of the workpiece frame as it stands in this one.
    pub fn from_workpiece(&self, point: &Point3<f64>) -> Point3<f64> {
        if self.is_workpiece() { *point } else { self.rows * point }
    }

    /// Returns a point of this frame as it stands in the workpiece frame.
    pub fn to_workpiece(&self, point: &Point3<f64>) -> Point3<f64> {
        if self.is_workpiece() { *point } else { self.rows.transpose() * point }
    }

    /// Returns a pose of the workpiece frame as it stands in this one.
    pub(crate) fn turn_pose(&self, pose: &Pose) -> Pose {
        if self.is_workpiece() {
            return *pose;
        }
        Pose { point: self.rows * pose.point, axis: self.rows * pose.axis }
    }

    /// Returns a piece of path of the workpiece frame as it stands in this one.
    pub(crate) fn turn_piece(&self, piece: &PathPiece) -> PathPiece {
        PathPiece { from: self.turn_pose(&piece.from), to: self.turn_pose(&piece.to), cutter: piece.cutter }
    }

    /// Returns the stock as it stands in this frame. Its bodies have their allowance in them; blocks become meshes.
    ///
    /// # Errors
    /// Returns an error for a mesh with an allowance, for a mesh that is not closed edge by edge once no edge is parallel
    /// to an axis any more, and for remains, whose columns stand along the workpiece's z.
    pub(crate) fn turn_stock(&self, stock: &Stock) -> Result<Stock, LayerStackError> {
        if self.is_workpiece() {
            return Ok(stock.clone());
        }
        let allowance = stock.allowance_mm();
        let bodies = stock.bodies().iter().map(|body| self.turn_body(body, allowance));
        let bodies: Vec<SolidBody> = bodies.collect::<Result<_, _>>()?;
        Stock::new(bodies, 0.0).map_err(|_| LayerStackError::Turned)
    }

    fn turn_body(&self, body: &SolidBody, allowance: f64) -> Result<SolidBody, LayerStackError> {
        let turn = |at: [f64; 3]| <[f64; 3]>::from((self.rows * Point3::from(at)).coords);
        let mesh = |vertices: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>| {
            let mesh = Mesh::new(vertices, triangles).map_err(|_| LayerStackError::Turned)?;
            Ok(SolidBody::Mesh(Arc::new(mesh)))
        };
        match body {
            SolidBody::Block { from, to } => {
                let (low, high) = (from.map(|at| at - allowance), to.map(|at| at + allowance));
                let corner = |number: usize| {
                    let pick =
                        |side: usize, low: f64, high: f64| if number >> side & 1 == 1 { high } else { low };
                    let ([x0, y0, z0], [x1, y1, z1]) = (low, high);
                    turn([pick(0, x0, x1), pick(1, y0, y1), pick(2, z0, z1)])
                };
                mesh((0..8).map(corner).collect(), BLOCK_TRIANGLES.to_vec())
            }
            SolidBody::Cylinder { diameter, from, to } => {
                let [start, end] = [*from, *to].map(Vector3::from);
                let more = (end - start).try_normalize(0.0).unwrap_or_default() * allowance;
                let [from, to] = [start - more, end + more].map(|at| turn(at.into()));
                Ok(SolidBody::Cylinder { diameter: diameter + 2.0 * allowance, from, to })
            }
            SolidBody::Mesh(_) if allowance > 0.0 => Err(LayerStackError::Allowance { allowance }),
            SolidBody::Mesh(given) => {
                let vertices = given.vertices().iter().map(|at| turn(*at)).collect();
                mesh(vertices, given.triangles().to_vec())
            }
            SolidBody::Remains(_) => Err(LayerStackError::Remains),
        }
    }
}

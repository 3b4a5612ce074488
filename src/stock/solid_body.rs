//! This module holds the bodies that stock is made of, in closed form where they have one.

use crate::stock::axis_box::{AxisBox, FARTHEST};
use crate::stock::stock_error::StockError;
use crate::stock::{Dexels, Mesh};
use nalgebra::Vector3;
use std::sync::Arc;

/// One body of the stock; lengths are in mm in the workpiece frame.
#[derive(Debug, Clone, PartialEq)]
pub enum SolidBody {
    /// A box along the axes.
    Block {
        /// The corner with the lowest coordinates.
        from: [f64; 3],
        /// The corner with the highest coordinates.
        to: [f64; 3],
    },
    /// A round bar in any direction.
    Cylinder {
        /// The diameter.
        diameter: f64,
        /// The centre of one end.
        from: [f64; 3],
        /// The centre of the other end.
        to: [f64; 3],
    },
    /// Any closed surface, such as a casting or a forging.
    Mesh(Arc<Mesh>),
    /// The stock that an earlier program left.
    Remains(Arc<Dexels>),
}

impl SolidBody {
    /// Checks that the body's numbers are finite and that it has volume.
    ///
    /// # Errors
    /// Returns an error if a number is not finite or the body has no volume.
    pub(super) fn check_volume(&self) -> Result<(), StockError> {
        match self {
            Self::Block { from, to } if from.iter().zip(to).all(|(from, to)| to - from > 0.0) => {
                check_finite(from.iter().chain(to))
            }
            Self::Block { from, to } => check_finite(from.iter().chain(to)).and(Err(StockError::Block)),
            Self::Cylinder { diameter, from, to } => {
                check_finite(from.iter().chain(to).chain([diameter]))?;
                let length = (Vector3::from(*to) - Vector3::from(*from)).norm();
                if *diameter > 0.0 && length > 0.0 { Ok(()) } else { Err(StockError::Cylinder) }
            }
            Self::Mesh(_) | Self::Remains(_) => Ok(()),
        }
    }

    /// Returns the box around the body grown by an allowance in mm, or `None` for remains without material.
    pub(super) fn grown_bounds(&self, allowance: f64) -> Option<AxisBox> {
        let (from, to) = match self {
            Self::Block { from, to } => (*from, *to),
            Self::Mesh(mesh) => mesh.bounds(),
            Self::Remains(dexels) => remains_bounds(dexels)?,
            Self::Cylinder { .. } => {
                let bar = self.grown_cylinder(allowance)?;
                let other = bar.from + bar.axis * bar.length;
                // A disc across the unit vector a reaches R sqrt(1 - a_i^2) along axis i.
                let across = bar.axis.map(|part| bar.radius * (1.0 - part * part).max(0.0).sqrt());
                return Some((
                    (bar.from.inf(&other) - across).into(),
                    (bar.from.sup(&other) + across).into(),
                ));
            }
        };
        Some((from.map(|at| at - allowance), to.map(|at| at + allowance)))
    }

    /// Returns the lower and upper z of the body, grown by an allowance in mm, over a point. Returns `None`
    /// beside the body and for bodies without a closed form. A block includes its lower sides and excludes
    /// its upper ones, so that columns on a boundary are not counted twice.
    pub(super) fn vertical_extent_at(&self, [x, y]: [f64; 2], allowance: f64) -> Option<[f64; 2]> {
        match self {
            Self::Block { .. } => {
                let ([x0, y0, z0], [x1, y1, z1]) = self.grown_bounds(allowance)?;
                ((x0..x1).contains(&x) && (y0..y1).contains(&y)).then_some([z0, z1])
            }
            Self::Cylinder { .. } => self.grown_cylinder(allowance)?.vertical_extent_at([x, y]),
            Self::Mesh(_) | Self::Remains(_) => None,
        }
    }

    /// Returns a cylinder grown by an allowance in mm in radius and at both ends, or `None` for other bodies.
    pub(super) fn grown_cylinder(&self, allowance: f64) -> Option<FiniteCylinder> {
        let Self::Cylinder { diameter, from, to } = self else { return None };
        let (from, to) = (Vector3::from(*from), Vector3::from(*to));
        let length = (to - from).norm();
        let axis = (to - from) / length;
        let radius = diameter / 2.0 + allowance;
        Some(FiniteCylinder { from: from - axis * allowance, axis, length: length + 2.0 * allowance, radius })
    }
}

/// Checks that all numbers are finite and not beyond [`FARTHEST`].
fn check_finite<'a>(mut values: impl Iterator<Item = &'a f64>) -> Result<(), StockError> {
    if values.all(|value| value.abs() <= FARTHEST) { Ok(()) } else { Err(StockError::NotFinite) }
}

/// Returns the box around the material of remains: the grid's in x and y, exact in z.
fn remains_bounds(dexels: &Dexels) -> Option<AxisBox> {
    let layout = dexels.grid();
    let (low, high) = dexels
        .bands()
        .iter()
        .flat_map(|band| (0..band.row_count() * band.columns).flat_map(|index| band.column_spans(index)))
        .fold((f32::INFINITY, f32::NEG_INFINITY), |(least, most), [low, top]| {
            (least.min(low), most.max(top))
        });
    let half = layout.cell_mm / 2.0;
    let [x0, y0] = layout.origin_mm.map(|at| at - half);
    let (x1, y1) = (x0 + layout.columns as f64 * layout.cell_mm, y0 + layout.rows as f64 * layout.cell_mm);
    let (z0, z1) = (layout.base_mm + f64::from(low), layout.base_mm + f64::from(high));
    (low < high).then_some(([x0, y0, z0], [x1, y1, z1]))
}

/// A cylinder: a point at the centre of one end, a unit vector along the axis, a length and a radius, in mm.
pub(super) struct FiniteCylinder {
    from: Vector3<f64>,
    axis: Vector3<f64>,
    length: f64,
    radius: f64,
}

/// The squared sine of the tilt below which a bar counts as vertical. It is far below what would move a wall
/// by the resolution of heights.
const UPRIGHT: f64 = 1e-24;

impl FiniteCylinder {
    /// Returns the z range in which the vertical line over a point is inside. The line must be both in the
    /// endless cylinder (a quadratic condition) and between the planes of the ends (a linear condition).
    pub(super) fn vertical_extent_at(&self, [x, y]: [f64; 2]) -> Option<[f64; 2]> {
        let across = Vector3::new(x - self.from.x, y - self.from.y, 0.0);
        // With t the height over `from`, the point is `along + t slope` along the axis.
        let (along, slope) = (across.dot(&self.axis), self.axis.z);
        let tilt = self.axis.x * self.axis.x + self.axis.y * self.axis.y;
        let outside = across.norm_squared() - along * along - self.radius * self.radius;
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        if tilt > UPRIGHT {
            // tilt t^2 - 2 along slope t + outside <= 0
            let half = along * slope;
            let squared = half * half - tilt * outside;
            if squared < 0.0 {
                return None;
            }
            let root = squared.sqrt();
            (low, high) = ((half - root) / tilt, (half + root) / tilt);
        } else if outside > 0.0 {
            return None;
        }
        // The ends: 0 <= along + t slope <= length.
        if slope == 0.0 {
            (0.0..=self.length).contains(&along).then_some(())?;
        } else {
            let (a, b) = (-along / slope, (self.length - along) / slope);
            (low, high) = (low.max(a.min(b)), high.min(a.max(b)));
        }
        (low < high).then_some([self.from.z + low, self.from.z + high])
    }
}

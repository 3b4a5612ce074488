//! The bodies that stock is made of, in closed form where they have one.

use super::{Dexels, Mesh, StockError};
use nalgebra::Vector3;
use std::sync::Arc;

/// Largest coordinate or length of a body, mm: far beyond any workpiece, and far from what `f32` heights cannot hold.
pub(super) const FARTHEST: f64 = 1e9;

/// One body; mm in the workpiece frame.
#[derive(Debug, Clone, PartialEq)]
pub enum SolidBody {
    /// A box along the axes.
    Block {
        /// Lower corner.
        from: [f64; 3],
        /// Upper corner.
        to: [f64; 3],
    },
    /// A bar along any line.
    Cylinder {
        /// Its diameter.
        diameter: f64,
        /// Centre of one end.
        from: [f64; 3],
        /// Centre of the other end.
        to: [f64; 3],
    },
    /// Any closed surface: a casting, a forging.
    Mesh(Arc<Mesh>),
    /// What an earlier program left.
    Remains(Arc<Dexels>),
}

/// A box along the axes: lower and upper corner.
pub(super) type AxisBox = ([f64; 3], [f64; 3]);

impl SolidBody {
    /// # Errors
    /// When a number is not finite or the body has no volume.
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

    /// The box around the body grown by an allowance; `None` for remains without material.
    pub(super) fn grown_bounds(&self, allowance: f64) -> Option<AxisBox> {
        let (from, to) = match self {
            Self::Block { from, to } => (*from, *to),
            Self::Mesh(mesh) => mesh.bounds(),
            Self::Remains(dexels) => remains_bounds(dexels)?,
            Self::Cylinder { .. } => {
                let bar = self.grown_cylinder(allowance)?;
                let other = bar.from + bar.axis * bar.length;
                let across = bar.axis.map(|part| bar.radius * (1.0 - part * part).max(0.0).sqrt());
                return Some((
                    (bar.from.inf(&other) - across).into(),
                    (bar.from.sup(&other) + across).into(),
                ));
            }
        };
        Some((from.map(|at| at - allowance), to.map(|at| at + allowance)))
    }

    /// Lower and upper end of the body, grown by an allowance, over a point; `None` beside it, and for bodies without closed form.
    /// A block has its lower sides and not its upper ones.
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

    /// A cylinder grown by an allowance: in radius, and at both ends.
    pub(super) fn grown_cylinder(&self, allowance: f64) -> Option<FiniteCylinder> {
        let Self::Cylinder { diameter, from, to } = self else { return None };
        let (from, to) = (Vector3::from(*from), Vector3::from(*to));
        let length = (to - from).norm();
        let axis = (to - from) / length;
        let radius = diameter / 2.0 + allowance;
        Some(FiniteCylinder { from: from - axis * allowance, axis, length: length + 2.0 * allowance, radius })
    }
}

fn check_finite<'a>(mut values: impl Iterator<Item = &'a f64>) -> Result<(), StockError> {
    if values.all(|value| value.abs() <= FARTHEST) { Ok(()) } else { Err(StockError::NotFinite) }
}

/// The box around the material of remains: the grid's in x and y, exact in z.
fn remains_bounds(dexels: &Dexels) -> Option<AxisBox> {
    let layout = dexels.grid();
    let (low, high) = dexels
        .bands()
        .iter()
        .flat_map(|band| (0..band.row_count() * band.columns).flat_map(|index| band.column_spans(index)))
        .fold((f32::INFINITY, f32::NEG_INFINITY), |(least, most), [low, top]| {
            (least.min(low), most.max(top))
        });
    let half = layout.cell / 2.0;
    let [x0, y0] = layout.origin.map(|at| at - half);
    let (x1, y1) = (x0 + layout.columns as f64 * layout.cell, y0 + layout.rows as f64 * layout.cell);
    let (z0, z1) = (layout.base + f64::from(low), layout.base + f64::from(high));
    (low < high).then_some(([x0, y0, z0], [x1, y1, z1]))
}

/// A cylinder: from a point along a unit vector.
pub(super) struct FiniteCylinder {
    from: Vector3<f64>,
    axis: Vector3<f64>,
    length: f64,
    radius: f64,
}

/// Squared sine of the tilt from which on a bar stands upright: far below what moves a wall by the resolution of heights.
const UPRIGHT: f64 = 1e-24;

impl FiniteCylinder {
    /// Where the line along z over a point is inside: both in the endless cylinder (a quadratic) and between the ends (linear).
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
        if slope == 0.0 {
            (0.0..=self.length).contains(&along).then_some(())?;
        } else {
            let (a, b) = (-along / slope, (self.length - along) / slope);
            (low, high) = (low.max(a.min(b)), high.min(a.max(b)));
        }
        (low < high).then_some([self.from.z + low, self.from.z + high])
    }
}

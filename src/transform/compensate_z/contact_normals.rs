//! This module moves points with contact normals: `Ps = Pc + R (n - a)` (Dragoi 2009), with the contact point
//! Pc, the ball's radius R, the outward normal n and the tool axis a.

use nalgebra::{Point3, Unit, Vector3};
use rstar::RTree;
use rstar::primitives::GeomWithData;

/// A contact point of a ball.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BallContact {
    /// The point on the part, in mm.
    pub point: Point3<f64>,
    /// The outward normal of the part there.
    pub normal: Unit<Vector3<f64>>,
    /// The tool axis, from the tip into the holder.
    pub axis: Unit<Vector3<f64>>,
}

/// A ball that cuts into another contact point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BallGouge {
    /// The index of the contact at which the ball stands.
    pub contact: usize,
    /// The index of the contact that it cuts into.
    pub neighbour: usize,
    /// The depth of the cut, in mm.
    pub depth_mm: f64,
}

impl BallContact {
    /// Returns the centre of a ball of `radius` mm that touches here.
    pub(super) fn ball_centre(&self, radius: f64) -> Point3<f64> {
        self.point + self.normal.into_inner() * radius
    }

    /// Returns the tip of that ball: `Pc + R (n - a)`.
    pub(super) fn ball_tip(&self, radius: f64) -> Point3<f64> {
        self.ball_centre(radius) - self.axis.into_inner() * radius
    }
}

/// Returns the balls that reach deeper than `tolerance` mm into the contact point nearest to their centre, in
/// the order of the contacts. No other point of the path can lie deeper in such a ball.
pub(crate) fn find_gouges(contacts: &[BallContact], radius: f64, tolerance: f64) -> Vec<BallGouge> {
    let points = contacts.iter().enumerate();
    let points = points.map(|(index, contact)| GeomWithData::new(tree_coordinates(contact.point), index));
    let tree = RTree::bulk_load(points.collect());
    let deepest = |(index, contact): (usize, &BallContact)| {
        let centre = contact.ball_centre(radius);
        let near = tree.nearest_neighbor(&tree_coordinates(centre))?;
        let neighbour = near.data;
        let depth = radius - (contacts.get(neighbour)?.point - centre).norm();
        (depth > tolerance).then_some(BallGouge { contact: index, neighbour, depth_mm: depth })
    };
    contacts.iter().enumerate().filter_map(deepest).collect()
}

fn tree_coordinates(point: Point3<f64>) -> [f64; 3] {
    point.coords.into()
}

//! Points with contact normals: each moves by its own, `Ps = Pc + R (n - a)`.

use nalgebra::{Point3, Unit, Vector3};
use rstar::RTree;
use rstar::primitives::GeomWithData;

/// A contact point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BallContact {
    /// The point of the part, mm.
    pub point: Point3<f64>,
    /// Its outward normal.
    pub normal: Unit<Vector3<f64>>,
    /// The tool axis.
    pub axis: Unit<Vector3<f64>>,
}

/// A ball that cuts into a neighbour's contact point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BallGouge {
    /// The contact whose ball does (its place in the list).
    pub contact: usize,
    /// The contact that it cuts into.
    pub neighbour: usize,
    /// How deep, mm.
    pub depth_mm: f64,
}

impl BallContact {
    /// Centre of a ball of `radius` mm that touches here.
    pub fn ball_centre(&self, radius: f64) -> Point3<f64> {
        self.point + self.normal.into_inner() * radius
    }

    /// Its tip: `Pc + R (n - a)`.
    pub fn ball_tip(&self, radius: f64) -> Point3<f64> {
        self.ball_centre(radius) - self.axis.into_inner() * radius
    }
}

/// Balls that reach deeper than `tolerance` mm into the contact point nearest to their centre, in the order of the contacts. No
/// other point of the path lies deeper in them.
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

//! The covered area from slices of time, for diagrams that are not resolved, and as a check of those that are.

use super::outline::{Cuts, outline};
use super::{Cover, Rim};
use crate::chips::family::Family;
use geo::{ConvexHull, MultiPoint};

/// Hulls of the sections at both ends of each slice.
pub(super) fn cover(family: &Family, rim: &Rim, slices: usize) -> Cover {
    let slices = slices.max(1);
    let section = |index: usize| outline(family, rim, index as f64 / slices as f64, Cuts::SEEN, &[]);
    let first = section(0);
    let mut last = first.clone();
    let mut advancing = Vec::new();
    for index in 1..=slices {
        let next = section(index);
        let points: Vec<geo::Point> =
            last.iter().chain(&next).map(|place| geo::Point::from(*place)).collect();
        // A section that comes or goes within the slice is taken to be there all through it.
        let hull = MultiPoint(points).convex_hull();
        let mut border: Vec<[f64; 2]> =
            hull.exterior().points().map(|point| [point.x(), point.y()]).collect();
        border.pop();
        if border.len() > 2 {
            advancing.push(border);
        }
        last = next;
    }
    Cover { first, last, advancing }
}

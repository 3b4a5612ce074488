//! Sweeps: the volume that a cutter passes through on one piece of its path, column by column.
//!
//! Three-axis sweeps are closed forms ([`straight`]): for a convex profile g that moves in a straight line, the lowest point
//! over a column is at the one contact where the profile's slope along the path equals the path's slope, and that place
//! depends only on the column's distance from the path ([`silhouette`]). Where the axis is not along z, each column asks for the
//! extremes of the solid's interval over time ([`tilted`]).

mod contact;
mod extent;
mod partial;
pub mod silhouette;
mod straight;
mod surface;
mod tilted;

pub(super) use partial::Partial;
pub(super) use straight::{Circumstances, Straight};
pub(super) use tilted::{Tilted, pace};

use crate::sim::Band;
use std::ops::Range;

/// A piece of the path made ready for any band of columns.
#[derive(Debug, Clone)]
pub(super) enum Sweep {
    /// Three-axis: the tool axis along z all the way.
    Straight(Box<Straight>),
    /// The tool axis in any direction, turning or not.
    Tilted(Box<Tilted>),
}

impl Sweep {
    /// Rows that it can change.
    pub fn rows(&self) -> Range<usize> {
        match self {
            Self::Straight(sweep) => sweep.rows(),
            Self::Tilted(sweep) => sweep.rows(),
        }
    }

    /// Removes what it passes through from a band.
    pub fn sweep(&self, band: &mut Band, scratch: &mut Vec<f32>) -> Partial {
        match self {
            Self::Straight(sweep) => sweep.sweep(band, scratch),
            Self::Tilted(sweep) => sweep.sweep(band),
        }
    }
}

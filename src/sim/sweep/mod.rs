//! Sweeps: the volume that a cutter passes through on one piece of its path, column by column.
//!
//! Three-axis sweeps are closed forms ([`straight`]): for a convex profile g that moves in a straight line, the lowest point
//! over a column is at the one contact where the profile's slope along the path equals the path's slope, and that place
//! depends only on the column's distance from the path ([`silhouette`]). Where the axis is not along z, each column asks for the
//! extremes of the solid's interval over time ([`tilted`]).

mod band_engagement;
mod cutter_underside;
pub mod silhouette;
mod straight;
mod straight_contact;
mod straight_footprint;
mod tilted;

pub(super) use band_engagement::BandEngagement;
pub(super) use straight::{StraightSweep, SweepContext};
pub(super) use tilted::{TiltedSweep, reference_length_mm};

use crate::sim::DexelBand;
use std::ops::Range;

/// A piece of the path made ready for any band of columns.
#[derive(Debug, Clone)]
pub(super) enum PieceSweep {
    /// Three-axis: the tool axis along z all the way.
    Straight(Box<StraightSweep>),
    /// The tool axis in any direction, turning or not.
    Tilted(Box<TiltedSweep>),
}

impl PieceSweep {
    /// Rows that it can change.
    pub fn row_range(&self) -> Range<usize> {
        match self {
            Self::Straight(sweep) => sweep.row_range(),
            Self::Tilted(sweep) => sweep.row_range(),
        }
    }

    /// Removes what it passes through from a band.
    pub fn sweep_band(&self, band: &mut DexelBand, scratch: &mut Vec<f32>) -> BandEngagement {
        match self {
            Self::Straight(sweep) => sweep.sweep_band(band, scratch),
            Self::Tilted(sweep) => sweep.sweep_band(band),
        }
    }
}

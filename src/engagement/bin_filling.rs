//! This module fills the bins between columns: directions in which the cutter is engaged although no column
//! lies there.
//!
//! Two columns that are one cell apart to the side are more than one bin apart, seen from the axis, where the
//! flank turns away from the feed. Forces need every direction. So an empty bin takes over the values of its
//! engaged neighbours where no column could have been in between.

use crate::engagement::engagement_bins::{BINS, Engagement, EngagementBin};
use std::f64::consts::{PI, TAU};

impl Engagement {
    /// Fills the bins of the front half that lie within a cell to the side of an engaged bin. `radius` is the
    /// cutter's radius where it is engaged widest, and `cell` is the distance of the columns, both in mm.
    pub(super) fn fill_empty_bins(&mut self, radius: f64, cell: f64) {
        if self.bins.len() != BINS || radius <= 0.0 {
            return;
        }
        // The lateral position of the boundary between two bins: sin(angle) times the radius.
        let edge = |border: usize| (border as f64 * TAU / BINS as f64 - PI).sin() * radius;
        let (front, end) = (BINS / 4, 3 * BINS / 4);
        let engaged: Vec<Option<EngagementBin>> =
            self.bins.iter().map(|bin| Some(*bin).filter(EngagementBin::is_engaged)).collect();
        let bin_at = |index: usize| Some((index, engaged.get(index).copied().flatten()?));
        for (index, bin) in self.bins.iter_mut().enumerate().take(end).skip(front) {
            if bin.is_engaged() {
                continue;
            }
            // A gap counts when it is not wider than a cell, measured across the path.
            let right =
                (front..index).rev().find_map(bin_at).filter(|(at, _)| edge(index) - edge(at + 1) <= cell);
            let left =
                (index + 1..end).find_map(bin_at).filter(|(at, _)| edge(*at) - edge(index + 1) <= cell);
            for (_, neighbour) in right.into_iter().chain(left) {
                bin.merge_bin(&neighbour);
            }
        }
    }
}

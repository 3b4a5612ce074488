//! Bins between columns: directions in which the cutter is engaged although no column lies there.
//!
//! Seen from the axis, columns one cell apart to the side are more than a bin apart where the flank turns away from the feed.
//! Forces need every direction, so an empty bin takes over from its engaged neighbours where no column could have told.

use super::engagement::{BINS, Engagement, EngagementBin};
use std::f64::consts::{PI, TAU};

impl Engagement {
    /// Fills bins of the front half that lie within a cell to the side of an engaged one. `radius` is the cutter's where it is
    /// engaged widest, `cell` the distance of columns, mm.
    pub(super) fn fill_empty_bins(&mut self, radius: f64, cell: f64) {
        if self.bins.len() != BINS || radius <= 0.0 {
            return;
        }
        let edge = |border: usize| (border as f64 * TAU / BINS as f64 - PI).sin() * radius;
        let (front, end) = (BINS / 4, 3 * BINS / 4);
        let engaged: Vec<Option<EngagementBin>> =
            self.bins.iter().map(|bin| Some(*bin).filter(EngagementBin::is_engaged)).collect();
        let bin_at = |index: usize| Some((index, engaged.get(index).copied().flatten()?));
        for (index, bin) in self.bins.iter_mut().enumerate().take(end).skip(front) {
            if bin.is_engaged() {
                continue;
            }
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

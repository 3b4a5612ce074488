//! What one band of columns contributes to the engagement of one piece.

use crate::sim::Engagement;
use crate::sim::engagement::{BINS, Bin, hull};
use std::f64::consts::{PI, TAU};

/// A contact of the cutter with removed material.
#[derive(Debug, Clone, Copy)]
pub(in crate::sim) struct Contact {
    /// Angle about the axis from the feed's direction, radians, left positive.
    pub angle: f32,
    /// Length along the meridian from the tip, mm.
    pub length: f32,
    /// `v.n / |v|`: best estimate, and not below what the grid may hide.
    pub share: f32,
    pub share_bound: f32,
    /// Radial part of the normal.
    pub radial: f32,
    /// Thickness of the removed material along the normal, mm.
    pub thickness: f32,
}

/// Sums and extremes over the columns of a band.
#[derive(Debug, Clone)]
pub(in crate::sim) struct Partial {
    /// Sum of removed heights, mm.
    pub removed: f64,
    pub lateral: [f32; 2],
    pub height: [f32; 2],
    pub graze: f32,
    pub contact: Option<(usize, f64)>,
    bins: Option<Box<[Bin; BINS]>>,
    /// Places of contacts (least and greatest rise, distance to the side) that dominate others.
    known: [[f64; 3]; KNOWN],
    next_known: usize,
}

/// Contacts that are kept to be compared with.
const KNOWN: usize = 4;

impl Partial {
    pub fn new() -> Self {
        Self {
            removed: 0.0,
            lateral: [f32::INFINITY, f32::NEG_INFINITY],
            height: [f32::INFINITY, f32::NEG_INFINITY],
            graze: 0.0,
            contact: None,
            bins: None,
            known: [[f64::INFINITY, f64::NEG_INFINITY, f64::INFINITY]; KNOWN],
            next_known: 0,
        }
    }

    /// Whether a contact is dominated by none of those known; then it becomes known itself.
    pub fn is_news(&mut self, [least, greatest, side]: [f64; 3]) -> bool {
        let dominates = |known: &[f64; 3]| known[0] <= least && known[1] >= greatest && known[2] <= side;
        if self.known.iter().any(dominates) {
            return false;
        }
        let worse = |known: &[f64; 3]| least <= known[0] && greatest >= known[1] && side <= known[2];
        let place = self.known.iter().position(worse).unwrap_or(self.next_known);
        if let Some(known) = self.known.get_mut(place) {
            *known = [least, greatest, side];
        }
        self.next_known = (place + 1) % KNOWN;
        true
    }

    /// Adds to the sums only.
    pub fn add_volume(&mut self, removed: f32, left: f32) {
        self.removed += f64::from(removed);
        self.lateral = hull(self.lateral, [left, left]);
    }

    /// Whether there is anything to tell.
    pub fn is_empty(&self) -> bool {
        self.removed <= 0.0 && self.graze <= 0.0 && self.contact.is_none()
    }

    pub fn add_column(&mut self, removed: f32, left: f32, height: [f32; 2]) {
        self.add_volume(removed, left);
        self.height = hull(self.height, height);
    }

    pub fn add(&mut self, contact: &Contact) {
        let bins = self.bins.get_or_insert_with(|| Box::new([Bin::EMPTY; BINS]));
        let turn = (f64::from(contact.angle) + PI) / TAU * BINS as f64;
        let index = (turn.max(0.0) as usize).min(BINS - 1);
        let Some(bin) = bins.get_mut(index) else { return };
        bin.low = bin.low.min(contact.length);
        bin.high = bin.high.max(contact.length);
        bin.thickness = bin.thickness.max(contact.thickness);
        bin.share_bound = bin.share_bound.max(contact.share_bound);
        if contact.share > bin.share {
            bin.share = contact.share;
            bin.radial = contact.radial;
        }
    }

    pub fn touch(&mut self, collar: usize, depth: f64) {
        if self.contact.is_none_or(|(_, known)| depth > known) {
            self.contact = Some((collar, depth));
        }
    }

    /// Adds itself to an engagement. `area` is that of a column, mm2; `half` half a cell.
    pub fn give(&self, engagement: &mut Engagement, area: f64, half: f64) {
        engagement.removed_mm3 += self.removed * area;
        if self.removed > 0.0 {
            let [least, greatest] = self.lateral.map(f64::from);
            engagement.lateral = hull(engagement.lateral, [least - half, greatest + half]);
            engagement.height = hull(engagement.height, self.height.map(f64::from));
        }
        engagement.graze = engagement.graze.max(f64::from(self.graze));
        if let Some((_, depth)) = self.contact
            && engagement.contact.is_none_or(|(_, known)| depth > known)
        {
            engagement.contact = self.contact;
        }
        let Some(mine) = &self.bins else { return };
        if engagement.bins.is_empty() {
            engagement.bins = mine.to_vec();
            return;
        }
        for (bin, mine) in engagement.bins.iter_mut().zip(mine.iter()) {
            bin.absorb(mine);
        }
    }
}

//! What one band of columns contributes to the engagement of one piece.

use crate::sim::Engagement;
use crate::sim::engagement::{BINS, EngagementBin, bin_index_at, interval_hull};

/// A contact of the cutter with removed material.
#[derive(Debug, Clone, Copy)]
pub(in crate::sim) struct BinContact {
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
pub(in crate::sim) struct BandEngagement {
    /// Sum of removed heights, mm.
    pub removed: f64,
    pub lateral: [f32; 2],
    pub height: [f32; 2],
    pub graze: f32,
    pub contact: Option<(usize, f64)>,
    bins: Option<Box<[EngagementBin; BINS]>>,
    known: [RememberedContact; KNOWN],
    next_known: usize,
}

/// Contacts that are kept to be compared with.
const KNOWN: usize = 4;

/// Contacts no further apart to the side than this (mm) are put together.
const ASIDE: f64 = 0.06;

/// Where a column's contacts lie across the path: from its least to its greatest rise, at a distance to the side, mm.
#[derive(Debug, Clone, Copy)]
pub(in crate::sim) struct CrossPathPosition {
    pub least: f64,
    pub greatest: f64,
    pub side: f64,
}

/// A contact that was looked at.
#[derive(Debug, Clone, Copy)]
struct RememberedContact {
    place: CrossPathPosition,
    /// Thickness along the normal over depth along the column.
    steepness: f64,
    bin: usize,
}

impl RememberedContact {
    const NONE: Self = Self {
        place: CrossPathPosition { least: f64::INFINITY, greatest: f64::NEG_INFINITY, side: f64::INFINITY },
        steepness: 0.0,
        bin: 0,
    };
}

impl BandEngagement {
    pub fn new() -> Self {
        Self {
            removed: 0.0,
            lateral: [f32::INFINITY, f32::NEG_INFINITY],
            height: [f32::INFINITY, f32::NEG_INFINITY],
            graze: 0.0,
            contact: None,
            bins: None,
            known: [RememberedContact::NONE; KNOWN],
            next_known: 0,
        }
    }

    /// Whether a contact is dominated by one that is known; the thickness of its material then counts where that one is.
    #[inline]
    pub fn is_dominated(&mut self, place: &CrossPathPosition, climbs: bool, depth: f64) -> bool {
        let dominates = |known: &&RememberedContact| {
            known.place.greatest >= place.greatest
                && known.place.side <= place.side
                && (climbs || known.place.least <= place.least)
        };
        let Some(known) = self.known.iter().find(dominates) else { return false };
        let bin = self.bins.as_mut().and_then(|bins| bins.get_mut(known.bin));
        if let Some(bin) = bin {
            bin.thickness = bin.thickness.max((depth * known.steepness) as f32);
        }
        true
    }

    /// Keeps a contact to be compared with: put together with one whose range of rise it continues, in place of one that it
    /// dominates, or of the oldest.
    pub fn remember_contact(&mut self, place: CrossPathPosition, climbs: bool, steepness: f64, angle: f32) {
        let touches = |known: &&mut RememberedContact| {
            climbs || (known.place.least <= place.greatest && known.place.greatest >= place.least)
        };
        let near = |known: &&mut RememberedContact| (known.place.side - place.side).abs() <= ASIDE;
        if let Some(known) = self.known.iter_mut().filter(near).find(touches) {
            known.place.least = known.place.least.min(place.least);
            known.place.greatest = known.place.greatest.max(place.greatest);
            known.place.side = known.place.side.max(place.side);
            known.steepness = known.steepness.max(steepness);
            return;
        }
        let worse = |known: &RememberedContact| {
            place.greatest >= known.place.greatest
                && place.side <= known.place.side
                && (climbs || place.least <= known.place.least)
        };
        let index = self.known.iter().position(worse).unwrap_or(self.next_known);
        if let Some(known) = self.known.get_mut(index) {
            *known = RememberedContact { place, steepness, bin: bin_index_at(f64::from(angle)) };
        }
        self.next_known = (index + 1) % KNOWN;
    }

    /// Adds to the sums only.
    #[inline]
    pub fn add_volume(&mut self, removed: f32, left: f32) {
        self.removed += f64::from(removed);
        self.lateral = interval_hull(self.lateral, [left, left]);
    }

    /// Whether there is anything to tell.
    pub fn is_empty(&self) -> bool {
        self.removed <= 0.0 && self.graze <= 0.0 && self.contact.is_none()
    }

    pub fn add_column(&mut self, removed: f32, left: f32, height: [f32; 2]) {
        self.add_volume(removed, left);
        self.height = interval_hull(self.height, height);
    }

    pub fn add_contact(&mut self, contact: &BinContact) {
        let bins = self.bins.get_or_insert_with(|| Box::new([EngagementBin::EMPTY; BINS]));
        let Some(bin) = bins.get_mut(bin_index_at(f64::from(contact.angle))) else { return };
        bin.merge_bin(&EngagementBin {
            low: contact.length,
            high: contact.length,
            share: contact.share,
            share_bound: contact.share_bound,
            radial: contact.radial,
            thickness: contact.thickness,
        });
    }

    pub fn record_collision(&mut self, collar: usize, depth: f64) {
        if self.contact.is_none_or(|(_, known)| depth > known) {
            self.contact = Some((collar, depth));
        }
    }

    /// Adds itself to an engagement. `area` is that of a column, mm2; `half` half a cell.
    pub fn add_to_engagement(&self, engagement: &mut Engagement, area: f64, half: f64) {
        engagement.removed_mm3 += self.removed * area;
        if self.removed > 0.0 {
            let [least, greatest] = self.lateral.map(f64::from);
            engagement.lateral = interval_hull(engagement.lateral, [least - half, greatest + half]);
            engagement.height = interval_hull(engagement.height, self.height.map(f64::from));
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
            bin.merge_bin(mine);
        }
    }
}
